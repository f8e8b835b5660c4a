"""What is said of an object on furniture, which was simulated as if it stood on the floor."""

from __future__ import annotations

from shaketable.assess import ItemResult, Share
from shaketable.language import tell
from shaketable.report.words.numbers import (
    in_hundred,
    in_hundred_short,
    two_digits,
    with_interval,
)


def first_sentence() -> str:
    """What stands before everything else that is said of it."""
    return tell("It stands on something that was not simulated. What falls may be more.")


def often(result: ItemResult, share: Share | None = None) -> str:
    """A share of an object in a table, its governing one by default: "25 (12–47)".

    Of what stands on furniture only what it is at least: "19 or more".
    """
    share = result.governing_share if share is None else share
    if not result.item.stands_on:
        return with_interval(share)
    return tell("{share} or more", share=in_hundred_short(share.value))


def what_happens(result: ItemResult) -> list[str]:
    """What is known of it, in sentences."""
    said = tell(
        "As if it stood on the floor, it falls in {often} of 100 of these shakings.",
        often=in_hundred(result.overturns.value),
    )
    return [f"{first_sentence()} {said}", *_of_landings(result)]


def _of_landings(result: ItemResult) -> list[str]:
    """What the landings of the furniture do to it, where that is in the list."""
    kick = result.kick
    if kick is None:
        return []
    does = tell("It rocks, too") if kick.rocks else tell("It does not rock by that")
    return [
        tell(
            "Each time that {carrier} rocks and lands, what stands in the middle of its top slides "
            "where its friction is below {friction}, and rocks where its half base is less than "
            "{slenderness} of the height of its centre of gravity. {does}: it has {own}.",
            carrier=kick.carrier,
            friction=two_digits(kick.friction),
            slenderness=two_digits(kick.slenderness),
            does=does,
            own=two_digits(kick.own),
        )
    ]


def what_to_do() -> list[str]:
    """What helps it, without a share, as none was simulated."""
    return [
        tell(
            "Hold what it stands on, and fix it to that, or put it on the floor. What that leaves "
            "was not simulated."
        )
    ]
