"""The support: what the body stands on."""

from __future__ import annotations

import math
from dataclasses import dataclass

from shaketable.errors import InputError, keep_floats, require_number

IN_PLANE = 1e-9  # sine of an azimuth that counts as 0 or π


@dataclass(frozen=True, kw_only=True)
class Support:
    """A rigid plane that may be tilted (theory, section 1).

    Friction and restitution belong to the pair of body and floor: they are the model's.

    Args:
        tilt: β [rad] in (-π/2, π/2). A negative one is the same tilt toward the opposite azimuth.
        azimuth: where downhill is, from +x toward +y [rad]. π, the default, is -x: a positive
            tilt then rises toward +x. A body in the plane can only stand on azimuths 0 and π.

    Raises:
        InputError: a tilt outside its range, or an azimuth that is not finite.
    """

    tilt: float = 0.0
    azimuth: float = math.pi

    def __post_init__(self) -> None:
        require_number("Support.tilt [rad]", self.tilt)
        if not -math.pi / 2 < self.tilt < math.pi / 2:
            raise InputError(f"Support.tilt [rad] must lie in (-π/2, π/2), got {self.tilt!r}")
        require_number("Support.azimuth [rad]", self.azimuth)
        if not math.isfinite(self.azimuth):
            raise InputError(f"Support.azimuth [rad] must be finite, got {self.azimuth!r}")
        keep_floats(self, "tilt", "azimuth")

    def in_plane(self) -> Support:
        """The same support as a body in the vertical plane of x sees it: azimuth π, any tilt.

        Raises:
            InputError: a tilted support whose azimuth is neither 0 nor π.
        """
        along, across = math.cos(self.azimuth), math.sin(self.azimuth)
        if self.tilt != 0.0 and abs(across) > IN_PLANE:
            raise InputError(
                "a planar body moves in the vertical plane of x: its support can fall toward "
                f"azimuth 0 or π, got {self.azimuth!r}; a Solid stands on any"
            )
        return Support(tilt=-self.tilt if along > 0.0 else self.tilt)
