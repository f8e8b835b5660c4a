"""What straps have to hold: static forces, and those of the straps that an object has."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess import STRAP_SHARE, ItemResult, MitigationKind, SolidResult, StrapForce
from shaketable.inventory import Item
from shaketable.language import number, tell
from shaketable.report.words.numbers import in_hundred, likely, two_digits
from shaketable.units import STANDARD_GRAVITY

HUNDRED = 100.0  # kg: for which the stiffness of a strap is told, and a force of an unknown mass
#: N: what a common fixing holds, a lag screw of 6 mm (1/4 in) with 50 mm (2 in) of thread in a stud
#: of specific gravity 0.50: W = 1800 G^1.5 D^0.75 = 225 lb/in (NDS 2018, equation 12.2-1 and table
#: 12.2A), times 1.6 for loads of seconds (table 2.3.2). A larger force is for an engineer.
FIXING = 3_200.0
LEAST_CODE_FORCE = 0.3  # of the weight: least F_p of ASCE 7-22, 13.3-3, with S_DS = 1 g and I_p = 1


def static_forces() -> str:
    """What must stand beside every static force."""
    return tell(
        "A static force is no design value: a simulated strap bears several times as much, as it "
        "stops what swings."
    )


def to_hold(kind: MitigationKind, result: ItemResult) -> StrapForce | None:
    """What a strap of a kind has to hold, over the weight; None where none was tried.

    The most that any stiffness and slack asks for beside a wall, where the anchor is. Where no wall
    was tried, to an anchor in the air.
    """
    tried = _forces(kind, result, walled=True) or _forces(kind, result, walled=False)
    return StrapForce(*(max(each) for each in zip(*tried, strict=True))) if tried else None


def _forces(kind: MitigationKind, result: ItemResult, walled: bool) -> list[StrapForce]:
    """Those of the straps of a kind that were tried beside a wall, or without one."""
    return [
        each.force
        for each in result.straps
        if each.force and each.kind is kind and each.to_a_post is not walled
    ]


def strap_forces(result: ItemResult) -> str:
    """What a strap bears beside a wall in STRAP_SHARE of the shakings (in all), over the weight."""
    held = to_hold(MitigationKind.STRAP, result) or to_hold(MitigationKind.TETHER, result)
    return f"{two_digits(held.high)} ({two_digits(held.largest)})" if held else "–"


def strong(item: Item, asked: StrapForce) -> str:
    """What hooks and anchors have to hold, in STRAP_SHARE of the shakings and in all, rounded up.

    Of an unknown mass over the weight, with an example.
    """
    high, largest = (
        _newtons(newtons_of(item, each), up=True) for each in (asked.high, asked.largest)
    )
    often = 100 * STRAP_SHARE
    if item.mass is not None:
        return tell(
            "{high} in {often:g} of 100 shakings, {largest} in all",
            high=high,
            often=often,
            largest=largest,
        )
    return tell(
        "{high} times its weight in {often:g} of 100 shakings, {largest} times in all "
        "({high_force} and {largest_force} if it weighs {mass:g} kg)",
        high=two_digits(asked.high, up=True),
        often=often,
        largest=two_digits(asked.largest, up=True),
        high_force=high,
        largest_force=largest,
        mass=HUNDRED,
    )


def newtons_of(item: Item, over_weight: float) -> float:
    """A force over the weight [N]; of HUNDRED where no mass is known."""
    return over_weight * (item.mass or HUNDRED) * STANDARD_GRAVITY


def in_newtons(item: Item, over_weight: float, up: bool = False) -> str:
    """A force over the weight in newtons, rounded up if so asked; "" where no mass is known."""
    return "" if item.mass is None else _newtons(newtons_of(item, over_weight), up)


def _newtons(force: float, up: bool = False) -> str:
    return f"{two_digits(force / 1e3, up)} kN" if force >= 1e3 else f"{two_digits(force, up)} N"


def borne(kind: MitigationKind, result: ItemResult) -> str:
    """What a strap bears, for which stiffness and slack: beside a wall, and without one."""
    told = []
    for walled, where in (
        (True, tell("beside a wall")),
        (False, tell("to a post or a ceiling, without a wall behind it")),
    ):
        if some := _forces(kind, result, walled):
            told.append(_most(result.item, max(each.high for each in some), where))
    tried = [each for each in result.straps if each.kind is kind]
    stiff = [each.about["stiffness_per_mass"] * HUNDRED / 1e3 for each in tried]
    slack = [1e3 * each.about["slack_m"] for each in tried]
    said = tell(
        "In {often:g} of 100 shakings the strap bears at most {told} (stiffness {stiff} kN/m for "
        "each {mass:g} kg, slack {slack} mm); hooks and walls were taken as unbreakable.",
        often=100 * STRAP_SHARE,
        told=tell(" and ").join(told),
        stiff=_range(stiff),
        mass=HUNDRED,
        slack=_range(slack),
    )
    return " ".join([said, *_without_a_wall(kind, result)])


def _without_a_wall(kind: MitigationKind, result: ItemResult) -> list[str]:
    """How often it falls in a strap with no wall behind it, where that is more often."""
    tried = [each for each in result.straps if each.kind is kind]
    posts = [each.left.value for each in tried if each.to_a_post]
    walled = [each.left.value for each in tried if not each.to_a_post]
    if not posts or not walled or max(posts) <= max(walled):
        return []
    often = in_hundred(max(posts))
    return [
        tell(
            "Without a wall behind it, it falls or only the strap holds it up in {often} of 100.",
            often=often,
        )
    ]


def _most(item: Item, over_weight: float, where: str) -> str:
    """The most that it bears somewhere."""
    newtons = in_newtons(item, over_weight)
    return tell(
        "{most} times its weight{newtons} {where}",
        most=two_digits(over_weight),
        newtons=f" ({newtons})" if newtons else "",
        where=where,
    )


def _range(values: Sequence[float]) -> str:
    low, high = number(min(values), "g"), number(max(values), "g")
    return low if low == high else tell("{low} to {high}", low=low, high=high)


def code_force(result: ItemResult) -> str:
    """What a strap at its top bears over the weight, by the least force of ASCE 7-22.

    LEAST_CODE_FORCE of the weight acts at the centre of gravity; about the nearer edge the strap
    takes what the weight does not: (0.3 h − b) / H, the larger of both directions. Where the
    weight alone holds, the code's force says nothing of a strap: a dash.
    """
    sides = [side.profile.body for side in (result, result.other) if side is not None]
    moment = max(LEAST_CODE_FORCE * body.cg_height - min(body.left, body.right) for body in sides)
    return two_digits(moment / result.item.height) if moment > 0.0 else "–"


def unbreakable(item: Item) -> str:
    """That a strap was, whose strength the list does not give."""
    straps = item.surroundings.straps if item.surroundings else ()
    if any(math.isinf(each.strength) for each in straps):
        return tell(", and so was the strap, whose strength the list does not give")
    return ""


def in_its_straps(item: Item, solid: SolidResult) -> str:
    """The force in the straps that it has, and how often they break."""
    held = solid.surrounded
    if held is None or held.force is None or held.broke is None:
        return ""
    if held.broke.value and item.mass is not None and item.surroundings:
        weakest = min(strap.strength for strap in item.surroundings.straps)
        return tell(
            "A strap breaks in {often} of 100 ({likely}), at {strength} N.",
            often=in_hundred(held.broke.value),
            likely=likely(held.broke),
            strength=two_digits(weakest),
        )
    return tell(
        "The force in its strap reaches {median} times its weight in half of the shakings, {high} "
        "times in {often} of 100 and {largest} times at most.",
        median=two_digits(held.force.median),
        high=two_digits(held.force.high),
        often=in_hundred(STRAP_SHARE),
        largest=two_digits(held.force.largest),
    )
