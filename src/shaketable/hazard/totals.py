"""What all objects of a site lose in a year: losses by how often they are exceeded.

The average annual loss is the sum of the objects' own rates, and does not depend on how they are
correlated; rare losses do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.hazard.curve import Hazard
from shaketable.hazard.exceedance import Correlation, LossCurve, Pieces, loss_curve
from shaketable.hazard.exposure import exposure_of
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.rates import MUCH
from shaketable.resampling import ends

if TYPE_CHECKING:
    import pandas as pd

#: Once in how many years losses are told, on average.
RETURN_PERIODS = (50.0, 100.0, 250.0, 475.0, 1000.0, 2475.0)
DRAWS = 400  # of losses at each level of the hazard curve
FUNCTIONS = 100  # draws of the functions
FEWER = 100  # losses at each level for each of them
#: By what the correlation is varied.
VARIED = {
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
        InputError: no object has a fragility function.
    """
    used = correlation or Correlation()
    exposure = exposure_of(rates)
    pieces, hazard = Pieces.of(exposure), rates.hazard
    curve = loss_curve(pieces, hazard, used, draws=DRAWS, seed=seed)
    drawn = [
        loss_curve(pieces.drawn(k), hazard, used, draws=FEWER, seed=seed)
        for k in range(min(FUNCTIONS, pieces.draws))
    ]
    other = {
        name: loss_curve(pieces, hazard, each, draws=DRAWS, seed=seed)
        for name, each in VARIED.items()
    }
    yearly = pieces.average(hazard)
    above = sum(
        one.item.quantity * exposure.value(one) * one.found.by_level[-1] for one in exposure.objects
    )
    return LossTotals(
        in_cost=exposure.in_cost,
        value=float(pieces.quantity @ pieces.cost),
        losses=curve.losses,
        rates=curve.rates,
        average=float(yearly[0]),
        average_interval=ends(yearly[1:]) if drawn else (np.nan, np.nan),
        average_above=float(above / yearly[0]) if yearly[0] > 0.0 else 0.0,
        periods=tuple(_period(years, curve, drawn, hazard) for years in return_periods),
        varied={
            name: tuple(each.at(years) for years in return_periods) for name, each in other.items()
        },
        correlation=used,
        without_cost=tuple(one.item.called(one.number) for one in exposure.without_cost),
        without_function=tuple(one.item.called(one.number) for one in exposure.without_function),
    )


def _period(
    years: float, curve: LossCurve, drawn: Sequence[LossCurve], hazard: Hazard
) -> PeriodLoss:
    """The loss of a return period, with its interval from draws of the functions."""
    loss, low, high = curve.at(years), np.nan, np.nan
    if drawn:
        low, high = ends(np.array([each.at(years) for each in drawn]))
        # they have fewer losses at each level, so that an end may lie beyond what more of them give
        low, high = min(low, loss), max(high, loss)
    last = 0.0 if hazard.ends else float(hazard.rates[hazard.positive - 1])
    return PeriodLoss(years, loss, low, high, last > 1.0 / years)
