"""The capacities of an incremental dynamic analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


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
