"""Whether solids can stand so: on their supports, and in their surroundings."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from shaketable.errors import InputError
from shaketable.models import General, Model, model_of
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.units import degrees

if TYPE_CHECKING:
    pass

MOST_CORNERS_AT_WALLS = 16  # of a base
OUTSIDE = 1.0 + 1e-9  # of a size: a strap's point that is farther out is outside the body


def model_for_solids(model: Model | str | None) -> General:
    """The model, or General() if none is given.

    Raises:
        InputError: the rocking model.
    """
    found = General() if model is None else model_of(model)
    if not isinstance(found, General):
        raise InputError(
            f"the {found.name} model knows one edge and one plane: a Solid needs General(...); "
            "without sliding, General() as it is"
        )
    return found


def upright(support: Support) -> tuple[float, float]:
    """Tilt >= 0 and azimuth of a support [rad]."""
    turned = support.azimuth + (math.pi if support.tilt < 0.0 else 0.0)
    return abs(support.tilt), turned


def require_standing(solid: Solid, support: Support, orientation: float) -> None:
    """InputError if a solid falls by itself on its support."""
    tilt, azimuth = upright(support)
    limit = standing_limit(solid, azimuth - orientation)
    if tilt >= limit:
        raise InputError(
            f"solid {solid.name or repr(solid)}: falls by itself on a support tilted by "
            f"{degrees(tilt):.4g}° toward {degrees(azimuth):.4g}°; in that direction it stands "
            f"below {degrees(limit):.4g}°"
        )


def standing_limit(solid: Solid, azimuth: float) -> float:
    """Tilt [rad] at which a solid falls by itself toward an azimuth of its own frame [rad]."""
    if solid.diameter is not None:
        return solid.least_slenderness
    corners = solid.corners
    sides = np.roll(corners, -1, axis=0) - corners
    length = np.hypot(*sides.T)
    out = np.column_stack([sides[:, 1], -sides[:, 0]]) / length[:, None]
    distance = (out * corners).sum(axis=1)
    toward = out @ np.array([math.cos(azimuth), math.sin(azimuth)])
    with np.errstate(divide="ignore"):
        reach = np.where(toward > 0.0, distance / np.maximum(toward, 1e-300), math.inf)
    return math.atan2(float(reach.min()), solid.cg_height)


def require_surrounded(solid: Solid, surroundings: Surroundings | None, orientation: float) -> None:
    """InputError if a solid cannot stand in its surroundings.

    Args:
        solid, surroundings: what is surrounded, and by what.
        orientation: of the solid on its support at the start [rad].
    """
    told = f"solid {solid.name or repr(solid)}"
    edge = surroundings.edge if surroundings else None
    if surroundings and surroundings.pad and solid.mass is None:
        raise InputError(f"{told}: a pull-off force in N needs a mass; give mass= [kg]")
    if edge:
        reach = solid.reach_toward(edge.azimuth - orientation)
        if not edge.at >= reach * (1.0 - 1e-12):
            raise InputError(
                f"{told}: its base reaches {reach:g} m from the foot of the centre of gravity, "
                f"beyond the edge of the support at {edge.at:g} m"
            )
    if edge and len(solid.corners) > MOST_CORNERS_AT_WALLS:
        raise InputError(_too_many_corners(told, "near an edge", solid))
    for k, wall in enumerate(surroundings.walls if surroundings else (), 1):
        told = f"solid {solid.name or repr(solid)}, wall {k}"
        if isinstance(wall.restitution, str):
            raise InputError(
                f'{told}: restitution="{wall.restitution}" belongs to one-sided rocking in the '
                "plane; give a number from 0 to 1"
            )
        if len(solid.corners) > MOST_CORNERS_AT_WALLS:
            raise InputError(_too_many_corners(told, "beside a wall", solid))
    for k, strap in enumerate(surroundings.straps if surroundings else (), 1):
        told = f"solid {solid.name or repr(solid)}, strap {k}"
        if solid.mass is None:
            raise InputError(f"{told}: a stiffness in N/m needs a mass; give mass= [kg]")
        if len(strap.point) != 3:
            raise InputError(
                f"{told}: a solid's point and its anchor are (x, y, z), got {strap.point}"
            )
        x, y, z = strap.point
        outside = not 0.0 <= z <= (solid.height or 0.0)
        if solid.diameter is not None:
            outside = outside or math.hypot(x, y) > OUTSIDE * solid.diameter / 2
        elif not solid.feet:
            corners = solid.corners
            sides = np.roll(corners, -1, axis=0) - corners
            off = sides[:, 0] * (y - corners[:, 1]) - sides[:, 1] * (x - corners[:, 0])
            reach = float(np.hypot(*corners.T).max())
            outside = outside or bool((off < (1.0 - OUTSIDE) * reach * np.hypot(*sides.T)).any())
        if outside:
            raise InputError(
                f"{told}: its point {strap.point} [m] lies outside the body, whose frame begins at "
                f"the foot of its centre of gravity and which is {solid.height:g} m high"
            )
        cosine, sine = math.cos(orientation), math.sin(orientation)
        start = np.array([cosine * x - sine * y, sine * x + cosine * y, z])
        length = float(np.linalg.norm(np.array(strap.anchor) - start))
        if not length > strap.stretch_at_start:
            raise InputError(
                f"{told}: from its point to its anchor are {length:g} m at the start, which must "
                f"be more than its stretch of {strap.stretch_at_start:g} m"
            )


def _too_many_corners(told: str, where: str, solid: Solid) -> str:
    return (
        f"{told}: a solid {where} has at most {MOST_CORNERS_AT_WALLS} corners, got "
        f"{len(solid.corners)}; Solid.cylinder rolls on its rim"
    )
