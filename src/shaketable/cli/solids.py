"""The object that sizes and a shape on the command line describe."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

from shaketable.cli.options import ShapeWord
from shaketable.errors import InputError
from shaketable.solid import Solid


class Losses(NamedTuple):
    """Lengths of friction against rolling and turning [m], None where an option is not given."""

    rolling_friction: float | None
    contour_friction: float | None
    drilling_friction: float | None

    @property
    def given(self) -> dict[str, float]:
        return {name: value for name, value in self._asdict().items() if value is not None}


def solid_from(
    width: float,
    depth: float | None,
    height: float,
    shape: ShapeWord | None,
    eccentricity: float,
    losses: Losses,
) -> Solid | None:
    """The object in three dimensions; None if it is asked for in its plane.

    Raises:
        InputError: options that do not go together.
    """
    solid = _lossless(width, depth, height, shape, eccentricity)
    if solid is None:
        options = {f"--{name.replace('_', '-')}-m": value for name, value in losses.given.items()}
        require_plane(options)
        return None
    if losses.contour_friction is not None and solid.diameter is None:
        raise InputError("--contour-friction-m: is of a rim; give --shape cylinder as well")
    return replace(
        solid,
        rolling_friction=losses.rolling_friction or 0.0,
        contour_friction=losses.contour_friction or 0.0,
        drilling_friction=losses.drilling_friction or 0.0,
    )


def _lossless(
    width: float, depth: float | None, height: float, shape: ShapeWord | None, eccentricity: float
) -> Solid | None:
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


def require_plane(given: Mapping[str, float | None]) -> None:
    """InputError if what only solids have is asked of a planar body."""
    named = ", ".join(name for name, value in given.items() if value is not None)
    if named:
        raise InputError(f"{named}: only in three dimensions; give --depth-m or --shape cylinder")
