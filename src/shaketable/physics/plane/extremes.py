"""What a run of the general model is asked for: peaks, slip, lift, impacts and phases."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import BOTH, FLIGHT, NO_CONTACT, contact_of, side_sign
from shaketable.physics.plane.contact import ContactBody, Pose, corner
from shaketable.physics.plane.events import negated, peak_within
from shaketable.physics.plane.phase_series import GUARDS, ROTATION, SPIN, SeriesTable, series
from shaketable.physics.plane.taylor import NO_ROOT, Series, first_root, value


class Extremes(NamedTuple):
    """What has happened to a body so far."""

    peak: float  # rad, the largest |θ|
    lift: float  # m, the largest clearance under the whole base
    farthest_left: float  # m, the most that a corner in contact has moved toward -x, <= 0
    farthest_right: float
    impacts: int
    changes: int  # of phase
    fallen_at: float  # fraction of the interval at which |θ| reached π/2, or -1
    exhausted: bool  # whether the event budget was used up


class ContactPassage(NamedTuple):
    """What became of a body in an interval."""

    pose: Pose
    extremes: Extremes


class Log(NamedTuple):
    """Where impacts and changes of phase are written, as many as fit."""

    impact_times: NDArray[np.float64]
    change_times: NDArray[np.float64]
    phases: NDArray[np.int8]
    guards: NDArray[np.int8]  # guard that ended the phase before, by its place in phases.TABLE


@kernel
def slipped(body: ContactBody, pose: Pose) -> float:
    """How far the lowest corner has moved along the support [m]."""
    contact = contact_of(pose.phase)
    side = side_sign(contact)
    if side == 0.0:
        side = 1.0 if pose.rotation >= 0.0 else -1.0
    return (
        pose.x
        + corner(body, side, pose.rotation)[0]
        - side * (body.right if side > 0.0 else body.left)
    )


@routine
def clearance(table: SeriesTable, until: float) -> float:
    """The largest height of the lower corner on [0, until].

    It is reached at the end, at a turn, or where both corners are level.
    """
    top = 0.0
    for place in range(2):
        gap = series(table, GUARDS + place)
        other = series(table, GUARDS + 1 - place)
        rise = Series(
            gap.c1, 2 * gap.c2, 3 * gap.c3, 4 * gap.c4, 5 * gap.c5,
            6 * gap.c6, 7 * gap.c7, 8 * gap.c8, 9 * gap.c9, 0.0,
        )  # fmt: skip
        turn = first_root(rise, 0.0) if rise.c0 > 0.0 else NO_ROOT
        turned = series(table, ROTATION)
        level = first_root(turned if place == 0 else negated(turned), 0.0)
        for u in (turn, level, until):
            if u <= until:
                top = max(top, min(value(gap, u), value(other, u)))
    return top


@kernel
def leaning(table: SeriesTable, pose: Pose) -> tuple[Series, Series]:
    """Rate and angle of the rotation, seen from the side that the body turns to or leans to."""
    turn, angle = series(table, SPIN), series(table, ROTATION)
    side = side_sign(contact_of(pose.phase))
    if side < 0.0 or (side == 0.0 and pose.spin < 0.0):
        return negated(turn), negated(angle)
    return turn, angle


@routine
def peak_until(table: SeriesTable, pose: Pose, until: float, peak: float) -> float:
    """The larger of `peak` and the largest |θ| on [0, until] of the phase that begins in `pose`."""
    contact = contact_of(pose.phase)
    if contact == BOTH:
        return peak
    turn, angle = leaning(table, pose)
    if contact == NO_CONTACT:  # it turns steadily
        return max(peak, value(angle, until))
    return peak_within(turn, angle, until, peak)


@routine
def with_extremes(
    table: SeriesTable,
    body: ContactBody,
    after: Pose,
    until: float,
    peak: float,
    lands: bool,
    extremes: Extremes,
) -> Extremes:
    """The extremes with those of a phase's motion on [0, until], which ends in the pose `after`."""
    lift, left, right = extremes.lift, extremes.farthest_left, extremes.farthest_right
    if after.phase == FLIGHT:
        lift = max(lift, clearance(table, until))
    if after.phase != FLIGHT or lands:
        place = slipped(body, after)
        left, right = min(left, place), max(right, place)
    return Extremes(
        peak, lift, left, right, extremes.impacts, extremes.changes, -1.0, extremes.exhausted
    )


@kernel
def write_change(log: Log, change: int, time: float, phase: int, guard: int) -> None:
    if change < log.phases.size:
        log.change_times[change] = time
        log.phases[change] = phase
        log.guards[change] = guard


@kernel
def one_change_more(extremes: Extremes) -> Extremes:
    return Extremes(
        extremes.peak,
        extremes.lift,
        extremes.farthest_left,
        extremes.farthest_right,
        extremes.impacts,
        extremes.changes + 1,
        extremes.fallen_at,
        extremes.exhausted,
    )
