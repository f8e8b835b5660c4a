"""The map of how a body at rest begins to move."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shaketable.criteria.shenton_1996 import Mode
from shaketable.drawing.history import BANDS, REST_COLOUR
from shaketable.drawing.shown import drawn
from shaketable.modes import ModeMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Area and points of each mode, in the colours of the bands of a history.
LOOKS = {
    Mode.REST: ("rest", REST_COLOUR, "0.45", "."),
    Mode.SLIDE: (*BANDS["SLIDE"], "#8a4f06", "s"),
    Mode.ROCK: (*BANDS["ROCK"], "#174a7c", "o"),
    Mode.SLIDE_ROCK: (*BANDS["SLIDE_ROCK"], "#3f1d6e", "^"),
}


def plot_modes(modes: ModeMap, friction: float | None = None, ax: Axes | None = None) -> Axes:
    """Areas by Shenton's criteria, beneath simulated points, over acceleration and friction.

    Args:
        modes: the result of `map_modes`.
        friction: μ_s to mark with a line.
        ax: axes to draw on; a new figure by default.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    if ax is None:
        ax = Figure(figsize=(6.6, 5.4), layout="constrained").subplots()
    colours = ListedColormap([LOOKS[mode][1] for mode in Mode])
    ax.pcolormesh(
        modes.acceleration,
        modes.friction,
        modes.modes,
        cmap=colours,
        norm=BoundaryNorm(np.arange(-0.5, len(Mode)), len(Mode)),
        shading="nearest",
        rasterized=True,
    )
    handles = []
    for mode, (label, area, colour, marker) in LOOKS.items():
        chosen = modes.simulated == mode
        (points,) = ax.plot(
            modes.tried_acceleration[chosen],
            modes.tried_friction[chosen],
            marker,
            color=colour,
            ms=3.5,
            label=f"{label}, simulated",
        )
        handles += [Patch(fc=area, ec="0.5", label=f"{label}, Shenton 1996"), points]
    if friction is not None:
        handles.append(ax.axhline(friction, color="black", lw=1, ls="--", label="friction given"))
    body, toward = modes.body, "+x" if modes.direction > 0 else "-x"
    ratio = f", $μ_k$ = {modes.kinetic_ratio:.3g} $μ_s$" if modes.kinetic_ratio != 1.0 else ""
    name = drawn(body.name or "body")
    ax.set_title(f"{name}, toward {toward}{ratio}")
    ax.set_xlabel("ground acceleration |a$_x$|/g [-]")
    ax.set_ylabel("static friction μ$_s$ [-]")
    ax.set_xlim(0.0, modes.acceleration[-1])
    ax.set_ylim(0.0, modes.friction[-1])
    ax.legend(handles=handles, fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return ax
