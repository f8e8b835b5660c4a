"""What a body stands beside, and what holds it: the surroundings of a simulation."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shaketable.errors import (
    InputError,
    keep_floats,
    require_not_negative,
    require_number,
    require_positive,
)

MOST_STRAPS = 8


@dataclass(frozen=True, kw_only=True)
class Strap:
    """A strap, a chain or a tether from a point of the body to an anchor.

    It pulls with F = k δ + c δ̇ where it is stretched by δ > 0, and never pushes. The body needs a
    mass.

    Args:
        point: of the body [m]: (x, y, z) from the foot of the centre of gravity along the base and
            above it, in the body's frame.
        anchor: [m], in the support's frame, whose origin is that foot at the start.
        stiffness: k [N/m].
        slack: by how much it is longer than from point to anchor at the start [m].
        damping: c [N s/m].
        pretension: force at the start [N], for a strap without slack.
        strength: force at which it breaks for good [N].

    Raises:
        InputError: a point or an anchor that is not three finite numbers, both at one place,
            numbers out of range, slack and pretension at once, or a pretension that breaks it.
    """

    point: tuple[float, float, float]
    anchor: tuple[float, float, float]
    stiffness: float
    slack: float = 0.0
    damping: float = 0.0
    pretension: float = 0.0
    strength: float = math.inf

    def __post_init__(self) -> None:
        for name in ("point", "anchor"):
            object.__setattr__(self, name, _place(f"Strap.{name} [m]", getattr(self, name)))
        require_positive("Strap.stiffness [N/m]", self.stiffness)
        require_not_negative("Strap.slack [m]", self.slack)
        require_not_negative("Strap.damping [N s/m]", self.damping)
        require_not_negative("Strap.pretension [N]", self.pretension)
        require_number("Strap.strength [N]", self.strength)
        if not self.strength > self.pretension:
            raise InputError(
                f"Strap.strength [N] must be above 0 and above the pretension of "
                f"{self.pretension!r}, got {self.strength!r}"
            )
        if self.slack > 0.0 and self.pretension > 0.0:
            raise InputError("a Strap has slack or pretension, not both")
        keep_floats(self, "stiffness", "slack", "damping", "pretension", "strength")


def _place(name: str, value: object) -> tuple[float, float, float]:
    """Three finite numbers.

    Raises:
        InputError: anything else.
    """
    try:
        x, y, z = (float(number) for number in value)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be three numbers (x, y, z), got {value!r:.100}") from None
    if not all(map(math.isfinite, (x, y, z))):
        raise InputError(f"{name} must be finite, got {value!r:.100}")
    return x, y, z


@dataclass(frozen=True, kw_only=True)
class Surroundings:
    """What holds a body on its support.

    Args:
        straps: at most 8.

    Raises:
        InputError: anything else.
    """

    straps: tuple[Strap, ...] = ()

    def __post_init__(self) -> None:
        straps = tuple(self.straps) if isinstance(self.straps, (tuple, list)) else (self.straps,)
        if not all(isinstance(strap, Strap) for strap in straps):
            raise InputError(f"Surroundings.straps must be Straps, got {self.straps!r:.100}")
        if len(straps) > MOST_STRAPS:
            raise InputError(f"a body has at most {MOST_STRAPS} straps, got {len(straps)}")
        object.__setattr__(self, "straps", straps)

    def __bool__(self) -> bool:
        return bool(self.straps)
