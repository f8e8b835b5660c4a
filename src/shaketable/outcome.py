"""How a body ends."""

from __future__ import annotations

from enum import IntEnum


class Outcome(IntEnum):
    """How a body ends.

    Downhill is that of the support's tilt: toward -x where the tilt is not negative, toward +x
    where it is. On a level support DOWNHILL means -x and UPHILL +x.
    """

    STANDING = 0
    DOWNHILL = -1
    UPHILL = 1


def downhill_sign(tilt: float) -> int:
    """+1 where a direction toward +x is uphill, -1 on a tilt [rad] below zero."""
    return -1 if tilt < 0.0 else 1
