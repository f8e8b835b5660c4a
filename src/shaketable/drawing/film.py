"""A film of one run."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.atomic_files import appearing_file
from shaketable.drawing.files import require_film, write_film
from shaketable.drawing.shown import ShownResponse, ShownWall, lying_rotation, strap_colour
from shaketable.outcome import Outcome
from shaketable.units import STANDARD_GRAVITY, degrees

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes


FRAMES_PER_SECOND = 25
FEWEST_PER_SECOND = 10  # of long films
MOST_FRAMES = 750  # from which on there are fewer a second
LEAD, TAIL = 0.5, 1.0  # s shown before the first and after the last movement
MOVED = 1e-4  # m or rad: the eye sees no smaller movement


def animate_response(response: ShownResponse, path: Path) -> Path:
    """Write a film of a planar body in real time, as a GIF or an MP4.

    It turns, slides and jumps as it was simulated, with its walls and straps, whose colour tells
    their force. A dot shows the centre of gravity, and a mark on the support where it stood.
    Films of more than half a minute have fewer pictures a second.

    Raises:
        InputError: an ending other than .gif or .mp4, or .mp4 without ffmpeg.
        OSError: ffmpeg failed.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure
    from matplotlib.patches import Polygon

    require_film(path)
    times, poses = _frames(response)
    figure = Figure(figsize=(6, 5), layout="constrained", dpi=100)
    canvas: Any = FigureCanvasAgg(figure)  # its methods have no types
    scene, trace = figure.subplots(2, 1, height_ratios=[4, 1])
    _draw_scene(response, poses, scene)
    outline = _outline(response, poses[0])
    shape = scene.add_patch(Polygon(outline, fc="tab:blue", ec="black", alpha=0.8))
    (dot,) = scene.plot([], [], "o", color="white", mec="black")
    motion = response.motion
    trace.plot(motion.time, motion.horizontal / STANDARD_GRAVITY, color="0.25", lw=0.6)
    trace.set_xlim(times[0], times[-1])
    trace.set_xlabel("time [s]")
    trace.set_ylabel("ground\nacc. [g]")
    (hand,) = trace.plot([times[0]] * 2, trace.get_ylim(), color="tab:red", lw=1)
    straps = _Straps.of(response, times)
    lines = scene.add_collection(LineCollection([], lw=2.5))
    moving: list[Artist] = [shape, dot, lines, hand, scene.set_title(" ")]
    canvas.draw()
    figure.set_layout_engine("none")  # it would lay out every frame anew
    for artist in moving:
        artist.set_animated(True)  # not drawn with what stands still
    canvas.draw()
    still = canvas.copy_from_bbox(figure.bbox)

    def draw(frame: int) -> NDArray[np.uint8]:
        """The pixels of a frame: what stands still, and what moves over it."""
        pose = poses[frame]
        shape.set_xy(_outline(response, pose))
        dot.set_data(*_placed(response, pose, [(0.0, 0.0)]).T)
        hand.set_xdata([times[frame]] * 2)
        lines.set_segments(straps.lines(response, frame, pose))
        lines.set_color(straps.colours(frame))
        scene.set_title(
            f"{times[frame]:.2f} s   rotation {degrees(pose[2]):.1f}°{straps.told(frame)}"
        )
        canvas.restore_region(still)
        for artist in moving:
            figure.draw_artist(artist)
        return np.asarray(canvas.buffer_rgba())[..., :3].copy()

    rate = (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else FRAMES_PER_SECOND
    with appearing_file(path) as fresh:
        write_film((draw(frame) for frame in range(len(times))), fresh, rate)
    return path


def _draw_scene(response: ShownResponse, poses: NDArray[np.float64], scene: Axes) -> None:
    """The support, with room for the body wherever it goes."""
    body, tilt = response.body, response.support.tilt
    size = np.hypot(max(body.left, body.right), body.whole_height)
    along = poses[:, 0]
    left, right = along.min() * np.cos(tilt), along.max() * np.cos(tilt)
    low, high = np.sort(np.sin(tilt) * np.array([along.min(), along.max()]))
    top = (poses[:, 1].max() - body.cg_height) * np.cos(tilt)
    scene.set_aspect("equal")
    scene.set_xlim(left - 1.25 * size, right + 1.25 * size)
    scene.set_ylim(low - 0.3 * size, high + top + 1.15 * size)
    scene.set_xlabel("[m]")
    scene.set_ylabel("[m]")
    around = response.surroundings
    ends = np.array([along.min() - 2.0 * size, along.max() + 2.0 * size])
    edge = around.edge if around else None
    if edge:
        side = np.sign(np.cos(edge.azimuth))
        ends[int(side > 0.0)] = side * edge.at
        lip = np.array([[ends[int(side > 0.0)]] * 2, [0.0, edge.lip]]).T
        scene.plot(*_on_support(response, lip).T, color="0.25", lw=3)
        scene.set_ylim(min(low - 0.3 * size, -1.1 * edge.drop), scene.get_ylim()[1])
        scene.axhline(-edge.drop, color="0.4", lw=1)
    ground = scene.get_ylim()[0]
    scene.fill_between(
        ends * np.cos(tilt), ends * np.sin(tilt), min(ground, low - size), color="0.8", ec="0.4"
    )
    scene.plot([0.0], [0.0], marker=7, color="black", ms=6)
    for wall in around.walls if around else ():
        scene.plot(*_on_support(response, _wall(response, wall)).T, color="0.4", lw=3)


def _wall(response: ShownResponse, wall: ShownWall) -> NDArray[np.float64]:
    """Foot and top of a wall in the support's frame [m], (2, 2)."""
    body, side = response.body, np.sign(np.cos(wall.azimuth))
    tilt = response.support.tilt if wall.vertical else 0.0
    toward = np.array([side * np.cos(tilt), -side * np.sin(tilt)])
    up = np.array([np.sin(tilt), np.cos(tilt)])
    base = body.right if side > 0.0 else -body.left
    corners = np.array([[base, 0.0], [base, body.whole_height]])
    away = float((corners @ toward).max()) + wall.gap
    foot = np.array([away / toward[0], 0.0])
    return np.array([foot, foot + 1.1 * body.whole_height * up])


class _Straps(NamedTuple):
    """The straps of a film at its frames.

    Attributes:
        force: [N], (strap, frame).
        whole: whether it has not broken, (strap, frame).
    """

    force: NDArray[np.float64]
    whole: NDArray[np.bool_]

    @classmethod
    def of(cls, response: ShownResponse, times: NDArray[np.float64]) -> _Straps:
        forces = response.strap_forces
        broke = np.array(response.strap_broke_at)
        return cls(
            np.array([np.interp(times, response.time, each) for each in forces.T]),
            ~(times >= broke[:, None]),
        )

    def lines(
        self, response: ShownResponse, frame: int, pose: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """From point to anchor of those that have not broken."""
        straps = response.surroundings.straps if response.surroundings else ()
        lines = []
        for strap, whole in zip(straps, self.whole[:, frame], strict=True):
            if whole:
                x, z = strap.point
                point = _placed(response, pose, [(x, z - response.body.cg_height)])
                lines.append(np.vstack([point, _on_support(response, np.array([strap.anchor]))]))
        return lines

    def colours(self, frame: int) -> list[str]:
        return [
            strap_colour(force[frame], force.max())
            for force, whole in zip(self.force, self.whole, strict=True)
            if whole[frame]
        ]

    def told(self, frame: int) -> str:
        """What they bear."""
        each = [
            f"{force[frame]:,.0f} N" if whole[frame] else "broken"
            for force, whole in zip(self.force, self.whole, strict=True)
        ]
        return f"   {'strap' if len(each) == 1 else 'straps'} {', '.join(each)}" if each else ""


def _frames(response: ShownResponse) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times, and x, y [m], θ [rad] in each: from just before the body moves until just after."""
    time = response.time
    poses = np.column_stack([response.position, response.rotation])
    if response.outcome is not Outcome.STANDING:
        rest = response.overturning_time - time[-1]
        end = poses[-1] + rest * np.r_[response.velocity[-1], 0.0]
        end[2] = lying_rotation(response)
        body = response.body  # it lies on its side, or is still higher
        if not response.off_edge:
            end[1] = max(end[1], body.right if end[2] > 0 else body.left)
        time, poses = np.append(time, response.overturning_time), np.vstack([poses, end])
    away = np.abs(poses - [0.0, response.body.cg_height, 0.0]).max(axis=1)
    step = np.abs(np.diff(poses, axis=0, prepend=poses[:1])).max(axis=1)
    moving = np.flatnonzero((away > MOVED) & (step > MOVED / 100))
    first, last = (time[moving[0]], time[moving[-1]]) if moving.size else (0.0, time[-1])
    begin, until = max(first - LEAD, 0.0), last + TAIL
    rate = min(FRAMES_PER_SECOND, max(MOST_FRAMES / (until - begin), FEWEST_PER_SECOND))
    times = np.arange(begin, until, 1 / rate)
    return times, np.column_stack([np.interp(times, time, pose) for pose in poses.T])


def _placed(
    response: ShownResponse, pose: NDArray[np.float64], points: list[tuple[float, float]]
) -> NDArray[np.float64]:
    """Where points of the body, given from its centre of gravity, are in the world."""
    x, y, theta = pose
    cos, sin = np.cos(theta), np.sin(theta)
    turned = np.array(points) @ np.array([[cos, -sin], [sin, cos]]) + [x, y]
    return _on_support(response, turned)


def _on_support(response: ShownResponse, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where points of the support's frame are in the world."""
    tilt = response.support.tilt
    leaning = np.array([[np.cos(tilt), np.sin(tilt)], [-np.sin(tilt), np.cos(tilt)]])
    return np.asarray(points @ leaning)


def _outline(response: ShownResponse, pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the body: base left and right, top right and left."""
    body = response.body
    h = body.cg_height
    top = body.whole_height - h
    corners = [(-body.left, -h), (body.right, -h), (body.right, top), (-body.left, top)]
    return _placed(response, pose, corners)
