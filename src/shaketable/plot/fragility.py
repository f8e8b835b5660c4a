"""What stands beside fragility functions: capacities, residuals, and two measures at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shaketable.fragility.covariates import DISTANCE, DURATION, MAGNITUDE
from shaketable.fragility.two_measures import VectorFragility

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LABELS = {
    DURATION: "significant duration D5-95 [s]",
    MAGNITUDE: "magnitude",
    DISTANCE: "distance to the rupture [km]",
}
LINEAR = (MAGNITUDE,)
COLOUR = "#1b6ca8"
SHARES = (0.02, 0.16, 0.5, 0.84, 0.98)  # that are drawn of two measures


def plot_residuals(table: pd.DataFrame) -> Figure:
    """The residuals of recordings against each quantity that is known of them.

    Args:
        table: what `residuals` gives.
    """
    from matplotlib.figure import Figure
    from matplotlib.ticker import LogLocator, NullFormatter

    known = [name for name in LABELS if name in table]
    figure = Figure(figsize=(max(6.4, 3.4 * len(known)), 3.6), layout="constrained")
    row = figure.subplots(1, len(known), sharey=True, squeeze=False)[0]
    for ax, name in zip(row, known, strict=True):
        x, y = table[name].to_numpy(), table["residual"].to_numpy()
        x, y = x[np.isfinite(y)], y[np.isfinite(y)]
        ax.axhline(0.0, color="0.6", linewidth=0.8)
        ax.plot(x, y, "o", color=COLOUR, markersize=4)
        at = x if name in LINEAR else np.log(x)
        if x.size > 2 and np.ptp(at) > 0.0:
            slope, start = np.polyfit(at, y, 1)
            ends = np.array([x.min(), x.max()])
            line = start + slope * (ends if name in LINEAR else np.log(ends))
            ax.plot(ends, line, color="#c8553d", linewidth=1.2)
        if name not in LINEAR:
            ax.set_xscale("log")
            ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            ax.xaxis.set_major_formatter("{x:g}")
            ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xlabel(LABELS[name])
    row[0].set_ylabel("ln(own median / θ)")
    return figure


def plot_measures(measures: pd.DataFrame, ax: Axes) -> Axes:
    """The dispersion about each measure of one body, with its interval.

    Args:
        measures: the rows of one body of what `efficiency` gives.
        ax: axes to draw on.
    """
    at = np.arange(len(measures))[::-1]
    middle = measures["dispersion"].to_numpy()
    low, high = measures["dispersion_low"].to_numpy(), measures["dispersion_high"].to_numpy()
    # limits of a basic bootstrap need not hold the estimate
    ax.hlines(at, low, high, color=COLOUR)
    ax.plot(middle, at, "o", color=COLOUR)
    ax.set_yticks(at, measures["measure"].tolist())
    ax.set_xlabel("dispersion of the factor on the motion")
    ax.set_xlim(left=0.0)
    return ax


def plot_two_measures(found: VectorFragility, ax: Axes | None = None) -> Axes:
    """Lines of equal probability in the plane of the two dimensionless measures."""
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.8), layout="constrained").subplots()
    velocity, acceleration = np.meshgrid(
        np.geomspace(0.1, 10.0, 121), np.geomspace(found.least or 0.1, 10.0, 121)[1:]
    )
    share = found.at(velocity, acceleration)
    lines = ax.contour(velocity, acceleration, share, levels=list(SHARES), cmap="viridis")
    ax.clabel(lines, fmt=lambda level: f"{100 * level:g} %", fontsize="small")
    ax.set(xscale="log", yscale="log", xlabel="p·PGV/(g tan α)", ylabel="PGA/(g tan α)")
    ax.set_ylim(0.5 * (found.least or 0.2), 10.0)
    if found.least:
        ax.axhspan(0.5 * found.least, found.least, color="0.9")
        ax.text(0.12, 0.7 * found.least, "does not move", color="0.4", va="center")
    for side in (ax.xaxis, ax.yaxis):
        side.set_major_formatter("{x:g}")
        side.set_minor_formatter("")
    ax.set_title(f"probability that a block {found.state.name}", fontsize="medium")
    return ax


def plot_capacities(runs: xr.Dataset, factor: float, unit: str, ax: Axes | None = None) -> Axes:
    """The share of motions that overturn each body up to a level, and what is survived above.

    Args:
        runs: what `ida` gives.
        factor, unit: of the unit in which levels are shown, from SI.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure
    from matplotlib.ticker import LogLocator, NullFormatter

    if ax is None:
        ax = Figure(figsize=(8.6, 5.0), layout="constrained").subplots()
    for body in range(runs.sizes["body"]):
        capacity = np.sort(runs["capacity"].values[body].ravel())
        known = factor * capacity[np.isfinite(capacity)]
        share = np.arange(1, known.size + 1) / capacity.size
        (line,) = ax.step(known, share, where="post", label=str(runs["body"].values[body]))
        above = factor * runs["highest_survived"].values[body].ravel()
        above = above[np.isfinite(above)]
        told = "highest level that is survived above a fall" if body == 0 else None
        low = np.full(above.size, -0.03 - 0.02 * body)
        ax.plot(above, low, "|", color=line.get_color(), label=told)
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel(f"{runs.attrs['measure']} [{unit}]")
    ax.set_ylabel("share of motions that overturn it up to there")
    ax.set_yticks(np.linspace(0.0, 1.0, 6))
    ax.set_ylim(top=1.02)
    ax.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return ax
