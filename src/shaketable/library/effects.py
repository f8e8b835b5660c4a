"""What was drawn of the object and of the model does to ln θ, and how much of β that makes.

In a probit regression on ln x and on what was drawn, in standard deviations, a coefficient over
that of ln x is by how much ln θ falls where the quantity is one standard deviation higher. One case
alone tells it poorly, as its few hundred things meet 48 recordings, and cases that are held alike
tell it together, as far as they are alike: each effect, per unit of its quantity, is drawn toward
the mean of the others by how much they differ beyond their errors (a random effect, DerSimonian and
Laird 1986, Control. Clin. Trials 7(3):177-188). Squares of what is not known exactly are too large
by its variance, which is taken off.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.fragility.lognormal import FARTHEST, Points, ndtr, scored
from shaketable.library.draws import OF_MODEL, OF_OBJECT, Draws


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


def drawn_beta(alike: Sequence[Effects]) -> list[DrawnBeta]:
    """What was drawn adds to β of each of some functions.

    Args:
        alike: the effects of functions of one state and measure, of things that are held alike.
    """
    squares = np.zeros((len(alike), 2))
    for name in (*OF_OBJECT, *OF_MODEL):
        at = [
            (k, each.parameters.index(name))
            for k, each in enumerate(alike)
            if name in each.parameters
        ]
        rows = [k for k, j in at if alike[k].variance[j] > 0.0]
        if not rows:
            continue
        spread = np.array([alike[k].spread[j] for k, j in at if k in rows])
        slope = np.array([alike[k].slope[j] for k, j in at if k in rows]) / spread
        variance = np.array([alike[k].variance[j] for k, j in at if k in rows]) / spread**2
        squares[rows, int(name in OF_MODEL)] += spread**2 * _squares(slope, variance)
    return [
        DrawnBeta(float(first), float(second)) for first, second in np.sqrt(np.maximum(squares, 0))
    ]


def _squares(slope: NDArray[np.float64], variance: NDArray[np.float64]) -> NDArray[np.float64]:
    """The squares of effects that are known with errors, without bias; some may be below 0."""
    weight = 1.0 / variance
    mean = weight @ slope / weight.sum()
    freedom = weight.sum() - (weight**2).sum() / weight.sum()
    excess = weight @ (slope - mean) ** 2 - (slope.size - 1)
    between = max(0.0, excess / freedom) if freedom > 0.0 else 0.0  # variance between the cases
    weight = 1.0 / (variance + between)
    mean, error = weight @ slope / weight.sum(), 1.0 / weight.sum()
    own = between / (between + variance)  # how much of its own each keeps
    drawn = own * slope + (1.0 - own) * mean
    if slope.size == 1:
        return np.asarray(slope**2 - variance)
    return np.asarray(drawn**2 + own * variance - (1.0 - own) ** 2 * error)
