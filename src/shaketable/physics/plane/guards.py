"""Which guard of a phase fires first, and when.

A guard fires once it is below -GUARD_SLACK, so that a quantity that starts at zero needs no care.
Heights have no such slack wherever the start of a phase can be told apart from a contact: a slack
would feed the smallest bounces.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.plane.codes import FLIGHT, GUARD_COUNT, is_landing
from shaketable.physics.plane.events import NO_LIFT, contact_at
from shaketable.physics.plane.phase_series import GUARDS, SeriesTable, series
from shaketable.physics.plane.taylor import NO_ROOT, Series, first_root, lowest

GUARD_SLACK = 1e-12  # in each guard's unit: m, m/s, m/s², rad
BOUNCED = 1e-12  # m per interval: a faster corner took off with a speed, not under a force
NO_GUARD = -1


@kernel
def raised(q: Series, by: float) -> Series:
    return Series(q.c0 + by, q.c1, q.c2, q.c3, q.c4, q.c5, q.c6, q.c7, q.c8, q.c9)


@routine
def fires_at(guard: Series, phase: int, place: int) -> float:
    """The u at which a guard fires, or NO_ROOT."""
    slack = raised(guard, GUARD_SLACK)
    if lowest(slack) > 0.0:
        return NO_ROOT
    if phase == FLIGHT and guard.c0 > GUARD_SLACK:
        return first_root(guard, 0.0)
    bounced = phase == FLIGHT and guard.c0 == 0.0 and guard.c1 > BOUNCED
    if bounced or (phase != FLIGHT and is_landing(phase, place)):
        u = contact_at(guard, False)
        return 0.0 if u == NO_LIFT else u
    return first_root(slack, 0.0)


@routine
def first_guard(table: SeriesTable, phase: int, deaf_to: int) -> tuple[float, int]:
    """(u, place) of the first guard to fire, ignoring the one at `deaf_to`, or (1, NO_GUARD)."""
    first, which = NO_ROOT, NO_GUARD
    for place in range(GUARD_COUNT[phase]):
        if place == deaf_to:
            continue
        u = fires_at(series(table, GUARDS + place), phase, place)
        if u < first:
            first, which = u, place
    return (first, which) if which != NO_GUARD else (1.0, NO_GUARD)
