"""The bodies that a command is given: an inventory, or one object by its sizes."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.cli.options import Eccentricity, warn_of_sizes
from shaketable.errors import InputError, named

if TYPE_CHECKING:
    from shaketable.body import Body

log = logging.getLogger(__name__)

MOST_NAMED = 10

InventoryOfBodies = Annotated[
    Path | None,
    typer.Option("--inventory", help="Table of objects, as for assess; each in both directions."),
]
OneBaseM = Annotated[
    float | None,
    typer.Option("--base-m", help="Base [m] of one object, with --height-m."),
]
OneHeightM = Annotated[float | None, typer.Option("--height-m", help="Its full height [m].")]


@dataclass(frozen=True)
class BodyOptions:
    """The objects of an inventory, or one by its sizes."""

    inventory: InventoryOfBodies = None
    base_m: OneBaseM = None
    height_m: OneHeightM = None
    eccentricity: Eccentricity = 0.5

    def bodies(self) -> list[Body]:
        """Those of an inventory in both directions, or the one."""
        return bodies_from(self.inventory, self.base_m, self.height_m, self.eccentricity)


def bodies_from(
    inventory: Path | None, base: float | None, height: float | None, eccentricity: float
) -> list[Body]:
    """Those of an inventory, or one of the sizes given [m]."""
    from shaketable.body import Body
    from shaketable.inventory import both_directions, read_inventory

    if (inventory is None) == (base is None and height is None):
        raise InputError("give --inventory, or --base-m and --height-m of one object")
    if inventory is not None and eccentricity != 0.5:
        raise InputError("--eccentricity: of one object; a list has a column of it")
    if inventory is None:
        if base is None or height is None:
            raise InputError("--base-m and --height-m: give both of them")
        warn_of_sizes({"--base-m": base, "--height-m": height})
        name = f"{base:g} × {height:g} m"
        return [Body.rectangle(base, height, eccentricity=eccentricity, name=name)]
    items = [
        (number, item) for number, item in enumerate(read_inventory(inventory), 1) if item.loose
    ]
    rolling = sum(item.rolls for _, item in items)
    if rolling:
        log.warning("%d objects on castors are taken as if they did not roll", rolling)
    held = [item.name for _, item in items if item.surroundings]
    if held:
        log.warning(
            "walls, straps, pads and edges of the list are not simulated here: %s stand alone",
            named(held, MOST_NAMED),
        )
    if not items:
        raise InputError(f"{inventory}: every object is anchored or hangs")
    return both_directions(items)
