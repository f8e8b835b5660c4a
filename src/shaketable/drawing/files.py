"""Files to which pictures and films are written."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.errors import InputError
from shaketable.outputs import appearing_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FILM_WRITERS = {".gif": "PillowWriter", ".mp4": "FFMpegWriter"}  # names in matplotlib


def require_picture(path: Path) -> None:
    """InputError unless matplotlib can write a picture there."""
    from matplotlib.figure import Figure

    _require_ending(path, [f".{end}" for end in Figure().canvas.get_supported_filetypes()])


def require_film(path: Path) -> None:
    """InputError unless an animation can be written there."""
    _require_ending(path, list(FILM_WRITERS))
    if not writer(path).isAvailable():
        raise InputError(f"{path}: writing {path.suffix} needs the program ffmpeg; use .gif")


def _require_ending(path: Path, accepted: list[str]) -> None:
    if path.suffix.lower() not in accepted:
        raise InputError(f"{path}: the name must end in one of {', '.join(sorted(accepted))}")
    folder = path.resolve().parent
    if not folder.is_dir():
        raise InputError(f"{path}: there is no folder {folder}")
    if path.is_dir():
        raise InputError(f"{path}: is a folder")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise InputError(f"{path}: cannot be written")


def writer(path: Path) -> Any:
    """Matplotlib's class that writes a film with this path's ending."""
    from matplotlib import animation

    return getattr(animation, FILM_WRITERS[path.suffix.lower()])


def save(ax: Axes, path: Path) -> Path:
    """Write the figure of these axes; the path's ending chooses the format."""
    require_picture(path)
    figure = ax.get_figure(root=True)
    assert figure is not None
    with appearing_file(path) as fresh:
        figure.savefig(fresh, dpi=150)
    return path


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
