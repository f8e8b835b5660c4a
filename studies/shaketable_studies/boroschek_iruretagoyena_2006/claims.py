"""What the paper says, beside what the motions at hand say."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor
from shaketable.resampling import CONFIDENCE, interval
from shaketable.study import BY_CONSTRUCTION, NO, OPEN, YES, Claim
from shaketable.tilting import control_tilt
from shaketable_studies.boroschek_iruretagoyena_2006.fits import CurveFits, body_mean, known_mean
from shaketable_studies.boroschek_iruretagoyena_2006.printed import (
    SHAKER_DISPLACEMENT,
    TABLE_1,
    TILTS,
)

FAMILIES = {0.20: (0, 10), 0.25: (1, 11), 0.30: (2, 9)}  # b/h: smallest, largest body
LARGE = [k for k, size in enumerate(TABLE_1) if size.height >= 1.0]  # half of the table
SMALL_TILTS = (TILTS > 0.0) & (np.degrees(TILTS) < 2.01)  # where the curve is steep
#: The seven bodies of table V in table I.
TESTED = [3, 4, 5, 0, 1, 7, 8]
ROUNDING = 0.5  # the paper prints whole per cents
OBSERVED = "as observed, "  # judged without an interval


class ClaimInputs(NamedTuple):
    """What a claim is judged by; the first of k rows is what was observed.

    Attributes:
        shares: share of the falls that go downhill, (k, body, t).
        falls: simulations that overturn, over all bodies and motions, (k, t), including motions
            below eq. 1 for the level support, with which a tilt can make a body fall.
        fits: GCOR and SCOR fitted anew.
        errors: table III computed anew.
        apart: largest difference between the two models' shares, None if only one was run.
        vertical: mean shares with and without verticals, (2, k, t), None if there are none.
        experiment: the motions of the tests on the shaking table, as `tables.table_6` gives them.
    """

    shares: NDArray[np.float64]
    falls: NDArray[np.float64]
    fits: CurveFits
    errors: pd.DataFrame
    apart: float | None
    vertical: NDArray[np.float64] | None
    experiment: pd.DataFrame


def claims(found: ClaimInputs) -> list[Claim]:
    """The paper's claims, one by one."""
    judged = [
        _bigger_is_easier(found),
        _models_agree(found),
        _seven_degrees(found),
        _conservative(found, "at small tilts", SMALL_TILTS, list(range(len(TABLE_1)))),
        _conservative(found, "for bigger bodies", TILTS > 0.0, LARGE),
        _tilt_for_95(found, "of the seven bodies that were tested", TESTED),
        _tilt_for_95(found, "of all 12 bodies", list(range(len(TABLE_1)))),
        *_more_falls(found),
        _bodies_alike(found),
        *_errors(found),
        _improves_most(found),
        _verticals(found),
        _within_the_shaker(found),
    ]
    tests = Claim(
        "simulation and shaking table agree",
        "within 5 % at every angle",
        "not compared: the table's motions are not published",
        OPEN,
    )
    return [*judged, tests]


def _span(draws: NDArray[np.float64], unit: str, factor: float = 100.0) -> tuple[str, float, float]:
    """A value with its interval in words, and the interval's ends."""
    low, high = (factor * float(end) for end in interval(draws[1:]))
    if np.isnan(draws[0]):
        return "unknown: too few falls", np.nan, np.nan
    value, least, most = (_said(each) for each in (factor * float(draws[0]), low, high))
    return f"{value}{unit} ({least} to {most})", low, high


def _said(value: float) -> str:
    return f"{value:.3g}" if np.isfinite(value) else "more"


def _verdict(sure: bool, refuted: bool) -> str:
    """The verdict; nothing is decided where the interval lies on both sides of a limit."""
    return YES if sure else NO if refuted else OPEN


def _at_most(value: float, limit: float, noise: NDArray[np.float64]) -> str:
    """Whether the largest of many departures is at most `limit`, in the unit of both.

    How much chance may add to it or take from it is shown by the draws' own departures from what
    was observed. A value within that of the limit, above it or below, decides nothing.
    """
    chance = float(np.nanquantile(noise, 0.95))
    return _verdict(bool(np.hypot(value, chance) < limit), bool(value > np.hypot(limit, chance)))


def _chance(noise: NDArray[np.float64], limit: float) -> str:
    """What chance makes of the largest of many departures, and whether that can be decided."""
    most = float(np.nanquantile(noise, 0.95))
    said = f"chance alone makes up to {most:.1f} %"
    return f"{said}: these motions cannot show that it is below" if most >= limit else said


def _bigger_is_easier(found: ClaimInputs) -> Claim:
    said, low, high = _span(found.fits.scor[:, 1], " rad/m", 1.0)
    tilts = np.degrees(control_tilt(TILTS, found.shares, 0.95))
    steps = [
        f"b/h {ratio:.2f}: {_tilt(tilts[0, small])} at {TABLE_1[small].height:g} m, "
        f"{_tilt(tilts[0, large])} at {TABLE_1[large].height:g} m"
        for ratio, (small, large) in FAMILIES.items()
    ]
    return Claim(
        "bigger bodies of one shape are easier to control",
        "c1 of SCOR falls by 0.0283 rad a metre of r",
        f"by fit {said}; tilt for 95 %: {'; '.join(steps)}",
        _verdict(high < 0.0, low > 0.0),
    )


def _tilt(tilt_deg: float) -> str:
    if np.isnan(tilt_deg):
        return "unknown (too few falls)"
    return f"{tilt_deg:.1f}°" if np.isfinite(tilt_deg) else "more than 7°"


def _models_agree(found: ClaimInputs) -> Claim:
    name, says = "both models agree", "within 4 %"
    if found.apart is None:
        return Claim(name, says, "only one model was run: --model both runs both", OPEN)
    said = (
        f"{OBSERVED}largest difference {100 * found.apart:.1f} % (a body that neither slides nor "
        "jumps is taken the same way by both)"
    )
    holds = BY_CONSTRUCTION if found.apart == 0.0 else _verdict(found.apart <= 0.04, True)
    return Claim(name, says, said, holds)


def _seven_degrees(found: ClaimInputs) -> Claim:
    at_seven = found.shares[..., -1]
    said, _, _ = _span(known_mean(at_seven, axis=1), " %")
    if np.isnan(at_seven[0]).all():
        return Claim("7° control in all cases", "more than 98 %", "too few falls at 7°", OPEN)
    worst = int(np.nanargmin(at_seven[0]))
    # where no fall goes uphill draws have no width, and what is unknown decides nothing
    sure = bool((at_seven[0] < 1.0).all())
    least, least_low, most = _span(at_seven[:, worst], " %")
    return Claim(
        "7° control in all cases",
        "more than 98 % (GCOR itself gives 97.4 %)",
        f"in the mean {said}; least for body {worst + 1}: {least}",
        _verdict(sure and least_low > 98.0, most < 98.0),
    )


def _conservative(
    found: ClaimInputs, where: str, at: NDArray[np.bool_], bodies: list[int]
) -> Claim:
    off = body_mean(found.shares[:, bodies]) - gcor(TILTS)
    said, low, high = _span(known_mean(off[:, at], axis=1), " percentage points above it")
    return Claim(
        f"GCOR is conservative {where}",
        "yes",
        f"simulated rates are in the mean {said}",
        _verdict(low > 0.0, high < 0.0),
    )


def _tilt_for_95(found: ClaimInputs, whose: str, bodies: list[int]) -> Claim:
    """Whether 4 to 5.5 degrees is where 95 % are controlled, for these bodies of table I."""
    shares = found.shares[:, bodies]
    mean = np.degrees(control_tilt(TILTS, body_mean(shares), 0.95))
    said, mean_low, mean_high = _span(mean, "°", 1.0)
    each = np.degrees(control_tilt(TILTS, shares, 0.95))
    each = each[:, ~np.isnan(each[0])]
    number = each.shape[1]
    # all of the bodies at once: they met the same earthquakes, and miss together (Bonferroni)
    level = 1.0 - (1.0 - CONFIDENCE) / max(1, number)
    low, high = interval(each[1:], level)
    meets = int(((low <= 5.5) & (high >= 4.0)).sum())
    spread = (
        f"; of the bodies, from {_tilt(each[0].min())} to {_tilt(each[0].max())}" if number else ""
    )
    return Claim(
        f"tilts that control 95 % {whose}",
        "between 4 and 5.5° in general",
        f"for their mean {_tilt(mean[0]) if np.isinf(mean[0]) else said}{spread}; the intervals of "
        f"{meets} of {number} bodies meet 4 to 5.5° ({100 * level:.1f} % each, so that all hold "
        "together in 95 of 100)",
        _verdict(
            bool(number and mean_low >= 4.0 and mean_high <= 5.5 and meets == number),
            bool(mean_low > 5.5 or mean_high < 4.0 or meets < number),
        ),
    )


def _more_falls(found: ClaimInputs) -> list[Claim]:
    rows = []
    with np.errstate(invalid="ignore", divide="ignore"):
        ratios = found.falls / found.falls[:, :1]
    for tilt_deg in (4.0, 7.0):
        at = int(np.argmin(np.abs(np.degrees(TILTS) - tilt_deg)))
        said, low, high = _span(ratios[:, at], " times as many", 1.0)
        rows.append(
            Claim(
                f"a tilt of {tilt_deg:g}° also raises the number of falls",
                "yes (without a number)",
                f"{said} as level",
                _verdict(low > 1.0, high < 1.0),
            )
        )
    return rows


def _bodies_alike(found: ClaimInputs) -> Claim:
    off = np.abs(found.shares - body_mean(found.shares)[:, None])
    worst = float(100 * np.nanmax(off[0]))
    noise = 100 * _largest(np.abs(found.shares[1:] - found.shares[0]))
    return Claim(
        "bodies differ little from their mean",
        "by less than 15 %",
        f"largest difference {worst:.1f} %; {_chance(noise, 15.0)}",
        _at_most(worst, 15.0, noise),
    )


def _largest(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The largest value of every row, NaN left out, (k, ...) to (k,)."""
    rows = np.where(np.isnan(values), 0.0, values).reshape(len(values), -1)
    return np.asarray(rows.max(axis=1))


def _errors(found: ClaimInputs) -> list[Claim]:
    rows = []
    # eq. 12's measure of the draws' noise, by body
    noise = np.where(np.isnan(found.shares[1:]), 0.0, found.shares[1:] - found.shares[0])
    size = np.sqrt(np.nansum(found.shares[0] ** 2, axis=1))
    with np.errstate(invalid="ignore", divide="ignore"):
        noise = 100 * _largest(np.sqrt(np.nansum(noise**2, axis=2)) / size)
    for curve, limit, other in (("gcor", 8.0, 13), ("scor", 3.0, 9)):
        errors = found.errors[f"{curve}_error_pct"]
        body = found.errors["body"].iloc[int(errors.argmax())]
        verdict = _at_most(float(errors.max()), limit + ROUNDING, noise)
        rows.append(
            Claim(
                f"error of {curve.upper()} as printed (eq. 12)",
                f"{limit:g} % at worst (its table III has {other} %)",
                f"{errors.max():.1f} % at worst, body {body}; {_chance(noise, limit)}",
                verdict,
            )
        )
    return [*rows, _scor_is_closer(found)]


def _scor_is_closer(found: ClaimInputs) -> Claim:
    """Both curves are fitted anew, and to each draw those fitted to that draw are compared."""
    better = np.zeros(len(found.shares))
    general = found.fits.gcor_at(TILTS)
    for k, size in enumerate(TABLE_1):
        specific = found.fits.scor_at(TILTS, size)
        off = [
            np.nansum((found.shares[:, k] - c) ** 2, axis=1) / np.sum(c**2, axis=1)
            for c in (specific, general)
        ]
        better += off[0] < off[1]
    low, high = (float(end) for end in interval(better[1:]))
    printed = found.errors["scor_error_pct"] < found.errors["gcor_error_pct"]
    anew = found.errors["scor_refit_error_pct"] < found.errors["gcor_error_pct"]
    return Claim(
        "SCOR is closer than GCOR",
        "for 9 of 12 bodies, for none less close (table III)",
        f"as printed, for {int(printed.sum())}; both fitted anew, for {better[0]:.0f} ({low:.0f} "
        f"to {high:.0f}); SCOR fitted anew against GCOR as printed, for {int(anew.sum())}",
        _verdict(low >= 9, high < 9),
    )


def _improves_most(found: ClaimInputs) -> Claim:
    """Whether the error that SCOR saves grows with the body's size: a rank correlation."""
    from scipy.stats import rankdata

    general, sizes = found.fits.gcor_at(TILTS), np.array([size.height for size in TABLE_1])
    saved = np.empty((len(found.shares), len(TABLE_1)))
    for k, size in enumerate(TABLE_1):
        specific = found.fits.scor_at(TILTS, size)
        off = [
            np.sqrt(np.nansum((found.shares[:, k] - c) ** 2, axis=1) / np.sum(c**2, axis=1))
            for c in (general, specific)
        ]
        saved[:, k] = off[0] - off[1]
    ranks = rankdata(saved, axis=1)
    size_rank = rankdata(sizes)
    ranks -= ranks.mean(axis=1, keepdims=True)
    size_rank -= size_rank.mean()
    with np.errstate(invalid="ignore"):
        correlation = (ranks @ size_rank) / (
            np.linalg.norm(ranks, axis=1) * np.linalg.norm(size_rank)
        )
    low, high = (float(end) for end in interval(correlation[1:]))
    printed = found.errors["gcor_error_pct"] - found.errors["scor_error_pct"]
    by_height = printed.groupby(sizes).mean()
    told = ", ".join(f"{value:+.1f} for {height:g} m" for height, value in by_height.items())
    return Claim(
        "SCOR improves most for bigger bodies",
        "yes",
        f"rank correlation of height and of the error that SCOR saves, both fitted anew, "
        f"{correlation[0]:.2f} ({low:.2f} to {high:.2f}); as printed it saves, in per cent: {told}",
        _verdict(low > 0.0, high < 0.0),
    )


def _verticals(found: ClaimInputs) -> Claim:
    name, says = "the records were entered with their vertical components", "yes"
    if found.vertical is None:
        return Claim(
            name,
            says,
            "these motions have no verticals: what is found here is for horizontal motion alone; "
            "--vertical with recordings of three components runs both",
            OPEN,
        )
    off = 100 * (found.vertical[0] - found.vertical[1])
    largest = float(np.nanmax(np.abs(off[0])))
    noise = _largest(np.abs(off[1:] - off[0]))
    return Claim(
        "verticals change the mean share downhill by little",
        "not said; the records were entered with their verticals",
        f"by at most {largest:.1f} % at any tilt; chance alone makes up to "
        f"{np.nanquantile(noise, 0.95):.1f} %; little is up to 4 %, as between the paper's models",
        _at_most(largest, 4.0, noise),
    )


def _within_the_shaker(found: ClaimInputs) -> Claim:
    """Whether the scaled motions stay within the table's displacement, which was no criterion."""
    limit = SHAKER_DISPLACEMENT
    over = int((found.experiment["peak_displacement_m"] > limit).sum())
    return Claim(
        "the scaled motions are within the physical limits of the table",
        f"scaled down where they surpass them; ±{limit:g} m, table IV",
        f"scaled as printed or to the table's acceleration and velocity, {over} of "
        f"{len(found.experiment)} exceed {limit:g} m as integrated: a high-pass or a lower scale "
        "was needed",
        YES if over == 0 else NO,
    )
