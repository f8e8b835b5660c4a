"""A film of one run of a solid, in perspective."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.atomic_files import appearing_file
from shaketable.drawing.files import require_film, write_film
from shaketable.drawing.perspective import (
    EDGE,
    Camera,
    Points,
    camera_at,
    shade,
    shadows,
    visible,
)
from shaketable.drawing.shown import strap_colour
from shaketable.drawing.solid_frames import (
    Poses,
    ShownPull,
    ShownRun,
    planes_of,
    poses_of,
    pulls_of,
    tilting,
)
from shaketable.drawing.solid_mesh import Prism, prisms_of
from shaketable.drawing.trace import plot_trace
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FRAMES_PER_SECOND = 25
FEWEST_PER_SECOND = 10  # of long films
MOST_FRAMES = 750  # from which on there are fewer a second
PLATE, SHADOW = "0.86", "0.55"
WALL, SEEN = "#c8bfa9", (0.7, 0.35)  # and how much of it: behind the body, and before it
SHADES = 18  # with all other colours no more than `files.COLOURS`
GRID = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)  # m between lines on the plate
LINES = 12  # on the plate, about


def animate_solid(run: ShownRun, path: Path) -> Path:
    """Write a film of a solid in real time, as a GIF or an MP4.

    It is seen from the support, in perspective, with its shadow. The plate's lines give the scale.
    Films of more than half a minute have fewer pictures a second.

    Raises:
        InputError: an ending other than .gif or .mp4, or .mp4 without ffmpeg.
        OSError: ffmpeg failed.
    """
    require_film(path)
    poses = poses_of(run, FRAMES_PER_SECOND, MOST_FRAMES, FEWEST_PER_SECOND)
    time = poses.time
    rate = (len(time) - 1) / (time[-1] - time[0]) if len(time) > 1 else FRAMES_PER_SECOND
    with appearing_file(path) as fresh:
        write_film(_pictures(run, poses), fresh, rate, shades())
    return path


def _pictures(run: ShownRun, poses: Poses) -> Iterator[NDArray[np.uint8]]:
    """The pixels of each picture: what stands still, and what moves over it."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.figure import Figure
    from scipy.spatial.transform import Rotation

    figure = Figure(figsize=(6.4, 5.8), layout="constrained", dpi=100)
    canvas: Any = FigureCanvasAgg(figure)  # its methods have no types
    scene, trace = figure.subplots(2, 1, height_ratios=[5, 1])
    plate = tilting(run.support)
    parts = prisms_of(run.body)
    camera = _draw_plate(run, parts, poses, plate, scene)
    plot_trace(run.motion, trace, transverse=True)
    trace.set_ylabel("ground\nacc. [g]")
    trace.set_xlim(poses.time[0], poses.time[-1])
    (hand,) = trace.plot([poses.time[0]] * 2, trace.get_ylim(), color="tab:red", lw=1)
    shadow = scene.add_collection(PolyCollection([], fc=SHADOW, ec="none"))
    faces = scene.add_collection(PolyCollection([], lw=0.8))
    pulls = pulls_of(run, poses)
    lines = scene.add_collection(LineCollection([], lw=2.5))
    moving = [shadow, faces, lines, hand, scene.set_title(" ")]
    canvas.draw()
    figure.set_layout_engine("none")  # it would lay out every frame anew
    for artist in moving:
        artist.set_animated(True)  # not drawn with what stands still
    canvas.draw()
    still = canvas.copy_from_bbox(figure.bbox)
    turns = Rotation.from_quat(poses.quaternions).as_matrix()
    places = zip(poses.time, poses.position, turns, strict=True)
    for number, (time, position, turn) in enumerate(places):
        shadow.set_verts([camera.project(each) for each in shadows(parts, position, turn, plate)])
        seen = visible(parts, position, turn, plate, camera)
        faces.set_verts([face.outline for face in seen])
        faces.set_facecolor([face.colour for face in seen])
        faces.set_edgecolor([face.edge for face in seen])
        held = [pull for pull in pulls if pull.whole[number]]
        ends = [np.array([pull.point[number], pull.anchor]) @ plate.T for pull in held]
        lines.set_segments([camera.project(each) for each in ends])
        lines.set_color(
            [strap_colour(float(pull.force[number]), float(pull.force.max())) for pull in held]
        )
        hand.set_xdata([time] * 2)
        nutation = math.acos(min(1.0, max(-1.0, float(turn[2, 2]))))
        scene.set_title(
            f"{time:.2f} s   axis leans by {degrees(nutation):.1f}°{_told(pulls, number)}"
        )
        canvas.restore_region(still)
        for artist in moving:
            figure.draw_artist(artist)
        yield np.asarray(canvas.buffer_rgba())[..., :3].copy()


def _told(pulls: list[ShownPull], number: int) -> str:
    """What the straps bear in a picture."""
    if not pulls:
        return ""
    each = [f"{pull.force[number]:,.0f} N" if pull.whole[number] else "broken" for pull in pulls]
    return f"   {'strap' if len(pulls) == 1 else 'straps'} {', '.join(each)}"


def _draw_plate(
    run: ShownRun, parts: list[Prism], poses: Poses, plate: Points, scene: Axes
) -> Camera:
    """The support with lines on it, under all places of the body; returns the eye that sees it."""
    size = max(float(np.linalg.norm(part.vertices, axis=1).max()) for part in parts)
    low, high = poses.position[:, :2].min(axis=0), poses.position[:, :2].max(axis=0)
    middle, half = (low + high) / 2, float((high - low).max()) / 2 + 1.25 * size
    camera = camera_at(plate @ [*middle, 0.6 * run.body.cg_height], half)
    step = next((each for each in GRID if 2 * half / each <= LINES), GRID[-1])

    def on_plate(*points: tuple[float, float]) -> Points:
        """Places in the picture of points of the plate, from its middle [m]."""
        flat = np.array([[x + middle[0], y + middle[1], 0.0] for x, y in points])
        return camera.project(flat @ plate.T)

    corners = on_plate((-half, -half), (half, -half), (half, half), (-half, half))
    scene.fill(*corners.T, fc=PLATE, ec="0.5", lw=1)
    for at in np.arange(-math.floor(half / step), math.floor(half / step) + 1) * step:
        scene.plot(*on_plate((at, -half), (at, half)).T, color="0.75", lw=0.6)
        scene.plot(*on_plate((-half, at), (half, at)).T, color="0.75", lw=0.6)
    for name, along in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
        start = np.array([-0.9 * half, -0.9 * half])
        tip = start + 0.3 * half * np.array(along)
        begin, end = on_plate(tuple(start), tuple(tip))
        scene.annotate("", end, begin, arrowprops={"arrowstyle": "->", "color": "0.3"})
        scene.annotate(name, end, color="0.3", ha="center", va="bottom")
    if run.support.tilt != 0.0:
        begin, end = on_plate(*_downhill(run, half))
        arrow = {"arrowstyle": "->", "color": "tab:red"}
        scene.annotate("", end, begin, arrowprops=arrow)
        scene.annotate("downhill", end, color="tab:red", ha="center", va="bottom", fontsize=8)
    for wall in planes_of(run):
        wide, up = 1.2 * size * wall.axes[:, 1], 2.2 * size * wall.axes[:, 2]
        left, right = wall.foot - wide, wall.foot + wide
        outline = camera.project(np.array([left, right, right + up, left + up]) @ plate.T)
        # behind the body where it stands away from the eye
        away = (plate @ wall.axes[:, 0]) @ (camera.eye - plate @ wall.foot) < 0.0
        scene.fill(*outline.T, fc=WALL, ec="0.4", lw=1, alpha=SEEN[0] if away else SEEN[1])
    top = camera.project((np.array([[*middle, 2.1 * size]])) @ plate.T)
    everything = np.vstack([corners, top])
    scene.set_xlim(everything[:, 0].min(), everything[:, 0].max())
    scene.set_ylim(everything[:, 1].min() - 0.01, everything[:, 1].max())
    scene.set_aspect("equal")
    scene.set_axis_off()
    scene.text(0.0, 0.0, f"lines {step:g} m apart", transform=scene.transAxes, fontsize=8)
    return camera


def _downhill(run: ShownRun, half: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Begin and end of the arrow that points downhill, from the plate's middle [m]."""
    azimuth = run.support.azimuth + (math.pi if run.support.tilt < 0.0 else 0.0)
    along = np.array([math.cos(azimuth), math.sin(azimuth)])
    near, far = 0.62 * half * along, 0.9 * half * along
    return (near[0], near[1]), (far[0], far[1])


def shades() -> NDArray[np.uint8]:
    """A picture of all colours of a film."""
    from matplotlib.colors import to_rgb

    body = [shade(lit) for lit in np.linspace(0.0, 1.0, SHADES)]
    grey = [np.full(3, level) for level in np.linspace(0.0, 1.0, SHADES)]
    mixed = [0.5 * (one + EDGE) for one in body]
    words = [to_rgb(name) for name in ("tab:cyan", "tab:red", "tab:orange")]
    wall = np.array(to_rgb(WALL))
    walls = [see * wall + (1.0 - see) * np.full(3, level) for see in SEEN for level in (0.8, 1.0)]
    return np.asarray(255 * np.array([*body, *mixed, *grey, *words, *walls]))[None].astype(np.uint8)
