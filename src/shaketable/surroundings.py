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

MOST_STRAPS, MOST_WALLS = 8, 4
#: A wall's restitution after Hogan (1992): see `Wall`.
SEQUENTIAL = "sequential"


@dataclass(frozen=True, kw_only=True)
class Wall:
    """A wall beside the body, which moves with its support.

    Args:
        azimuth: it stands toward this side of the body, from +x about the support's normal [rad];
            in the plane 0 (+x) or π (-x).
        gap: from the nearest point of the body at the start, normal to the wall [m].
        vertical: whether it is vertical where the support is tilted; otherwise it is normal to the
            support, as the back of a shelf that is tilted as a whole.
        friction: μ of the body on it.
        restitution: part of the speed of approach with which the body leaves it, 0 to 1, or
            "sequential": what three plastic impacts one after another leave of a rotation in
            one-sided rocking (Hogan 1992). [None: "sequential" in the rocking model, else 0]

    Raises:
        InputError: numbers out of range.
    """

    azimuth: float = 0.0
    gap: float = 0.0
    vertical: bool = True
    friction: float = 0.3
    restitution: float | str | None = None

    def __post_init__(self) -> None:
        require_number("Wall.azimuth [rad]", self.azimuth)
        if not math.isfinite(self.azimuth):
            raise InputError(f"Wall.azimuth [rad] must be finite, got {self.azimuth!r}")
        require_not_negative("Wall.gap [m]", self.gap)
        require_not_negative("Wall.friction", self.friction)
        e = self.restitution
        if e is not None and e != SEQUENTIAL:
            require_number("Wall.restitution", e)
            if not 0.0 <= float(e) <= 1.0:
                raise InputError(
                    f'Wall.restitution must lie in [0, 1] or be "{SEQUENTIAL}", got {e!r}'
                )
            object.__setattr__(self, "restitution", float(e))
        object.__setattr__(self, "vertical", bool(self.vertical))
        keep_floats(self, "azimuth", "gap", "friction")


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
    """What stands beside a body, and what holds it on its support.

    Args:
        walls: at most 4.
        straps: at most 8.

    Raises:
        InputError: anything else.
    """

    walls: tuple[Wall, ...] = ()
    straps: tuple[Strap, ...] = ()

    def __post_init__(self) -> None:
        for name, kind, most in (("walls", Wall, MOST_WALLS), ("straps", Strap, MOST_STRAPS)):
            given = getattr(self, name)
            things = tuple(given) if isinstance(given, (tuple, list)) else (given,)
            if not all(isinstance(thing, kind) for thing in things):
                raise InputError(
                    f"Surroundings.{name} must be {kind.__name__}s, got {given!r:.100}"
                )
            if len(things) > most:
                raise InputError(f"a body has at most {most} {name}, got {len(things)}")
            object.__setattr__(self, name, things)

    def __bool__(self) -> bool:
        return bool(self.walls or self.straps)
