"""The engine's view of solids, of what surrounds them, and of their motions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from shaketable.footprint import nearest_side
from shaketable.motion import Motion
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from shaketable.physics.space.ground import GroundAcceleration
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
PADS_OF_A_CIRCLE = 4
FLUSH = 1e-9  # m: what is on the edge but for round-off stands on its whole base
OUTSIDE = 1.0 + 1e-9  # of a size: no point is farther out


class ContactLaws(Protocol):
    """What a contact model says of contacts; `General` does."""

    @property
    def static_friction(self) -> float: ...
    @property
    def sliding_friction(self) -> float: ...
    @property
    def normal_restitution(self) -> float: ...
    @property
    def restitution_factor(self) -> float: ...


def shapes_of(
    solid: Solid,
    model: ContactLaws,
    surroundings: Surroundings | None = None,
    *,
    planar_reach: float | None = None,
) -> tuple[SolidRecords, Workspaces]:
    """The solid's numbers as a record, and the workspace of a run of it.

    What is among walls or straps has a second record, without them.

    Args:
        solid, model, surroundings: what is simulated.
        planar_reach: of a planar body, for which this deep one stands, the distance of its farther
            corner from the foot of its centre of gravity [m]; None of a body in space.
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
    reach = planar_reach or radius or float(np.hypot(*contacts.T).max())
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
        planar=planar_reach is not None,
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
    from shaketable.physics.space.ground import GroundAcceleration

    acceleration = np.zeros((motion.horizontal.size, 3))
    acceleration[:, 0] = motion.horizontal
    if motion.transverse is not None:
        acceleration[:, 1] = motion.transverse
    if motion.vertical is not None:
        acceleration[:, 2] = motion.vertical
    return GroundAcceleration(acceleration, float(motion.time_step))
