"""The motion of a building's floors, from that of its ground.

A linear shear building: floors of mass m_i on storeys of stiffness k_i, one direction, no torsion.
Its modes are found once; each is an oscillator under the ground's acceleration, solved exactly for
accelerations linear between samples. A floor's absolute acceleration is

    a_i = a_g + Σ_n φ_in Γ_n q̈_n = -Σ_n φ_in Γ_n (2 ζ_n w_n q̇_n + w_n² q_n) ,   Σ_n φ_in Γ_n = 1

Chopra (2017) Dynamics of structures, 5th ed., sections 13.2 and 13.6.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.body import require_positive
from shaketable.errors import InputError
from shaketable.motion import Motion


@dataclass(frozen=True, kw_only=True, eq=False)
class ShearBuilding:
    """A linear shear building.

    Args:
        storeys: how many.
        first_period: [s]; stiffness is scaled to it.
        damping: ratio of critical damping, of every mode.
        masses: of the floors from the first to the roof, relative; equal by default.
        stiffnesses: of the storeys from the lowest to the highest, relative; equal by default.
        name: what to call it.

    Raises:
        InputError: values out of range, or as many masses or stiffnesses as there are not storeys.
    """

    storeys: int
    first_period: float
    damping: float = 0.05
    masses: Sequence[float] | None = None
    stiffnesses: Sequence[float] | None = None
    name: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.storeys, bool) or not isinstance(self.storeys, int) or self.storeys < 1:
            raise InputError(f"storeys must be a positive whole number, got {self.storeys!r}")
        require_positive("first_period [s]", self.first_period)
        if not 0.0 <= self.damping < 1.0:
            raise InputError(f"damping must be in [0, 1), got {self.damping!r}")
        for what in ("masses", "stiffnesses"):
            given = getattr(self, what)
            values = np.ones(self.storeys) if given is None else np.array(given, dtype=np.float64)
            if values.shape != (self.storeys,) or not ((values > 0.0) & np.isfinite(values)).all():
                raise InputError(
                    f"{what} must be {self.storeys} positive numbers, one a storey; got {given!r}"
                )
            object.__setattr__(self, what, tuple(float(value) for value in values))

    def matrices(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Mass and stiffness, shape (storeys, storeys), scaled to the first period."""
        from scipy.linalg import eigh

        m, k = np.diag(np.array(self.masses)), np.array(self.stiffnesses)
        above = np.append(k[1:], 0.0)
        stiffness = np.diag(k + above) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
        first = eigh(stiffness, m, eigvals_only=True, subset_by_index=[0, 0])[0]
        return m, stiffness * ((2.0 * math.pi / self.first_period) ** 2 / first)

    def modes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Periods [s], shape (storeys,), falling, and shares φ_in Γ_n, shape (floors, modes)."""
        from scipy.linalg import eigh

        m, k = self.matrices()
        squares, shapes = eigh(k, m)
        return 2.0 * math.pi / np.sqrt(squares), shapes * (shapes.T @ m).sum(axis=1)


def floor_motions(building: ShearBuilding, ground: Motion) -> list[Motion]:
    """The absolute motion of every floor, from the first above the ground to the roof.

    The horizontal component goes through the building; the vertical one is the ground's, as that
    of a building whose columns are stiff. After its last sample the ground is taken to rest for
    ten first periods or until the building's waves are below 1 % of the ground's peak, so that no
    floor is cut off in full swing.

    Args:
        building: the shear building.
        ground: motion of its ground.
    """
    from shaketable.engine.oscillators import history

    periods, shares = building.modes()
    h = ground.time_step
    extra = _ring_down(building) if building.damping > 0.0 else 10.0 * building.first_period
    more = math.ceil(extra / h)
    a_g = np.pad(ground.horizontal, (0, more))
    vertical = None if ground.vertical is None else np.pad(ground.vertical, (0, more))
    modal = np.empty((periods.size, a_g.size))
    for n, period in enumerate(periods):
        w = 2.0 * math.pi / period
        q, q_rate = np.empty((2, a_g.size))
        history(a_g, h, w, building.damping, q, q_rate)
        modal[n] = -2.0 * building.damping * w * q_rate - w * w * q
    floors = shares @ modal
    motions = []
    for number, horizontal in enumerate(floors, 1):
        said = (
            f"floor {number} of {building.storeys}: linear shear building, first period "
            f"{building.first_period:g} s, damping {building.damping:g}"
        )
        motions.append(
            replace(
                ground,
                horizontal=horizontal,
                vertical=vertical,
                name=f"{ground.name} floor {number}",
                origin=ground.origin
                and replace(ground.origin.after(said), location=f"floor {number}"),
            )
        )
    return motions


def _ring_down(building: ShearBuilding) -> float:
    """Until the first mode has decayed to 1 %, at most ten of its periods [s]."""
    decay = math.log(100.0) * building.first_period / (2.0 * math.pi * building.damping)
    return min(decay, 10.0 * building.first_period)
