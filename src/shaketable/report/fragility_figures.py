"""Figures of fragility functions: each with the simulations that it was fitted to."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.fragility import Curve, Fragility
from shaketable.fragility.exported import unit_shown
from shaketable.fragility.lognormal import Capacities

#: What is drawn beside a function: of an IDA, or of simulations.
BESIDE = {
    True: "Steps are the share of shakings whose lowest overturning level lies below.",
    False: "A point is the share of simulations at about one level; all have as many of them.",
}
SIZE = (6.4, 4.4)  # inches
MOST_BODIES = 6  # in a figure of their own
BINS = 8
ENDS = 3.0  # standard deviations of ln x that a curve is drawn over
COLOURS = ("#1b6ca8", "#c8553d", "#588157", "#7b2d8b", "#b58900", "#555555")


def figures(
    fragility: Fragility, measures: pd.DataFrame | None
) -> Iterator[tuple[str, str, Figure]]:
    """The name, the caption and the figure of each.

    Args:
        fragility: what was found.
        measures: what `efficiency` gives of the first body, or None.
    """
    count = len(fragility.states)
    for k, body in enumerate(fragility.bodies[:MOST_BODIES]):
        figure = Figure(figsize=SIZE, layout="constrained")
        draw_curves(figure.subplots(), fragility.curves[k * count : (k + 1) * count], body)
        yield (
            f"curve_{k + 1}",
            f"{body}: the probability of each state, with the 95 % band of a bootstrap over "
            f"earthquakes. {BESIDE[isinstance(fragility.curves[0].data, Capacities)]}",
            figure,
        )
    if measures is not None:
        figure = Figure(figsize=SIZE, layout="constrained")
        draw_measures(figure.subplots(), measures)
        yield (
            "measures",
            f"{fragility.bodies[0]}: the dispersion about each measure, with its 95 % interval "
            "over earthquakes. The smaller it is, the more a measure tells.",
            figure,
        )


def draw_curves(ax: Axes, curves: tuple[Curve, ...], title: str) -> None:
    """The functions of one body, with their bands and what they were fitted to."""
    unit = unit_shown(curves[0].measure)
    for curve, colour in zip(curves, COLOURS, strict=False):
        _draw_data(ax, curve, colour, unit.factor)
        if curve.problem:
            continue
        levels = curve.median * np.exp(curve.beta * np.linspace(-ENDS, ENDS, 161))
        shown = unit.factor * levels
        if curve.fits.median.size > 1:
            ax.fill_between(shown, *curve.band(levels), color=colour, alpha=0.18, linewidth=0)
        label = f"{curve.state.name}: θ {unit.factor * curve.median:.3g}, β {curve.beta:.2f}"
        ax.plot(shown, curve.probability(levels), color=colour, label=label)
    ax.set_xlabel(f"{curves[0].measure.name} [{unit.name}]")
    ax.set_ylabel("probability")
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlim(left=0.0)
    ax.set_title(title, fontsize="medium")
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower right", fontsize="small")


def _draw_data(ax: Axes, curve: Curve, colour: str, factor: float) -> None:
    if isinstance(curve.data, Capacities):
        known = np.sort(curve.data.level[curve.data.reached])
        share = np.arange(1, known.size + 1) / curve.data.level.size
        ax.step(factor * known, share, where="post", color=colour, alpha=0.5, linewidth=1.0)
        return
    order = np.argsort(curve.data.intensity, kind="stable")
    for some in np.array_split(order, min(BINS, order.size)):
        level = np.exp(np.log(curve.data.intensity[some]).mean())
        share = curve.data.reached[some].sum() / curve.data.trials[some].sum()
        ax.plot(factor * level, share, "o", color=colour, markersize=4)


def draw_measures(ax: Axes, measures: pd.DataFrame) -> None:
    """The dispersion about each measure of one body."""
    first = measures[measures["body"] == measures["body"].iloc[0]]
    at = np.arange(len(first))[::-1]
    middle = first["dispersion"].to_numpy()
    low, high = first["dispersion_low"].to_numpy(), first["dispersion_high"].to_numpy()
    ax.errorbar(middle, at, xerr=[middle - low, high - middle], fmt="o", color=COLOURS[0])
    ax.set_yticks(at, first["measure"].tolist())
    ax.set_xlabel("dispersion of the factor on the motion")
    ax.set_xlim(left=0.0)
