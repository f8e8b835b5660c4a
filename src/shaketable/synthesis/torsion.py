"""The motions at the edges of a building's floors that sway and twist.

A linear building of equal rigid floors, three degrees of freedom each: two displacements of the
centre of mass and a rotation θ about the vertical. The centre of stiffness lies off the centre of
mass by (e_x, e_y). Per floor, with k the lateral stiffness of a storey and ρ the radius of gyration
of the plan,

    K = k [[1, 0, -e_y], [0, 1, e_x], [-e_y, e_x, e_x² + e_y² + ρ² Ω²]] ,   M = m diag(1, 1, ρ²)

where Ω is the ratio of the torsional to the lateral frequency without eccentricity. Chopra (2017)
Dynamics of structures, 5th ed., section 9.6. All storeys are alike, so that the modes are products
of those of the shear building and those of one floor.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_number, require_positive
from shaketable.motion import Motion
from shaketable.synthesis.floors import RESTS, ShearBuilding

MOST_ECCENTRIC = 0.5  # of the plan: the centre of stiffness lies within it


@dataclass(frozen=True, kw_only=True)
class TorsionalBuilding:
    """A linear building whose floors sway and twist.

    Args:
        storeys: number of storeys.
        first_period: of sway without eccentricity [s].
        plan: lengths along x and y [m].
        eccentricity: of the centre of stiffness from the centre of mass, as shares of the plan's
            lengths, in [-0.5, 0.5].
        torsional_ratio: Ω, the torsional over the lateral frequency without eccentricity.
        damping: ratio of critical damping, of every mode.
        name: what to call it.

    Raises:
        InputError: values out of range.
    """

    storeys: int
    first_period: float
    plan: tuple[float, float]
    eccentricity: tuple[float, float] = (0.0, 0.0)
    torsional_ratio: float = 1.2
    damping: float = 0.05
    name: str = ""

    def __post_init__(self) -> None:
        self.sway()  # checks the storeys, the period and the damping
        for length in self.plan:
            require_positive("plan [m]", length)
        for share in self.eccentricity:
            require_number("eccentricity", share)
            if not abs(share) <= MOST_ECCENTRIC:
                raise InputError(f"eccentricity must lie within the plan, ±0.5, got {share!r}")
        require_positive("torsional_ratio", self.torsional_ratio)

    def sway(self) -> ShearBuilding:
        """The same building without eccentricity, in one direction."""
        return ShearBuilding(
            storeys=self.storeys,
            first_period=self.first_period,
            damping=self.damping,
            name=self.name,
        )

    def floor_modes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Squares of a floor's frequencies over that of sway, (3,), and shapes (dof, mode)."""
        from scipy.linalg import eigh

        a, b = self.plan
        e_x, e_y = self.eccentricity[0] * a, self.eccentricity[1] * b
        rho = math.sqrt((a * a + b * b) / 12.0)
        twist = e_x * e_x + e_y * e_y + (rho * self.torsional_ratio) ** 2
        stiffness = np.array([[1.0, 0.0, -e_y], [0.0, 1.0, e_x], [-e_y, e_x, twist]])
        return eigh(stiffness, np.diag([1.0, 1.0, rho * rho]))


@dataclass(frozen=True, kw_only=True, eq=False)
class EdgeMotion:
    """What a channel at the edge of a floor records.

    Attributes:
        floor: from 1.
        direction: "x" or "y".
        at: where across that direction, "-" or "+".
        motion: absolute acceleration.
    """

    floor: int
    direction: str
    at: str
    motion: Motion


def corner_motions(building: TorsionalBuilding, ground: Motion) -> list[Motion]:
    """The motion of every floor at the corner farthest from its centre of stiffness.

    Where that is the centre of mass the floors do not twist, and all corners move alike.

    Args:
        building: what stands on the ground.
        ground: both components of a recording, along x and y.

    Raises:
        InputError: no transverse component.
    """
    if ground.transverse is None:
        raise InputError(
            f"{ground.name}: floors that twist need both horizontal components of the ground, with "
            "known directions"
        )
    along, across = ground.components()
    e_x, e_y = building.eccentricity
    # motion along x depends on y, and the other way round
    at = {"x": "-" if e_y > 0.0 else "+", "y": "-" if e_x > 0.0 else "+"}
    edges = {
        (edge.floor, edge.direction): edge.motion
        for edge in edge_motions(building, along, across)
        if edge.at == at[edge.direction]
    }
    more = edges[1, "x"].horizontal.size - ground.horizontal.size
    vertical = None if ground.vertical is None else np.pad(ground.vertical, (0, more))
    motions = []
    for number in range(1, building.storeys + 1):
        x, y = edges[number, "x"], edges[number, "y"]
        said = f"floor {number} of {building.storeys} that twist, at the corner that moves most"
        floor = ground.after(
            said, horizontal=x.horizontal, vertical=vertical, transverse=y.horizontal
        )
        assert floor.origin is not None
        origin = replace(floor.origin, location=f"floor {number}")
        motions.append(replace(floor, name=f"{ground.name} floor {number}", origin=origin))
    return motions


def edge_motions(building: TorsionalBuilding, along: Motion, across: Motion) -> list[EdgeMotion]:
    """The absolute motion at both edges of every floor, in both directions.

    Args:
        building: what stands on the ground.
        along, across: the ground's two components, along x and y, of one recording.

    Raises:
        InputError: components with different time steps.
    """
    from shaketable.oscillators.peaks import history

    if along.time_step != across.time_step:
        raise InputError(
            f"{along.name} has the time step {along.time_step:g} s, {across.name} "
            f"{across.time_step:g} s; they must be one recording's"
        )
    h = along.time_step
    count = max(along.horizontal.size, across.horizontal.size)
    count += math.ceil(RESTS * building.first_period / h)
    ground = np.stack(
        [np.pad(m.horizontal, (0, count - m.horizontal.size)) for m in (along, across)]
    )
    periods, shares = building.sway().modes()
    squares, shapes = building.floor_modes()
    accelerations = np.zeros((building.storeys, 3, count))
    q, rate = np.empty((2, count))
    for i, period in enumerate(periods):
        for j, square in enumerate(squares):
            w = 2.0 * math.pi / period * math.sqrt(square)
            history(shapes[:2, j] @ ground, h, w, building.damping, q, rate)
            modal = -2.0 * building.damping * w * rate - w * w * q
            accelerations += shares[:, i, None, None] * (shapes[:, j, None] * modal)
    found = []
    for floor, (a_x, a_y, a_twist) in enumerate(accelerations, 1):
        for direction, sway, arm, source in (
            ("x", a_x, -building.plan[1] / 2.0, along),
            ("y", a_y, building.plan[0] / 2.0, across),
        ):
            for sign in (-1, 1):
                at = "+" if sign > 0 else "-"
                said = f"floor {floor}, {direction}, edge {at}, of a building that twists"
                motion = source.after(
                    said, horizontal=sway + sign * arm * a_twist, vertical=None, transverse=None
                )
                name = f"{source.name} floor {floor} {direction}{at}"
                found.append(
                    EdgeMotion(
                        floor=floor,
                        direction=direction,
                        at=at,
                        motion=replace(motion, name=name, vertical_origin=None),
                    )
                )
    return found
