"""What stands below a history: the motion's acceleration, and the forces of straps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from shaketable.drawing.shown import Series, ShownMotion
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_trace(motion: ShownMotion, ax: Axes | None = None, *, transverse: bool = False) -> Axes:
    """Horizontal and vertical acceleration of the ground.

    Args:
        motion: what to show.
        ax: axes to draw on; a new figure by default.
        transverse: whether the second horizontal component is shown, too.
    """
    if ax is None:
        from matplotlib.figure import Figure

        ax = Figure(figsize=(9, 2.4), layout="constrained").subplots()
    components = {"horizontal": (motion.horizontal, "0.25", 0.7)}
    if transverse and motion.transverse is not None:
        components = {
            "along x": (motion.horizontal, "0.25", 0.7),
            "along y": (motion.transverse, "tab:cyan", 0.6),
        }
    if motion.vertical is not None:
        components["vertical"] = (motion.vertical, "tab:orange", 0.6)
    for label, (series, colour, width) in components.items():
        ax.plot(motion.time, series / STANDARD_GRAVITY, color=colour, lw=width, label=label)
    if len(components) > 1:
        ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize="small")
    ax.set_ylabel("ground\nacceleration [g]")
    ax.set_xlabel("time [s]")
    return ax


class ShownForces(Protocol):
    """What is asked of a response with straps."""

    @property
    def time(self) -> Series: ...
    @property
    def strap_forces(self) -> Series: ...
    @property
    def strap_broke_at(self) -> tuple[float, ...]: ...


def plot_forces(run: ShownForces, ax: Axes) -> None:
    """The force of each strap over time, and when one breaks."""
    forces = run.strap_forces
    for k, broke in enumerate(run.strap_broke_at):
        colour = f"C{k + 1}"
        ax.plot(run.time, forces[:, k], color=colour, lw=1.0, label=f"strap {k + 1}")
        if np.isfinite(broke):
            ax.axvline(broke, color=colour, lw=1.0, ls="--", label=f"strap {k + 1} breaks")
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel("strap [N]")
    ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize="small")
