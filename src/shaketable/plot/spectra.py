"""Overturning and rocking spectra, and the capacities of an incremental dynamic analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shaketable.fragility import Fate

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

#: Area of each fate.
LOOKS = {
    Fate.RESTS: ("rests", "#e9e9e9"),
    Fate.ROCKS: ("rocks", "#9ecae1"),
    Fate.OVERTURNS_AFTER_IMPACTS: ("overturns after impacts", "#fdae6b"),
    Fate.OVERTURNS_WITHOUT_IMPACT: ("overturns without impact", "#c8553d"),
}


def plot_overturning_spectrum(
    spectrum: xr.Dataset, borders: pd.DataFrame | None = None, ax: Axes | None = None
) -> Axes:
    """Draw what pulses do to a body, over their frequency and amplitude.

    Args:
        spectrum: what `overturning_spectrum` gives.
        borders: what `fragility.borders` gives, drawn as dots.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    if ax is None:
        ax = Figure(figsize=(7.0, 5.0), layout="constrained").subplots()
    ax.pcolormesh(
        spectrum["frequency"].values,
        spectrum["amplitude"].values,
        spectrum["fate"].values.T,
        cmap=ListedColormap([colour for _, colour in LOOKS.values()]),
        norm=BoundaryNorm(np.arange(-0.5, len(LOOKS)), len(LOOKS)),
        shading="nearest",
        rasterized=True,
    )
    handles: list[Artist] = [
        Patch(fc=colour, ec="0.5", label=label) for label, colour in LOOKS.values()
    ]
    if borders is not None and len(borders):
        ax.plot(borders["frequency"], borders["amplitude"], ".", color="black", markersize=1.5)
    closed = spectrum["closed_form"].values
    if np.isfinite(closed).any():
        handles += ax.plot(
            spectrum["frequency"].values, closed, "--", color="black", linewidth=1.0,
            label="without impact, slender block",
        )  # fmt: skip
    ax.set_xlabel("pulse frequency ω$_p$/p [-]")
    ax.set_ylabel("peak acceleration a$_p$/(g tan α) [-]")
    ax.set_ylim(0.0, float(spectrum["amplitude"].max()))
    ax.set_title(
        f"{spectrum.attrs['pulse']} pulse, p = {spectrum.attrs['p']:.3g} rad/s, "
        f"α = {np.degrees(spectrum.attrs['slenderness']):.3g}°",
        fontsize="medium",
    )
    ax.legend(handles=handles, fontsize="small", loc="upper left")
    return ax


def plot_rocking_spectrum(spectrum: xr.Dataset, ax: Axes | None = None) -> Axes:
    """Return the largest rotation of blocks of all sizes under one motion.

    Args:
        spectrum: what `rocking_spectrum` gives.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(7.0, 5.0), layout="constrained").subplots()
    period = spectrum["period"].values
    for k, alpha in enumerate(spectrum["slenderness"].values.tolist()):
        share = spectrum["share"].values[k].copy()
        fallen = spectrum["overturns"].values[k]
        share[fallen] = np.nan
        (line,) = ax.plot(period, share, label=f"α = {np.degrees(alpha):.3g}°")
        ax.plot(period[fallen], np.full(fallen.sum(), 1.05 + 0.03 * k), "|", color=line.get_color())
    ax.set_xlabel("2π/p [s]")
    ax.set_ylabel("largest rotation over α [-]; above 1, | where it overturns")
    ax.set_ylim(0.0, 1.2)
    ax.set_title(spectrum.attrs["motion"], fontsize="medium")
    ax.legend(fontsize="small", loc="upper right")
    return ax
