"""What all objects of a site lose in a year: losses by how often they are exceeded.

The hazard curve is cut into levels with a rate each. At a level every object falls with the
probability of its fragility function, and objects fall together: what they withstand of one measure
departs from their medians alike, as one motion shakes them all. Losses are drawn at each level, and
weighed by its rate: the loss exceedance curve, whose mean is the average annual loss (Grossi and
Kunreuther 2005, Catastrophe modeling, chapter 2). The average, which is the sum of
the objects' own rates, does not depend on how they are correlated; rare losses do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.fragility.lognormal import ndtr, reflected
from shaketable.hazard.curve import Hazard
from shaketable.hazard.objects import ObjectRate, ObjectRates
from shaketable.hazard.rates import MUCH, rate_parts
from shaketable.hazard.spatial import COMMON
from shaketable.resampling import ends

if TYPE_CHECKING:
    import pandas as pd

#: Once in how many years losses are told, on average.
RETURN_PERIODS = (50.0, 100.0, 250.0, 475.0, 1000.0, 2475.0)
LEVELS, DRAWS = 240, 400  # of the curve, and of losses at each
FEWER = 100  # losses at each level for each draw of the functions
FUNCTIONS = 100  # draws of them
AT_ONCE = 2**21  # numbers of an array
BEYOND = 5.0  # times the last level of the curve: what is shaken by more is shaken by this


class Correlation(NamedTuple):
    """Of what objects withstand of one measure, beside their medians.

    Attributes:
        alike: of pieces with the same function.
        kinds: of pieces with different functions.
    """

    alike: float = 1.0
    kinds: float = COMMON


#: The usual one, and what it is varied by.
CORRELATIONS = {
    "usual": Correlation(),
    "each piece by itself": Correlation(0.0, 0.0),
    "all together": Correlation(1.0, 1.0),
}


class PeriodLoss(NamedTuple):
    """A loss that is exceeded once in so many years, with its 95 % interval.

    The interval is that of the fragility functions; the hazard curve is taken as it is. What is
    rarer than the last level of the curve comes from beyond it.
    """

    years: float
    loss: float
    low: float
    high: float
    beyond_curve: bool


@dataclass(frozen=True, kw_only=True, eq=False)
class LossTotals:
    """What the objects of a site lose together.

    Attributes:
        in_cost: whether losses are in the list's currency; otherwise they are pieces that fall.
        value: of all pieces that count.
        losses, rates: the loss exceedance curve: rates at which losses are exceeded [1/year].
        average: loss of a year, on average.
        average_interval: its 95 % interval, from the fragility functions'.
        average_above: the share of it that comes from above the hazard curve's last level.
        periods: losses at return periods.
        varied: the same periods' losses with other correlations, by their names.
        correlation: that was used.
        without_cost, without_function: names of objects that do not count.
    """

    in_cost: bool
    value: float
    losses: NDArray[np.float64]
    rates: NDArray[np.float64]
    average: float
    average_interval: tuple[float, float]
    average_above: float
    periods: tuple[PeriodLoss, ...]
    varied: dict[str, tuple[float, ...]]
    correlation: Correlation
    without_cost: tuple[str, ...]
    without_function: tuple[str, ...]

    def table(self) -> pd.DataFrame:
        """A row for the average and for each return period, with each correlation."""
        import pandas as pd

        first = {
            "return_period": np.nan, "loss": self.average, "loss_low": self.average_interval[0],
            "loss_high": self.average_interval[1],
            "beyond_hazard_curve": self.average_above > MUCH,
            **{_column(name): self.average for name in self.varied},
        }  # fmt: skip
        rows = [
            {"return_period": each.years, "loss": each.loss, "loss_low": each.low,
             "loss_high": each.high, "beyond_hazard_curve": each.beyond_curve,
             **{_column(name): losses[k] for name, losses in self.varied.items()}}
            for k, each in enumerate(self.periods)
        ]  # fmt: skip
        table = pd.DataFrame([first, *rows])
        table.insert(0, "what", ["average annual loss", *["loss exceeded once in"] * len(rows)])
        table["unit"] = "cost" if self.in_cost else "pieces"
        return table

    def curve_table(self) -> pd.DataFrame:
        """The loss exceedance curve."""
        import pandas as pd

        return pd.DataFrame(
            {
                "loss": self.losses,
                "unit": "cost" if self.in_cost else "pieces",
                "annual_rate_of_exceedance": self.rates,
            }
        )


def _column(name: str) -> str:
    return f"loss_{name.replace(' ', '_')}"


def loss_totals(
    rates: ObjectRates,
    *,
    correlation: Correlation | None = None,
    return_periods: Sequence[float] = RETURN_PERIODS,
    seed: int = 0,
) -> LossTotals:
    """What the objects of a site lose together.

    Of an object the direction counts in which it falls more often. A piece that falls is lost.

    Args:
        rates: what `object_rates` gives.
        correlation: of what objects withstand; the usual one by default.
        return_periods: at which losses are told [years].
        seed: of the draws.

    Raises:
        InputError: no object has a fragility function, or a correlation out of order.
    """
    used = correlation or Correlation()
    if not 0.0 <= used.kinds <= used.alike <= 1.0:
        raise InputError(
            f"correlations must be 0 <= kinds <= alike <= 1, got {used.kinds:g} and {used.alike:g}"
        )
    worse = list(rates.of_objects().values())
    known = [one for one in worse if not one.curve.problem]
    in_cost = any(one.item.cost is not None for one in known)
    counted = [one for one in known if not in_cost or one.item.cost is not None]
    if not counted:
        raise InputError("no object has a fragility function: nothing can be added up")
    pieces = _Pieces.of(counted, in_cost)
    varied = {**CORRELATIONS, "usual": used}
    curves = {
        name: _exceedance(pieces, rates.hazard, each, LEVELS, DRAWS, seed)
        for name, each in varied.items()
    }
    losses, exceeded = curves["usual"]
    drawn = [
        _exceedance(pieces.drawn(k), rates.hazard, used, LEVELS, FEWER, seed)
        for k in range(min(FUNCTIONS, pieces.draws))
    ]
    periods = []
    last = 0.0 if rates.hazard.ends else float(rates.hazard.rates[rates.hazard.positive - 1])
    for years in return_periods:
        loss = _at(losses, exceeded, years)
        each = [_at(one.losses, one.rates, years) for one in drawn]
        low, high = ends(np.array(each)) if each else (np.nan, np.nan)
        periods.append(
            # of fewer draws an end may lie beyond what more of them give
            PeriodLoss(years, loss, min(low, loss), max(high, loss), last > 1.0 / years)
            if each
            else PeriodLoss(years, loss, low, high, last > 1.0 / years)
        )
    yearly = pieces.average(rates.hazard)
    return LossTotals(
        in_cost=in_cost,
        value=float(pieces.quantity @ pieces.cost),
        losses=losses,
        rates=exceeded,
        average=float(yearly[0]),
        average_interval=ends(yearly[1:]) if yearly.size > 1 else (np.nan, np.nan),
        average_above=float(
            sum(
                one.item.quantity * cost * one.found.by_level[-1]
                for one, cost in zip(counted, pieces.cost, strict=True)
            )
            / yearly[0]
        )
        if yearly[0] > 0.0
        else 0.0,
        periods=tuple(periods),
        varied={
            name: tuple(_at(one.losses, one.rates, years) for years in return_periods)
            for name, one in curves.items()
            if name != "usual"
        },
        correlation=used,
        without_cost=tuple(
            one.item.called(one.number) for one in known if in_cost and one.item.cost is None
        ),
        without_function=tuple(one.item.called(one.number) for one in worse if one.curve.problem),
    )


@dataclass(frozen=True, eq=False)
class _Pieces:
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
    def of(cls, counted: Sequence[ObjectRate], in_cost: bool) -> _Pieces:
        """Those of objects with a function."""
        curves = list(dict.fromkeys(one.curve for one in counted))
        of = np.array([curves.index(one.curve) for one in counted], np.intp)
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
            np.array([one.item.quantity for one in counted]),
            np.array([(one.item.cost if in_cost else 1.0) or 0.0 for one in counted]),
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

    def drawn(self, number: int) -> _Pieces:
        """The pieces with the number-th draw of their functions, from 0."""
        at = slice(number + 1, number + 2)
        return _Pieces(self.median[at], self.beta[at], self.quantity, self.cost, self.function)


class _Exceedance(NamedTuple):
    """A loss exceedance curve."""

    losses: NDArray[np.float64]
    rates: NDArray[np.float64]


def _exceedance(
    pieces: _Pieces, hazard: Hazard, correlation: Correlation, levels: int, draws: int, seed: int
) -> _Exceedance:
    """The curve of losses, by draws at each level."""
    random = np.random.default_rng(seed)
    level, rate = _cut(hazard, pieces.median[0], pieces.beta[0], levels)
    alike, kinds = correlation
    theta, beta = np.log(pieces.median[0]), pieces.beta[0]
    functions, own = int(pieces.function.max()) + 1, np.sqrt(1.0 - alike)
    at_once = max(1, AT_ONCE // (draws * theta.size))
    found = []
    for some in np.array_split(np.log(level), -(-levels // at_once)):
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
    return _Exceedance(ordered[last], above[last])


def _cut(
    hazard: Hazard, median: NDArray[np.float64], beta: NDArray[np.float64], count: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Levels and the rate of each, from where nothing falls to beyond the curve."""
    low = float((median * np.exp(-4.0 * beta)).min())
    known = hazard.levels[: hazard.positive]
    high = float(known[-1]) * (1.0 if hazard.ends else BEYOND)
    edges = np.geomspace(min(low, float(known[0])), high, count + 1)
    exceeded = hazard.rate(edges)
    rate = exceeded[:-1] - exceeded[1:]
    rate[-1] += exceeded[-1]
    return np.sqrt(edges[:-1] * edges[1:]), np.maximum(rate, 0.0)


def _at(losses: NDArray[np.float64], rates: NDArray[np.float64], years: float) -> float:
    """The loss that is exceeded once in so many years: the smallest with no higher a rate."""
    return float(losses[int(np.argmax(rates <= 1.0 / years))])
