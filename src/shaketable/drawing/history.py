"""The history of one run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from shaketable.drawing.names import drawn
from shaketable.drawing.shown import ShownResponse
from shaketable.drawing.trace import plot_trace
from shaketable.kernels.phases import Phase
from shaketable.outcome import Outcome
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes


SLIPPED = 1e-4  # m: the eye sees no smaller slip
REST_COLOUR = "#efefef"

#: Colours of the bands, by the beginning of a phase's name; the first that fits holds.
BANDS = {
    "SLIDE_ROCK": ("slide-rock", "#d9c8ec"),
    "SLIDE": ("slide", "#fbdcb5"),
    "ROCK": ("rock", "#cfe3f5"),
    "FLIGHT": ("flight", "#cdeccb"),
}


def plot_response(
    response: ShownResponse, ax: tuple[Axes, Axes] | None = None
) -> tuple[Axes, Axes]:
    """Draw the rotation over time, above the motion that caused it.

    With the general model the phases are coloured bands behind it, and if the body slides its slip
    is drawn on an axis of its own.

    Args:
        response: what to show.
        ax: axes for the rotation and for the motion; a new figure by default.

    Returns:
        Both axes.
    """
    if ax is None:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(9, 5.5), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    else:
        above, below = ax
    time, rotation = response.time, np.degrees(response.rotation)
    above.plot(time, rotation, color="tab:blue", lw=1.2, label="rotation")
    above.axhline(0.0, color="0.6", lw=0.8)
    body, tilt = response.body, response.support.tilt
    right, left = body.slenderness_right + tilt, tilt - body.slenderness_left
    uphill, downhill = (right, left) if tilt >= 0.0 else (left, right)
    for name, level, style in (("uphill", uphill, "--"), ("downhill", downhill, ":")):
        above.axhline(degrees(level), color="tab:red", ls=style, lw=0.9, label=f"{name} balance")
    reach = 1.35 * degrees(max(abs(right), abs(left)))
    above.set_ylim(-reach, reach)
    if response.model.slides:
        _draw_phases(response, above, reach)
        _draw_slip(response, above)
    if response.outcome is not Outcome.STANDING:
        above.axvline(response.overturning_time, color="black", lw=1)
        above.annotate(
            f"overturns {response.outcome.name.lower()}\nat {response.overturning_time:.2f} s",
            (response.overturning_time, -0.9 * reach),
            xytext=(6, 0),
            textcoords="offset points",
            va="bottom",
        )
    above.set_ylabel("rotation [°]\n(+ toward +x)")
    above.set_title(
        drawn(f"{response.body.name or 'body'} on {response.motion.name or 'the motion'}, ")
        + f"tilt {degrees(response.support.tilt):.3g}°: {response.outcome.name.lower()}, "
        f"peak {degrees(response.peak_rotation):.3g}°, {response.impacts} impacts"
    )
    above.legend(loc="upper right", fontsize="small", ncols=2)

    motion = response.motion
    plot_trace(motion, below)
    below.set_xlim(0.0, max(time[-1], motion.duration))
    return above, below


def _draw_phases(response: ShownResponse, ax: Axes, reach: float) -> None:
    """A band of colour for each phase except rest."""
    last = response.time[-1]
    if response.outcome is not Outcome.STANDING:
        last = response.overturning_time
    begins, ends = response.phase_times, np.append(response.phase_times[1:], last)
    kinds = [_kind_of(phase) for phase in response.phases]
    for kind, (label, colour) in BANDS.items():
        spans = [
            (begin, end - begin)
            for begin, end, of in zip(begins, ends, kinds, strict=True)
            if of == kind
        ]
        if spans:
            ax.broken_barh(spans, (-reach, 2 * reach), color=colour, lw=0, zorder=0, label=label)


def _kind_of(phase: Phase) -> str | None:
    return next((kind for kind in BANDS if phase.name.startswith(kind)), None)


def _draw_slip(response: ShownResponse, ax: Axes) -> None:
    """The slip in millimetres on the right, where there is any."""
    if response.peak_slip < SLIPPED:
        return
    beside = ax.twinx()
    (line,) = beside.plot(response.time, 1e3 * response.slip, color="tab:green", lw=1.2)
    beside.set_ylabel("slip [mm]\n(+ toward +x)", color=line.get_color())
    reach = 1.7e3 * max(response.peak_slip, float(np.abs(response.slip).max()))
    beside.set_ylim(-reach, reach)
    ax.plot([], [], color=line.get_color(), label="slip")
