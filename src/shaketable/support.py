"""The support: what the body stands on."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shaketable.errors import InputError, require_number


@dataclass(frozen=True, kw_only=True)
class Support:
    """A rigid plane that may be tilted (theory, section 1).

    Friction and restitution belong to the pair of body and floor: they are the model's.

    Args:
        tilt: β [rad] in (-π/2, π/2). A positive one rises toward +x, so that -x is downhill; a
            negative one rises toward -x.

    Raises:
        InputError: a tilt outside its range.
    """

    tilt: float = 0.0

    def __post_init__(self) -> None:
        require_number("Support.tilt [rad]", self.tilt)
        if not -math.pi / 2 < self.tilt < math.pi / 2:
            raise InputError(f"Support.tilt [rad] must lie in (-π/2, π/2), got {self.tilt!r}")
