"""One recorded component: its acceleration, velocity and displacement, and its spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.drawing.shown import drawn
from shaketable.motion import Motion
from shaketable.signal import PERIODS, Spectrum, displacement, response_spectrum, velocity
from shaketable.units import CM, STANDARD_GRAVITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LINE = "#2a6fae"


def plot_record(motion: Motion) -> Figure:
    """Histories of the horizontal component on the left, its 5 % spectrum on the right."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 5.4), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=(1.6, 1.0))
    series = {
        "acceleration [g]": motion.horizontal / STANDARD_GRAVITY,
        "velocity [cm/s]": velocity(motion.horizontal, motion.time_step) / CM,
        "displacement [cm]": displacement(motion.horizontal, motion.time_step) / CM,
    }
    for row, (label, values) in enumerate(series.items()):
        ax = figure.add_subplot(grid[row, 0])
        ax.plot(motion.time, values, color=LINE, lw=0.7)
        peak = int(np.argmax(np.abs(values)))
        ax.plot(motion.time[peak], values[peak], "o", ms=4, color="black")
        ax.annotate(
            f"{values[peak]:.3g}",
            (motion.time[peak], values[peak]),
            xytext=(6, 0),
            textcoords="offset points",
            fontsize="small",
            va="center",
        )
        ax.set_ylabel(label)
        ax.set_xlim(0.0, motion.duration)
        ax.margins(y=0.12)
        ax.axhline(0.0, color="0.7", lw=0.6, zorder=0)
    ax.set_xlabel("time [s]")
    plot_spectra([response_spectrum(motion)], figure.add_subplot(grid[:, 1]))
    figure.suptitle(drawn(_title(motion)), fontsize="medium")
    return figure


def plot_spectra(spectra: list[Spectrum], ax: Axes | None = None, **line: Any) -> Axes:
    """Pseudo-acceleration over period, both logarithmic.

    Args:
        ax: axes to draw on; a new figure by default.
        line: matplotlib's properties of the lines.
    """
    from matplotlib.figure import Figure

    if ax is None:
        ax = Figure(figsize=(6.0, 4.6), layout="constrained").subplots()
    style: dict[str, Any] = {"color": LINE, "lw": 1.2, **line}
    for spectrum in spectra:
        shown = spectrum.periods > 0.0
        ordinate = np.maximum(spectrum.acceleration[shown], 1e-9) / STANDARD_GRAVITY
        ax.loglog(spectrum.periods[shown], ordinate, **style)
    ax.set_xlabel("period [s]")
    ax.set_ylabel(f"pseudo-acceleration [g], {100 * spectra[0].damping:g} % damping")
    ax.set_xlim(PERIODS[0], PERIODS[-1])
    ax.grid(which="both", color="0.9", lw=0.6)
    return ax


def _title(motion: Motion) -> str:
    said = [motion.name]
    if motion.origin is not None:
        code = motion.origin.component
        said += [motion.origin.station, motion.origin.event, code and f"component {code}"]
    return ", ".join(word for word in dict.fromkeys(said) if word)
