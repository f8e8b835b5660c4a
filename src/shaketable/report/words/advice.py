"""What to do about one object, the surest first."""

from __future__ import annotations

import math

from shaketable.assess import (
    ACCEPTED_FALLS,
    ANCHOR_SHARE,
    BASE_GRID,
    FEWEST_RECORDINGS,
    REACHED,
    Direction,
    ItemResult,
    ProfileResult,
)
from shaketable.inventory import Castors, Item, Shape
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
        kept = "It must not fall: anchor it, by a force that these motions do not tell. "
        return [
            f"{kept if item.must_not_fall else ''}Nothing is decided by so few motions: use "
            f"{FEWEST_RECORDINGS} independent recordings or more."
        ]
    sliding = result.on_support.sliding
    rim = ["Keep it on its support: a rim, a strap, a pad with more grip."]
    rim = rim if sliding and sliding.walks_off > 0.0 else []
    if item.must_not_fall:
        return [_hold_always(result), *rim]
    if item.castors is Castors.FREE:
        return [*_about_free_castors(result), *rim]
    if not item.depth_known and result.fall.value <= ACCEPTED_FALLS:
        return ["Fill in depth_m, front to back: without it nothing is advised."]
    tether = [_tether(result)] if item.castors is Castors.LOCKED else []
    said = [*rim, *([] if tether and not result.overturns.value else [_hold(result)]), *tether]
    if _worst(result) <= ACCEPTED_FALLS:
        return said
    move = "Or move it to where its fall hits nobody and blocks no way out."
    if tether:
        return [*said, "Or lower its centre of gravity: take weight off its top.", move]
    return [*said, _wider(result), move, _tilt(result, control)]


def _worst(result: ItemResult) -> float:
    """The largest share of falls, of all frictions that make a difference."""
    other = (each.fall.value for each in result.frictions if result.differs(each))
    return max(result.overturns.value, *other, 0.0)


def first_measure(result: ItemResult) -> str:
    """The first thing to do, in a few words."""
    item, sliding = result.item, result.on_support.sliding
    if result.recordings < FEWEST_RECORDINGS:
        return "use more recordings"
    if item.must_not_fall:
        return "anchor or strap it"
    if item.castors is Castors.UNKNOWN:
        return "fill in column castors"
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
    return " and ".join(reason for reason, holds in reasons.items() if holds)


def force_at_top(result: ItemResult) -> str:
    """The force that an anchor needs, in a few words; nothing where it needs none."""
    if not result.holds:
        return ""
    force = result.holds[0].largest if result.item.must_not_fall else result.holds[0].high
    idle = result.item.rolls and not (result.overturns.value or result.item.must_not_fall)
    if force == 0.0 or idle or not (result.item.depth_known or result.overturns.value):
        return ""
    if result.item.mass is None:
        return f"{two_digits(force)} N/kg at its top"
    return f"{two_digits(force * result.item.mass)} N at its top"


def _about_free_castors(result: ItemResult) -> list[str]:
    """What rolls freely: tether it, and whether locking it is any better."""
    said = [_tether(result)]
    if result.locked is not None and result.locked.sliding is not None:
        far, falls = result.locked.sliding.reach, result.locked.fall
        if falls.value > result.fall.value:
            said.append(
                f"Locked castors are no remedy: where they hold, it falls in "
                f"{in_hundred(falls.value)} of 100."
            )
        else:
            said.append(
                f"Lock its castors: in {100 * REACHED:g} of 100 of the shakings it then goes no "
                f"farther than {at_most(far)}, and it falls no more often, with any friction that "
                "was tried."
            )
    return said


def _tether(result: ItemResult) -> str:
    sliding = result.sliding
    far = sliding.reach if sliding else math.nan
    clear = (
        f", or keep {at_most(far)} around it clear: in {100 * REACHED:g} of 100 it goes no farther"
        if far > SLIDES
        else ""
    )
    return (
        "Tether it to the wall or the bed while it stands there, above its centre of gravity, as "
        f"one that is stopped at its base may tip{clear}."
    )


def _hold_always(result: ItemResult) -> str:
    """What holds something that must not fall: the force of the strongest of all motions."""
    top, lower = result.holds
    if top.largest == 0.0:
        return (
            "It must not fall: anchor it. None of these motions lifts it, and a stronger one may."
        )
    mass, unit = (1.0, "N per kilogram") if result.item.mass is None else (result.item.mass, "N")
    strong = [two_digits(mass * hold.largest) for hold in (top, lower)]
    return (
        f"It must not fall: anchor or strap it. In the strongest of these motions that takes a "
        f"horizontal force of {strong[0]} {unit} at its top, or {strong[1]} {unit} at "
        f"{lower.height:.2f} m{_one_at_a_time(result)}. A tilt, or a place where it may fall, is "
        "no measure here."
    )


def _hold(result: ItemResult) -> str:
    """Anchor or strap, with the force that this takes."""
    why = _why(result.item)
    begin = "Anchor it where a fall would hurt somebody or stop work."
    if _worst(result) > ACCEPTED_FALLS:
        begin = "Anchor it, or strap it to a wall."
    elif why:
        begin = f"Anchor it: {why}."
    top, lower = result.holds
    often = f"{100 * ANCHOR_SHARE:g} of 100 of these motions"
    if top.high == 0.0:
        return f"{begin} In {often} it does not begin to rock."
    mass, unit = (1.0, "N per kilogram") if result.item.mass is None else (result.item.mass, "N")
    strong = [two_digits(mass * hold.high) for hold in (top, lower)]
    middle = [two_digits(mass * hold.median) for hold in (top, lower)]
    half = f" ({middle[0]} or {middle[1]} {unit} in half of them)" if top.median else ""
    return (
        f"{begin} A horizontal force of {strong[0]} {unit} at its top, or {strong[1]} {unit} at "
        f"{lower.height:.2f} m, keeps it from lifting in {often}{half}{_one_at_a_time(result)}."
    )


def _one_at_a_time(result: ItemResult) -> str:
    """What a force leaves out, where both directions of shaking are known."""
    return ", in one direction at a time: both at once may take more" if result.decisive else ""


def _wider(result: ItemResult) -> str:
    """A wider base, in both directions where it falls often in both."""
    lower = "lower its centre of gravity, heavy things in the lowest drawers or shelves"
    solid = result.decisive
    if solid and solid.fall.value > ACCEPTED_FALLS and result.item.shape is Shape.CYLINDER:
        return (
            "No wider base was tried in three dimensions, where what is round falls more easily "
            "than in a plane: hold it."
        )
    sides = [_base(result)]
    if result.profile.alike:
        sides.append((sides[0][0], sides[0][1], WORDS[Direction.SIDE_TO_SIDE]))
    elif result.other is not None and result.falls_either_way:
        sides.append(_base(result.other))
    if any(math.isnan(safe) for safe, _, _ in sides):
        return f"No base up to {BASE_GRID[-1]:g} times as wide would be enough."
    wider = [(safe, now, word) for safe, now, word in sides if safe >= now + LEAST_WIDENING]
    if not wider and solid and solid.fall.value > ACCEPTED_FALLS:
        return (
            "Shaken in one direction at a time its base would do; in both at once it does not: "
            f"{lower}."
        )
    if not wider:
        return f"Its base is at the limit: {lower}."
    base = " and ".join(f"{safe:.2f} m {word}" for safe, _, word in wider)
    now = " and ".join(f"{now:.2f} m" for _, now, _ in wider)
    return (
        f"Or give it a base {base} in place of {now}, or {lower}: on that base at most "
        f"{100 * ACCEPTED_FALLS:g} of 100 such shakings overturn it"
        f"{', one direction at a time; both at once may overturn it more often' if solid else ''}."
    )


def safe_base(result: ItemResult) -> str:
    """The base on which few fall [m]: both sizes, the depth first, where it falls both ways.

    A dash for what is round and falls more often in three dimensions, where none was sought.
    """
    if result.decisive and result.item.shape is Shape.CYLINDER:
        return "–"
    if result.profile.alike:
        return f"{_metres(result.safe_width)}×{_metres(result.safe_width)}"
    if result.other is not None and result.falls_either_way:
        sides = sorted((result, result.other), key=lambda side: side.profile.direction)
        return "×".join(_metres(side.safe_width) for side in sides)
    return _metres(result.safe_width)


def _metres(length: float) -> str:
    return "–" if math.isnan(length) else f"{length:.2f}"


def _base(result: ProfileResult) -> tuple[float, float, str]:
    """The safe base and the present one [m], and the word for its direction."""
    return result.safe_width, result.profile.body.width, WORDS[result.profile.direction]


def _tilt(result: ItemResult, control: float) -> str:
    curves, profile = result.curves, result.profile
    assert curves is not None
    if result.falls_either_way:
        return (
            "A tilt is no measure here: it is made for falls along it, and this falls as well "
            "across it."
        )
    tilt = curves.control_tilt
    wanted = f"{100 * control:g} of 100 falls"
    toward = SIDES[profile.direction][0]
    if not math.isfinite(tilt):
        return (
            f"No tilt up to {degrees(TILTS[-1]):g}° was found that sends {wanted} one way, with "
            f"{FEWEST_FALLS} falls or more at the neighbouring tilts to tell."
        )
    if tilt <= profile.tilt or tilt == 0.0:
        return f"As it stands, {wanted} or more already go {toward}."
    chosen = "to the side that is lower, whichever you choose"
    if profile.body.left != profile.body.right:
        chosen = f"{toward}; turned round, it needs another tilt"
    rise = shim_height(profile.body.width, tilt)
    now, then = in_hundred(result.fall.value), in_hundred(curves.fall_share_there)
    likelier = curves.fall_share_there > result.fall.value
    cost = f"makes falls likelier, {then} in place of {now} of 100, but" if likelier else (
        f"leaves {then} falls in 100, {now} without it, and"
    )  # fmt: skip
    return (
        f"Only where none of this can be done, choose the side: a tilt of {tilt_degrees(tilt)} "
        f"{cost} about {wanted} then go "
        f"{chosen}. The higher edge of its base is then {1000 * rise:.0f} mm above the other. The "
        f"tilt needed: {tilt_interval(curves)}."
    )
