"""The friction of what stands on castors."""

from __future__ import annotations

from dataclasses import dataclass

from shaketable.errors import require_positive
from shaketable.solid import ROLLING_RESISTANCE


@dataclass(frozen=True, kw_only=True)
class CastorFriction:
    """Friction of what stands on castors, static and kinetic.

    Both are assumed; neither has a source.

    Raises:
        InputError: a value below zero or not finite.
    """

    free: float = ROLLING_RESISTANCE
    locked: float = 0.4

    def __post_init__(self) -> None:
        for name in ("free", "locked"):
            require_positive(f"friction of {name} castors", getattr(self, name))
