"""What the paper says, beside what the motions at hand say."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor
from shaketable.recordings import interval
from shaketable.studies.boroschek_iruretagoyena_2006.fits import Fits, body_mean, known_mean
from shaketable.studies.boroschek_iruretagoyena_2006.printed import TABLE_1, TILTS
from shaketable.tilting import control_tilt

YES, NO, OPEN = "yes", "no", "not decided"
FAMILIES = {0.20: (0, 10), 0.25: (1, 11), 0.30: (2, 9)}  # b/h: smallest, largest body
LARGE = [k for k, size in enumerate(TABLE_1) if size.height >= 1.0]
SMALL_TILTS = (TILTS > 0.0) & (np.degrees(TILTS) < 2.01)
LAST = TILTS.size - 1  # 7°


class Found(NamedTuple):
    """What a claim is judged by; the first of every k rows is what was observed.

    Attributes:
        shares: of the falls that go downhill, (k, body, t).
        falls: simulations that overturn, over all bodies, (k, t).
        fits: GCOR and SCOR fitted anew.
        errors: table III anew.
        apart: largest difference of the two models' shares, None if only one was run.
    """

    shares: NDArray[np.float64]
    falls: NDArray[np.float64]
    fits: Fits
    errors: pd.DataFrame
    apart: float | None


class Claim(NamedTuple):
    claim: str
    paper_says: str
    we_find: str
    holds: str


def claims(found: Found) -> list[Claim]:
    """The paper's claims, one by one."""
    judged = [
        _bigger_is_easier(found),
        _models_agree(found),
        _seven_degrees(found),
        _conservative(found, "at small tilts", SMALL_TILTS, list(range(len(TABLE_1)))),
        _conservative(found, "for bigger bodies", TILTS > 0.0, LARGE),
        _tilt_for_95(found),
        *_more_falls(found),
        _bodies_alike(found),
        *_errors(found),
    ]
    table = Claim(
        "simulation and shaking table agree",
        "within 5 % at every angle",
        "not compared: the table's motions are not published",
        OPEN,
    )
    return [*judged, table]


def _span(draws: NDArray[np.float64], unit: str, factor: float = 100.0) -> tuple[str, float, float]:
    """A value with its interval in words, and the interval's ends."""
    low, high = (factor * float(end) for end in interval(draws[1:]))
    return f"{factor * draws[0]:.3g}{unit} ({low:.3g} to {high:.3g})", low, high


def _verdict(sure: bool, refuted: bool) -> str:
    return YES if sure else NO if refuted else OPEN


def _bigger_is_easier(found: Found) -> Claim:
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


def _models_agree(found: Found) -> Claim:
    name, says = "both models agree", "within 4 %"
    if found.apart is None:
        return Claim(name, says, "only one model was run: --model both runs both", OPEN)
    said = f"largest difference {100 * found.apart:.1f} %"
    return Claim(name, says, said, _verdict(found.apart <= 0.04, found.apart > 0.04))


def _seven_degrees(found: Found) -> Claim:
    at_seven = found.shares[..., LAST]
    said, _, _ = _span(known_mean(at_seven, axis=1), " %")
    if np.isnan(at_seven[0]).all():
        return Claim("7° control in all cases", "more than 98 %", "too few falls at 7°", OPEN)
    worst = int(np.nanargmin(at_seven[0]))
    least, _, most = _span(at_seven[:, worst], " %")
    return Claim(
        "7° control in all cases",
        "more than 98 % (GCOR itself gives 97.4 %)",
        f"in the mean {said}; least for body {worst + 1}: {least}",
        _verdict(float(100 * at_seven[0, worst]) > 98.0, most < 98.0),
    )


def _conservative(found: Found, where: str, at: NDArray[np.bool_], bodies: list[int]) -> Claim:
    off = body_mean(found.shares[:, bodies]) - gcor(TILTS)
    said, low, high = _span(known_mean(off[:, at], axis=1), " % above it")
    return Claim(
        f"GCOR is conservative {where}",
        "yes",
        f"simulated rates are in the mean {said}",
        _verdict(low > 0.0, high < 0.0),
    )


def _tilt_for_95(found: Found) -> Claim:
    tilts = np.degrees(control_tilt(TILTS, body_mean(found.shares), 0.95))
    said, low, high = _span(tilts, "°", 1.0)
    each = np.degrees(control_tilt(TILTS, found.shares[0], 0.95))
    each = each[~np.isnan(each)] if not np.isnan(each).all() else each
    return Claim(
        "tilts that control 95 %",
        "between 4 and 5.5°",
        f"for the mean of the bodies {said}; of the bodies, from {_tilt(each.min())} to "
        f"{_tilt(each.max())}",
        _verdict(low >= 4.0 and high <= 5.5, high < 4.0 or low > 5.5),
    )


def _more_falls(found: Found) -> list[Claim]:
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


def _bodies_alike(found: Found) -> Claim:
    observed = found.shares[:1]
    off = np.abs(observed[0] - body_mean(observed)[0])
    worst = float(100 * np.nanmax(off))
    return Claim(
        "bodies differ little from their mean",
        "by less than 15 %",
        f"largest difference {worst:.1f} %",
        _verdict(worst < 15.0, worst >= 15.0),
    )


def _errors(found: Found) -> list[Claim]:
    rows = []
    for curve, limit in (("gcor", 8.0), ("scor", 3.0)):
        worst = found.errors[f"{curve}_error_pct"]
        body = found.errors["body"].iloc[int(worst.argmax())]
        rows.append(
            Claim(
                f"error of {curve.upper()} as printed (eq. 12)",
                f"{limit:g} % at worst (its table III has {13 if curve == 'gcor' else 9} %)",
                f"{worst.max():.1f} % at worst, body {body}",
                _verdict(worst.max() <= limit + 0.5, worst.max() > limit + 0.5),
            )
        )
    fitted, general = found.errors["scor_refit_error_pct"], found.errors["gcor_error_pct"]
    refit = found.errors["gcor_refit_error_pct"]
    better = int((fitted < general).sum())
    rows.append(
        Claim(
            "SCOR is closer than GCOR",
            "for 9 of 12 bodies, for none less close (table III)",
            f"fitted anew, for {better} than GCOR as printed, for {int((fitted < refit).sum())} "
            "than GCOR fitted anew",
            _verdict(better >= 9, better < 6),
        )
    )
    return rows
