"""What to do about one object, the surest first."""

from __future__ import annotations

import math

from shaketable.assess import (
    ACCEPTED_FALLS,
    ANCHOR_SHARE,
    BASE_GRID,
    FEWEST_RECORDINGS,
    NOT_CLASSED,
    REACHED,
    Direction,
    ItemResult,
    ProfileResult,
    SolidResult,
)
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.language import number, tell, translated
from shaketable.report.words import straps
from shaketable.report.words.findings import SIDES
from shaketable.report.words.numbers import (
    at_most,
    in_hundred,
    tilt_degrees,
    tilt_interval,
    two_digits,
)
from shaketable.tilting import FEWEST_FALLS, SLIDES, TILTS, shim_height
from shaketable.units import degrees

#: What a base is called that is long in a direction.
WORDS = {Direction.FRONT_TO_BACK: "deep", Direction.SIDE_TO_SIDE: "wide"}
LEAST_WIDENING = 0.005  # m: less is no measure


def what_to_do(result: ItemResult, control: float) -> list[str]:
    """What helps: hold it, give it a wider base, move it, and only then tilt it.

    Args:
        result: of an item.
        control: wanted share of the falls that go downhill.
    """
    item = result.item
    if result.recordings < FEWEST_RECORDINGS:
        kept = tell("It must not fall: anchor it, by a force that these motions do not tell.")
        more = tell(
            "Nothing is decided by so few motions: use {fewest} independent recordings or more.",
            fewest=FEWEST_RECORDINGS,
        )
        return [f"{kept} {more}" if item.must_not_fall else more]
    sliding = result.along_support.sliding
    over = result.as_it_stands and result.as_it_stands.surrounded and _over_the_edge(result)
    rim = [tell("Keep it on its support: a rim, a strap, a pad with more grip.")]
    rim = rim if sliding and sliding.walks_off > 0.0 else []
    around = item.surroundings
    if result.as_it_stands is not None and around and not (item.rolls and not around.straps):
        return [*_as_it_stands(result, result.as_it_stands), *rim]
    if item.must_not_fall:
        return [_hold_always(result), *rim]
    if result.as_it_stands is not None and item.rolls:
        return [*([over] if over else []), _tether(result), *rim]
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
    """The largest share of falls, of all frictions that make a difference.

    In surroundings leaning counts, as it is no place to stand under.
    """
    if result.as_it_stands is not None:
        return max(each.value for each in result.as_it_stands.shares)
    other = (each.fall.value for each in result.frictions if result.differs(each))
    return max(result.overturns.value, *other, 0.0)


def first_measure(result: ItemResult) -> str:
    """The first thing to do, in a few words."""
    return translated(_first(result))


def _first(result: ItemResult) -> str:
    item, sliding = result.item, result.along_support.sliding
    if result.recordings < FEWEST_RECORDINGS:
        return "use more recordings"
    held = _first_as_it_stands(result)
    if item.must_not_fall and not held:
        return "anchor or strap it"
    if item.castors is Castors.UNKNOWN and not item.must_not_fall:
        return "fill in column castors"
    if item.may_be_round and result.risk == NOT_CLASSED and not item.must_not_fall:
        return "fill in column shape"
    if held:
        return held
    if not item.depth_known and _worst(result) <= ACCEPTED_FALLS:
        return "fill in column depth_m"
    if item.castors is Castors.FREE:
        return "tether it"
    if _worst(result) > ACCEPTED_FALLS:
        return "anchor or strap it"
    if sliding and sliding.walks_off > 0.0:
        return "keep it on its support"
    if item.castors is Castors.LOCKED and not result.overturns.value:
        return "tether it if it may hit"
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
    # how far it goes is known of the object alone
    far = sliding.reach if sliding and result.as_it_stands is None else math.nan
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
    sure = worst <= ACCEPTED_FALLS and not result.moves_on
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
    """What helps where it stands in its surroundings."""
    item, held = result.item, solid.surrounded
    assert held is not None
    over = _over_the_edge(result)
    said = [over] if over else []
    move = tell("Or move it to where its fall hits nobody and blocks no way out.")
    after = [move] if _worst(result) > ACCEPTED_FALLS and not item.must_not_fall else []
    if held.force is None or held.broke is None:
        return [*said, _hold_always(result) if item.must_not_fall else _hold(result), *after]
    if held.broke.value:
        stronger = tell("Take a stronger strap: this one breaks in {often} of 100.",
                        often=in_hundred(held.broke.value))  # fmt: skip
        return [*said, stronger + straps.in_a_strap(result), *after]
    if after or result.moves_on or (item.must_not_fall and _worst(result)):
        more = tell("Hold it better: by a second strap, with less slack, or higher up.")
        return [*said, more, *after]
    return [
        *said,
        tell(
            "Keep it strapped: see that its strap, its hooks and what they are fastened to hold "
            "{most} times its weight{newtons}, the largest force of these shakings. Hooks and "
            "walls were taken as unbreakable{strap}.",
            most=two_digits(held.force.largest),
            newtons=straps.in_newtons(item, held.force.largest),
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
        "It must not fall: anchor or strap it near its top.{strap} A tilt, or a place where it may "
        "fall, is no measure here.",
        strap=straps.in_a_strap(result),
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
    return begin + straps.in_a_strap(result)


def _wider(result: ItemResult) -> str:
    """A wider base, in both directions where it falls often in both."""
    lower = tell("lower its centre of gravity, heavy things in the lowest drawers or shelves")
    solid = result.governing_3d
    if solid and solid.fall.value > ACCEPTED_FALLS and result.item.shape is BaseShape.CYLINDER:
        return tell(
            "No wider base was tried in three dimensions, where what is round falls more easily "
            "than in a plane: hold it."
        )
    sides = [_base(result)]
    if result.profile.alike:
        sides.append((sides[0][0], sides[0][1], WORDS[Direction.SIDE_TO_SIDE]))
    elif result.other is not None and result.falls_either_way:
        sides.append(_base(result.other))
    if any(math.isnan(safe) for safe, _, _ in sides):
        return tell("No base up to {most:g} times as wide would be enough.", most=BASE_GRID[-1])
    wider = [(safe, now, word) for safe, now, word in sides if safe >= now + LEAST_WIDENING]
    if not wider and solid and solid.fall.value > ACCEPTED_FALLS:
        return tell(
            "Shaken in one direction at a time its base would do; in both at once it does not: "
            "{lower}.",
            lower=lower,
        )
    if not wider:
        return tell("Its base is at the limit: {lower}.", lower=lower)
    both = ""
    if solid:
        both = tell(", one direction at a time; both at once may overturn it more often")
    return tell(
        "Or give it a base {base} in place of {now}, or {lower}: on that base at most {accepted:g} "
        "of 100 such shakings overturn it{both}.",
        base=tell(" and ").join(
            tell("{size:.2f} m {long}", size=safe, long=translated(word)) for safe, _, word in wider
        ),
        now=tell(" and ").join(f"{number(now, '.2f')} m" for _, now, _ in wider),
        lower=lower,
        accepted=100 * ACCEPTED_FALLS,
        both=both,
    )


def safe_base(result: ItemResult) -> str:
    """The base on which few fall [m]: both sizes, the depth first, where it falls both ways.

    A dash where a plane's base does not do in three dimensions, in which none was sought.
    """
    if not result.base_holds_in_space:
        return "–"
    if result.profile.alike:
        return f"{_metres(result.safe_width)}×{_metres(result.safe_width)}"
    if result.other is not None and result.falls_either_way:
        sides = sorted((result, result.other), key=lambda side: side.profile.direction)
        return "×".join(_metres(side.safe_width) for side in sides)
    return _metres(result.safe_width)


def _metres(length: float) -> str:
    return "–" if math.isnan(length) else number(length, ".2f")


def _base(result: ProfileResult) -> tuple[float, float, str]:
    """The safe base and the present one [m], and the word for its direction."""
    return result.safe_width, result.profile.body.width, WORDS[result.profile.direction]


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
        rise=1000 * shim_height(profile.body.width, tilt),
        sure=tilt_interval(curves),
    )
