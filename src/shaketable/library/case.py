"""One case of a library: a thing, where it stands, what holds it, on which tilt and friction."""

from __future__ import annotations

import re
from dataclasses import dataclass

from shaketable.errors import InputError, require_not_negative, require_positive, require_whole
from shaketable.library.thing import LibraryThing
from shaketable.synthesis import ShearBuilding
from shaketable.units import degrees

GROUND = "ground"


@dataclass(frozen=True, kw_only=True)
class Stand:
    """The floor on which things stand: the ground, or a floor of a shear building.

    Args:
        name: of the place.
        building: None for the ground.
        floor: its number, from 1 to the building's storeys; 0 is the ground.

    Raises:
        InputError: a floor that the building has not got.
    """

    name: str = GROUND
    building: ShearBuilding | None = None
    floor: int = 0

    def __post_init__(self) -> None:
        storeys = self.building.storeys if self.building else 0
        if not (0 < self.floor <= storeys or (self.floor == 0 and self.building is None)):
            raise InputError(
                f"{self.name}: floor must be from 1 to {storeys} storeys, got {self.floor}"
            )


@dataclass(frozen=True, kw_only=True)
class Held:
    """What stands behind things and holds them, for a thing of any mass.

    A strap goes from the middle of the upper edge of the back straight to the wall. Its stiffness
    and damping go with the mass of the thing, so that the mass does not matter.

    Args:
        name: of this way of holding.
        wall_gap: from the back to a wall [m]; None where there is no wall.
        strength: force at which the strap breaks, in weights of the thing; None for no strap.
        slack: of the strap [m].
        edge: from the front to the edge of the table on which things stand [m]; None on a floor.
        draws: how many things, as they may be, meet each motion.

    Raises:
        InputError: numbers out of range, or a strap without a wall.
    """

    name: str = "free"
    wall_gap: float | None = None
    strength: float | None = None
    slack: float = 0.0
    edge: float | None = None
    draws: int = 4

    def __post_init__(self) -> None:
        require_not_negative(f"{self.name}: slack [m]", self.slack)
        require_whole(f"{self.name}: draws", self.draws)
        if self.edge is not None:
            require_not_negative(f"{self.name}: edge [m]", self.edge)
        if self.wall_gap is not None:
            require_not_negative(f"{self.name}: wall_gap [m]", self.wall_gap)
        if self.strength is not None:
            require_positive(f"{self.name}: strength, in weights", self.strength)
            if self.wall_gap is None:
                raise InputError(f"{self.name}: a strap goes to a wall; give the wall's gap")


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case of a library.

    Args:
        thing: what stands there.
        stand: the floor.
        held: the wall and the strap behind it.
        tilt: of the support [rad], on which it leans to its back.
        friction: least and largest, alike likely between them.
    """

    thing: LibraryThing
    stand: Stand
    held: Held
    tilt: float = 0.0
    friction: tuple[float, float] = (0.4, 0.6)

    def __post_init__(self) -> None:
        low, high = self.friction
        require_not_negative("tilt [rad]", self.tilt)
        require_positive("friction", low)
        if not low <= high:
            raise InputError(f"friction must be from the least to the largest, got {self.friction}")

    @property
    def is_held(self) -> bool:
        """Whether a wall, a strap or an edge is there."""
        return self.held.wall_gap is not None or self.held.edge is not None

    @property
    def name(self) -> str:
        """Letters, digits, dots and underscores, such as "bookcase.slender.ground.free"."""
        low, high = self.friction
        parts = [self.thing.kind, *self.thing.name[len(self.thing.kind) + 1 :].split(" ")]
        parts += [self.stand.name, self.held.name]
        parts += [f"tilt{degrees(self.tilt):g}"] if self.tilt else []
        parts += [f"mu{low:g}to{high:g}"]
        return ".".join(re.sub(r"[^A-Za-z0-9]+", "_", part) for part in parts)
