"""The one object that a command is given: in a plane by its base, in space by its sizes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.options import Eccentricity, HeightM, ShapeWord, warn_of_sizes
from shaketable.errors import InputError
from shaketable.solid import Solid

PLANE = "in a plane the one size along the shaking is --base-m"


@dataclass(frozen=True, kw_only=True)
class ObjectOptions:
    """An object: along x its base in a plane, or its depth in space, where its width is along y."""

    base_m: Annotated[
        float | None,
        typer.Option(
            help="Base along the shaking [m], of an object in its plane; the diameter of a "
            "cylinder."
        ),
    ] = None
    depth_m: Annotated[
        float | None,
        typer.Option(
            help="From front to back [m], along x, with --width-m in place of --base-m: a box in "
            "three dimensions."
        ),
    ] = None
    width_m: Annotated[
        float | None, typer.Option(help="From side to side [m], along y, with --depth-m.")
    ] = None
    height_m: HeightM
    shape: Annotated[
        ShapeWord | None,
        typer.Option(
            "--shape",
            help="cylinder: one of --base-m, in three dimensions; box: of --depth-m and --width-m.",
        ),
    ] = None
    eccentricity: Eccentricity = 0.5
    rolling_friction_m: Annotated[
        float | None,
        typer.Option(
            help="Length that, times the pressure, bounds the moment against rolling [m], in three "
            "dimensions. [0]"
        ),
    ] = None
    contour_friction_m: Annotated[
        float | None,
        typer.Option(
            help="Length that, times the pressure and the rate of the contact around the rim, is "
            "the power lost [m]: of a cylinder. [0]"
        ),
    ] = None
    drilling_friction_m: Annotated[
        float | None,
        typer.Option(
            help="Length that, times the pressure, bounds the moment against turning on the spot "
            "[m], in three dimensions. [0]"
        ),
    ] = None

    def object(self, mass: float | None = None) -> Body | Solid:
        """The object, of a mass [kg] where it is given; sizes that are odd are told.

        Raises:
            InputError: sizes and options that do not go together.
        """
        sizes = {
            "--base-m": self.base_m, "--depth-m": self.depth_m, "--width-m": self.width_m,
            "--height-m": self.height_m,
        }  # fmt: skip
        found = self._in_space(mass) or self._in_plane(mass)
        warn_of_sizes({name: size for name, size in sizes.items() if size is not None})
        return found

    @property
    def settings(self) -> dict[str, float | str | None]:
        """The sizes and the shape as they were given."""
        return {
            "base_m": self.base_m,
            "depth_m": self.depth_m,
            "width_m": self.width_m,
            "height_m": self.height_m,
            "shape": self.shape and self.shape.value,
            "eccentricity": self.eccentricity,
        }

    def _in_plane(self, mass: float | None) -> Body:
        require_plane(
            {
                "--rolling-friction-m": self.rolling_friction_m,
                "--contour-friction-m": self.contour_friction_m,
                "--drilling-friction-m": self.drilling_friction_m,
            }
        )
        if self.base_m is None:
            raise InputError(
                "give --base-m, its size along the shaking; or --depth-m and --width-m, for a box "
                "in three dimensions"
            )
        name = f"{self.base_m:g} m × {self.height_m:g} m"
        return Body.rectangle(
            self.base_m, self.height_m, eccentricity=self.eccentricity, name=name, mass=mass
        )

    def _in_space(self, mass: float | None) -> Solid | None:
        """None if it is asked for in its plane."""
        rolling, drilling = self.rolling_friction_m or 0.0, self.drilling_friction_m or 0.0
        across = {"--depth-m": self.depth_m, "--width-m": self.width_m}
        given = [name for name, size in across.items() if size is not None]
        if self.shape is ShapeWord.CYLINDER:
            if given or self.base_m is None:
                raise InputError(
                    f"{' and '.join(given) or '--shape cylinder'}: the one size of a cylinder's "
                    "base is its diameter, --base-m"
                )
            if self.eccentricity != 0.5:
                raise InputError("--eccentricity: of a cylinder it must be 0.5, the middle")
            return Solid.cylinder(
                self.base_m,
                self.height_m,
                rolling_friction=rolling,
                contour_friction=self.contour_friction_m or 0.0,
                drilling_friction=drilling,
                name=f"cylinder {self.base_m:g} m × {self.height_m:g} m",
                mass=mass,
            )
        if self.depth_m is None or self.width_m is None:
            if given or self.shape is not None:
                named = given[0] if given else "--shape box"
                raise InputError(f"{named}: a box has --depth-m and --width-m; {PLANE}")
            return None
        if self.base_m is not None:
            raise InputError(f"--base-m: a box has --depth-m and --width-m; {PLANE}")
        if self.contour_friction_m is not None:
            raise InputError("--contour-friction-m: is of a rim; give --shape cylinder")
        return Solid.box(
            self.depth_m,
            self.width_m,
            self.height_m,
            eccentricity=(self.eccentricity, 0.5),
            rolling_friction=rolling,
            drilling_friction=drilling,
            name=f"{self.depth_m:g} m × {self.width_m:g} m × {self.height_m:g} m",
            mass=mass,
        )


def require_plane(given: Mapping[str, float | None]) -> None:
    """InputError if what only solids have is asked of a planar body."""
    named = ", ".join(name for name, value in given.items() if value is not None)
    if named:
        raise InputError(
            f"{named}: only in three dimensions; give --depth-m and --width-m in place of "
            "--base-m, or --shape cylinder"
        )
