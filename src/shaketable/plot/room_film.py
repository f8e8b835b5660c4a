"""A film of one shaking of a whole room: in perspective, and from above."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from shaketable.atomic_files import appearing_file
from shaketable.drawing.files import require_film, write_film
from shaketable.drawing.perspective import (
    AWAY,
    BODY,
    EDGE,
    Camera,
    Points,
    camera_at,
    shade,
    shadows,
    visible,
)
from shaketable.drawing.solid_film import (
    FEWEST_PER_SECOND,
    FRAMES_PER_SECOND,
    MOST_FRAMES,
    SHADES,
    SHADOW,
)
from shaketable.drawing.solid_frames import poses_of
from shaketable.drawing.solid_mesh import Prism, prisms_of
from shaketable.drawing.trace import plot_trace
from shaketable.inventory import BaseShape
from shaketable.outcome import Outcome
from shaketable.progress import Done, Progress, meter
from shaketable.rooms.once import RoomShaken
from shaketable.rooms.room import Room
from shaketable.rooms.shapes import footprint, inward_at, place_of

FALLEN = np.array([0.84, 0.37, 0.0])  # as in the plan; in grey it is darker than what stands
FURNITURE = np.array([0.80, 0.82, 0.84])  # beds and desks, and what was not simulated
WALL, FLOOR, OPENING = "#d9d4c8", "0.94", "#7fb0d5"
DOORSTEP = 0.08  # m: of the mark of a door on the floor
PLACE, WALLS = 0.5, 2.4  # m: heights of a bed or desk and of a wall, assumed
AZIMUTH, ABOVE = math.radians(-70.0), (math.radians(42.0), math.radians(89.9))
FAR = 40.0  # from above: things lean little outward
FLAT = np.eye(3)


class View:
    """A room in axes, from one place: what stands still is drawn once, the rest in each picture."""

    def __init__(self, room: Room, axes: Axes, elevation: float) -> None:
        """The floor, doors and walls."""
        self._camera = _draw_room(room, axes, elevation)
        # seen from above they would lie beyond the walls, which are not drawn there
        self._shadows = not _from_above(elevation)
        self._dark, self._faces = PolyCollection([], fc=SHADOW, ec="none"), PolyCollection([])
        self._faces.set_linewidth(0.7)
        self.moving = [axes.add_collection(each) for each in (self._dark, self._faces)]

    def show(self, shown: Sequence[Shown], still: Sequence[Shown]) -> None:
        """Show things where they are; those that stand still throw no shadow."""
        self._dark.set_verts(
            [
                self._camera.project(outline)
                for each in (shown if self._shadows else ())
                for outline in shadows(each.parts, each.position, each.turn, FLAT)
            ]
        )
        seen = [
            face
            for each in (*shown, *still)
            for face in visible(
                each.parts, each.position, each.turn, FLAT, self._camera, each.colour
            )
        ]
        seen.sort(key=lambda face: -face.away)
        self._faces.set_verts([face.outline for face in seen])
        self._faces.set_facecolor([_rgb(face.colour) for face in seen])
        self._faces.set_edgecolor([_rgb(face.edge) for face in seen])


class Shown(NamedTuple):
    """A thing in a picture: its parts about its centre of gravity, where that is, and its turn."""

    parts: Sequence[Prism]
    position: Points
    turn: Points
    colour: Points


def _rgb(colour: Points) -> tuple[float, float, float]:
    red, green, blue = colour.tolist()
    return red, green, blue


def animate_room(shaken: RoomShaken, path: Path, progress: Progress = False) -> Path:
    """A room under one motion in real time, as a GIF or an MP4.

    It is seen from its floor, in perspective and from above. What has fallen is drawn in another
    colour. Beds, desks and walls have assumed heights.

    Args:
        shaken: of `shake_once`.
        path: of the film.
        progress: whether to tell how many pictures are drawn.

    Raises:
        InputError: an ending other than .gif or .mp4, or .mp4 without ffmpeg.
        OSError: ffmpeg failed.
    """
    require_film(path)
    time = times_of(shaken, FRAMES_PER_SECOND, MOST_FRAMES, FEWEST_PER_SECOND)
    rate = (time.size - 1) / (time[-1] - time[0]) if time.size > 1 else FRAMES_PER_SECOND
    with appearing_file(path) as fresh, meter("pictures", time.size, progress) as done:
        write_film(_pictures(shaken, time, done), fresh, rate, _shades())
    return path


def times_of(shaken: RoomShaken, rate: float, most: int, fewest: float) -> NDArray[np.float64]:
    """The times of the pictures: from just before something moves until nothing does any more."""
    each = [poses_of(one.response, rate, most, fewest).time for one in shaken.things]
    if not each:
        return np.zeros(1)
    begin, end = min(one[0] for one in each), max(one[-1] for one in each)
    return np.arange(begin, end, 1 / min(rate, max(most / max(end - begin, 1 / rate), fewest)))


def standing(room: Room, simulated: set[str]) -> list[tuple[Prism, float]]:
    """What stands still in a room, each with its height over the floor [m]."""
    found = [
        (Prism(_corners(place_of(place)), 0.0, PLACE), 0.0)
        for place in room.places
        if place.kind.stands
    ]
    heights = {thing.name: thing.item.height for thing in room.things}
    for thing in room.things:
        if thing.name not in simulated:
            foot = heights.get(thing.on, 0.0)
            corners, high = _corners(footprint(thing, room)), thing.item.height
            is_round = thing.item.shape is BaseShape.CYLINDER
            found.append((Prism(corners, 0.0, high, is_round), foot))
    return found


def _corners(polygon: Any) -> Points:
    """Corners of a polygon, counterclockwise."""
    import shapely

    return np.array(shapely.geometry.polygon.orient(polygon).exterior.coords)[:-1]


def _pictures(
    shaken: RoomShaken, time: NDArray[np.float64], done: Done
) -> Iterator[NDArray[np.uint8]]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from scipy.spatial.transform import Rotation

    figure = Figure(figsize=(10.2, 6.0), layout="constrained", dpi=100)
    canvas: Any = FigureCanvasAgg(figure)  # its methods have no types
    axes = figure.subplot_mosaic([["room", "above"], ["trace", "trace"]], height_ratios=[5, 1])
    views = [
        View(shaken.room, axes[name], up) for name, up in zip(("room", "above"), ABOVE, strict=True)
    ]
    plot_trace(shaken.motion.rotated(shaken.along), axes["trace"], transverse=True)
    axes["trace"].set_ylabel("ground\nacc. [g]")
    axes["trace"].set_xlim(time[0], time[-1])
    (hand,) = axes["trace"].plot([time[0]] * 2, axes["trace"].get_ylim(), color="tab:red", lw=1)
    title = axes["room"].set_title(" ")
    moving: list[Artist] = [part for view in views for part in view.moving] + [hand, title]
    canvas.draw()
    figure.set_layout_engine("none")  # it would lay out every frame anew
    for artist in moving:
        artist.set_animated(True)  # not drawn with what stands still
    canvas.draw()
    background = canvas.copy_from_bbox(figure.bbox)
    parts = [prisms_of(each.response.body) for each in shaken.things]
    still = [
        Shown([part], np.array([0.0, 0.0, foot]), FLAT, FURNITURE)
        for part, foot in standing(shaken.room, {each.thing.name for each in shaken.things})
    ]
    poses = [each.poses(time) for each in shaken.things]
    turns = [Rotation.from_quat(quaternions).as_matrix() for _, quaternions in poses]
    ends = [
        math.inf if each.response.outcome is Outcome.STANDING else float(each.response.time[-1])
        for each in shaken.things
    ]
    for k, now in enumerate(time.tolist()):
        fallen = [now >= end for end in ends]
        shown = [
            Shown(own, position[k], turn[k], FALLEN if lies else BODY)
            for own, (position, _), turn, lies in zip(parts, poses, turns, fallen, strict=True)
        ]
        for view in views:
            view.show(shown, still)
        hand.set_xdata([now] * 2)
        title.set_text(f"{now:.2f} s   {sum(fallen)} of {len(fallen)} things have fallen")
        canvas.restore_region(background)
        for artist in moving:
            figure.draw_artist(artist)
        yield np.asarray(canvas.buffer_rgba())[..., :3].copy()
        done(1)


def _draw_room(room: Room, scene: Axes, elevation: float) -> Camera:
    """The floor, doors and walls of a room; returns the eye that sees them."""
    corners = np.array(room.outline)
    low, high = corners.min(axis=0), corners.max(axis=0)
    half = 0.62 * float((high - low).max())
    from_above = _from_above(elevation)
    azimuth = -math.pi / 2 if from_above else AZIMUTH
    away = FAR if from_above else AWAY
    camera = camera_at(np.array([*(low + high) / 2, 0.4]), half, azimuth, elevation, away)
    floor = np.column_stack([corners, np.zeros(len(corners))])
    scene.fill(*camera.project(floor).T, fc=FLOOR, ec="0.3", lw=1)
    everything = [camera.project(floor)]
    for start, end in zip(floor, np.roll(floor, -1, axis=0), strict=True):
        inward = np.array([*inward_at(room, tuple(((start + end) / 2)[:2].tolist())), 0.0])
        if from_above or inward @ (camera.eye - start) < 0.0:
            continue  # it would hide the room
        up = np.array([0.0, 0.0, WALLS])
        outline = camera.project(np.array([start, end, end + up, start + up]))
        scene.fill(*outline.T, fc=WALL, ec="0.4", lw=0.8)
        everything.append(outline)
    for door in room.doors:
        into = np.array(inward_at(room, door.at))
        along = np.array([into[1], -into[0]]) * door.width / 2
        at = np.array(door.at)
        opening = np.array(
            [at - along, at + along, at + along + 0.08 * into, at - along + 0.08 * into]
        )
        flat = np.column_stack([opening, np.zeros(4)])
        scene.fill(*camera.project(flat).T, fc=OPENING, ec="none")
    for place in room.places:
        if not place.kind.stands:
            edge = _corners(place_of(place))
            flat = np.column_stack([edge, np.zeros(len(edge))])
            scene.fill(*camera.project(flat).T, fill=False, ec="0.6", lw=0.8, ls="--")
    limits = np.vstack(everything)
    pad = 0.03 * float(np.ptp(limits, axis=0).max())
    scene.set_xlim(limits[:, 0].min() - pad, limits[:, 0].max() + pad)
    scene.set_ylim(limits[:, 1].min() - pad, limits[:, 1].max() + pad)
    scene.set_aspect("equal")
    scene.set_axis_off()
    return camera


def _from_above(elevation: float) -> bool:
    return elevation > math.radians(80.0)


def _shades() -> NDArray[np.uint8]:
    """A picture of all colours of a film."""
    from matplotlib.colors import to_rgb

    levels = np.linspace(0.0, 1.0, SHADES // 2)
    bodies = [shade(lit, colour) for colour in (BODY, FALLEN, FURNITURE) for lit in levels]
    grey = [np.full(3, level) for level in np.linspace(0.0, 1.0, SHADES)]
    words = [to_rgb(name) for name in ("tab:cyan", "tab:red", "tab:orange", WALL, OPENING)]
    return np.asarray(255 * np.array([*bodies, *grey, *words, EDGE]))[None].astype(np.uint8)
