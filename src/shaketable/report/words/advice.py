"""What to do about one object, the best first."""

from __future__ import annotations

import math

from shaketable.assess import (
    ACCEPTED_FALLS,
    ANCHOR_SHARE,
    BASE_GRID,
    FEWEST_RECORDINGS,
    NOT_CLASSED,
    REACHED,
    Assessment,
    Direction,
    ItemResult,
    Premises,
    ProfileResult,
    SolidResult,
)
from shaketable.inventory import Castors, Item
from shaketable.language import number, tell, translated
from shaketable.report.words import carried, mitigation, straps
from shaketable.report.words.findings import SIDES
from shaketable.report.words.numbers import (
    at_most,
    in_hundred,
    tilt_degrees,
    tilt_interval,
)
from shaketable.tilting import FEWEST_FALLS, SLIDES, TILTS, shim_height
from shaketable.units import degrees

#: What a base is called that is long in a direction.
WORDS = {Direction.FRONT_TO_BACK: "deep", Direction.SIDE_TO_SIDE: "wide"}
NO_HELP = "nothing that was tried clearly helps"
LEAST_WIDENING = 0.005  # m: less is no measure


def what_to_do(result: ItemResult, assessment: Assessment) -> list[str]:
    """What helps: as it was simulated in three dimensions, or as a plane tells.

    Args:
        result: of an item.
        assessment: of which it is one.
    """
    item = result.item
    if result.by < FEWEST_RECORDINGS:
        more = tell(
            "Nothing is decided by so few motions: use {fewest} independent recordings or more.",
            fewest=FEWEST_RECORDINGS,
        )
        kept = tell("It must not fall: anchor it, by a force that these motions do not tell.")
        return [f"{kept} {more}" if item.must_not_fall else more]
    if item.stands_on:
        return carried.what_to_do()
    sliding = result.along_support.sliding
    rim = [tell("Keep it on its support: a rim, a strap, a pad with more grip.")]
    rim = rim if sliding and sliding.walks_off > 0.0 else []
    if result.solid is not None:
        return [*_as_simulated(result, result.solid, assessment.premises), *rim]
    return _in_a_plane(result, assessment.control, rim)


def _as_simulated(result: ItemResult, solid: SolidResult, premises: Premises) -> list[str]:
    """What was tried on it in three dimensions, and what its surroundings ask for."""
    item, worst = result.item, _worst(result)
    said = [tell("It must not fall.")] if item.must_not_fall else []
    said += _as_it_stands(result, solid)
    said += [mitigation.sentence(each, result, premises) for each in result.helpful]
    no_help = mitigation.of_no_help(result, premises)
    said += [no_help] if no_help else []
    if not result.mitigations and not (solid.surrounded and solid.surrounded.force):
        said.append(_not_tried(result))
    if worst > ACCEPTED_FALLS and not item.must_not_fall:
        said.append(tell("Or move it to where its fall hits nobody and blocks no way out."))
    return said


def _not_tried(result: ItemResult) -> str:
    """What is said of an object on which no measure was tried."""
    why = _why(result.item)
    if not result.before.value:
        if not (why or result.item.must_not_fall):
            return tell("Anchor it where a fall would hurt somebody or stop work.")
        reason = f" ({why})" if why else ""
        if _falls_where_it_slides(result):
            return tell(
                "Anchor it all the same{why}: with another friction some of these shakings "
                "overturn it.",
                why=reason,
            )
        return tell(
            "Anchor it all the same{why}: none of these shakings overturns it, and a stronger one "
            "may.",
            why=reason,
        )
    return tell(
        "Hold it, by a strap or an anchor. What helps how much was simulated for the objects that "
        "come first; shaketable assess --try all does it for every kind that falls."
    )


def _falls_where_it_slides(result: ItemResult) -> bool:
    """Whether it falls with some other friction."""
    tried = result.solid.frictions if result.solid else result.frictions
    return any(each.fall.value > 0.0 for each in tried)


def _in_a_plane(result: ItemResult, control: float, rim: list[str]) -> list[str]:
    """What a plane tells, where three dimensions are not known."""
    item = result.item
    if item.must_not_fall:
        return [_hold_always(result), *rim]
    if item.castors is Castors.FREE:
        return [*_about_free_castors(result), *rim]
    if not item.depth_known and result.fall.value <= ACCEPTED_FALLS:
        return [tell("Fill in depth_m, front to back: without it nothing is advised.")]
    tether = [_tether(result)] if item.castors is Castors.LOCKED else []
    said = [*rim, *([] if tether and not result.overturns.value else [_hold(result)]), *tether]
    if _worst(result) <= ACCEPTED_FALLS:
        return said
    move = tell("Or move it to where its fall hits nobody and blocks no way out.")
    if tether:
        lower = tell("Or lower its centre of gravity: take weight off its top.")
        return [*said, lower, move]
    return [*said, _wider(result), move, _tilt(result, control)]


def _worst(result: ItemResult) -> float:
    """The largest share of what falls or is held up alone, of all frictions that differ."""
    return max(each.value for each in result.shares)


def first_measure(result: ItemResult, premises: Premises) -> str:
    """The first thing to do, in a few words."""
    asked = _to_fill_in(result)
    if asked:
        return translated(asked)
    held = _first_as_it_stands(result)
    if held:
        return translated(held)
    if result.helpful:
        return mitigation.short(result.helpful[0], result.item, premises)
    if result.mitigations:  # none of them is a clear help, and none is advised
        return translated(NO_HELP if result.item.rolls else "anchor it")
    return translated(_first(result))


def _to_fill_in(result: ItemResult) -> str:
    """What the list lacks, without which nothing can be said; "" if nothing."""
    item = result.item
    if result.by < FEWEST_RECORDINGS:
        return "use more recordings"
    if item.must_not_fall:
        return ""
    if item.stands_on:
        return "hold what it stands on, and it"
    if item.castors is Castors.UNKNOWN:
        return "fill in column castors"
    if item.may_be_round and result.risk == NOT_CLASSED:
        return "fill in column shape"
    if not item.depth_known and _worst(result) <= ACCEPTED_FALLS:
        return "fill in column depth_m"
    return ""


def _first(result: ItemResult) -> str:
    item, sliding = result.item, result.along_support.sliding
    if item.must_not_fall:
        return "anchor or strap it"
    if item.castors is Castors.FREE:
        return "tether it"
    if _worst(result) > ACCEPTED_FALLS:
        return "anchor or strap it"
    if sliding and sliding.walks_off > 0.0:
        return "keep it on its support"
    if item.castors is Castors.LOCKED and not result.overturns.value:
        return "tether it" if _why(item) else "tether it if it could hit somebody"
    return "anchor it" if _why(item) else "anchor it if a fall hurts"


def _why(item: Item) -> str:
    """Why a fall of this object would matter, as its inventory says."""
    reasons = {
        "people are near it": item.people_nearby,
        "it would block a way out": item.blocks_exit,
        "its function is critical": item.critical > 0,
    }
    return tell(" and ").join(translated(reason) for reason, holds in reasons.items() if holds)


def _about_free_castors(result: ItemResult) -> list[str]:
    """What rolls freely: tether it, and whether locking it is any better."""
    said = [_tether(result)]
    if result.locked is not None and result.locked.sliding is not None:
        far, falls = result.locked.sliding.reach, result.locked.fall
        if falls.value > result.fall.value:
            said.append(
                tell(
                    "Under these motions locked castors are no remedy: where they hold, it falls "
                    "in {often} of 100.",
                    often=in_hundred(falls.value),
                )
            )
        else:
            said.append(
                tell(
                    "Lock its castors: in {reached:g} of 100 of these shakings it then goes no "
                    "farther than {far}, and under these motions it falls no more often, with any "
                    "friction that was tried.",
                    reached=100 * REACHED,
                    far=at_most(far),
                )
            )
    return said


def _tether(result: ItemResult) -> str:
    sliding = result.sliding
    far = sliding.reach if sliding else math.nan
    clear = ""
    if far > SLIDES:
        clear = tell(
            ", or keep {far} around it clear: in {reached:g} of 100 it goes no farther",
            far=at_most(far),
            reached=100 * REACHED,
        )
    return tell(
        "Tether it to the wall or the bed while it stands there, above its centre of gravity, as "
        "one that is stopped at its base may tip{clear}.",
        clear=clear,
    )


def _first_as_it_stands(result: ItemResult) -> str:
    """The first thing to do with what is held already, "" if that is what it is for all."""
    around, held = result.item.surroundings, result.as_it_stands
    if not (around and held and held.surrounded):
        return ""
    off = held.surrounded.off
    if off is not None and 2.0 * off.value > held.fall.value:
        return "move it back from the edge"
    if not around.straps:
        return ""
    if held.surrounded.broke and held.surrounded.broke.value:
        return "take a stronger strap"
    worst = _worst(result)
    sure = worst <= ACCEPTED_FALLS
    sure &= not (result.item.must_not_fall and worst > 0.0)
    return "keep it strapped" if sure else "hold it better"


def _over_the_edge(result: ItemResult) -> str:
    """What helps against going over the edge of its support; "" where it does not."""
    solid = result.as_it_stands
    off = solid.surrounded.off if solid and solid.surrounded else None
    if off is None or not off.value:
        return ""
    return tell(
        "Move it back from the edge of its support, or give that a rim: in {often} of 100 it goes "
        "over it.",
        often=in_hundred(off.value),
    )


def _as_it_stands(result: ItemResult, solid: SolidResult) -> list[str]:
    """What its surroundings ask for; nothing where it stands alone or beside a wall only."""
    item, held = result.item, solid.surrounded
    if held is None:
        return []
    over = _over_the_edge(result)
    said = [over] if over else []
    if held.force is None or held.broke is None:
        return said
    if held.broke.value:
        stronger = tell(
            "Take a stronger strap: this one breaks in {often} of 100.",
            often=in_hundred(held.broke.value),
        )
        return [*said, stronger]
    too_often = _worst(result) > (0.0 if item.must_not_fall else ACCEPTED_FALLS)
    if too_often:
        return [
            *said,
            tell("Hold it better: by a second strap, with less slack, or higher up."),
        ]
    return [
        *said,
        tell(
            "Keep it strapped: see that its strap, its hooks and what they are fastened to hold "
            "{strong}. Hooks and walls were taken as unbreakable{strap}.",
            strong=straps.strong(item, held.force),
            strap=straps.unbreakable(item),
        ),
    ]


def _hold_always(result: ItemResult) -> str:
    """What holds something that must not fall."""
    if result.anchor_forces[0].largest == 0.0:
        return tell(
            "It must not fall: anchor it. None of these motions lifts it, and a stronger one may."
        )
    return tell(
        "It must not fall: anchor or strap it near its top. What a strap must bear was not "
        "simulated. A tilt, or a place where it may fall, is no measure here."
    )


def _hold(result: ItemResult) -> str:
    """Anchor or strap."""
    why = _why(result.item)
    begin = tell("Anchor it where a fall would hurt somebody or stop work.")
    if _worst(result) > ACCEPTED_FALLS:
        begin = tell("Anchor it, or strap it to a wall.")
    elif why:
        begin = tell("Anchor it: {why}.", why=why)
    if result.anchor_forces[0].high == 0.0:
        often = 100 * ANCHOR_SHARE
        return begin + tell(
            " In {often:g} of 100 of these motions it does not begin to rock.", often=often
        )
    return begin + tell(" What a strap must bear was not simulated.")


def _wider(result: ItemResult) -> str:
    """A wider base, in both directions where it falls often in both."""
    lower = tell("lower its centre of gravity, heavy things in the lowest drawers or shelves")
    sides = [_base(result)]
    if result.profile.alike:
        sides.append((sides[0][0], sides[0][1], WORDS[Direction.SIDE_TO_SIDE]))
    elif result.other is not None and result.falls_either_way:
        sides.append(_base(result.other))
    if any(math.isnan(safe) for safe, _, _ in sides):
        return tell("No base up to {most:g} times as wide would be enough.", most=BASE_GRID[-1])
    wider = [(safe, now, word) for safe, now, word in sides if safe >= now + LEAST_WIDENING]
    if not wider:
        return tell("Its base is at the limit: {lower}.", lower=lower)
    return tell(
        "Or give it a base {base} in place of {now}, or {lower}: on that base at most {accepted:g} "
        "of 100 such shakings overturn it.",
        base=tell(" and ").join(
            tell("{size:.2f} m {long}", size=safe, long=translated(word)) for safe, _, word in wider
        ),
        now=tell(" and ").join(f"{number(now, '.2f')} m" for _, now, _ in wider),
        lower=lower,
        accepted=100 * ACCEPTED_FALLS,
    )


def safe_base(result: ItemResult) -> str:
    """The base on which few fall [m]: both sizes, the depth first, where it falls both ways."""
    if result.profile.alike:
        return f"{mitigation.metres(result.safe_base)}×{mitigation.metres(result.safe_base)}"
    if result.other is not None and result.falls_either_way:
        sides = sorted((result, result.other), key=lambda side: side.profile.direction)
        return "×".join(mitigation.metres(side.safe_base) for side in sides)
    return mitigation.metres(result.safe_base)


def _base(result: ProfileResult) -> tuple[float, float, str]:
    """The safe base and the present one [m], and the word for its direction."""
    return result.safe_base, result.profile.body.base, WORDS[result.profile.direction]


def _tilt(result: ItemResult, control: float) -> str:
    curves, profile = result.curves, result.profile
    assert curves is not None
    if result.falls_either_way:
        return tell(
            "A tilt is no measure here: it is made for falls along it, and this falls as well "
            "across it."
        )
    tilt, wanted = curves.control_tilt, 100 * control
    toward = translated(SIDES[profile.direction][0])
    if not math.isfinite(tilt):
        return tell(
            "No tilt up to {most:g}° was found that sends {wanted:g} of 100 falls one way, with "
            "{fewest} falls or more at the neighbouring tilts to tell.",
            most=degrees(TILTS[-1]),
            wanted=wanted,
            fewest=FEWEST_FALLS,
        )
    if tilt <= profile.tilt or tilt == 0.0:
        return tell(
            "As it stands, {wanted:g} of 100 falls or more already go {toward}.",
            wanted=wanted,
            toward=toward,
        )
    chosen = tell("to the side that is lower, whichever you choose")
    if profile.body.left != profile.body.right:
        chosen = tell("{toward}; turned round, it needs another tilt", toward=toward)
    now, then = in_hundred(result.fall.value), in_hundred(curves.fall_share_there)
    cost = tell("leaves {then} falls in 100, {now} without it, and", then=then, now=now)
    if curves.fall_share_there > result.fall.value:
        cost = tell(
            "makes falls likelier, {then} in place of {now} of 100, but", then=then, now=now
        )
    return tell(
        "Only where none of this can be done, choose the side: a tilt of {tilt} {cost} about "
        "{wanted:g} of 100 falls then go {chosen}. The higher edge of its base is then {rise:.0f} "
        "mm above the other. The tilt needed: {sure}.",
        tilt=tilt_degrees(tilt),
        cost=cost,
        wanted=wanted,
        chosen=chosen,
        rise=1000 * shim_height(profile.body.base, tilt),
        sure=tilt_interval(curves),
    )
