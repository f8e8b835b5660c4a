"""Figures of fragility functions: each with the simulations that it was fitted to."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd
from matplotlib.figure import Figure

from shaketable.fragility import Fragility
from shaketable.fragility.lognormal import Capacities
from shaketable.plot import plot_functions, plot_measures, plot_residuals

#: What is drawn beside a function: of an IDA, or of simulations.
BESIDE = {
    True: "Steps are the share of shakings whose lowest overturning level lies below.",
    False: "A point is the share of simulations at about one level; all have as many of them.",
}
SIZE = (6.4, 4.4)  # inches
MOST_BODIES = 6  # in a figure of their own


def figures(
    fragility: Fragility, measures: pd.DataFrame | None, residuals: pd.DataFrame | None
) -> Iterator[tuple[str, str, Figure]]:
    """The name, the caption and the figure of each.

    Args:
        fragility: what was found.
        measures, residuals: what `efficiency` and `residuals` give of the first body, or None.
    """
    count = len(fragility.states)
    for k, body in enumerate(fragility.bodies[:MOST_BODIES]):
        figure = Figure(figsize=SIZE, layout="constrained")
        ax = plot_functions(fragility.curves[k * count : (k + 1) * count], figure.subplots())
        ax.set_title(body, fontsize="medium")
        yield (
            f"curve_{k + 1}",
            f"{body}: the probability of each state, with the 95 % band of a bootstrap over "
            f"earthquakes. {BESIDE[isinstance(fragility.curves[0].data, Capacities)]}",
            figure,
        )
    if measures is not None:
        figure = Figure(figsize=SIZE, layout="constrained")
        plot_measures(measures, figure.subplots())
        yield (
            "measures",
            f"{fragility.bodies[0]}: the dispersion about each measure, with its 95 % interval "
            "over earthquakes. The smaller it is, the more a measure tells.",
            figure,
        )
    if residuals is not None:
        yield (
            "residuals",
            f"{fragility.bodies[0]}: how far the median of each recording lies from θ, in its "
            f"logarithm. Were {fragility.measure.name} all that matters of a motion, the points "
            "would not rise or fall with what else is known of it.",
            plot_residuals(residuals),
        )
