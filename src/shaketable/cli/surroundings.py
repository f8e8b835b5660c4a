"""What stands beside an object and what holds it, as the command line spells it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from shaketable.errors import InputError
from shaketable.solid import Solid
from shaketable.spelled_surroundings import EXAMPLE, surroundings_of
from shaketable.surroundings import Surroundings, Wall


@dataclass(frozen=True)
class SurroundingOptions:
    """What surrounds an object."""

    mass_kg: Annotated[
        float | None, typer.Option(help="Mass [kg], which a strap needs and nothing else.")
    ] = None
    wall_gap_mm: Annotated[
        float | None,
        typer.Option(
            help="Distance [mm] from the side toward +x to a wall. In three dimensions the wall is "
            "vertical; in a plane it is normal to the support, and the distance 0."
        ),
    ] = None
    wall_friction: Annotated[
        float | None, typer.Option(help="Of the object on the wall. [0.3]", show_default=False)
    ] = None
    wall_restitution: Annotated[
        float | None,
        typer.Option(
            help="Part of its speed with which the object leaves the wall, 0 to 1. [0, but in a "
            "plane by Hogan's rule (1992): 0.41 of a bookcase]",
            show_default=False,
        ),
    ] = None
    strap: Annotated[
        list[str] | None,
        typer.Option(
            help=f"A strap in three dimensions, such as {EXAMPLE}: from the middle of the side "
            "toward +x, at the top or at a height such as 1.5m; of damping (Ns/m), pretension and "
            "strength (N, kN) what is given. It ends on the wall straight behind that point, "
            "50 mm behind it where there is no gap, or at anchor=X/Y/Z, such as 0.3m/0m/1.9m: on "
            "the support, from the foot of the centre of gravity at the start. Several times for "
            "several."
        ),
    ] = None

    @property
    def of_solids(self) -> dict[str, float | None]:
        """The options that only solids have, by the names of the command line."""
        return {
            "--mass-kg": self.mass_kg,
            "--wall-friction": self.wall_friction,
            "--strap": 1.0 if self.strap else None,
        }

    @property
    def in_plane(self) -> Surroundings | None:
        """The wall that a planar body stands against; None without one.

        Raises:
            InputError: a wall that cannot be.
        """
        if self.wall_gap_mm is None:
            if self.wall_restitution is not None:
                raise InputError("--wall-restitution: without its gap: give --wall-gap-mm")
            return None
        gap = 1e-3 * self.wall_gap_mm
        wall = Wall(gap=gap, vertical=False, restitution=self.wall_restitution)
        return Surroundings(walls=(wall,))

    def around(self, solid: Solid, orientation: float) -> Surroundings | None:
        """What surrounds a solid that is turned by an orientation [rad]; None if nothing does.

        Raises:
            InputError: a wall or a strap that cannot be read, or cannot be.
        """
        if self.strap and solid.mass is None:
            raise InputError("--strap: a stiffness in N/m needs a mass; give --mass-kg")
        try:
            return surroundings_of(
                solid,
                orientation,
                straps=self.strap or (),
                wall_gap=None if self.wall_gap_mm is None else 1e-3 * self.wall_gap_mm,
                wall_friction=self.wall_friction,
                wall_restitution=self.wall_restitution,
            )
        except InputError as error:
            named = "--strap" if self.strap else "--wall-gap-mm"
            raise InputError(f"{named}: {error}") from None
