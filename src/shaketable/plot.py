"""Pictures of one run: its history, and a film of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.response import Outcome, Response
from shaketable.units import STANDARD_GRAVITY, degrees

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

FRAMES_PER_SECOND = 25
FILM_WRITERS = {".gif": "PillowWriter", ".mp4": "FFMpegWriter"}  # of matplotlib
LEAD, TAIL = 0.5, 1.0  # s shown before the first and after the last movement


def plot_response(response: Response, ax: tuple[Axes, Axes] | None = None) -> tuple[Axes, Axes]:
    """Rotation over time, above the motion that caused it.

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
    bounds = {
        "uphill balance": degrees(response.body.slenderness_right + response.support.tilt),
        "downhill balance": -degrees(response.body.slenderness_left - response.support.tilt),
    }
    for (name, level), style in zip(bounds.items(), ("--", ":"), strict=True):
        above.axhline(level, color="tab:red", ls=style, lw=0.9, label=name)
    reach = 1.35 * max(abs(level) for level in bounds.values())
    above.set_ylim(-reach, reach)
    if response.outcome is not Outcome.STANDING:
        above.axvline(response.overturning_time, color="black", lw=1)
        above.annotate(
            f"overturns {response.outcome.name.lower()}\nat {response.overturning_time:.2f} s",
            (response.overturning_time, -0.9 * reach),
            xytext=(6, 0),
            textcoords="offset points",
            va="bottom",
        )
    above.set_ylabel("rotation [°]\n(+ uphill)")
    above.set_title(
        f"{response.body.name or 'body'} on {response.motion.name or 'the motion'}, ".replace(
            "$", r"\$"
        )
        + f"tilt {degrees(response.support.tilt):.3g}°: {response.outcome.name.lower()}, "
        f"peak {degrees(response.peak_rotation):.3g}°, {response.impacts} impacts"
    )
    above.legend(loc="upper right", fontsize="small")

    motion = response.motion
    below.plot(
        motion.time, motion.horizontal / STANDARD_GRAVITY, color="0.25", lw=0.7, label="horizontal"
    )
    if motion.vertical is not None:
        below.plot(
            motion.time,
            motion.vertical / STANDARD_GRAVITY,
            color="tab:orange",
            lw=0.6,
            alpha=0.8,
            label="vertical",
        )
        below.legend(loc="upper right", fontsize="small")
    below.set_ylabel("ground\nacceleration [g]")
    below.set_xlabel("time [s]")
    below.set_xlim(0.0, max(time[-1], motion.duration))
    return above, below


def require_picture(path: Path) -> None:
    """InputError unless matplotlib can write a picture there."""
    from matplotlib.figure import Figure

    _require_ending(path, [f".{end}" for end in Figure().canvas.get_supported_filetypes()])


def require_film(path: Path) -> None:
    """InputError unless an animation can be written there."""
    _require_ending(path, list(FILM_WRITERS))
    if not _writer(path).isAvailable():
        raise InputError(f"{path}: writing {path.suffix} needs the program ffmpeg; use .gif")


def _require_ending(path: Path, accepted: list[str]) -> None:
    if path.suffix.lower() not in accepted:
        raise InputError(f"{path}: the name must end in one of {', '.join(sorted(accepted))}")
    if not path.resolve().parent.is_dir():
        raise InputError(f"{path}: there is no folder {path.resolve().parent}")


def _writer(path: Path) -> Any:
    from matplotlib import animation

    return getattr(animation, FILM_WRITERS[path.suffix.lower()])


def save(response: Response, path: Path) -> Path:
    """Write the picture of `plot_response`; the path's ending chooses the format."""
    require_picture(path)
    figure = plot_response(response)[0].get_figure(root=True)
    assert figure is not None
    figure.savefig(path, dpi=150)
    return path


def animate_response(response: Response, path: Path) -> Path:
    """The body on its tilted support, in real time, as a GIF or an MP4.

    The centre of gravity is a dot; the body is drawn twice as high as that lies.

    Raises:
        InputError: another ending than .gif or .mp4, or .mp4 without ffmpeg.
    """
    from matplotlib.animation import FuncAnimation
    from matplotlib.figure import Figure
    from matplotlib.patches import Polygon

    require_film(path)
    times, angles = _frames(response)
    body, tilt = response.body, response.support.tilt
    size = np.hypot(max(body.left, body.right), 2 * body.cg_height)
    figure = Figure(figsize=(6, 5), layout="constrained")
    scene, trace = figure.subplots(2, 1, height_ratios=[4, 1])
    scene.set_aspect("equal")
    scene.set_xlim(-1.25 * size, 1.25 * size)
    scene.set_ylim(-0.3 * size, 1.15 * size)
    scene.set_xlabel("[m]")
    scene.set_ylabel("[m]")
    edge = np.array([-2.0 * size, 2.0 * size])
    scene.fill_between(
        edge * np.cos(tilt), edge * np.sin(tilt), -size, color="0.8", edgecolor="0.4"
    )
    shape = scene.add_patch(Polygon(_corners(response, 0.0), fc="tab:blue", ec="black", alpha=0.8))
    (dot,) = scene.plot([], [], "o", color="white", mec="black")
    motion = response.motion
    trace.plot(motion.time, motion.horizontal / STANDARD_GRAVITY, color="0.25", lw=0.6)
    trace.set_xlim(times[0], times[-1])
    trace.set_xlabel("time [s]")
    trace.set_ylabel("ground\nacc. [g]")
    (hand,) = trace.plot([times[0]] * 2, trace.get_ylim(), color="tab:red", lw=1)

    def draw(frame: int) -> list[Artist]:
        shape.set_xy(_corners(response, angles[frame]))
        dot.set_data(*_place(response, angles[frame], [(0.0, body.cg_height)]).T)
        hand.set_xdata([times[frame]] * 2)
        scene.set_title(f"{times[frame]:.2f} s   rotation {degrees(angles[frame]):.1f}°")
        return [shape, dot, hand]

    film = FuncAnimation(figure, draw, frames=len(times), blit=False)
    film.save(path, writer=_writer(path)(fps=FRAMES_PER_SECOND))
    return path


def _frames(response: Response) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times and rotations of the frames: from just before it moves until just after."""
    time, rotation = response.time, response.rotation
    last = time[-1]
    if response.outcome is not Outcome.STANDING:
        last = response.overturning_time
        time = np.append(time, last)
        rotation = np.append(rotation, response.outcome * np.pi / 2)
    moving = np.flatnonzero(np.abs(rotation) > 1e-4)
    first, end = (time[moving[0]], time[moving[-1]]) if moving.size else (0.0, last)
    times = np.arange(max(first - LEAD, 0.0), end + TAIL, 1 / FRAMES_PER_SECOND)
    return times, np.interp(times, time, rotation)


def _place(
    response: Response, theta: float, points: list[tuple[float, float]]
) -> NDArray[np.float64]:
    """Points of the body, from the foot of its centre of gravity, where they are in the world."""
    body, tilt = response.body, response.support.tilt
    pivot = np.array([body.right if theta >= 0.0 else -body.left, 0.0])
    cos, sin = np.cos(theta), np.sin(theta)
    turned: NDArray[np.float64] = (np.array(points) - pivot) @ np.array(
        [[cos, -sin], [sin, cos]]
    ) + pivot
    leaning = np.array([[np.cos(tilt), np.sin(tilt)], [-np.sin(tilt), np.cos(tilt)]])
    return np.asarray(turned @ leaning)


def _corners(response: Response, theta: float) -> NDArray[np.float64]:
    body = response.body
    top = 2 * body.cg_height
    outline = [(-body.left, 0.0), (body.right, 0.0), (body.right, top), (-body.left, top)]
    return _place(response, theta, outline)
