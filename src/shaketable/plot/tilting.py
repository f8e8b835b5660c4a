"""What a tilt does to a body: which way it falls, and how often."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor, outside_of_scor, scor
from shaketable.drawing.shown import drawn
from shaketable.tilting import TiltDesign

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_tilt(design: TiltDesign, axes: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
    """Draw the share of the falls that go downhill, with the published curves, and of falls.

    Args:
        design: what `design_tilt` gives.
        axes: upper and lower axes; a new figure by default.
    """
    from matplotlib.figure import Figure

    if axes is None:
        figure = Figure(figsize=(10.2, 6.4), layout="constrained")
        axes = tuple(figure.subplots(2, 1, sharex=True, height_ratios=(3, 2)))
    above, below = axes
    _directions(design, above)
    _falls(design, below)
    curves = design.curves
    for ax in axes:
        ax.set_xlim(0.0, max(np.degrees(curves.tilts[-1]), 0.25))
        if math.isfinite(curves.control_tilt):
            ends = np.degrees(np.minimum(curves.control_tilt_interval, curves.tilts[-1]))
            ax.axvspan(*ends, color="tab:green", alpha=0.12, lw=0)
            ax.axvline(
                np.degrees(curves.control_tilt),
                color="tab:green",
                lw=1.2,
                label=f"{100 * design.control:g} % downhill from here on, with its 95 % interval",
            )
    name = drawn(design.body.name or "body")
    above.set_title(
        f"{name}: {design.motion_count} motions of {design.recording_count} recordings, both "
        f"directions{f', turned in {design.turns} ways' if design.turns > 1 else ''}",
        fontsize="medium",
    )
    above.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize="small")
    below.set_xlabel("tilt of the support [°]")
    return above, below


def _directions(design: TiltDesign, ax: Axes) -> None:
    """Share of the falls that go downhill, with the published curves."""
    body, curves = design.body, design.curves
    tilts = np.degrees(curves.tilts)
    low, high = curves.downhill_band
    ax.fill_between(tilts, 100 * low, 100 * high, color="tab:blue", alpha=0.2, lw=0)
    label = "simulated, with its 95 % interval"
    ax.plot(tilts, 100 * curves.downhill_share, ".-", color="tab:blue", label=label)
    fine = np.linspace(0.0, curves.tilts[-1], 200)
    at = np.degrees(fine)
    ax.plot(at, 100 * gcor(fine), color="black", lw=1.2, label="GCOR, any body")
    specific = scor(fine, body.base, 2 * body.cg_height)
    if np.isfinite(specific).all():
        beyond = outside_of_scor(body.base, 2 * body.cg_height)
        label = "SCOR, fitted to other bodies" if beyond else "SCOR, by its size"
        ax.plot(at, 100 * specific, "--", color="black", lw=1.2, label=label)
    ax.axhline(100 * design.control, color="0.6", lw=0.8)
    ax.set_ylabel("falls that go downhill [%]")
    ax.set_ylim(min(45.0, np.nanmin(100 * curves.downhill_share, initial=50.0) - 5.0), 101)


def _falls(design: TiltDesign, ax: Axes) -> None:
    """Share of the simulations that overturn the body."""
    curves = design.curves
    tilts = np.degrees(curves.tilts)
    low, high = curves.fall_band
    ax.fill_between(tilts, 100 * low, 100 * high, color="tab:red", alpha=0.2, lw=0)
    ax.plot(tilts, 100 * curves.fall_share, ".-", color="tab:red")
    ax.set_ylabel("shakings that overturn it [%]")
    ax.set_ylim(0, 101)
