"""What a body stands beside, and what holds it: the surroundings of a simulation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

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
            above it, in the body's frame; of a planar body (x, z).
        anchor: [m], in the support's frame, whose origin is that foot at the start; likewise.
        stiffness: k [N/m].
        slack: by how much it is longer than from point to anchor at the start [m].
        damping: c [N s/m].
        pretension: force at the start [N], for a strap without slack.
        strength: force at which it breaks for good [N].

    Raises:
        InputError: a point or an anchor that is not two or three finite numbers, both at one
            place, numbers out of range, slack and pretension at once, or a pretension that breaks
            it.
    """

    point: tuple[float, ...]
    anchor: tuple[float, ...]
    stiffness: float
    slack: float = 0.0
    damping: float = 0.0
    pretension: float = 0.0
    strength: float = math.inf

    def __post_init__(self) -> None:
        for name in ("point", "anchor"):
            object.__setattr__(self, name, _place(f"Strap.{name} [m]", getattr(self, name)))
        if len(self.point) != len(self.anchor):
            raise InputError(
                f"Strap.point and Strap.anchor must have as many numbers each, got {self.point} "
                f"and {self.anchor}"
            )
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

    @property
    def stretch_at_start(self) -> float:
        """By which its pretension has stretched it [m]."""
        return self.pretension / self.stiffness

    @property
    def excess(self) -> float:
        """How much longer it is than its way at the start [m], negative where that stretches it."""
        return self.slack - self.stretch_at_start

    def pulls(
        self, length: NDArray[np.float64], rate: NDArray[np.float64], start: float
    ) -> NDArray[np.float64]:
        """Its force [N] while it is whole, where it is so long [m] and grows so fast [m/s].

        Args:
            start: the distance from point to anchor at the start [m].
        """
        stretch = length - start - self.excess
        force = self.stiffness * stretch + self.damping * rate
        return np.where(stretch > 0.0, np.maximum(force, 0.0), 0.0)


def _place(name: str, value: object) -> tuple[float, ...]:
    """Two or three finite numbers.

    Raises:
        InputError: anything else.
    """
    try:
        place = tuple(float(number) for number in value)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        place = ()
    if len(place) not in (2, 3):
        raise InputError(
            f"{name} must be three numbers (x, y, z), or in the plane two (x, z), got "
            f"{value!r:.100}"
        )
    if not all(map(math.isfinite, place)):
        raise InputError(f"{name} must be finite, got {value!r:.100}")
    return place


@dataclass(frozen=True, kw_only=True)
class Edge:
    """The edge of a support, such as the front of a shelf, with or without a lip.

    Args:
        at: its distance from the foot of the centre of gravity at the start [m].
        azimuth: the side on which it is, from +x about the support's normal [rad]; in the plane 0
            (+x) or π (-x).
        lip: its height over the support [m].
        friction: μ of the body on the edge and on the lip.
        restitution: part of the speed of approach with which the body leaves them, 0 to 1.
        drop: from the support down to what lies below [m].

    Raises:
        InputError: numbers out of range.
    """

    at: float
    azimuth: float = 0.0
    lip: float = 0.0
    friction: float = 0.3
    restitution: float = 0.0
    drop: float = 0.75

    def __post_init__(self) -> None:
        require_number("Edge.azimuth [rad]", self.azimuth)
        if not math.isfinite(self.azimuth):
            raise InputError(f"Edge.azimuth [rad] must be finite, got {self.azimuth!r}")
        for name in ("at", "drop"):
            require_positive(f"Edge.{name} [m]", getattr(self, name))
        require_not_negative("Edge.lip [m]", self.lip)
        require_not_negative("Edge.friction", self.friction)
        require_number("Edge.restitution", self.restitution)
        if not 0.0 <= self.restitution <= 1.0:
            raise InputError(f"Edge.restitution must lie in [0, 1], got {self.restitution!r}")
        keep_floats(self, "at", "azimuth", "lip", "friction", "restitution", "drop")


@dataclass(frozen=True, kw_only=True)
class Pad:
    """Adhesive feet, such as museum wax, which hold until one is pulled off.

    The body needs a mass.

    Args:
        pull_off: force that pulls off one foot [N].

    Raises:
        InputError: a number out of range.
    """

    pull_off: float

    def __post_init__(self) -> None:
        require_positive("Pad.pull_off [N]", self.pull_off)
        keep_floats(self, "pull_off")


@dataclass(frozen=True, kw_only=True)
class Surroundings:
    """The walls beside a body, its straps, the edge of its support and its adhesive feet.

    Args:
        walls: at most 4.
        straps: at most 8.
        edge: where the support ends; nowhere by default.
        pad: what glues its feet down; nothing by default.

    Raises:
        InputError: anything else.
    """

    walls: tuple[Wall, ...] = ()
    straps: tuple[Strap, ...] = ()
    edge: Edge | None = None
    pad: Pad | None = None

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
        for name, one in (("edge", Edge), ("pad", Pad)):
            if not isinstance(getattr(self, name), one | None):
                raise InputError(
                    f"Surroundings.{name} must be {one.__name__}(...), got "
                    f"{getattr(self, name)!r:.100}"
                )

    def __bool__(self) -> bool:
        return bool(self.walls or self.straps or self.edge or self.pad)

    def turned(self, angle: float) -> Surroundings:
        """The same about the support's normal, from x toward y [rad], as a Solid is turned."""
        cosine, sine = math.cos(angle), math.sin(angle)

        def turn(place: tuple[float, ...]) -> tuple[float, ...]:
            x, y, *up = place
            return cosine * x - sine * y, sine * x + cosine * y, *up

        return replace(
            self,
            walls=tuple(replace(each, azimuth=each.azimuth + angle) for each in self.walls),
            straps=tuple(replace(each, anchor=turn(each.anchor)) for each in self.straps),
            edge=self.edge and replace(self.edge, azimuth=self.edge.azimuth + angle),
        )


def told_surroundings(around: Sequence[Surroundings | None]) -> str:
    """What surrounds bodies, as results keep it; empty where nothing does."""
    if not any(around):
        return ""
    alike = list(dict.fromkeys(around))
    return repr(alike[0] if len(alike) == 1 else alike)
