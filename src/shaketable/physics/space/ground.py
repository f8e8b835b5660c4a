"""The motion of the ground as a body force, seen from a support that may be tilted."""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel
from shaketable.physics.space.vectors import Vec, add, cross, dot, subtract, times
from shaketable.physics.space.workspace import Floats
from shaketable.units import STANDARD_GRAVITY


class GroundAcceleration(NamedTuple):
    """A motion in the level frame, at its samples."""

    acceleration: Floats  # (n, 3): along X, Y, Z [m/s²]
    time_step: float  # s


class RunSetup(NamedTuple):
    """How one run's body stands, and how the motion meets it."""

    tilt: float  # β [rad]
    azimuth: float  # γ [rad]
    orientation: float  # ψ0 [rad]
    scale: float
    polarity: float  # of both horizontal components


class Tilted(NamedTuple):
    """How the level frame is seen from the support."""

    axis: Vec  # about which it is tilted
    sine: float
    cosine: float


@kernel
def tilted(stand: RunSetup) -> Tilted:
    axis = Vec(-math.sin(stand.azimuth), math.cos(stand.azimuth), 0.0)
    return Tilted(axis, math.sin(stand.tilt), math.cos(stand.tilt))


@kernel
def seen(frame: Tilted, a: Vec) -> Vec:
    """A vector of the level frame in the support's: Rᵀ a (Rodrigues)."""
    along = times(dot(frame.axis, a) * (1.0 - frame.cosine), frame.axis)
    return add(subtract(times(frame.cosine, a), times(frame.sine, cross(frame.axis, a))), along)


@kernel
def force_at(ground: GroundAcceleration, i: int, stand: RunSetup, frame: Tilted) -> Vec:
    """f at a sample; gravity alone after the last one."""
    a = Vec(0.0, 0.0, -STANDARD_GRAVITY)
    if i < ground.acceleration.shape[0]:
        flat, given = stand.scale * stand.polarity, ground.acceleration
        a = Vec(
            -flat * given[i, 0], -flat * given[i, 1], -stand.scale * given[i, 2] - STANDARD_GRAVITY
        )
    return seen(frame, a)
