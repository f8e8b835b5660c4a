"""The support: what the body stands on."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shaketable.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Support:
    """A rigid plane that may be tilted, with friction and restitution (physics.md section 1).

    Args:
        tilt: β [rad] in [0, π/2); the support rises toward +x, so that -x is downhill.
        static_friction: μ_s; infinite by default. Used by the general model.
        kinetic_friction: μ_k <= μ_s; μ_s if not given. Used by the general model.
        restitution: normal restitution e_n in [0, 1). Used by the general model.
        rocking_restitution: η in (0, 1), the share of the angular velocity kept at an impact;
            by default that of a plastic impact without slip (B eq. 34). Used by the rocking model.

    Raises:
        InputError: a value outside its range.
    """

    tilt: float = 0.0
    static_friction: float = math.inf
    kinetic_friction: float | None = None
    restitution: float = 0.0
    rocking_restitution: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 <= self.tilt < math.pi / 2:
            raise InputError(
                f"Support.tilt [rad] must lie in [0, π/2), got {self.tilt!r}; a support that "
                "rises toward -x is the mirrored body on one that rises toward +x"
            )
        if not self.static_friction >= 0.0:
            raise InputError(
                "Support.static_friction must not be negative (infinite: no slip), "
                f"got {self.static_friction!r}"
            )
        kinetic = self.kinetic_friction
        if kinetic is not None and not 0.0 <= kinetic <= self.static_friction:
            raise InputError(
                "Support.kinetic_friction must lie between 0 and static_friction = "
                f"{self.static_friction!r}, got {kinetic!r}"
            )
        if not 0.0 <= self.restitution < 1.0:
            raise InputError(f"Support.restitution must lie in [0, 1), got {self.restitution!r}")
        kept = self.rocking_restitution
        if kept is not None and not 0.0 < kept < 1.0:
            raise InputError(f"Support.rocking_restitution must lie in (0, 1), got {kept!r}")

    @property
    def sliding_friction(self) -> float:
        """μ_k, which is μ_s where it is not given."""
        return self.static_friction if self.kinetic_friction is None else self.kinetic_friction
