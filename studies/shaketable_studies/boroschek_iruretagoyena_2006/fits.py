"""GCOR and SCOR fitted anew, and how far a curve is from what was simulated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C1,
    C2,
    SCOR,
    controlled_rate,
    curve_error,
    size_measures,
)
from shaketable.errors import InputError
from shaketable_studies.boroschek_iruretagoyena_2006.printed import PrintedSize

SMALLEST_C1 = 1e-4  # rad: keeps a trial step away from bodies without a curve


@dataclass(frozen=True, eq=False)
class CurveFits:
    """Both curves fitted to what was observed and to every draw of the bootstrap.

    Attributes:
        gcor: c1 [rad] and c2, shape (1 + draws, 2); the first row is the fit. NaN in draws with
            too few falls.
        scor: the three terms of c1, with c2 of `gcor`, (1 + draws, 3).
    """

    gcor: NDArray[np.float64]
    scor: NDArray[np.float64]

    def gcor_at(self, tilts: NDArray[np.float64]) -> NDArray[np.float64]:
        """The fitted general curve of every draw at `tilts` [rad], (1 + draws, t)."""
        return controlled_rate(tilts, self.gcor[:, :1], self.gcor[:, 1:])

    def scor_at(self, tilts: NDArray[np.float64], size: PrintedSize) -> NDArray[np.float64]:
        """The fitted specific curve of a body, of every draw, (1 + draws, t)."""
        c1 = (self.scor @ size_measures(size.base, size.height))[:, None]
        return controlled_rate(tilts, np.maximum(c1, SMALLEST_C1), self.gcor[:, 1:])


def fit_curves(
    tilts: NDArray[np.float64], shares: NDArray[np.float64], sizes: Sequence[PrintedSize]
) -> CurveFits:
    """Fit by least squares to the bodies' mean (GCOR) and to every body (SCOR).

    Args:
        tilts: β [rad], (t,).
        shares: of the falls that go downhill, (1 + draws, body, t); NaN is left out.
        sizes: of the bodies.

    Raises:
        InputError: too few falls to fit anything to.
    """
    mean = body_mean(shares)
    gcor = np.array([_fit_gcor(tilts, each) for each in mean])
    scor = np.array(
        [_fit_scor(tilts, each, sizes, c2) for each, c2 in zip(shares, gcor[:, 1], strict=True)]
    )
    if not (np.isfinite(gcor[0]).all() and np.isfinite(scor[0]).all()):
        raise InputError(
            "the motions overturn too few of the bodies to fit curves to: use stronger or more "
            "motions"
        )
    return CurveFits(gcor, scor)


def known_mean(values: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Mean along an axis of what is not NaN; NaN where nothing is known."""
    known = np.isfinite(values)
    count = known.sum(axis=axis)
    total = np.where(known, values, 0.0).sum(axis=axis)
    return np.asarray(np.where(count > 0, total / np.maximum(count, 1), np.nan))


def body_mean(shares: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean over the bodies, (k, body, t) to (k, t)."""
    return known_mean(shares, axis=-2)


def _fit_gcor(tilts: NDArray[np.float64], mean: NDArray[np.float64]) -> NDArray[np.float64]:
    from scipy.optimize import least_squares

    known = np.isfinite(mean) & (tilts > 0.0)
    if known.sum() < 2:
        return np.full(2, np.nan)
    beta, share = tilts[known], mean[known]

    def miss(p: NDArray[np.float64]) -> NDArray[np.float64]:
        return controlled_rate(beta, max(p[0], SMALLEST_C1), p[1]) - share

    found = least_squares(miss, (C1, C2), method="lm")
    if not (found.x[0] >= SMALLEST_C1 and found.x[1] <= 0.5):  # bounds take three times as long
        found = least_squares(miss, (C1, C2), bounds=((SMALLEST_C1, 0.0), (np.inf, 0.5)))
    return np.asarray(found.x)


def _fit_scor(
    tilts: NDArray[np.float64], shares: NDArray[np.float64], sizes: Sequence[PrintedSize], c2: float
) -> NDArray[np.float64]:
    from scipy.optimize import least_squares

    known = np.isfinite(shares) & (tilts > 0.0)
    if known.sum() < 3 or np.isnan(c2):
        return np.full(3, np.nan)
    shapes = np.array([size_measures(size.base, size.height) for size in sizes])

    def miss(p: NDArray[np.float64]) -> NDArray[np.float64]:
        c1 = np.maximum(shapes @ p, SMALLEST_C1)[:, None]
        return np.asarray((controlled_rate(tilts, c1, c2) - shares)[known])

    return np.asarray(least_squares(miss, SCOR, method="lm").x)


def departures(
    tilts_deg: NDArray[np.float64], found: NDArray[np.float64], curve: NDArray[np.float64]
) -> tuple[float, float, float]:
    """Table III's measures of a curve: largest difference and area [%, % · degrees], eq. 12 [%].

    NaN where nothing was found.

    The difference is what was found less the curve: positive where the curve is conservative.
    """
    known = np.isfinite(found)
    if not known.any():
        return np.nan, np.nan, np.nan
    off = 100 * (found - curve)[known]
    largest = off[np.argmax(np.abs(off))]
    area = np.trapezoid(np.abs(off), tilts_deg[known])
    return float(largest), float(area), 100 * curve_error(found, curve)
