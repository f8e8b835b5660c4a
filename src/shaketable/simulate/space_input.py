"""The engine's view of solids and their motions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.footprint import nearest_side
from shaketable.models import General, Model, model_of
from shaketable.motion import Motion
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.units import STANDARD_GRAVITY, degrees

if TYPE_CHECKING:
    from shaketable.physics.space.run import GroundAcceleration
    from shaketable.physics.space.workspace import SolidRecords, Thresholds, Workspaces

# Choices of the engine. Shares over ensembles do not depend on them: `benchmarks.solid_choices`.
TOLERANCE = 1e-9  # of a step, see `SolidParameters.tolerance`
RING = 16  # points that stand for a circle that lies flat
# Of `Thresholds`: speeds in parts of √(g R) and lengths in parts of R, R the distance of the
# farthest point from the foot of the centre of gravity.
BOUNCE, SETTLE = 5e-5, 5e-5
#: Of √(g R) (s/R)², s the shortest side: some such speed a corner has that is left where a polygon
#: just rolls over the next one, as its centre rises by some s²/R.
LEAVING = 3e-5
TURNING, SLOW, SLIPPING = 5e-4, 5e-5, 6e-7
LANDING, HOVERING = 3e-9, 3e-6
STARTING = 1e-9  # m/s²
MOST_CORNERS_AT_WALLS = 16  # of a base
PADS_OF_A_CIRCLE = 4
FLUSH = 1e-9  # m: what is on the edge but for round-off stands on its whole base
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


def shapes_of(
    solid: Solid, model: General, surroundings: Surroundings | None = None
) -> tuple[SolidRecords, Workspaces]:
    """The solid's numbers as a record, and the workspace of a run of it.

    What is among walls or straps has a second record, without them.
    """
    from shaketable.physics.space.vectors import Sym
    from shaketable.physics.space.workspace import (
        SolidParameters,
        make_records,
        make_workspaces,
    )

    static, kinetic = model.static_friction, model.sliding_friction
    contacts, hull, radius = solid.contacts, len(solid.corners), (solid.diameter or 0.0) / 2
    if solid.round:
        angles = 2 * math.pi * np.arange(RING) / RING
        contacts, hull = radius * np.column_stack([np.cos(angles), np.sin(angles)]), RING
    reach = radius or float(np.hypot(*contacts.T).max())
    if solid.inner_ring > 0.0:
        contacts = np.concatenate([contacts, solid.inner_ring * contacts[:hull]])
    sides = np.roll(contacts[:hull], -1, axis=0) - contacts[:hull]
    inscribed = solid.inscribed
    side = 2 * radius  # a circle rolls without corners
    if not solid.round:
        side = float(np.hypot(*sides.T).min())
        inscribed = nearest_side(contacts[:hull])
    if solid.rise > 0.0:  # from a high point to where a rim touches that leans by a radian
        side = min(side, math.sqrt(2 * solid.rise * radius))
    workspaces = make_workspaces()
    points = workspaces["points"][0]
    points["x"][: len(contacts)], points["y"][: len(contacts)] = contacts.T
    points["static"], points["kinetic"] = static, kinetic
    for k, castor in enumerate(solid.castors):
        if castor:
            points["static"][k] = points["kinetic"][k] = solid.rolling_resistance
    frictions = points["static"][: len(contacts)]
    inverse = np.asarray(np.linalg.inv(solid.inertia), np.float64)
    shape = SolidParameters(
        h=solid.cg_height,
        radius=radius,
        hull=hull,
        contacts=len(contacts),
        inertia=Sym(*_six(solid.inertia)),
        mobility=Sym(*_six(inverse)),
        restitution=model.normal_restitution,
        factor=model.restitution_factor,
        limits=_thresholds(reach, side),
        tolerance=TOLERANCE,
        rolling=solid.rolling_friction,
        contour=solid.contour_friction,
        drilling=solid.drilling_friction,
        inscribed=inscribed,
        reach=reach,
        least_static=float(frictions.min()),
        inner=solid.inner_ring,
        uniform=bool((frictions == frictions[0]).all()),
        rise=solid.rise,
        straps=_write_straps(solid, surroundings, workspaces),
        walls=_write_walls(surroundings, workspaces),
        outline=_write_outline(solid, surroundings, workspaces),
        size=_size_of(solid, reach),
        **_write_edge(surroundings, workspaces),
        **_pads_of(solid, surroundings),
    )
    alone = shape._replace(straps=0, walls=0, glue=0.0)
    held = shape.straps + shape.walls > 0
    return make_records(shape, alone) if held else make_records(shape), workspaces


def _write_straps(solid: Solid, surroundings: Surroundings | None, workspaces: Workspaces) -> int:
    """Write the straps of a solid into its workspace; returns how many there are."""
    straps = surroundings.straps if surroundings else ()
    mass = solid.mass or math.nan
    for k, strap in enumerate(straps):
        row = workspaces["straps"][0, k]
        x, y, z = strap.point
        row["arm"], row["anchor"] = (x, y, z - solid.cg_height), strap.anchor
        row["stiffness"], row["damping"] = strap.stiffness / mass, strap.damping / mass
        row["slack"] = strap.excess
        row["strength"] = strap.strength / mass
    return len(straps)


def _write_walls(surroundings: Surroundings | None, workspaces: Workspaces) -> int:
    """Write the walls beside a solid into its workspace; returns how many there are."""
    walls = surroundings.walls if surroundings else ()
    for k, wall in enumerate(walls, 1):
        row = workspaces["planes"][0, k]
        row["toward"], row["free_gap"], row["vertical"] = wall.azimuth, wall.gap, wall.vertical
        row["friction"], row["restitution"] = wall.friction, wall.restitution or 0.0
    return len(walls)


def _size_of(solid: Solid, reach: float) -> float:
    """No point of a solid is farther from its centre of gravity than this [m]."""
    over = (solid.height or 0.0) - solid.cg_height
    return OUTSIDE * math.hypot(reach, max(solid.cg_height, over))


def _write_edge(surroundings: Surroundings | None, workspaces: Workspaces) -> dict[str, float]:
    """Write what the edge of a support is like into a workspace; returns where it is."""
    edge = surroundings.edge if surroundings else None
    if edge:
        walls = len(surroundings.walls) if surroundings else 0
        for row in workspaces["planes"][0, walls + 1 : walls + 3]:  # the lip's face and the line
            row["friction"], row["restitution"] = edge.friction, edge.restitution
    return {
        "edge_x": math.cos(edge.azimuth) if edge else 0.0,
        "edge_y": math.sin(edge.azimuth) if edge else 0.0,
        "edge_at": edge.at + FLUSH if edge else math.inf,
        "lip": edge.lip if edge else 0.0,
        "drop": edge.drop if edge else 0.0,
    }


def _pads_of(solid: Solid, surroundings: Surroundings | None) -> dict[str, float]:
    """The numbers of glued feet: corners of a polygon, feet, high points, or four of a circle."""
    pad = surroundings.pad if surroundings else None
    if pad is None:
        return {"glue": 0.0, "glue_x": 0.0, "glue_y": 0.0}
    feet = solid.contacts if solid.feet or solid.rise > 0.0 else solid.corners
    count, middle = len(feet), feet.mean(axis=0) if len(feet) else np.zeros(2)
    if solid.round and not solid.rise > 0.0:
        count, middle = PADS_OF_A_CIRCLE, np.zeros(2)
    glue = count * pad.pull_off / (solid.mass or math.nan)
    return {"glue": glue, "glue_x": float(middle[0]), "glue_y": float(middle[1])}


def _write_outline(solid: Solid, surroundings: Surroundings | None, workspaces: Workspaces) -> int:
    """Write the points that walls and an edge may touch; returns how many there are.

    They are the lower and the upper corners over the base or the hull of the feet, or the centres
    of the lower and the upper rim.
    """
    if not (surroundings and (surroundings.walls or surroundings.edge)):
        return 0
    low, high = solid.rise - solid.cg_height, (solid.height or 0.0) - solid.cg_height
    at = np.zeros((1, 2)) if solid.diameter is not None else solid.corners
    rows = [np.column_stack([at, np.full(len(at), z)]) for z in (low, high)]
    outline = np.concatenate(rows)
    workspaces["outline"][0, : len(outline)] = outline
    return len(outline)


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


def _thresholds(reach: float, side: float) -> Thresholds:
    """Those of a solid whose farthest point and shortest side are so long [m]."""
    from shaketable.physics.space.workspace import Thresholds

    speed = math.sqrt(STANDARD_GRAVITY * reach)
    return Thresholds(
        bounce=BOUNCE * speed,
        settle=SETTLE * speed,
        leaving=LEAVING * speed * (side / reach) ** 2,
        turning=TURNING * speed,
        slow=SLOW * speed,
        slipping=SLIPPING * speed,
        landing=LANDING * reach,
        hovering=HOVERING * reach,
        starting=STARTING,
    )


def _six(tensor: NDArray[np.float64]) -> tuple[float, ...]:
    rows, columns = (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)
    return tuple(float(tensor[i, j]) for i, j in zip(rows, columns, strict=True))


def ground_of(motion: Motion) -> GroundAcceleration:
    """A motion's components side by side."""
    from shaketable.physics.space.run import GroundAcceleration

    acceleration = np.zeros((motion.horizontal.size, 3))
    acceleration[:, 0] = motion.horizontal
    if motion.transverse is not None:
        acceleration[:, 1] = motion.transverse
    if motion.vertical is not None:
        acceleration[:, 2] = motion.vertical
    return GroundAcceleration(acceleration, float(motion.time_step))
