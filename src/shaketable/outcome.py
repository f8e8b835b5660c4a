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


def side_names(tilt: float) -> tuple[str, str]:
    """What the sides of DOWNHILL and UPHILL are called on a tilt [rad].

    On a level support nothing is downhill: there they are left, -x, and right, +x.
    """
    return ("left (-x)", "right (+x)") if tilt == 0.0 else ("downhill", "uphill")


def outcome_name(outcome: Outcome, tilt: float) -> str:
    """ "standing", or the side to which the body overturned on a tilt [rad]."""
    downhill, uphill = side_names(tilt)
    return {Outcome.STANDING: "standing", Outcome.DOWNHILL: downhill, Outcome.UPHILL: uphill}[
        outcome
    ]


def downhill_sign(tilt: float) -> int:
    """+1 where a direction toward +x is uphill, -1 on a tilt [rad] below zero."""
    return -1 if tilt < 0.0 else 1
