"""What a tilt does to a body: which way it falls, and how often."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from shaketable.criteria.boroschek_iruretagoyena_2006 import gcor, outside_of_scor, scor
from shaketable.tilting import TiltDesign

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_tilt(design: TiltDesign, axes: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
    """Share of the falls that go downhill with the published curves, and share that falls.

    Args:
        design: what `design_tilt` gives.
        axes: upper and lower axes; a new figure by default.
    """
    from matplotlib.figure import Figure

    if axes is None:
        figure = Figure(figsize=(7.2, 6.4), layout="constrained")
        axes = tuple(figure.subplots(2, 1, sharex=True, height_ratios=(3, 2)))
    above, below = axes
    body, curves = design.body, design.curves
    tilts = np.degrees(curves.tilts)
    low, high = curves.control_band
    above.fill_between(tilts, 100 * low, 100 * high, color="tab:blue", alpha=0.2, lw=0)
    above.plot(
        tilts,
        100 * curves.control,
        ".-",
        color="tab:blue",
        label="simulated, with its 95 % interval",
    )
    fine = np.linspace(0.0, curves.tilts[-1], 200)
    above.plot(
        np.degrees(fine), 100 * gcor(fine), color="black", lw=1.2, label="GCOR (paper, any body)"
    )
    beyond = outside_of_scor(body.width, 2 * body.cg_height)
    specific = scor(fine, body.width, 2 * body.cg_height)
    if np.isfinite(specific).all():
        note = ", outside its range" if beyond else ""
        above.plot(
            np.degrees(fine), 100 * specific, "--", color="black", lw=1.2, label=f"SCOR{note}"
        )
    above.axhline(100 * design.control, color="0.6", lw=0.8)
    for ax in axes:
        if math.isfinite(curves.tilt):
            ends = np.degrees(np.minimum(curves.tilt_interval, curves.tilts[-1]))
            ax.axvspan(*ends, color="tab:green", alpha=0.12, lw=0)
            ax.axvline(
                np.degrees(curves.tilt),
                color="tab:green",
                lw=1.2,
                label=f"{100 * design.control:g} % downhill from here on, with its 95 % interval",
            )
    low, high = curves.falls_band
    below.fill_between(tilts, 100 * low, 100 * high, color="tab:red", alpha=0.2, lw=0)
    below.plot(tilts, 100 * curves.falls, ".-", color="tab:red", label="simulated")
    above.set_ylabel("falls that go downhill [%]")
    above.set_ylim(min(45.0, np.nanmin(100 * curves.control, initial=45.0) - 5.0), 101)
    below.set_ylabel("shakings that overturn it [%]")
    below.set_ylim(0, 101)
    below.set_xlabel("tilt of the support [°]")
    below.set_xlim(0.0, tilts[-1])
    name = (body.name or "body").replace("$", r"\$")
    above.set_title(
        f"{name}: {design.motions} motions of {design.recordings} recordings, both directions",
        fontsize="medium",
    )
    above.legend(loc="lower right", fontsize="small")
    return above, below
