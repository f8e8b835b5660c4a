"""Results as sentences that a facility manager can act on."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    COLUMNS,
    TILT_GRID_DEG,
    Assessment,
    Part,
)
from shaketable.criteria.together import HOUSNER
from shaketable.tilting import FEWEST_FALLS, SLIDES, shim_height
from shaketable.units import radians

#: Criteria that call safe what is below their limit, with the begin of their columns.
NECESSARY = {name: column for name, column in COLUMNS.items() if name != HOUSNER}

Row = Mapping[Any, Any]  # one row of Assessment.table


def in_hundred(share: float) -> str:
    """A share as a count of a hundred, without false zeros and hundreds."""
    if 0.0 < share < 0.01:
        return "less than 1"
    if 0.99 < share < 1.0:
        return "more than 99"
    return f"{100 * share:.0f}"


def counted(number: int, thing: str) -> str:
    """ "1 motion", "2 motions"."""
    return f"{number} {thing}{'' if number == 1 else 's'}"


def expected_count(number: float) -> str:
    """A mean count, to a tenth where it is small."""
    return f"{number:.{0 if number >= 10 else 1}f}"


def what_happens(row: Row) -> str:
    """How often it falls, and how sure that is."""
    if row["falls"] == 0:
        median = row["peak_rotation_median_deg"]
        still = "did not rock" if "slides_share" in row else "did not move"
        half = f"rocked by less than {max(median, 0.01):.2g}°" if median else still
        return (
            f"Did not fall in any of {row['simulations']} simulated shakings (the true share is "
            f"below {math.ceil(100 * row['fall_share_high'])} in 100). In at least half of them it "
            f"{half}."
        )
    return (
        f"Falls in {in_hundred(row['fall_share'])} of 100 such shakings "
        f"(likely between {in_hundred(row['fall_share_low'])} and "
        f"{in_hundred(row['fall_share_high'])})."
    )


def which_way(row: Row, tilt_deg: float) -> str:
    """Where it falls."""
    if row["falls"] < FEWEST_FALLS:
        return "Too few falls to tell which way." if row["falls"] else ""
    share = row["downhill_share"]
    downhill, uphill = ("downhill", "uphill") if tilt_deg > 0 else ("left (-x)", "right (+x)")
    if abs(share - 0.5) < 0.05:
        return "It falls either way about equally often."
    side, often = (downhill, share) if share > 0.5 else (uphill, 1 - share)
    low, high = row["downhill_share_low"], row["downhill_share_high"]
    if share <= 0.5:
        low, high = 1 - high, 1 - low
    return (
        f"{in_hundred(often)} of 100 falls go {side} (likely between {in_hundred(low)} and "
        f"{in_hundred(high)})."
    )


def what_criteria_miss(row: Row) -> str:
    """A flag where a criterion says safe and the simulation says that it falls."""
    missed = [
        f"{name} {row[f'{column}_missed']}"
        for name, column in NECESSARY.items()
        if row.get(f"{column}_missed", 0)
    ]
    if not missed:
        return ""
    return (
        f"Of its {row['falls']} simulated falls some are under motions that a simple criterion "
        f"calls safe: {', '.join(missed)}."
    )


def how_far_it_slides(row: Row) -> str:
    """Sliding in words; nothing for the rocking model."""
    if "slides_share" not in row:
        return ""
    median, upper = row["slip_median_m"], row["slip_upper_quartile_m"]
    often = in_hundred(row["slides_share"])
    if row["fall_share"] == 1.0:
        return ""
    upright = "Where it does not fall, it" if row["fall_share"] else "It"
    if row["slides_share"] == 0.0:
        said = f"{upright} never slides by more than {100 * SLIDES:g} cm."
    else:
        said = (
            f"{upright} slides by {distance(median)} or more in half of the shakings and by "
            f"{distance(upper)} or more in a quarter of them; that it stays upright and slides by "
            f"more than {100 * SLIDES:g} cm happens in {often} of 100."
        )
    if math.isnan(row["walks_off_share"]):
        return said
    off = in_hundred(row["walks_off_share"])
    return said + (
        f" In {off} of 100 it walks off its support of {row['support_length_m']:.2f} m."
        if row["walks_off_share"]
        else f" It stays on its support of {row['support_length_m']:.2f} m."
    )


def distance(metres: float) -> str:
    """A distance to two digits, in the unit that one would say it in."""
    if metres >= 1.0:
        return f"{metres:.2g} m"
    if metres >= 0.01:
        return f"{100 * metres:.2g} cm"
    return f"{1000 * metres:.2g} mm" if metres >= 1e-4 else "0 mm"


def what_to_do(row: Row, control: float, tilt_deg: float) -> list[str]:
    """The tilt and the base that would help, if it needs help."""
    keep = ["Keep it on its support: a rim, a strap, a pad with more grip."]
    keep = keep if row.get("walks_off_share", 0.0) > ACCEPTED_FALLS else []
    if row["fall_share"] <= ACCEPTED_FALLS:
        rare = ["It falls rarely. Anchor it where a fall would hurt somebody or stop work."]
        said = (rare if row["falls"] else []) + keep
        return said or ["Nothing is needed against shaking like this."]
    base = row["safe_width_m"]
    if math.isnan(base):
        wider = f"No base up to {BASE_GRID[-1]:g} times as wide would be enough: anchor it."
    else:
        wider = (
            f"To keep it standing, anchor it, or widen its base from {row['width_m']:.2f} to "
            f"{base:.2f} m: at most {100 * ACCEPTED_FALLS:g} of 100 such shakings would still "
            "overturn it."
        )
    return [_tilt_advice(row, control, tilt_deg), wider, *keep]


def _tilt_advice(row: Row, control: float, tilt_deg: float) -> str:
    tilt = row["control_tilt_deg"]
    wanted = f"{100 * control:g} of 100 falls"
    if math.isnan(tilt):
        return (
            f"No tilt up to {TILT_GRID_DEG[-1]:g}° was found that sends {wanted} downhill, with "
            f"{FEWEST_FALLS} falls or more at the tilts around it to tell."
        )
    side = "downhill" if tilt_deg else "to its left (-x)"
    if tilt <= tilt_deg or tilt == 0.0:
        return f"As it stands, {wanted} or more already go {side}."
    toward = "to the side you choose"
    if row["eccentricity"] != 0.5:
        toward = "to its left (-x); turned round, it needs another tilt"
    rise = shim_height(row["width_m"], radians(tilt))
    now, then = in_hundred(row["fall_share"]), in_hundred(row["fall_share_at_control_tilt"])
    return (
        f"To choose the side, tilt what it stands on to {tilt:.1f}° ("
        f"{tilt_interval(row['control_tilt_low_deg'], row['control_tilt_high_deg'])}; at "
        f"{tilt:.1f}° the uphill edge of its base is {1000 * rise:.0f} mm above the other): about "
        f"{wanted} then go downhill, {toward}; falls change from {now} to {then} of 100."
    )


def tilt_interval(low: float, high: float) -> str:
    """The interval of a tilt [degrees] in words; its high end may be infinite, NaN is unknown."""
    if math.isnan(low):
        return "how sure that is cannot be told from so few falls"
    if math.isinf(high):
        return f"likely above {low:.1f}°"
    return f"likely between {low:.1f} and {high:.1f}°"


def headline(assessment: Assessment) -> list[str]:
    """The whole inventory in a few sentences."""
    sentences = _overturning_headline(assessment)
    table = assessment.table
    if "slides_share" not in table:
        return sentences
    far = table.sort_values("slip_upper_quartile_m", na_position="first").iloc[-1]
    if far["slip_upper_quartile_m"] > SLIDES:
        sentences.append(
            f"What slides farthest is {far['name']!r}: by {distance(far['slip_upper_quartile_m'])} "
            "or more in a quarter of the shakings that leave it upright."
        )
    off = table[table["walks_off_share"] > 0.0].sort_values("walks_off_share")
    if len(off):
        kinds = "kind of object walks" if len(off) == 1 else "kinds of object walk"
        sentences.append(
            f"{len(off)} {kinds} off the support in some shakings, {off.iloc[-1]['name']!r} in "
            f"{in_hundred(off.iloc[-1]['walks_off_share'])} of 100."
        )
    return sentences


def building_headline(parts: Sequence[Part]) -> list[str]:
    """A whole building in a few sentences."""
    pieces = sum(part.pieces for part in parts)
    falls = sum(part.expected_falls for part in parts)
    worst = max(parts, key=lambda part: part.expected_falls / part.pieces)
    share = worst.expected_falls / worst.pieces
    sentences = [
        f"On average over the motions, {expected_count(falls)} of the {pieces} pieces on "
        f"{counted(len(parts), 'floor')} fall."
    ]
    if share > 0.0:
        sentences.append(
            f"Most of a floor's pieces fall on floor {worst.floor}: {in_hundred(share)} of 100."
        )
    return sentences


def _overturning_headline(assessment: Assessment) -> list[str]:
    table = assessment.table
    often = table[table["fall_share"] > ACCEPTED_FALLS]
    kinds, pieces = len(table), int(table["quantity"].sum())
    if often.empty:
        return [
            f"None of {kinds} kinds of object ({pieces} pieces) overturns in more than "
            f"{100 * ACCEPTED_FALLS:.0f} of 100 such shakings."
        ]
    worst = often.sort_values("fall_share").iloc[-1]
    falls = float((table["fall_share"] * table["quantity"]).sum())
    return [
        f"{len(often)} of {kinds} kinds of object ({int(often['quantity'].sum())} of {pieces} "
        f"pieces) overturn in more than {100 * ACCEPTED_FALLS:.0f} of 100 shakings like those of "
        "this suite.",
        f"The likeliest to fall is {worst['name']!r}: {in_hundred(worst['fall_share'])} of 100.",
        f"On average over the suite, {expected_count(falls)} of the {pieces} pieces fall.",
    ]
