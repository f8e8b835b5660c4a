"""The plan of a room: what stands where, what is wrong with it, and what shaking does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrow, PathPatch, Polygon
from matplotlib.path import Path

from shaketable.assess import Share
from shaketable.language import tell
from shaketable.report.words.numbers import in_hundred_short
from shaketable.rooms.room import PlaceKind, Room, Thing
from shaketable.rooms.shapes import (
    base_of,
    foot_of,
    footprint,
    opening_of,
    own_angle,
    place_of,
    sweep_of,
)

if TYPE_CHECKING:
    from shaketable.rooms import PlanFault, RoomAssessment, ThingResult

# Blue to orange, which those who do not see red or green tell apart, and which are so in grey too.
OPEN, HALF, CLOSED, UNKNOWN = "#0072b2", "#e69f00", "#d55e00", "#999999"
COLOURS = {
    PlaceKind.BED: "#cfe3f1", PlaceKind.DESK: "#e8e0d0", PlaceKind.TURNING: "none",
    PlaceKind.CORRIDOR: "none",
}  # fmt: skip
RAREST = 0.005  # of all runs: rarer falls have no arrow
ARROW = (0.15, 0.85)  # m: of the shortest, and how much longer one is that stands for all runs
INCHES_PER_METRE, LARGEST = 1.3, 11.0


def plot_room(
    room: Room,
    assessment: RoomAssessment | None = None,
    faults: Sequence[PlanFault] = (),
) -> Axes:
    """Draw a room from above.

    Args:
        room: any, also one with faults.
        assessment: what shaking does: where something lies, in percent of the runs, and how often
            ways out are closed.
        faults: are drawn where they are, and listed.
    """
    width, height = np.ptp(room.outline, axis=0)
    scale = min(INCHES_PER_METRE, LARGEST / max(width, height))
    lines = 0.22 * (1 + len(faults))
    size = (max(scale * width + 2.2, 5.0), scale * height + 1.6 + lines)
    figure = Figure(figsize=size, layout="constrained")
    axes: Axes = figure.subplots()
    if assessment is not None:
        _draw_heat(figure, axes, assessment)
    axes.add_patch(Polygon(room.outline, closed=True, fill=False, lw=3, ec="#333333", zorder=3))
    for place in room.places:
        corners = np.array(place_of(place).exterior.coords)
        dashed = "-" if place.kind.stands else "--"
        axes.add_patch(
            Polygon(corners, fc=COLOURS[place.kind], ec="#7a8b99", ls=dashed, alpha=0.8, zorder=1)
        )
        axes.annotate(place.name, place.at, ha="center", va="center", fontsize=7, color="#445566")
    _draw_doors(axes, room, assessment)
    found = {each.name: each for each in assessment.things} if assessment else {}
    for thing in room.things:
        corners = np.array(footprint(thing, room).exterior.coords)
        axes.add_patch(Polygon(corners, fc="#bbbbbb", ec="black", lw=1, zorder=4))
        angle = own_angle(thing, room) + math.pi  # to where its front looks
        front = thing.item.body.base / 2
        axes.add_patch(
            FancyArrow(
                *thing.at, front * math.cos(angle), front * math.sin(angle), width=0.01,
                head_width=0.07, head_length=0.05, length_includes_head=True, color="black",
                zorder=5,
            )
        )  # fmt: skip
        told = thing.name
        if thing.name in found:
            share = in_hundred_short(found[thing.name].falls.value)
            told += "\n" + tell("falls in {share} of 100", share=share)
            _draw_falls(axes, room, thing, found[thing.name])
        elif assessment is not None:
            told += "\n" + tell("not simulated")
        foot = foot_of(thing, room)
        axes.annotate(
            told, (foot[0], foot[1]), xytext=(0, 7), textcoords="offset points", ha="center",
            fontsize=6.5, zorder=6,
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.7},
        )  # fmt: skip
    for at in dict.fromkeys(fault.at for fault in faults):
        numbers = ", ".join(str(k) for k, fault in enumerate(faults, 1) if fault.at == at)
        axes.plot(*at, "o", ms=10 + 6 * len(numbers), mfc="none", mec=CLOSED, mew=2, zorder=7)
        axes.annotate(numbers, at, ha="center", va="center", color=CLOSED, weight="bold", zorder=8)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.set_title(_title(room, assessment), fontsize=10)
    if room.north is not None:
        _draw_north(axes, room.north)
    if faults:
        told = "\n".join(f"{k}  {each.where}: {each.text}" for k, each in enumerate(faults, 1))
        figure.supxlabel(told, fontsize=7, ha="left", x=0.02, color=CLOSED)
    return axes


def _title(room: Room, assessment: RoomAssessment | None) -> str:
    if assessment is None:
        return room.name
    return tell(
        "{room}: {runs:,} shakings by {recordings} independent recordings",
        room=room.name,
        runs=assessment.runs,
        recordings=assessment.recordings,
    )


def _draw_heat(figure: Figure, axes: Axes, assessment: RoomAssessment) -> None:
    grid = assessment.grid
    half = grid.cell / 2
    extent = (grid.x[0] - half, grid.x[-1] + half, grid.y[0] - half, grid.y[-1] + half)
    share = np.ma.masked_equal(100 * assessment.covered, 0.0)
    image = axes.imshow(
        share, origin="lower", extent=extent, cmap="YlOrBr", vmin=0.0,
        vmax=max(5.0, float(share.max() or 0.0)), zorder=2, alpha=0.85,
    )  # fmt: skip
    bar = figure.colorbar(image, ax=axes, shrink=0.7)
    bar.set_label(tell("something lies there, in % of the shakings"))


def _draw_falls(axes: Axes, room: Room, thing: Thing, found: ThingResult) -> None:
    """An arrow out of each side of a thing to which it falls, as long as that is frequent."""
    base = base_of(thing.item)
    foot = foot_of(thing, room)
    ways = (math.pi, 0.0, math.pi / 2, -math.pi / 2)
    for way, share in zip(ways, found.sides, strict=True):
        often = 0.0 if math.isnan(share) else share * found.falls.value
        if often < RAREST:
            continue
        reach = float((base @ [math.cos(way), math.sin(way)]).max())
        angle = own_angle(thing, room) + way
        out = np.array([math.cos(angle), math.sin(angle)])
        far = ARROW[0] + ARROW[1] * often
        axes.add_patch(
            FancyArrow(
                *(foot + reach * out), *(far * out), width=0.04 + 0.12 * often,
                head_width=0.14 + 0.2 * often, head_length=0.12, length_includes_head=True,
                fc=CLOSED, ec="white", lw=0.6, zorder=6,
            )
        )  # fmt: skip


def _draw_doors(axes: Axes, room: Room, assessment: RoomAssessment | None) -> None:
    worst: dict[str, Share] = {}
    narrow: set[str] = set()  # doors to which a way is closed before anything is shaken
    for way in sorted(assessment.ways if assessment else (), key=lambda way: way.closed):
        worst[way.exit] = way.closed
        narrow |= set() if way.open_before else {way.exit}
    for door in room.doors:
        # by what the recordings cannot exclude, as the colours of classes
        most = worst[door.name].high if door.name in worst else math.nan
        colour = UNKNOWN if math.isnan(most) else OPEN if most < 0.05 else HALF
        colour = CLOSED if most >= 0.2 or door.name in narrow else colour
        opening = opening_of(door, room)
        axes.add_patch(
            Polygon(np.array(opening.exterior.coords), fc=colour, ec="none", alpha=0.35, zorder=2)
        )
        sweep = sweep_of(door, room)
        if not sweep.is_empty:
            corners = np.array(sweep.exterior.coords)
            axes.add_collection(
                PatchCollection([PathPatch(Path(corners))], fc="none", ec=colour, ls=":", zorder=3)
            )
        told = door.name
        if door.name in narrow:
            told += "\n" + tell("too narrow as it is")
        elif door.name in worst:
            share = in_hundred_short(worst[door.name].value)
            told += "\n" + tell("closed in {share} of 100", share=share)
        middle = opening.centroid
        axes.annotate(told, (middle.x, middle.y), ha="center", va="center", fontsize=6.5)


def _draw_north(axes: Axes, north: float) -> None:
    x, y = math.sin(north), math.cos(north)

    def at(far: float) -> tuple[float, float]:
        return 0.95 + far * x, 0.9 + far * y

    axes.annotate(
        "", at(0.04), xytext=at(-0.04), xycoords="axes fraction", textcoords="axes fraction",
        arrowprops={"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip
    axes.annotate("N", at(0.065), xycoords="axes fraction", ha="center", va="center")
