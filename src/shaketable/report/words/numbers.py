"""Numbers as people say them."""

from __future__ import annotations

import math

from shaketable.assess import Share
from shaketable.language import number, tell, translated
from shaketable.tilting import TiltCurves
from shaketable.units import degrees

BELOW_ONE, ABOVE_99 = "<1", ">99"  # of a hundred, in tables
ROUND_OFF = 1e-9  # of a count: what is whole but for it is whole


def in_hundred(share: float) -> str:
    """A share as a count out of a hundred in a sentence, never rounded to 0 or 100."""
    short = in_hundred_short(share)
    words = {BELOW_ONE: tell("less than 1"), ABOVE_99: tell("more than 99")}
    return words.get(short, short)


def in_hundred_short(share: float) -> str:
    """The same in a table: "<1" and ">99"; a dash for NaN. Halves are rounded up."""
    if math.isnan(share):
        return "–"
    if 0.0 < share < 0.01:
        return BELOW_ONE
    if 0.99 < share < 1.0:
        return ABOVE_99
    return f"{math.floor(100 * share + 0.5 + ROUND_OFF)}"


def limits_in_hundred(share: Share) -> tuple[str, str]:
    """The ends of the interval of a share, in whole counts out of a hundred that enclose it."""
    if math.isnan(share.low) or math.isnan(share.high):
        return "–", "–"
    low, high = 100 * share.low + ROUND_OFF, 100 * share.high - ROUND_OFF
    return f"{math.floor(low)}", f"{math.ceil(high)}"


def with_interval(share: Share) -> str:
    """A share and its interval in a table: "25 (12–47)"."""
    return f"{in_hundred_short(share.value)} ({'–'.join(limits_in_hundred(share))})"


def likely(share: Share) -> str:
    """The interval of a share in words."""
    low, high = limits_in_hundred(share)
    return tell("likely between {low} and {high}", low=low, high=high)


def counted(count: int, thing: str) -> str:
    """ "1 motion", "2 motions"; "2 kinds of object"."""
    first, of, rest = thing.partition(" of ")
    plural = f"{first}{'' if count == 1 else 's'}{of}{rest}"
    return f"{number(count, ',')} {translated(plural)}"


def expected_count(count: float) -> str:
    """A mean count, to a tenth where it is small."""
    return number(count, f",.{0 if count >= 10 else 1}f")


def of_pieces(share: Share, pieces: int) -> str:
    """How many of some pieces, with whole numbers that enclose the interval: "12 (7–19)".

    Of none it is said so: "none (0–8)".
    """
    if math.isnan(share.value):
        return "–"
    low = math.floor(pieces * share.low + ROUND_OFF)
    high = math.ceil(pieces * share.high - ROUND_OFF)
    count = expected_count(pieces * share.value) if share.value else tell("none")
    return f"{count} ({number(low, ',')}–{number(high, ',')})"


def distance(metres: float) -> str:
    """A distance to two digits, in the unit that people would use."""
    if metres >= 1.0:
        return f"{number(metres, '.2g')} m"
    if metres >= 0.01:
        return f"{number(100 * metres, '.2g')} cm"
    return f"{number(1000 * metres, '.2g')} mm" if metres >= 1e-4 else "0 mm"


def at_most(metres: float) -> str:
    """A limit of a distance: "40 cm", "1 cm" for anything less."""
    return distance(max(metres, 0.01))


def two_digits(value: float, up: bool = False) -> str:
    """A number to two digits, without an exponent: 0.85, 12, 340, 1,200; `up` never rounds down."""
    if value == 0.0:
        return "0"
    if up:
        unit = 10.0 ** (math.floor(math.log10(abs(value))) - 1)
        value = math.ceil(value / unit - ROUND_OFF) * unit
    rounded = float(f"{value:.2g}")
    return number(rounded, f",.{max(0, 1 - math.floor(math.log10(abs(rounded))))}f")


def tilt_degrees(tilt: float) -> str:
    """A tilt [rad] of the grid in degrees: 2.25°, 3.5°, 4.0°."""
    return f"{number(degrees(tilt), '.2f').removesuffix('0')}°"


def between(low: float, high: float, unit: str) -> str:
    """A range of numbers to two decimals: "from 0.15 to 0.82 g", "of 0.40 g"."""
    if f"{low:.2f}" == f"{high:.2f}":
        return tell("of {low:.2f} {unit}", low=low, unit=unit)
    return tell("from {low:.2f} to {high:.2f} {unit}", low=low, high=high, unit=unit)


def percent(share: float) -> str:
    """A share in percent to three digits, "below 0.1 %" where it is less."""
    if 0.0 < share < 0.001:
        return tell("below {limit:g} %", limit=0.1)
    return f"{number(100 * share, '.3g')} %"


def tilt_interval(curves: TiltCurves) -> str:
    """The interval of the tilt for control in words."""
    low, high = curves.control_tilt_interval
    if math.isnan(low):
        return tell("how sure that is cannot be told from so few falls")
    if math.isinf(high):
        return tell("likely above {low}", low=tilt_degrees(low))
    return tell("likely between {low} and {high}", low=tilt_degrees(low), high=tilt_degrees(high))
