"""The general model across one interval of the motion, phase by phase.

`cross_phases` writes the table of the phase, finds the first guard that falls through zero
(`guards`), takes the body there, and lets the reset of that guard decide what follows (`resets`).
"""

from __future__ import annotations

from shaketable.compiled import routine
from shaketable.physics.plane.codes import BOTH, NO_CONTACT, contact_of, side_sign, slip_of
from shaketable.physics.plane.contact import ContactBody, Force, Pose, corner, force_of, on_corner
from shaketable.physics.plane.events import EVENT_BUDGET, fall_at
from shaketable.physics.plane.extremes import (
    ContactPassage,
    Extremes,
    Log,
    leaning,
    peak_until,
    with_extremes,
    write_change,
)
from shaketable.physics.plane.forcing import Instant, Interval, Shaking, forcing_at, rest_of
from shaketable.physics.plane.guards import NO_GUARD, first_guard
from shaketable.physics.plane.phase_series import (
    ALONG,
    NORMAL,
    ROTATION,
    ROWS,
    SPIN,
    TERMS,
    SeriesTable,
    converged_part,
    expand,
    series,
)
from shaketable.physics.plane.resets import after_guard
from shaketable.physics.plane.rocking import RIGHT_ANGLE
from shaketable.physics.plane.taylor import slope, value


@routine
def expand_converged(
    table: SeriesTable, body: ContactBody, pose: Pose, force: Force, h: float
) -> float:
    """Write the table over the part of the span for which it has converged; return that part."""
    expand(table, body, pose, force, h)
    part = converged_part(table, body.h + body.right + body.left)
    if part < 1.0:
        power = 1.0
        for k in range(TERMS):
            for row in range(ROWS):
                table[row, k] *= power
            power *= part
        for k in range(TERMS):
            table[SPIN, k] *= part
    return part


@routine
def advanced(table: SeriesTable, body: ContactBody, pose: Pose, u: float, h: float) -> Pose:
    """The pose at u, with the coordinates and rates that its contact implies."""
    contact = contact_of(pose.phase)
    along = series(table, ALONG)
    x, x_rate = value(along, u), slope(along, u) / h
    if contact == BOTH:
        return Pose(pose.phase, x, body.h, 0.0, x_rate, 0.0, 0.0)
    rotation = value(series(table, ROTATION), u)
    spin = value(series(table, SPIN), u) / h
    if contact == NO_CONTACT:
        normal = series(table, NORMAL)
        return Pose(pose.phase, x, value(normal, u), rotation, x_rate, slope(normal, u) / h, spin)
    side = side_sign(contact)
    if slip_of(pose.phase) == 0.0:
        x_rate = -spin * corner(body, side, rotation)[1]
    return on_corner(body, Pose(pose.phase, x, 0.0, rotation, x_rate, 0.0, spin), side)


@routine
def cross_phases(
    passage: ContactPassage,
    body: ContactBody,
    shaking: Shaking,
    interval: Interval,
    log: Log,
    table: SeriesTable,
) -> ContactPassage:
    """Take a body through an interval of the motion.

    What happens is written to `log`; `table` is an array for the series of a phase.
    """
    pose, extremes = passage
    i, start, polarity = interval
    whole, h = forcing_at(shaking, i, polarity), shaking.time_step
    elapsed, deaf_to = 0.0, NO_GUARD
    impacts, changes, fallen_at, exhausted = extremes.impacts, extremes.changes, -1.0, False
    for _ in range(EVENT_BUDGET):
        left = 1.0 - elapsed
        force = force_of(body, rest_of(whole, elapsed))
        part = expand_converged(table, body, pose, force, left * h)
        left *= part
        u, place = first_guard(table, pose.phase, deaf_to)
        peak = peak_until(table, pose, u, extremes.peak)
        if peak >= RIGHT_ANGLE:
            peak, u, place = RIGHT_ANGLE, fall_at(leaning(table, pose)[1]), NO_GUARD
            fallen_at = elapsed + u * left
        after = advanced(table, body, pose, u, left * h)
        extremes = with_extremes(table, body, after, u, peak, place != NO_GUARD, extremes)
        if fallen_at >= 0.0:
            pose = after
            break
        elapsed += u * left
        pose = after
        if place != NO_GUARD:
            pose, impact = after_guard(
                table, body, after, place, u, shaking, Instant(i, elapsed, polarity), extremes.peak
            )
            if impact:
                if impacts < log.impact_times.size:
                    log.impact_times[impacts] = start + elapsed * h
                impacts += 1
            # where no other phase is admissible this one goes on, and its guard is then ignored
            deaf_to = place if pose.phase == after.phase and not impact else NO_GUARD
            if pose.phase != after.phase:
                write_change(log, changes, start + elapsed * h, pose.phase, place)
                changes += 1
        if elapsed >= 1.0:
            break
    else:
        exhausted = True
    extremes = Extremes(
        extremes.peak,
        extremes.lift,
        extremes.farthest_left,
        extremes.farthest_right,
        impacts,
        changes,
        fallen_at,
        exhausted,
    )
    return ContactPassage(pose, extremes)
