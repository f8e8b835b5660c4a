"""What holds an object, as the command line spells it: its mass and its straps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import typer

from shaketable.errors import InputError
from shaketable.solid import Solid
from shaketable.spelled_straps import EXAMPLE, strap_of
from shaketable.surroundings import Surroundings


@dataclass(frozen=True)
class SurroundingOptions:
    """What holds an object in three dimensions."""

    mass_kg: Annotated[
        float | None, typer.Option(help="Mass [kg], which a strap needs and nothing else.")
    ] = None
    strap: Annotated[
        list[str] | None,
        typer.Option(
            help=f"A strap in three dimensions, such as {EXAMPLE}: from the middle of the side "
            "toward +x, at the top or at a height such as 1.5m; of damping (Ns/m), pretension and "
            "strength (N, kN) what is given. It ends 50 mm behind that point, or at "
            "anchor=X/Y/Z, such as 0.3m/0m/1.9m: on the support, from the foot of the centre of "
            "gravity at the start. Several times for several."
        ),
    ] = None

    @property
    def given(self) -> dict[str, float | None]:
        """The options that only solids have, by the names of the command line."""
        return {"--mass-kg": self.mass_kg, "--strap": 1.0 if self.strap else None}

    def around(self, solid: Solid, orientation: float) -> Surroundings | None:
        """What holds a solid that is turned by an orientation [rad]; None if nothing does.

        Raises:
            InputError: a strap that cannot be read, or cannot be.
        """
        if not self.strap:
            return None
        if solid.mass is None:
            raise InputError("--strap: a stiffness in N/m needs a mass; give --mass-kg")
        try:
            straps = tuple(strap_of(text, solid, orientation) for text in self.strap)
            return Surroundings(straps=straps)
        except InputError as error:
            raise InputError(f"--strap: {error}") from None
