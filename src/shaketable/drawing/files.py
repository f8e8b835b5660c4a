"""Files to which pictures and films are written."""

from __future__ import annotations

import itertools
import os
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.atomic_files import appearing_file
from shaketable.errors import refused
from shaketable.extras import require

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FILMS = (".gif", ".mp4")
SCENE = ".glb"
COLOURS = 64  # of a GIF


def require_picture(path: Path) -> None:
    """InputError unless matplotlib can write a picture there."""
    from matplotlib.figure import Figure

    _require_ending(path, [f".{end}" for end in Figure().canvas.get_supported_filetypes()])


def require_film(path: Path) -> None:
    """InputError unless an animation can be written there."""
    _require_ending(path, list(FILMS))
    if path.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
        raise refused(path, f"writing {path.suffix} needs the program ffmpeg; use .gif")


def require_scene(path: Path) -> None:
    """InputError unless an animated scene can be written there."""
    _require_ending(path, [SCENE])
    require("gltf", f"{path}: a scene")


def require_film_or_scene(path: Path) -> None:
    """InputError unless an animation of a solid can be written there."""
    if path.suffix.lower() == SCENE:
        require_scene(path)
    else:
        _require_ending(path, [*FILMS, SCENE])
        require_film(path)


def _require_ending(path: Path, accepted: list[str]) -> None:
    if path.suffix.lower() not in accepted:
        raise refused(path, f"the name must end in one of {', '.join(sorted(accepted))}")
    folder = path.resolve().parent
    if not folder.is_dir():
        raise refused(path, f"there is no folder {folder}")
    if path.is_dir():
        raise refused(path, "is a folder")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise refused(path, "cannot be written")


def write_film(
    frames: Iterable[NDArray[np.uint8]],
    path: Path,
    rate: float,
    colours: NDArray[np.uint8] | None = None,
) -> None:
    """Write pictures (height, width, RGB) as a GIF or an MP4.

    Args:
        frames: the pictures.
        path: of the film.
        rate: pictures a second.
        colours: a picture that has all colours of the others; the first of them if not given.
    """
    if path.suffix.lower() == ".gif":
        _write_gif(frames, path, rate, colours)
    else:
        _write_mp4(frames, path, rate)


def _write_gif(
    frames: Iterable[NDArray[np.uint8]],
    path: Path,
    rate: float,
    colours: NDArray[np.uint8] | None,
) -> None:
    from PIL import Image

    pictures = (Image.fromarray(frame) for frame in frames)
    first = next(pictures)
    palette = (first if colours is None else Image.fromarray(colours)).quantize(COLOURS)
    first = first.quantize(palette=palette, dither=Image.Dither.NONE)
    rest = (picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures)
    first.save(path, format="gif", save_all=True, append_images=rest, duration=1000 / rate, loop=0)


def _write_mp4(frames: Iterable[NDArray[np.uint8]], path: Path, rate: float) -> None:
    """By the program ffmpeg, whose input are the pixels."""
    pixels = iter(frames)
    first = next(pixels)
    height, width = first.shape[:2]
    options = ["-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command = [
        "ffmpeg", *options, "-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-",
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-y", str(path),
    ]  # fmt: skip
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:  # noqa: S603  our own words and a path
        assert process.stdin is not None
        assert process.stderr is not None
        try:
            for frame in itertools.chain([first], pixels):
                process.stdin.write(frame.tobytes())
            process.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg says why
        said = process.stderr.read().decode(errors="replace").strip()
    if process.returncode:
        raise OSError(f"ffmpeg failed: {said}")


def save(ax: Axes, path: Path) -> Path:
    """Write the figure of these axes; the path's ending chooses the format."""
    require_picture(path)
    figure = figure_of(ax)
    with appearing_file(path) as fresh:
        figure.savefig(fresh, dpi=150)
    return path


def figure_of(ax: Axes) -> Figure:
    """The figure that axes belong to."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    return figure


def as_html(ax: Axes, title: str) -> str:
    """The figure of these axes for a notebook, with a line of words above it."""
    import base64
    import html
    import io

    figure = ax.get_figure(root=True)
    assert figure is not None
    picture = io.BytesIO()
    figure.savefig(picture, format="png", dpi=90)
    data = base64.b64encode(picture.getvalue()).decode()
    said = html.escape(title)
    return f'<p>{said}</p><img alt="{said}" src="data:image/png;base64,{data}">'
