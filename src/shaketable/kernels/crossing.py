"""The general model across one interval of the motion, phase by phase.

`cross_phases` lays the course of the phase, finds the first guard that falls through zero
(`guards`), takes the body there, and lets the reset of that guard decide what follows (`resets`).
"""

from __future__ import annotations

from shaketable.kernels.codes import BOTH, NO_CONTACT, contact_of, side_sign, slip_of
from shaketable.kernels.compiled import routine
from shaketable.kernels.contact import Force, Pose, Stand, corner, force_of, on_corner
from shaketable.kernels.course import (
    ALONG,
    NORMAL,
    ROTATION,
    SPIN,
    TERMS,
    Course,
    lay,
    series,
    trusted,
)
from shaketable.kernels.events import EVENT_BUDGET, fall_at
from shaketable.kernels.guards import NO_GUARD, first_guard
from shaketable.kernels.resets import Shaking, after_guard, forcing
from shaketable.kernels.rocking import RIGHT_ANGLE, rest_of
from shaketable.kernels.tally import Log, Tally, leaning, peak_until, tallied, write_change
from shaketable.kernels.taylor import slope, value


@routine
def lay_trusted(course: Course, stand: Stand, pose: Pose, force: Force, h: float) -> float:
    """Lay the course over the part of the span over which it holds, which is returned."""
    lay(course, stand, pose, force, h)
    part = trusted(course, stand.h + stand.right + stand.left)
    if part < 1.0:
        power = 1.0
        for k in range(TERMS):
            course[:, k] *= power
            power *= part
        course[SPIN] *= part
    return part


@routine
def advanced(course: Course, stand: Stand, pose: Pose, u: float, h: float) -> Pose:
    """The pose at u, with what its contact implies."""
    contact = contact_of(pose.phase)
    along = series(course, ALONG)
    x, x_rate = value(along, u), slope(along, u) / h
    if contact == BOTH:
        return Pose(pose.phase, x, stand.h, 0.0, x_rate, 0.0, 0.0)
    rotation = value(series(course, ROTATION), u)
    spin = value(series(course, SPIN), u) / h
    if contact == NO_CONTACT:
        normal = series(course, NORMAL)
        return Pose(pose.phase, x, value(normal, u), rotation, x_rate, slope(normal, u) / h, spin)
    side = side_sign(contact)
    if slip_of(pose.phase) == 0.0:
        x_rate = -spin * corner(stand, side, rotation)[1]
    return on_corner(stand, Pose(pose.phase, x, 0.0, rotation, x_rate, 0.0, spin), side)


@routine
def cross_phases(
    pose: Pose,
    stand: Stand,
    shaking: Shaking,
    i: int,
    start: float,
    tally: Tally,
    log: Log,
    course: Course,
) -> tuple[Pose, Tally]:
    """Take a body through interval i of the motion, which begins at time `start`."""
    whole, h = forcing(shaking, i), shaking.time_step
    elapsed, deaf_to = 0.0, NO_GUARD
    impacts, changes, fallen_at, exhausted = tally.impacts, tally.changes, -1.0, False
    for _ in range(EVENT_BUDGET):
        left = 1.0 - elapsed
        force = force_of(stand, rest_of(whole, elapsed))
        part = lay_trusted(course, stand, pose, force, left * h)
        left *= part
        u, place = first_guard(course, pose.phase, deaf_to)
        peak = peak_until(course, pose, u, tally.peak)
        if peak >= RIGHT_ANGLE:
            peak, u, place = RIGHT_ANGLE, fall_at(leaning(course, pose)[1]), NO_GUARD
            fallen_at = elapsed + u * left
        after = advanced(course, stand, pose, u, left * h)
        tally = tallied(course, stand, after, u, peak, place != NO_GUARD, tally)
        if fallen_at >= 0.0:
            pose = after
            break
        elapsed += u * left
        pose = after
        if place != NO_GUARD:
            pose, impact = after_guard(
                course, stand, after, place, u, shaking, i, elapsed, tally.peak
            )
            if impact:
                if impacts < log.impact_times.size:
                    log.impact_times[impacts] = start + elapsed * h
                impacts += 1
            # where nothing else is admissible the phase goes on, and its guard is not asked again
            deaf_to = place if pose.phase == after.phase and not impact else NO_GUARD
            if pose.phase != after.phase:
                write_change(log, changes, start + elapsed * h, pose.phase, place)
                changes += 1
        if elapsed >= 1.0:
            break
    else:
        exhausted = True
    return pose, Tally(
        tally.peak,
        tally.lift,
        tally.farthest_down,
        tally.farthest_up,
        impacts,
        changes,
        fallen_at,
        exhausted,
    )
