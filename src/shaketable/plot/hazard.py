"""A hazard curve, and from which of its levels the falls come."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shaketable.fragility.drawn import COLOURS
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import AnnualRate, Hazard
from shaketable.hazard.totals import LossTotals

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PERIODS = (475.0, 2475.0)  # years between exceedances that are marked


def plot_hazard(hazard: Hazard, ax: Axes | None = None) -> Axes:
    """The annual rate of exceedance of each level, and usual return periods."""
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.4), layout="constrained").subplots()
    unit = unit_shown(hazard.measure)
    known = hazard.rates > 0.0
    ax.plot(unit.factor * hazard.levels[known], hazard.rates[known], "o-", color=COLOURS[0],
            markersize=3)  # fmt: skip
    for years in PERIODS:
        if hazard.rates[known][-1] < 1.0 / years < hazard.rates[0]:
            ax.axhline(1.0 / years, color="0.7", linewidth=0.8)
            ax.text(0.01, 1.0 / years, f"once in {years:g} years", fontsize="x-small",
                    va="bottom", transform=ax.get_yaxis_transform())  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel=f"{hazard.measure.name} of the ground [{unit.name}]",
           ylabel="annual rate of exceedance [1/year]")  # fmt: skip
    ax.xaxis.set_major_formatter("{x:g}")
    return ax


def plot_levels(
    found: Sequence[tuple[str, AnnualRate]], hazard: Hazard, ax: Axes | None = None
) -> Axes:
    """The share of each object's falls that comes from below each level of the ground's motion.

    Args:
        found: names and rates, of which each has a function.
        hazard: the curve that they were found with.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.4), layout="constrained").subplots()
    unit = unit_shown(hazard.measure)
    for k, (name, one) in enumerate(found):
        share = np.cumsum(one.by_level)[:-1] / one.rate
        ax.plot(unit.factor * one.levels[1:-1], share, color=COLOURS[k % len(COLOURS)], label=name)
    ax.set(xscale="log", xlabel=f"{hazard.measure.name} of the ground [{unit.name}]",
           ylabel="share of the falls from below", ylim=(-0.02, 1.02))  # fmt: skip
    ax.xaxis.set_major_formatter("{x:g}")
    ax.legend(fontsize="small", loc="upper left")
    return ax


def plot_losses(totals: LossTotals, ax: Axes | None = None) -> Axes:
    """The loss exceedance curve, and losses at return periods with their 95 % intervals.

    Args:
        totals: of a site.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.4), layout="constrained").subplots()
    some = totals.rates > 0.0
    ax.plot(totals.losses[some], totals.rates[some], color=COLOURS[0])
    for each in totals.periods:
        if np.isfinite(each.low):
            ax.plot([each.low, each.high], [1.0 / each.years] * 2, color=COLOURS[0], alpha=0.5)
        marker = "o" if not each.beyond_curve else "x"
        ax.plot(each.loss, 1.0 / each.years, marker, color=COLOURS[0], markersize=4)
        ax.annotate(f"{each.years:g} years", (each.loss, 1.0 / each.years), fontsize="x-small",
                    xytext=(4, 3), textcoords="offset points")  # fmt: skip
    ax.set(yscale="log", ylim=(0.4 / max(each.years for each in totals.periods), None),
           xlabel="loss [currency of the list]" if totals.in_cost else "pieces that fall",
           ylabel="annual rate of exceedance [1/year]")  # fmt: skip
    return ax
