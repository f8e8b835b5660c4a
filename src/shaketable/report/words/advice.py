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
from shaketable.inventory import Castors
from shaketable.report.words.findings import SIDES
from shaketable.report.words.numbers import (
    distance,
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
    if result.item.castors is Castors.FREE:
        return _about_free_castors(result)
    sliding = result.on_support.sliding
    walks_off = sliding.walks_off if sliding else 0.0
    rim = ["Keep it on its support: a rim, a strap, a pad with more grip."]
    rim = rim if walks_off > ACCEPTED_FALLS else []
    tether = [_tether(result)] if result.item.castors is Castors.LOCKED else []
    if result.item.must_not_fall:
        return [_hold_always(result), *tether, *rim]
    said = [*([] if tether and not result.falls else [_hold(result)]), *tether, *rim]
    worst = max([result.fall.value, *(f.fall.value for f in result.frictions if result.differs(f))])
    if result.recordings < FEWEST_RECORDINGS or worst <= ACCEPTED_FALLS:
        return said
    move = "Or move it to where its fall hits nobody and blocks no way out."
    if tether:
        return [*said, "Or lower its centre of gravity: take weight off its top.", move]
    return [*said, _wider(result), move, _tilt(result, control)]


def first_measure(result: ItemResult) -> str:
    """The first thing to do, in a few words."""
    item = result.item
    if result.recordings < FEWEST_RECORDINGS:
        return "use more recordings"
    if item.castors is Castors.FREE:
        return "tether it"
    if item.castors is Castors.UNKNOWN:
        return "fill in column castors"
    if item.must_not_fall or result.fall.value > ACCEPTED_FALLS:
        return "anchor or strap it"
    if item.castors is Castors.LOCKED:
        return "tether it if it may hit"
    return "anchor it if a fall hurts"


def force_at_top(result: ItemResult) -> str:
    """The force that an anchor needs, in a few words; nothing where it needs none."""
    if not result.holds:
        return ""
    force = result.holds[0].largest if result.item.must_not_fall else result.holds[0].high
    if force == 0.0 or (result.item.rolls and not result.falls):
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
                f"Locked castors are no remedy: it then falls in {in_hundred(falls.value)} of 100."
            )
        else:
            said.append(
                "Lock its castors: in 90 of 100 of the shakings it then goes no farther than "
                f"{distance(far)}."
            )
    return said


def _tether(result: ItemResult) -> str:
    sliding = result.sliding
    far = sliding.reach if sliding else math.nan
    clear = (
        f", or keep {distance(far)} around it clear: in {100 * REACHED:g} of 100 it goes no farther"
        if far > SLIDES
        else ""
    )
    return f"Tether it to the wall or the bed while it stands there{clear}."


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
        f"{lower.height:.2f} m. A tilt, or a place where it may fall, is no measure here."
    )


def _hold(result: ItemResult) -> str:
    """Anchor or strap, with the force that this takes."""
    begin = (
        "Anchor it, or strap it to a wall."
        if result.fall.value > ACCEPTED_FALLS
        else "Anchor it where a fall would hurt somebody or stop work."
    )
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
        f"{lower.height:.2f} m, keeps it from lifting in {often}{half}."
    )


def _wider(result: ItemResult) -> str:
    """A wider base, in both directions where it falls often in both."""
    lower = "lower its centre of gravity, heavy things in the lowest drawers or shelves"
    sides = [_base(result)]
    if result.profile.alike:
        sides.append((sides[0][0], sides[0][1], WORDS[Direction.SIDE_TO_SIDE]))
    elif result.other is not None and result.falls_either_way:
        sides.append(_base(result.other))
    if any(math.isnan(safe) for safe, _, _ in sides):
        return f"No base up to {BASE_GRID[-1]:g} times as wide would be enough."
    wider = [(safe, now, word) for safe, now, word in sides if safe >= now + LEAST_WIDENING]
    if not wider:
        return f"Its base is at the limit: {lower}."
    base = " and ".join(f"{safe:.2f} m {word}" for safe, _, word in wider)
    now = " and ".join(f"{now:.2f} m" for _, now, _ in wider)
    return (
        f"Or give it a base {base} in place of {now}, or {lower}: on that base at most "
        f"{100 * ACCEPTED_FALLS:g} of 100 such shakings overturn it."
    )


def _base(result: ProfileResult) -> tuple[float, float, str]:
    """The safe base and the present one [m], and the word for its direction."""
    return result.safe_width, result.profile.body.width, WORDS[result.profile.direction]


def _tilt(result: ItemResult, control: float) -> str:
    curves, profile = result.curves, result.profile
    assert curves is not None
    if result.falls_either_way:
        return (
            "A tilt is no measure here: it chooses the side of falls along it, and this falls as "
            "well across it."
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
    return (
        f"Only where none of this can be done, choose the side: a tilt of {tilt_degrees(tilt)} "
        f"makes falls likelier, {then} in place of {now} of 100, but about {wanted} then go "
        f"{chosen}. The higher edge of its base is then {1000 * rise:.0f} mm above the other. The "
        f"tilt needed: {tilt_interval(curves)}."
    )
