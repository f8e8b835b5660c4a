"""What to do about one object, the surest first."""

from __future__ import annotations

import math

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    FEWEST_RECORDINGS,
    HIGH,
    Direction,
    ItemResult,
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

LEAST_WIDENING = 0.005  # m: less is no measure


def what_to_do(result: ItemResult, control: float) -> list[str]:
    """What helps: hold it, give it a wider base, move it, and only then tilt it.

    Args:
        result: of an item.
        control: wanted share of the falls that go downhill.
    """
    if result.item.rolls:
        return _about_castors(result)
    walks_off = result.sliding.walks_off if result.sliding else 0.0
    rim = ["Keep it on its support: a rim, a strap, a pad with more grip."]
    rim = rim if walks_off > ACCEPTED_FALLS else []
    said = [_hold(result), *rim]
    worst = max([result.fall.value, *(f.fall.value for f in result.frictions if result.differs(f))])
    if result.recordings < FEWEST_RECORDINGS or worst <= ACCEPTED_FALLS:
        return said
    said += [_wider(result), "Or move it to where its fall hits nobody and blocks no way out."]
    if result.item.must_not_fall:
        return [*said, "A tilt is no measure here: it must not fall, whichever way."]
    return [*said, _tilt(result, control)]


def first_measure(result: ItemResult) -> str:
    """The first thing to do, in a few words."""
    item = result.item
    if item.castors is Castors.FREE:
        return "tether it"
    if item.castors is Castors.LOCKED:
        return "tether it if it may hit"
    if item.castors is Castors.UNKNOWN:
        return "say: on castors?"
    if result.recordings < FEWEST_RECORDINGS:
        return "use more recordings"
    if item.must_not_fall or result.fall.value > ACCEPTED_FALLS:
        return "anchor or strap it"
    return "anchor it if a fall hurts"


def force_at_top(result: ItemResult) -> str:
    """The force that an anchor needs, in a few words; nothing where it needs none."""
    if not result.holds or result.holds[0].high == 0.0:
        return ""
    force = result.holds[0].high
    if result.item.mass is None:
        return f"{two_digits(force)} N per kilogram at its top"
    return f"{two_digits(force * result.item.mass)} N at its top"


def _about_castors(result: ItemResult) -> list[str]:
    sliding = result.sliding
    far = sliding.slip.upper if sliding else math.nan
    clear = (
        f", or keep {distance(far)} around it clear: in a quarter of the shakings it goes that far "
        "or farther"
        if far > SLIDES
        else ""
    )
    lower = ["It may fall: take weight off its top."] if result.falls else []
    if result.item.castors is Castors.FREE:
        return [
            f"Tether it to the wall or the bed while it stands there{clear}.",
            "Lock its castors: say 'locked' in the inventory to see how far it then goes.",
            *lower,
        ]
    return [f"Tether it where it may hit somebody or block a way out{clear}.", *lower]


def _hold(result: ItemResult) -> str:
    """Anchor or strap, with the force that this takes."""
    begin = (
        "Anchor it, or strap it to a wall."
        if result.fall.value > ACCEPTED_FALLS or result.item.must_not_fall
        else "Anchor it where a fall would hurt somebody or stop work."
    )
    top, lower = result.holds
    often = f"{100 * HIGH:g} of 100 of these motions"
    if top.high == 0.0:
        return f"{begin} In {often} it does not begin to rock."
    mass, unit = (1.0, "N per kilogram") if result.item.mass is None else (result.item.mass, "N")
    strong = [f"{two_digits(mass * hold.high)}" for hold in (top, lower)]
    middle = [f"{two_digits(mass * hold.median)}" for hold in (top, lower)]
    half = f" ({middle[0]} or {middle[1]} {unit} in half of them)" if top.median else ""
    return (
        f"{begin} A horizontal force of {strong[0]} {unit} at its top, or {strong[1]} {unit} at "
        f"{lower.height:.2f} m, keeps it from lifting in {often}{half}."
    )


def _wider(result: ItemResult) -> str:
    width = result.profile.body.width
    if math.isnan(result.safe_width):
        return f"No base up to {BASE_GRID[-1]:g} times as wide would be enough."
    if result.safe_width < width + LEAST_WIDENING:
        return (
            "Its base is at the limit: lower its centre of gravity, heavy things in the lowest "
            "drawers or shelves."
        )
    deep = "deep" if result.profile.direction is Direction.FRONT_TO_BACK else "wide"
    return (
        f"Or give it a base {result.safe_width:.2f} m {deep} in place of {width:.2f} m, or a lower "
        f"centre of gravity: on that base at most {100 * ACCEPTED_FALLS:g} of 100 such shakings "
        "overturn it."
    )


def _tilt(result: ItemResult, control: float) -> str:
    curves, profile = result.curves, result.profile
    assert curves is not None
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
        f"{chosen}. The tilt needed is {tilt_interval(curves)}; the higher edge of its base is "
        f"then {1000 * rise:.0f} mm above the other."
    )
