"""The profile of floor accelerations of ASCE 7-22, section 13.3.1: a quick building.

    H_f = 1 + a1 (z/h) + a2 (z/h)^10,  a1 = 1/T_a <= 2.5,  a2 = 1 - (0.4/T_a)^2 >= 0   (13.3-4)
    H_f = 1 + 2.5 (z/h)                           where T_a is not known               (13.3-5)
    R_mu = sqrt(1.1 R/(I_e Omega_0)) >= 1.3                                            (13.3-6)

A floor is shaken H_f/R_mu times as strongly as the ground; at or below grade both are 1. R_mu is
what the ductility of a structure takes off at its design earthquake: in weaker ones it takes off
less, so that here no floor is shaken less than the ground. The profile tells peaks alone: here the
ground's motion is scaled by it, so that floors shake no longer and no slower than the ground does,
which things that overturn would feel.

ASCE/SEI 7-22 (2022) Minimum design loads and associated criteria for buildings and other
structures, section 13.3.1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, require_positive, require_whole
from shaketable.motion import Motion
from shaketable.synthesis.floors import MOST_STOREYS

STEEPEST = 2.5  # a1 at most; H_f at the roof less 1 where the period is not known
LEAST_DUCTILITY = 1.3  # R_mu above grade


@dataclass(frozen=True, kw_only=True)
class FloorProfile:
    """A building known by its number of storeys and little more.

    Args:
        storeys: number of storeys, of equal height.
        period: approximate fundamental period T_a [s], None if it is not known.
        response_modification: R of the structure, None if it is not known; R_mu is then 1.3.
        overstrength: Omega_0, to be given with R.
        importance: I_e.
        name: what to call it.

    Raises:
        InputError: values out of range, or one of R and Omega_0 without the other.
    """

    storeys: int
    period: float | None = None
    response_modification: float | None = None
    overstrength: float | None = None
    importance: float = 1.0
    name: str = ""

    def __post_init__(self) -> None:
        require_whole("storeys", self.storeys)
        if self.storeys > MOST_STOREYS:
            raise InputError(
                f"at most {MOST_STOREYS} storeys are computed, got {self.storeys!r:.20}"
            )
        for name in ("period", "response_modification", "overstrength", "importance"):
            value = getattr(self, name)
            if value is not None:
                require_positive(name, value)
        if (self.response_modification is None) != (self.overstrength is None):
            raise InputError(
                "response_modification (R) and overstrength (Omega_0) are given together, or "
                "neither is"
            )

    @property
    def ductility_reduction(self) -> float:
        """R_mu of the floors above grade."""
        if self.response_modification is None or self.overstrength is None:
            return LEAST_DUCTILITY
        reduction = 1.1 * self.response_modification / (self.importance * self.overstrength)
        return max(math.sqrt(reduction), LEAST_DUCTILITY)

    def amplification(self) -> NDArray[np.float64]:
        """H_f of the floors from the ground to the roof, (storeys + 1,)."""
        z = np.linspace(0.0, 1.0, self.storeys + 1)
        if self.period is None:
            return np.asarray(1.0 + STEEPEST * z)
        a1 = min(1.0 / self.period, STEEPEST)
        a2 = max(1.0 - (0.4 / self.period) ** 2, 0.0)
        return np.asarray(1.0 + a1 * z + a2 * z**10)

    def factors(self) -> NDArray[np.float64]:
        """How many times as strongly as the ground each floor is shaken, (storeys + 1,)."""
        return np.asarray(np.maximum(self.amplification() / self.ductility_reduction, 1.0))


def profile_motions(profile: FloorProfile, ground: Motion) -> list[Motion]:
    """The motion of every floor, from the first above the ground to the roof.

    The horizontal components are those of the ground times the profile's factor; the vertical one
    is the ground's.
    """
    motions = []
    for number, factor in enumerate(profile.factors()[1:], 1):
        said = f"floor {number} of {profile.storeys}: {factor:.3g} times the ground, ASCE 7-22"
        across = None if ground.transverse is None else ground.transverse * factor
        along, above = ground.horizontal * factor, ground.vertical
        floor = ground.after(said, horizontal=along, vertical=above, transverse=across)
        assert floor.origin is not None
        origin = replace(floor.origin, location=f"floor {number}")
        motions.append(replace(floor, name=f"{ground.name} floor {number}", origin=origin))
    return motions
