"""Planar bodies that stand against a wall and rock away from it alone."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models.model import Model, Table
from shaketable.surroundings import SEQUENTIAL, Surroundings, Wall

ALONG = 1e-9  # rad: azimuths this near to 0 or π are in the plane
NEVER = 1e-300  # cosine of a side that a body cannot rock on: no acceleration tips it there
HOMOGENEOUS = 1e-6  # of i²: how near to a rectangle's it must be


def require_one_sided(body: Body, around: Surroundings, tilt: float) -> None:
    """InputError unless the rocking model takes such surroundings: one wall without a gap."""
    name = body.name or repr(body)
    if around.straps or around.edge or around.pad or len(around.walls) != 1:
        raise InputError(
            f"{name}: in the rocking model a planar body has one wall and nothing else beside it; "
            "the general model, General(...), takes walls, straps, an edge and pads"
        )
    wall = around.walls[0]
    side_of(wall.azimuth, "wall")
    if wall.gap > 0.0:
        raise InputError(
            f"{name}: in the rocking model a body stands against its wall, without a gap, got "
            f"{wall.gap!r} m: one that strikes a wall lifts from its corner; the general model, "
            "General(...), knows it"
        )
    if wall.vertical and tilt != 0.0:
        raise InputError(
            f"{name}: a wall that is vertical does not stand against a body on a tilted support: "
            "give Wall(vertical=False), the back of a shelf that is tilted as a whole"
        )


def side_of(azimuth: float, what: str) -> float:
    """+1 for a wall or an edge toward +x, -1 for one toward -x.

    Raises:
        InputError: an azimuth [rad] out of the plane.
    """
    if abs(math.sin(azimuth)) > ALONG:
        raise InputError(
            f"a planar body's {what} is toward +x or -x, azimuth 0 or π, got {azimuth!r} rad"
        )
    return 1.0 if math.cos(azimuth) > 0.0 else -1.0


def stand_at_walls(
    table: Table, bodies: Sequence[Body], surroundings: Sequence[Surroundings | None], model: Model
) -> Table:
    """The rocking model's table with the sides that walls leave.

    Args:
        table: its rows, changed where they stand.
        bodies, surroundings: of each row.
        model: the contact model.
    """
    if not any(surroundings):
        return table
    from shaketable.physics.plane.layout import struct_view
    from shaketable.physics.plane.rocking import Block

    block = struct_view(table.blocks, Block)
    for row, (body, around) in enumerate(zip(bodies, surroundings, strict=True)):
        if around:
            wall = around.walls[0]
            away, toward = ("left", "right")[:: int(side_of(wall.azimuth, "wall"))]
            block[away]["onward"][row] = 1.0
            block[away]["velocity_ratio"][row] = restitution_of(wall, body, model)
            block[toward]["k"][row] = 0.0
            block[toward]["sine"][row], block[toward]["cosine"][row] = 1.0, NEVER
    return table


def restitution_of(wall: Wall, body: Body, model: Model) -> float:
    """Part of its angular velocity that an impact against the wall leaves a body that rocks.

    The rule by name takes the impacts of the base, of the back's top and of its bottom one after
    another, each plastic: (1 - 3/2 sin² α)² (3/2 cos² α - 1) of a homogeneous rectangle whose
    diagonal makes α with its side (Hogan 1992; for façades Sorrentino et al. 2008). A body's own
    restitution factor, or the model's, multiplies that, not a number.

    Raises:
        InputError: the rule for another body.
    """
    if wall.restitution is not None and wall.restitution != SEQUENTIAL:
        return float(wall.restitution)
    half, h = body.base / 2.0, body.cg_height
    homogeneous = (half**2 + h**2) / 3.0
    if abs(body.left - half) > 1e-9 * body.base or (
        abs(body.gyration_radius**2 - homogeneous) > HOMOGENEOUS * homogeneous
    ):
        raise InputError(
            f'{body.name or "the body"}: Wall.restitution="{SEQUENTIAL}", the default in the '
            "rocking model, is a homogeneous rectangle's; give a number from 0 to 1"
        )
    alpha = math.atan2(half, h)
    left = (1.0 - 1.5 * math.sin(alpha) ** 2) ** 2 * (1.5 * math.cos(alpha) ** 2 - 1.0)
    own = body.restitution_factor
    return max(0.0, left * (model.restitution_factor if own is None else own))
