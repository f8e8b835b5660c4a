"""What stands beside an object and what holds it, as the command line spells it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.solid import Solid
from shaketable.spelled_surroundings import EXAMPLE, metres, read_strap, surroundings_of
from shaketable.surroundings import Surroundings


@dataclass(frozen=True)
class SurroundingOptions:
    """What surrounds an object."""

    mass_kg: Annotated[
        float | None, typer.Option(help="Mass [kg], which straps and pads need and nothing else.")
    ] = None
    wall_gap_mm: Annotated[
        float | None,
        typer.Option(
            help="Distance [mm] from the back, the side toward +x, to a wall. It is vertical; with "
            "the rocking model it is normal to the support, and the distance 0."
        ),
    ] = None
    wall_friction: Annotated[
        float | None,
        typer.Option(help="Friction between the object and the wall. [0.3]", show_default=False),
    ] = None
    wall_restitution: Annotated[
        float | None,
        typer.Option(
            help="Restitution at the wall, 0 to 1. [0, but with "
            "the rocking model by Hogan's rule (1992): 0.41 of a bookcase]",
            show_default=False,
        ),
    ] = None
    strap: Annotated[
        list[str] | None,
        typer.Option(
            help=f"A strap, such as {EXAMPLE}: from the middle of the back, "
            "toward +x, at the top or at a height such as 1.5m; of damping (Ns/m), pretension and "
            "strength (N, kN) what is given. It ends on the wall straight behind that point, "
            "50 mm behind it where there is no gap, or at anchor=X/Y/Z, such as 0.3m/0m/1.9m, in a "
            "plane X/Z: on the support, from the foot of the centre of gravity at the start. "
            "Several times for several. In a plane with the general model."
        ),
    ] = None
    edge_mm: Annotated[
        float | None,
        typer.Option(
            help="Distance [mm] from the front, the side toward -x, to where the support ends; "
            "in a plane with the general model."
        ),
    ] = None
    lip_mm: Annotated[
        float | None, typer.Option(help="Height [mm] of a lip at that edge, in a plane. [0]")
    ] = None
    pad_n: Annotated[
        float | None,
        typer.Option(
            help="Force [N] that pulls off one foot that is glued down, as by museum wax; in a "
            "plane, which has two feet, with the general model."
        ),
    ] = None

    def around(
        self, body: Body | Solid, orientation: float = 0.0, *, vertical: bool = True
    ) -> Surroundings | None:
        """What surrounds a body, a solid turned by an orientation [rad]; None if nothing does.

        Args:
            body: what is surrounded.
            orientation: its own [rad].
            vertical: whether its wall is so, on a tilted support.

        Raises:
            InputError: a wall, a strap or an edge that cannot be read, or cannot be.
        """
        if (self.strap or self.pad_n is not None) and body.mass is None:
            named = "--strap" if self.strap else "--pad-n"
            raise InputError(f"{named}: newtons need a mass; give --mass-kg")
        if self.mass_kg is not None and not self.strap and self.pad_n is None:
            raise InputError("--mass-kg: only a --strap or --pad-n needs it; leave it out")
        try:
            return surroundings_of(
                body,
                orientation,
                straps=[read_strap(text) for text in self.strap or ()],
                wall_gap=metres(self.wall_gap_mm),
                wall_friction=self.wall_friction,
                wall_restitution=self.wall_restitution,
                wall_vertical=vertical,
                edge=metres(self.edge_mm),
                lip=metres(self.lip_mm),
                pull_off=self.pad_n,
            )
        except InputError as error:
            given: dict[str, object] = {
                "--wall-restitution": self.wall_restitution if self.wall_gap_mm is None else None,
                "--wall-friction": self.wall_friction if self.wall_gap_mm is None else None,
                "--lip-mm": self.lip_mm if self.edge_mm is None else None,
                "--strap": self.strap,
                "--wall-gap-mm": self.wall_gap_mm,
                "--edge-mm": self.edge_mm,
                "--pad-n": self.pad_n,
            }
            named = next(name for name, value in given.items() if value is not None)
            raise InputError(f"{named}: {error}") from None
