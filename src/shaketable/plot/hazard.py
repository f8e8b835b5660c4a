"""A hazard curve, and from which of its levels the falls come."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shaketable.fragility.drawn import COLOURS
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import AnnualRate, Hazard

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
