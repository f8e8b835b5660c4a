"""What was drawn of the object and of the model does to ln θ, and how much of β that makes.

In a probit regression on ln x and on what was drawn, in standard deviations, a coefficient over
that of ln x is by how much ln θ falls where the quantity is one standard deviation higher. One case
alone tells it poorly, as its few hundred things meet 48 recordings; all cases that are held alike
tell it well. So each effect is the mean over those cases, weighed by what each knows of it, per
unit of the quantity (Hedges and Olkin 1985, Statistical methods for meta-analysis, chapter 6), and
its square is lessened by the square of its error.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.fragility.lognormal import FARTHEST, Points, ndtr, scored
from shaketable.library.draws import OF_MODEL, Draws


class Effects(NamedTuple):
    """By how much ln θ falls where a quantity is one standard deviation higher.

    Attributes:
        parameters: the quantities.
        spread: standard deviation of each in its own unit, (parameter,).
        slope: the effect of one standard deviation, (parameter,); NaN where it is not known.
        variance: of the slope, over earthquakes, (parameter,).
    """

    parameters: tuple[str, ...]
    spread: NDArray[np.float64]
    slope: NDArray[np.float64]
    variance: NDArray[np.float64]


class DrawnBeta(NamedTuple):
    """What was drawn adds to β: of the object, and of the model."""

    object: float
    model: float


def no_effects(draws: Draws) -> Effects:
    """Where there is no function."""
    unknown = np.full(len(draws.parameters), np.nan)
    return Effects(draws.parameters, draws.spread, unknown, unknown)


def effects_of(
    points: Points, draws: Draws, draw: NDArray[np.int32], event: NDArray[np.intp]
) -> Effects:
    """The effects of one function.

    Args:
        points: whether each simulation reached the state, (run,).
        draws: of its case.
        draw: which of them each simulation had, (run,).
        event: number of the earthquake of each simulation, (run,).
    """
    x = np.log(points.intensity)
    z = (x - x.mean()) / x.std()
    columns = np.vstack([np.ones_like(z), z, draws.standard[:, draw]])
    reached = points.reached.astype(np.float64)
    found = scored(columns, reached[None], np.ones((1, z.size)))[0]
    if not (np.isfinite(found).all() and found[1] > 0.0):
        return no_effects(draws)
    eta = np.clip(found @ columns, -FARTHEST, FARTHEST)
    mean, density = ndtr(eta), np.exp(-0.5 * eta * eta) / np.sqrt(2.0 * np.pi)
    variance = mean * ndtr(-eta)
    information = (columns * (density**2 / variance)) @ columns.T
    score = columns * ((reached - mean) * density / variance)
    by_event = np.stack([score[:, event == k].sum(axis=1) for k in np.unique(event)], axis=1)
    inverse = np.linalg.pinv(information, hermitian=True)
    # robust to what the simulations of one earthquake have in common (Liang and Zeger 1986)
    robust = inverse @ (by_event @ by_event.T) @ inverse
    unit = x.std() / found[1]
    return Effects(draws.parameters, draws.spread, found[2:] * unit, np.diag(robust)[2:] * unit**2)


def drawn_beta(own: Effects, alike: Sequence[Effects]) -> DrawnBeta:
    """What was drawn adds to β of a function.

    Args:
        own: of the function.
        alike: of all functions of the same state and measure of what is held alike, it included.
    """
    square = dict.fromkeys((False, True), 0.0)
    for number, name in enumerate(own.parameters):
        slopes, variances = [], []
        for other in alike:
            if name in other.parameters:
                k = other.parameters.index(name)
                if np.isfinite(other.slope[k]) and other.variance[k] > 0.0:
                    slopes.append(other.slope[k] / other.spread[k])
                    variances.append(other.variance[k] / other.spread[k] ** 2)
        if not slopes:
            continue
        weight = 1.0 / np.array(variances)
        mean = float(weight @ np.array(slopes) / weight.sum())
        known = mean**2 - 1.0 / float(weight.sum())
        square[name in OF_MODEL] += own.spread[number] ** 2 * max(known, 0.0)
    return DrawnBeta(float(np.sqrt(square[False])), float(np.sqrt(square[True])))
