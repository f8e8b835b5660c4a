"""The object that sizes and a shape on the command line describe."""

from __future__ import annotations

from shaketable.cli.options import ShapeWord
from shaketable.errors import InputError
from shaketable.solid import Solid


def solid_from(
    width: float, depth: float | None, height: float, shape: ShapeWord | None, eccentricity: float
) -> Solid | None:
    """The object in three dimensions; None if it is asked for in its plane.

    Raises:
        InputError: options that do not go together.
    """
    if shape is ShapeWord.CYLINDER:
        if depth is not None:
            raise InputError("--depth-m: a cylinder has none; its diameter is --width-m")
        if eccentricity != 0.5:
            raise InputError("--eccentricity: of a cylinder it must be 0.5, the middle")
        return Solid.cylinder(width, height, name=f"cylinder {width:g} m × {height:g} m")
    if depth is None:
        if shape is not None:
            raise InputError("--shape box needs --depth-m [m], the size across --width-m")
        return None
    name = f"{width:g} m × {depth:g} m × {height:g} m"
    return Solid.box(width, depth, height, eccentricity=(eccentricity, 0.5), name=name)


def require_plane(given: dict[str, float | None]) -> None:
    """InputError if what only solids have is asked of a planar body."""
    named = ", ".join(name for name, value in given.items() if value is not None)
    if named:
        raise InputError(f"{named}: only in three dimensions; give --depth-m or --shape cylinder")
