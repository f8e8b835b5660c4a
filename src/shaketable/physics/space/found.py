"""What a run tells: numbers of its end, and a history."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.physics.space.workspace import STATE, Floats, PerStrap, record_type

# How a run ends, and what says that it has not.
STANDING, OVERTURNED, STILL_MOVING, STILL_SLIDING = range(4)
NOT_YET = -1


class Found:
    """What is told of one run; `telling` writes it."""

    ending: int  # STANDING, OVERTURNED, STILL_MOVING or STILL_SLIDING
    time: float  # of the fall [s], NaN if there was none
    fall_azimuth: float  # of the body's axis then [rad], NaN if there was none
    peak: float  # nutation [rad]
    lift: float  # [m]
    yaw: float  # [rad]
    displacement_x: float  # of the foot of the centre of gravity [m]
    displacement_y: float
    impacts: int
    events: int
    steps: int
    energy_cuts: int
    fallbacks: int
    samples: int  # of its history
    lowest: int  # row of the lowest corner at the fall, -1 without
    beside: int  # row of the other corner of the side that it fell over, -1 for a corner alone
    shaken_x: float  # displacement and yaw at the motion's end, or at a fall before it [m, m, rad]
    shaken_y: float
    shaken_yaw: float
    farthest: float  # that the foot comes from where it stood [m]
    held_up: int  # 1 if it would fall without what holds it
    strap_force: PerStrap  # the largest of each strap, by the body's mass [m/s²]
    strap_broke_at: PerStrap  # [s], NaN if it did not
    off_edge: int  # 1 if it left its support over the edge
    left_at: float  # when it did [s], NaN if it did not
    landing_time: float  # when it came down from there [s], NaN if it did not: likewise all others
    landing_x: float  # where its centre of gravity is then [m]
    landing_y: float
    landing_speed: float  # [m/s]
    landing_rotation: float  # how far it is turned then [rad]
    slip: float  # of a body in the plane, that of its lowest corner at the end [m]
    slip_back: float  # and the farthest of corners on the support toward -x [m]
    slip_front: float  # and toward +x
    met: int  # 1 if it met a wall, the edge, or what holds it


#: The type of such a record.
FOUND = record_type(Found)
#: An array of them, one a run.
FoundRecords = NDArray[np.void]


def make_found(runs: int) -> FoundRecords:
    """Room for what so many runs tell."""
    return np.zeros(runs, FOUND)


def numbers_of(found: FoundRecords) -> Found:
    """What is told of the first run, in numbers of Python."""
    told = Found()
    for name, value in zip(FOUND.names or (), found[0].item(), strict=True):
        setattr(told, name, value)
    return told


class SolidTrace(NamedTuple):
    """Samples of a run, as many as fit."""

    state: Floats  # (n, STATE)
    rank: np.ndarray  # (n,) int8
    hold: np.ndarray  # (n,) int8
    impact_times: Floats  # s; as many as fit


def make_trace(samples: int, impacts: int = 0) -> SolidTrace:
    """An empty trace with room for so many samples and times of impacts."""
    rank, hold = np.zeros((2, samples), np.int8)
    return SolidTrace(np.full((samples, STATE), np.nan), rank, hold, np.full(impacts, np.nan))
