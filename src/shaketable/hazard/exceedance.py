"""The loss exceedance curve of pieces that fall together.

At a level of the hazard curve every piece falls with the probability of its fragility function, and
pieces fall together: what they withstand of one measure departs from their medians alike, as one
motion shakes them all. Losses are drawn at each level, and weighed by its rate (Grossi and
Kunreuther 2005, Catastrophe modeling, chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.fragility.lognormal import ndtr, reflected
from shaketable.hazard.curve import Hazard
from shaketable.hazard.exposure import Exposure
from shaketable.hazard.rates import rate_parts
from shaketable.hazard.spatial import COMMON

LEVELS = 240  # into which the hazard curve is cut
AT_ONCE = 2**21  # numbers of an array
BEYOND = 5.0  # times the last level of the curve: what is shaken by more is shaken by this


@dataclass(frozen=True)
class Correlation:
    """Of what pieces withstand of one measure, beside their medians.

    Args:
        alike: of pieces with the same function.
        kinds: of pieces with different functions.

    Raises:
        InputError: they are not 1 >= alike >= kinds >= 0.
    """

    alike: float = 1.0
    kinds: float = COMMON

    def __post_init__(self) -> None:
        if not 0.0 <= self.kinds <= self.alike <= 1.0:
            raise InputError(
                "correlation: that of alike pieces and that of different kinds must be 1 >= alike "
                f">= kinds >= 0, got {self.alike:g} and {self.kinds:g}"
            )


class LossCurve(NamedTuple):
    """The loss exceedance curve: rates at which losses are exceeded [1/year]."""

    losses: NDArray[np.float64]
    rates: NDArray[np.float64]

    def at(self, years: float) -> float:
        """The loss that is exceeded once in so many years: the smallest with no higher a rate."""
        return float(self.losses[int(np.argmax(self.rates <= 1.0 / years))])


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces with their functions.

    Attributes:
        median, beta: (draw, kind); the first is what was found, the others are of the bootstrap.
        quantity, cost: of each kind, (kind,).
        function: number of the function of each kind, (kind,).
    """

    median: NDArray[np.float64]
    beta: NDArray[np.float64]
    quantity: NDArray[np.int64]
    cost: NDArray[np.float64]
    function: NDArray[np.intp]

    @classmethod
    def of(cls, exposure: Exposure) -> Pieces:
        """Those of the objects that count."""
        curves = list(dict.fromkeys(one.curve for one in exposure.objects))
        of = np.array([curves.index(one.curve) for one in exposure.objects], np.intp)
        found = np.array([(curve.median, curve.beta) for curve in curves]).T
        # an interval is known where that of every function is
        draws = min(curve.fits.median.size for curve in curves) - 1
        draws = draws if all(curve.drawn[0].size for curve in curves) else 0
        each = []
        for curve, (median, beta) in zip(curves, found.T, strict=True):
            theta, spread = (reflected(one)[:draws] for one in curve.widened)
            # a draw without a fit is taken as what was found
            fitted = np.isfinite(theta) & np.isfinite(spread)
            each.append((np.where(fitted, theta, median), np.where(fitted, spread, beta)))
        medians = np.column_stack([one[0] for one in each])
        betas = np.column_stack([one[1] for one in each])
        return cls(
            np.vstack([found[0], medians])[:, of],
            np.vstack([found[1], betas])[:, of],
            np.array([one.item.quantity for one in exposure.objects]),
            np.array([exposure.value(one) for one in exposure.objects]),
            of,
        )

    @property
    def draws(self) -> int:
        """How many draws of the functions there are."""
        return len(self.median) - 1

    def average(self, hazard: Hazard) -> NDArray[np.float64]:
        """The average annual loss with the functions and with each draw of them, (1 + draw,)."""
        _, first = np.unique(self.function, return_index=True)
        value = np.bincount(self.function, self.quantity * self.cost)
        rate = [rate_parts(hazard, self.median[:, k], self.beta[:, k]).sum(axis=1) for k in first]
        return np.asarray(np.array(value) @ np.array(rate))

    def drawn(self, number: int) -> Pieces:
        """The pieces with the number-th draw of their functions, from 0."""
        at = slice(number + 1, number + 2)
        return Pieces(self.median[at], self.beta[at], self.quantity, self.cost, self.function)


def loss_curve(
    pieces: Pieces, hazard: Hazard, correlation: Correlation, *, draws: int, seed: int
) -> LossCurve:
    """The curve of losses, from so many draws at each level of the hazard curve."""
    random = np.random.default_rng(seed)
    level, rate = _cut(hazard, pieces.median[0], pieces.beta[0])
    alike, kinds = correlation.alike, correlation.kinds
    theta, beta = np.log(pieces.median[0]), pieces.beta[0]
    functions, own = int(pieces.function.max()) + 1, np.sqrt(1.0 - alike)
    at_once = max(1, AT_ONCE // (draws * theta.size))
    found = []
    for some in np.array_split(np.log(level), -(-LEVELS // at_once)):
        shape = some.size, draws
        site = random.standard_normal((*shape, 1))
        kind = random.standard_normal((*shape, functions))[..., pieces.function]
        deviate = np.sqrt(kinds) * site + np.sqrt(alike - kinds) * kind
        left = some[:, None, None] - theta - beta * deviate
        if own > 0.0:
            fallen = random.binomial(pieces.quantity, ndtr(left / np.maximum(beta * own, 1e-12)))
        else:
            fallen = pieces.quantity * (left > 0.0)
        found.append((fallen @ pieces.cost).ravel())
    loss = np.concatenate(found)
    weight = np.repeat(rate / draws, draws)
    order = np.argsort(loss)
    ordered = loss[order]
    # the rate of losses above each: what comes behind it
    above = np.concatenate([np.cumsum(weight[order][::-1])[::-1][1:], [0.0]])
    last = np.flatnonzero(np.append(np.diff(ordered) > 0.0, True))
    return LossCurve(ordered[last], above[last])


def _cut(
    hazard: Hazard, median: NDArray[np.float64], beta: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Levels and the rate of each, from where nothing falls to beyond the curve."""
    low = float((median * np.exp(-4.0 * beta)).min())
    known = hazard.levels[: hazard.positive]
    high = float(known[-1]) * (1.0 if hazard.ends else BEYOND)
    edges = np.geomspace(min(low, float(known[0])), high, LEVELS + 1)
    exceeded = hazard.rate(edges)
    rate = exceeded[:-1] - exceeded[1:]
    rate[-1] += exceeded[-1]
    return np.sqrt(edges[:-1] * edges[1:]), np.maximum(rate, 0.0)
