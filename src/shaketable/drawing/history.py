"""The history of one run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.drawing.shown import ShownResponse, drawn, lying_rotation
from shaketable.drawing.trace import plot_forces, plot_trace
from shaketable.outcome import Outcome, outcome_name, side_names
from shaketable.physics.plane.phases import Phase
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes


SLIPPED = 1e-4  # m: the eye sees no smaller slip
REST_COLOUR = "#efefef"

#: Colours of the bands, by the beginning of a phase's name; the first that fits holds. Their
#: brightness differs, so that they can be told apart in grey print.
BANDS = {
    "SLIDE_ROCK": ("slide-rock", "#a58cc7"),
    "SLIDE": ("slide", "#f2bd7c"),
    "ROCK": ("rock", "#d6e8f8"),
    "FLIGHT": ("flight", "#5f9e5c"),
}
#: Hatches of the bands, for the same reason.
HATCHES = {"SLIDE_ROCK": "xxx", "SLIDE": "///", "ROCK": "", "FLIGHT": "..."}
FALLEN = 90.0  # degrees


def plot_response(
    response: ShownResponse, ax: tuple[Axes, Axes] | None = None
) -> tuple[Axes, Axes]:
    """Draw the rotation over time, above the motion that caused it.

    With the general model the phases are coloured bands behind it, and if the body slides its slip
    is drawn on an axis of its own. In a new figure the forces of straps, if there are any, stand
    above the motion.

    Args:
        response: what to show.
        ax: axes for the rotation and for the motion; a new figure by default.

    Returns:
        Both axes.
    """
    if ax is None:
        from matplotlib.figure import Figure

        held = len(response.strap_broke_at) > 0
        figure = Figure(figsize=(10.5, 7.0 if held else 5.5), layout="constrained")
        ratios = [2, 1, 1] if held else [2, 1]
        rows = figure.subplots(len(ratios), 1, sharex=True, height_ratios=ratios)
        above, below = rows[0], rows[-1]
        if held:
            plot_forces(response, rows[1])
    else:
        above, below = ax
    time, rotation = _until_it_lies(response)
    above.plot(time, rotation, color="tab:blue", lw=1.2, label="rotation")
    above.axhline(0.0, color="0.6", lw=0.8)
    body, tilt = response.body, response.support.tilt
    right, left = body.slenderness_right + tilt, tilt - body.slenderness_left
    uphill, downhill = (right, left) if tilt >= 0.0 else (left, right)
    lower, upper = side_names(tilt)
    for name, level, style in ((upper, uphill, "--"), (lower, downhill, ":")):
        above.axhline(degrees(level), color="tab:red", ls=style, lw=0.9, label=f"{name} balance")
    reach = 1.35 * degrees(max(abs(right), abs(left)))
    far = _scale(response, above, reach)
    if response.model.slides:
        _draw_phases(response, above, far)
    if response.outcome is not Outcome.STANDING:
        above.axvline(response.overturning_time, color="black", lw=1)
        above.annotate(
            f"{'comes down' if response.off_edge else 'overturns'} "
            f"{outcome_name(response.outcome, tilt)}\n"
            f"at {response.overturning_time:.2f} s",
            (response.overturning_time, -0.9 * far),
            xytext=(6, 0),
            textcoords="offset points",
            va="bottom",
        )
    above.set_ylabel("rotation [°]\n(+ toward +x)")
    above.set_title(
        drawn(f"{response.body.name or 'body'} on {response.motion.name or 'the motion'}, ")
        + f"tilt {degrees(tilt):.3g}°: {outcome_name(response.outcome, tilt)}, "
        f"peak {degrees(response.peak_rotation):.3g}°, {response.impacts} impacts"
    )
    slips = _draw_slip(response, above) if response.model.slides else False
    # beside the data, and beside the axis of the slip where there is one
    above.legend(loc="upper left", bbox_to_anchor=(1.11 if slips else 1.01, 1), fontsize="small")

    motion = response.motion
    plot_trace(motion, below)
    below.set_xlim(0.0, max(time[-1], motion.duration))
    return above, below


def _until_it_lies(response: ShownResponse) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times [s] and rotations [°], with the one at which a fall ends."""
    time, rotation = response.time, np.degrees(response.rotation)
    if response.outcome is Outcome.STANDING:
        return time, rotation
    end = degrees(lying_rotation(response))
    return np.append(time, response.overturning_time), np.append(rotation, end)


def _scale(response: ShownResponse, ax: Axes, reach: float) -> float:
    """Set the scale of the rotation [°], and return how far it goes.

    Of a fall all is shown: the scale is linear up to `reach` and logarithmic from there to 90°.
    """
    if response.outcome is Outcome.STANDING or (reach >= FALLEN and not response.off_edge):
        ax.set_ylim(-reach, reach)
        return reach
    far = 1.08 * max(FALLEN, degrees(abs(lying_rotation(response))))
    ax.set_yscale("symlog", linthresh=reach, linscale=1.2)
    ax.set_ylim(-far, far)
    step = max(1.0, 5.0 * round(reach / 12.5)) if reach > 6.0 else max(round(reach / 2.5), 1)
    inner = np.arange(step, reach, step)
    outer = [level for level in (45.0, FALLEN) if level > 1.5 * reach]
    ticks = np.r_[inner, outer]
    ax.set_yticks(np.r_[-ticks[::-1], 0.0, ticks])
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.minorticks_off()
    return far


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
            ax.broken_barh(
                spans, (-reach, 2 * reach), fc=colour, ec="0.55", hatch=HATCHES[kind], lw=0,
                zorder=0, label=label,
            )  # fmt: skip


def _kind_of(phase: Phase) -> str | None:
    return next((kind for kind in BANDS if phase.name.startswith(kind)), None)


def _draw_slip(response: ShownResponse, ax: Axes) -> bool:
    """The slip in millimetres on the right; whether there is any."""
    if response.peak_slip < SLIPPED:
        return False
    beside = ax.twinx()
    (line,) = beside.plot(response.time, 1e3 * response.slip, color="tab:green", lw=1.2)
    beside.set_ylabel("slip [mm]\n(+ toward +x)", color=line.get_color())
    reach = 1.7e3 * max(response.peak_slip, float(np.abs(response.slip).max()))
    beside.set_ylim(-reach, reach)
    ax.plot([], [], color=line.get_color(), label="slip")
    return True
