"""Fragility functions drawn with the simulations that they were fitted to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shaketable.fragility.curve import Curve
from shaketable.fragility.lognormal import Capacities
from shaketable.fragility.shown import unit_shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BINS = 8
ENDS = 3.0  # standard deviations of ln x that a curve is drawn over
COLOURS = ("#1b6ca8", "#c8553d", "#588157", "#7b2d8b", "#b58900", "#555555")


def plot_functions(curves: Sequence[Curve], ax: Axes | None = None) -> Axes:
    """Fragility functions of one measure, with 95 % bands and what they were fitted to.

    A point is the share of simulations at about one level; all points have as many of them. Of an
    IDA steps are the share of shakings whose lowest level lies below.

    Args:
        curves: of one body or of several.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.4), layout="constrained").subplots()
    unit = unit_shown(curves[0].measure)
    several = len({curve.body for curve in curves}) > 1
    end = 0.0  # of the longest curve: beyond it points tell nothing
    for k, curve in enumerate(curves):
        colour = COLOURS[k % len(COLOURS)]
        _draw_data(ax, curve, colour, unit.factor)
        if curve.problem:
            ax.plot([], [], "o", color=colour, markersize=4, label=f"{curve.state.name}: no fit")
            continue
        levels = curve.median * np.exp(curve.beta * np.linspace(-ENDS, ENDS, 161))
        shown = unit.factor * levels
        end = max(end, 1.02 * shown[-1])
        if curve.fits.median.size > 1:
            ax.fill_between(shown, *curve.band(levels), color=colour, alpha=0.18, linewidth=0)
        whose = f"{curve.body.name or 'body'}, " if several else ""
        median = f"{unit.factor * curve.median:.3g}"
        label = f"{whose}{curve.state.name}: θ {median}, β {curve.beta:.2f}"
        ax.plot(shown, curve.probability(levels), color=colour, label=label)
    ax.set_xlabel(f"{curves[0].measure.name} [{unit.name}]")
    ax.set_ylabel("probability")
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlim(left=0.0, right=end or None)
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower right", fontsize="small")
    return ax


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
