"""An earthquake: the spectra of its motions beside those wanted, and a map of what falls."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.drawing.shown import drawn
from shaketable.fragility.drawn import COLOURS
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import ShakeMap, SpectralTarget
from shaketable.signal import measure_named
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

MOST_LINES = 100
MOST_NAMED = 12  # places on a map
LARGEST = 18.0  # points: the dot of the place where most falls


def plot_target(
    target: SpectralTarget, ln_spectra: NDArray[np.float64], ax: Axes | None = None
) -> Axes:
    """The spectra of motions, their median and spread, and those of the target.

    Args:
        target: what they should be like.
        ln_spectra: of the motions at its periods [ln m/s²], (motion, period).
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.4, 4.4), layout="constrained").subplots()
    g = STANDARD_GRAVITY
    for one in ln_spectra[:MOST_LINES]:
        ax.plot(target.periods, np.exp(one) / g, color="0.8", linewidth=0.6)
    ax.plot([], [], color="0.8", label=f"{len(ln_spectra)} motions")
    mean, sigma = ln_spectra.mean(axis=0), ln_spectra.std(axis=0, ddof=1)
    for k, (middle, spread, who) in enumerate((
        (target.mean, target.sigma, "wanted"), (mean, sigma, "of the motions"),
    )):  # fmt: skip
        style: dict[str, Any] = {"color": COLOURS[k], "linestyle": "-" if k == 0 else "--"}
        ax.plot(target.periods, np.exp(middle) / g, linewidth=2.0,
                label=f"median {who}", **style)  # fmt: skip
        for sign in (-1.0, 1.0):
            ax.plot(target.periods, np.exp(middle + sign * spread) / g, linewidth=1.0,
                    label=f"± 1 standard deviation {who}" if sign > 0.0 else None,
                    **style)  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel="period [s]",
           ylabel="spectral acceleration, 5 % damped [g]")  # fmt: skip
    ax.xaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_major_formatter("{x:g}")
    ax.legend(fontsize="x-small", loc="lower left")
    return ax


def plot_map(quake: ShakeMap, measure: str, places: pd.DataFrame, ax: Axes | None = None) -> Axes:
    """Draw a map of the shaking and of the expected falls.

    Args:
        quake: of which the shaking is drawn.
        measure: PGA, PGV or SA(T), as the map has it.
        places: what `EarthquakeFalls.place_table` gives.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(7.0, 5.6), layout="constrained").subplots()
    known = measure_named(measure)
    unit = unit_shown(known)
    x, y = quake.longitudes, quake.latitudes
    shown = unit.factor * np.exp(quake.ln_median[known.name])
    filled = ax.contourf(x, y, shown, levels=12, cmap="YlOrBr")
    assert ax.figure is not None
    ax.figure.colorbar(filled, ax=ax, label=f"median {known.name} [{unit.name}]", shrink=0.85)
    falls = np.nan_to_num(places["expected_falls"].to_numpy())  # none where no function is known
    most = max(float(falls.max(initial=0.0)), 1e-12)
    size = LARGEST * min(1.0, (MOST_LINES / len(places)) ** 0.25)
    ax.scatter(
        places["longitude"], places["latitude"], s=4.0 + size**2 * falls / most,
        color=COLOURS[0], edgecolor="white", linewidth=0.6, alpha=0.85, zorder=3,
        rasterized=len(places) > MOST_LINES,
    )  # fmt: skip
    if len(places) <= MOST_NAMED:
        above = _labels_below(places, float(np.ptp(x)), float(np.ptp(y)))
        for k, row in enumerate(places.to_dict("records")):
            name = f"{row['building']}: " if row["building"] else ""
            ax.annotate(
                drawn(f"{name}{_told(row['expected_falls'])}"),
                (row["longitude"], row["latitude"]),
                xytext=(28, 18 + 14 * above[k]), textcoords="offset points", fontsize="small",
                arrowprops={"arrowstyle": "-", "linewidth": 0.7, "color": "0.2"}, zorder=4,
                bbox={"facecolor": "white", "alpha": 0.7, "linewidth": 0, "pad": 1},
            )  # fmt: skip
    ax.set(xlabel="longitude [°]", ylabel="latitude [°]",
           title="expected falls, by fragility functions: area of the dots")  # fmt: skip
    ax.set_aspect(1.0 / max(math.cos(math.radians(float(y.mean()))), 0.05))
    return ax


def _told(falls: float) -> str:
    return f"{falls:.2g}" if np.isfinite(falls) else "not known"


def _labels_below(places: pd.DataFrame, width: float, height: float) -> list[int]:
    """How many labels of near places stand below that of each, so that none covers another."""
    found: list[int] = []
    sites = places[["longitude", "latitude"]].to_numpy()
    for k, site in enumerate(sites):
        near = np.abs(sites[:k] - site) < (0.3 * width, 0.05 * height)
        found.append(1 + max((found[i] for i in np.flatnonzero(near.all(axis=1))), default=-1))
    return found
