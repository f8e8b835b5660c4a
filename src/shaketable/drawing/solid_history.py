"""The history of one run of a solid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from shaketable.drawing.history import BANDS, FALLEN, HATCHES
from shaketable.drawing.shown import drawn
from shaketable.drawing.solid_frames import ShownRun
from shaketable.drawing.trace import plot_forces, plot_trace
from shaketable.outcome import Outcome
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: What of the base is on the support and whether it slips, as (contact, slips), by the name of
#: its band, the first that fits; what is not named rests.
KINDS = {
    "slides": (("BASE", True), BANDS["SLIDE"][1], HATCHES["SLIDE"]),
    "rocks on a side": (("SIDE", False), BANDS["ROCK"][1], HATCHES["ROCK"]),
    "rolls on a point": (("POINT", False), "#9ecae1", "\\\\\\"),
    "presses a wall": (("WALL", True), "#c8bfa9", "..."),
    "on the edge": (("EDGE", True), "#d9b38c", "++"),
    "in flight": (("NOTHING", True), BANDS["FLIGHT"][1], HATCHES["FLIGHT"]),
    "slips on a side or point": (("", True), BANDS["SLIDE_ROCK"][1], HATCHES["SLIDE_ROCK"]),
}


class Named(Protocol):
    """A member of an enumeration."""

    @property
    def name(self) -> str: ...


class ShownSolidResponse(ShownRun, Protocol):
    """What is asked of a `SolidResponse`."""

    @property
    def outcome(self) -> Outcome: ...
    @property
    def overturning_time(self) -> float: ...
    @property
    def fall_azimuth(self) -> float: ...
    @property
    def peak_rotation(self) -> float: ...
    @property
    def impacts(self) -> int: ...
    @property
    def nutation(self) -> NDArray[np.float64]: ...
    @property
    def foot(self) -> NDArray[np.float64]: ...
    @property
    def contact(self) -> tuple[Named, ...]: ...
    @property
    def grip(self) -> tuple[Named, ...]: ...


def plot_solid(
    run: ShownSolidResponse, ax: tuple[Axes, Axes, Axes] | None = None
) -> tuple[Axes, Axes, Axes]:
    """Draw the nutation over time, below it where the foot goes, below that the motion.

    In a new figure the forces of straps, if there are any, stand above the motion.

    Args:
        run: what to show.
        ax: axes for the nutation, the foot and the motion; a new figure by default.

    Returns:
        The three axes.
    """
    if ax is None:
        from matplotlib.figure import Figure

        held = len(run.strap_broke_at) > 0
        figure = Figure(figsize=(10.5, 8.5 if held else 7.0), layout="constrained")
        ratios = [2, 1.2, 1.2, 1] if held else [2, 1.2, 1]
        rows = figure.subplots(len(ratios), 1, sharex=True, height_ratios=ratios)
        above, middle, below = rows[0], rows[1], rows[-1]
        if held:
            plot_forces(run, rows[2])
    else:
        above, middle, below = ax
    above.plot(run.time, np.degrees(run.nutation), color="tab:blue", lw=1.2, label="nutation")
    peak = degrees(run.peak_rotation)
    fell = run.outcome is not Outcome.STANDING
    reach = 1.05 * FALLEN if fell else max(1.25 * peak, 1e-3)
    above.set_ylim(0.0, reach)
    _draw_bands(run, above, reach)
    ends = f"overturns toward {degrees(run.fall_azimuth):.0f}°" if fell else "stands"
    if fell:
        above.axvline(run.overturning_time, color="black", lw=1)
        above.annotate(
            f"{ends}\nat {run.overturning_time:.2f} s",
            (run.overturning_time, 0.05 * reach), xytext=(6, 0), textcoords="offset points",
            va="bottom",
        )  # fmt: skip
    above.set_ylabel("nutation [°]\n(axis from normal)")
    tilt, azimuth = degrees(run.support.tilt), degrees(run.support.azimuth)  # as they were given
    leaning = f"tilt {tilt:.3g}° toward {azimuth:.3g}°" if tilt else "level"
    above.set_title(
        drawn(f"{run.body.name or 'solid'} on {run.motion.name or 'the motion'}, ")
        + f"{leaning}: {ends}, peak {peak:.3g}°, {run.impacts} impacts"
    )
    for label, series, colour in zip("xy", 1e3 * run.foot.T[:2], ("0.25", "tab:cyan"), strict=True):
        middle.plot(run.time, series, color=colour, lw=1.0, label=f"along {label}")
    middle.set_ylabel("foot moved [mm]")
    plot_trace(run.motion, below, transverse=True)
    for each in (above, middle):
        each.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize="small")
    below.set_xlim(0.0, max(run.time[-1], run.motion.duration))
    return above, middle, below


def _draw_bands(run: ShownSolidResponse, ax: Axes, reach: float) -> None:
    """A band of colour for each kind of contact except rest."""
    last = np.append(run.time[1:], run.time[-1])
    kinds = [_kind_of(*each) for each in zip(run.contact, run.grip, strict=True)]
    for label, (_, colour, hatch) in KINDS.items():
        spans: list[tuple[float, float]] = []
        for begin, end, kind in zip(run.time.tolist(), last.tolist(), kinds, strict=True):
            if kind != label:
                continue
            if spans and spans[-1][0] + spans[-1][1] >= begin:
                spans[-1] = (spans[-1][0], end - spans[-1][0])
            else:
                spans.append((begin, end - begin))
        if spans:
            ax.broken_barh(
                spans, (0.0, reach), fc=colour, ec="0.55", hatch=hatch, lw=0, zorder=0,
                label=label,
            )  # fmt: skip


def _kind_of(contact: Named, grip: Named) -> str | None:
    slips = grip.name != "STICKS"
    for label, ((of, does), _, _) in KINDS.items():
        if of in ("", contact.name) and does == slips:
            return label
    return None
