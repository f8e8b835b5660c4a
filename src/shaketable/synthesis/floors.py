"""The motions of a building's floors, from the motion of its ground.

A linear shear building has floors of mass m_i on storeys of stiffness k_i, in one direction and
without torsion. Its modes are found once; each is an oscillator under the ground's acceleration,
solved exactly for accelerations linear between samples. A floor's absolute acceleration is

    a_i = a_g + Σ_n φ_in Γ_n q̈_n = -Σ_n φ_in Γ_n (2 ζ_n w_n q̇_n + w_n² q_n) ,   Σ_n φ_in Γ_n = 1

Chopra (2017) Dynamics of structures, 5th ed., sections 13.2 and 13.6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_damping, require_positive, require_whole
from shaketable.motion import Motion

MOST_STOREYS = 300  # the tallest building has 163
PERIODS = (1e-4, 60.0)  # s
RESTS = 10.0  # first periods, for which the ground is at rest after its motion


@dataclass(frozen=True, kw_only=True, eq=False)
class ShearBuilding:
    """A linear shear building.

    Args:
        storeys: number of storeys.
        first_period: [s]; stiffness is scaled to it.
        damping: ratio of critical damping, of every mode.
        masses: of the floors from the first to the roof, relative; equal by default.
        stiffnesses: of the storeys from the lowest to the highest, relative; equal by default.
        name: what to call it.

    Raises:
        InputError: values out of range, or not one mass and one stiffness per storey.
    """

    storeys: int
    first_period: float
    damping: float = 0.05
    masses: Sequence[float] | None = None
    stiffnesses: Sequence[float] | None = None
    name: str = ""

    def __post_init__(self) -> None:
        require_whole("storeys", self.storeys)
        require_positive("first_period [s]", self.first_period)
        if self.storeys > MOST_STOREYS:
            raise InputError(
                f"at most {MOST_STOREYS} storeys are computed, got {self.storeys!r:.20}"
            )
        if not PERIODS[0] <= self.first_period <= PERIODS[1]:
            raise InputError(
                f"first_period [s] must lie between {PERIODS[0]:g} and {PERIODS[1]:g}, got "
                f"{self.first_period:g}"
            )
        require_damping(self.damping)
        for what in ("masses", "stiffnesses"):
            given = getattr(self, what)
            values = np.ones(self.storeys) if given is None else np.array(given, dtype=np.float64)
            if values.shape != (self.storeys,) or not ((values > 0.0) & np.isfinite(values)).all():
                raise InputError(
                    f"{what} must be {self.storeys} positive numbers, one per storey; got {given!r}"
                )
            object.__setattr__(self, what, tuple(float(value) for value in values))

    def modes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Periods [s], shape (storeys,), descending, and shares φ_in Γ_n, shape (floors, modes)."""
        from scipy.linalg import eigh

        m, k = np.diag(np.array(self.masses)), np.array(self.stiffnesses)
        stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
        squares, shapes = eigh(stiffness, m)
        periods = self.first_period * np.sqrt(squares[0] / squares)
        return periods, shapes * (shapes.T @ m).sum(axis=1)


def floor_motions(
    building: ShearBuilding, ground: Motion, *, across: ShearBuilding | None = None
) -> list[Motion]:
    """The absolute motion of every floor, from the first above the ground to the roof.

    Each horizontal component goes through the building in its own direction; the vertical one is
    the ground's, as in a building with stiff columns. The ground is at rest for another ten first
    periods, so that no floor's motion is cut off in full swing.

    Args:
        building: the shear building.
        ground: motion of its ground.
        across: the same building in the direction of the transverse component; alike by default.

    Raises:
        InputError: a building of other storeys across.
    """
    other = across or building
    if other.storeys != building.storeys:
        raise InputError(f"{building.storeys} storeys along x and {other.storeys} across it")
    longest = max(building.first_period, other.first_period)
    more = math.ceil(RESTS * longest / ground.time_step)
    vertical = None if ground.vertical is None else np.pad(ground.vertical, (0, more))
    along = _through(building, np.pad(ground.horizontal, (0, more)), ground.time_step)
    sideways: Sequence[NDArray[np.float64] | None] = [None] * building.storeys
    if ground.transverse is not None:
        sideways = list(_through(other, np.pad(ground.transverse, (0, more)), ground.time_step))
    motions = []
    for number, (horizontal, transverse) in enumerate(zip(along, sideways, strict=True), 1):
        periods = f"first period {building.first_period:g} s"
        if other.first_period != building.first_period:
            periods += f" ({other.first_period:g} s across)"
        said = (
            f"floor {number} of {building.storeys}: linear shear building, {periods}, damping "
            f"{building.damping:g}"
        )
        floor = ground.after(said, horizontal=horizontal, vertical=vertical, transverse=transverse)
        assert floor.origin is not None
        origin = replace(floor.origin, location=f"floor {number}")
        motions.append(replace(floor, name=f"{ground.name} floor {number}", origin=origin))
    return motions


def _through(building: ShearBuilding, a_g: NDArray[np.float64], h: float) -> NDArray[np.float64]:
    """The absolute accelerations of the floors under one component of the ground, (floor, n)."""
    from shaketable.oscillators.peaks import history

    periods, shares = building.modes()
    modal = np.empty((periods.size, a_g.size))
    for n, period in enumerate(periods):
        w = 2.0 * math.pi / period
        q, q_rate = np.empty((2, a_g.size))
        history(a_g, h, w, building.damping, q, q_rate)
        modal[n] = -2.0 * building.damping * w * q_rate - w * w * q
    return np.asarray(shares @ modal)
