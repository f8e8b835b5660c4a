"""Straps that are tried on an object: how often it still falls, and what they bear."""

from __future__ import annotations

import math
from dataclasses import replace

from shaketable.solid import Solid
from shaketable.spelled_surroundings import AWAY, BodyStrap
from shaketable.surroundings import Pad, Surroundings

STIFFNESSES = (500.0, 2000.0)  # per mass [1/s²]: 50 and 200 kN/m for 100 kg
SLACKS = (0.005, 0.020)  # m
DAMPING = 1.0  # per mass [1/s]: 1 to 2 % of critical, so that what swings comes to rest
STRAP_SHARE = 0.9  # of the simulations ask for no larger force


def asks_for_trial(around: Surroundings | None) -> bool:
    """Whether straps are to be tried: where it has none, or some that may break."""
    straps = around.straps if around else ()
    return not straps or any(math.isfinite(each.strength) for each in straps)


def in_strap(
    solid: Solid, around: Surroundings | None, stiffness: float, slack: float, height: float
) -> tuple[Solid, Surroundings]:
    """A solid, as if of 1 kg, in one strap that does not break, beside the walls that it has.

    The strap goes from the middle of its side at a height, on the side of its first wall or at its
    back, straight to that wall or, where there is none, to a point as far away as the command line
    takes it.

    Args:
        solid: of any mass; pads need one.
        around: what surrounds it now; its own straps are left out.
        stiffness: per mass [1/s²].
        slack: [m].
        height: [m].
    """
    walls = around.walls if around else ()
    side = walls[0].azimuth if walls else 0.0
    behind = walls[0].gap or AWAY if walls else AWAY
    numbers = {"slack": slack, "stiffness": stiffness, "damping": DAMPING}
    strap = BodyStrap(numbers, height).on(solid, side=side, behind=behind)
    pad = around.pad if around else None
    if pad is not None and solid.mass is not None:
        pad = Pad(pull_off=pad.pull_off / solid.mass)
    held = replace(around or Surroundings(), straps=(strap,), pad=pad)
    return replace(solid, mass=1.0), held
