"""A planar body among its surroundings across one interval of its motion, event by event."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.dormand_prince import next_part
from shaketable.physics.surrounded.creep import FELL, GOES_ON, LANDED, creep
from shaketable.physics.surrounded.events import accept, respond
from shaketable.physics.surrounded.guards import FALL, LANDING, NO_GUARD, dips, least_guard
from shaketable.physics.surrounded.modes import Force, choose, force_at, mode_size, rates, rests
from shaketable.physics.surrounded.scene import (
    A_STICK,
    B_STICK,
    EVENTS,
    PASSED,
    PAST,
    PEAK,
    STATE,
    STEPS,
    STICK,
    Floats,
    Scene,
    Workspace,
)
from shaketable.physics.surrounded.step import LEAST_PART, find_event, take_step
from shaketable.physics.surrounded.straps import note_rest, pull_or_not

BUDGET = 100  # events in an interval, after which the rest of it is stepped over
NEVER = 2.0
SHORT_DIP = 1e-5  # s: a contact that closes for less is not looked for


@routine
def rest_until(scene: Scene, work: Workspace, force: Force, u: float) -> float:
    """The u at which the forces of a mode of rest leave their cones, or NEVER.

    They are linear in the body force, as straps pull alike all the while.
    """
    count, past, until = mode_size(work), work.tally[PAST], NEVER
    f_x, f_y = force_at(force, u)
    rates(scene, work, work.state, f_x, f_y, work.stages[1])
    for j in range(3):
        work.stages[2, j] = work.reaction[j]
    f_x, f_y = force_at(force, 1.0)
    rates(scene, work, work.state, f_x, f_y, work.stages[1])
    at = 0
    for e in range(count):
        a, b = work.touch[e, A_STICK], work.touch[e, B_STICK]
        until = min(until, falls_at(work.stages[2, at], work.reaction[at], past, u))
        if work.mode[1 + e, 1] == STICK:
            for side in (1.0, -1.0):
                before = a * work.stages[2, at] - side * b * work.stages[2, at + 1]
                after = a * work.reaction[at] - side * b * work.reaction[at + 1]
                until = min(until, falls_at(before, after, past, u))
            at += 1
        at += 1
    return until


@kernel
def falls_at(before: float, after: float, past: float, u: float) -> float:
    """Where a number that is linear between u and 1 falls below -past."""
    if not after < -past:
        return NEVER
    if before <= -past:
        return u
    return u + (1.0 - u) * (before + past) / (before - after)


@routine
def cross_interval(
    scene: Scene, work: Workspace, force: Force, h: float, first: float, impact_times: Floats
) -> tuple[int, float]:
    """Take a body through an interval of h [s]; how it ends, and the part its last step took.

    Args:
        first: part of the interval that its first step tries.
        impact_times: where those of impacts are written [s], as many as fit.
    """
    u, part, fresh, events = 0.0, first, True, 0
    tally = work.tally
    tally[PASSED] = 0.0
    while u < 1.0:
        if events > BUDGET:
            return creep(scene, work, force, h, u, impact_times), first
        if rests(work):
            pull_or_not(scene, work)
            note_rest(scene, work)
            u = rest_until(scene, work, force, u)
            if u >= 1.0:
                return GOES_ON, 1.0
            tally[PASSED] = u * h
            f_x, f_y = force_at(force, u)
            choose(scene, work, f_x, f_y, True)
            events += 1
            tally[EVENTS] += 1.0
            fresh, part = True, 1.0
            continue
        if fresh:
            f_x, f_y = force_at(force, u)
            rates(scene, work, work.state, f_x, f_y, work.stages[0])
            fresh = False
        du = max(min(part, 1.0 - u), LEAST_PART)
        error = take_step(scene, work, force, h, u, du)
        tally[STEPS] += 1.0
        if error > 1.0 and du > LEAST_PART:
            part = next_part(du, error)
            continue
        if error == math.inf:
            return creep(scene, work, force, h, u, impact_times), first
        guard = least_guard(scene, work, work.trial, NO_GUARD)
        if guard.least < 0.0:
            du, kind = find_event(scene, work, force, h, u, du, guard)
            accept(scene, work, du * h)
            u += du
            tally[PASSED] = u * h
            if kind == FALL:
                tally[PEAK] = 0.5 * math.pi
                return FELL, part
            if kind == LANDING:
                return LANDED, part
            f_x, f_y = force_at(force, min(u, 1.0))
            respond(scene, work, f_x, f_y, kind, impact_times)
            events += 1
            tally[EVENTS] += 1.0
            fresh, part = True, max(part, 1e-3)
            continue
        if du * h > SHORT_DIP and dips(scene, work, du * h):
            part = 0.5 * du
            continue
        accept(scene, work, du * h)
        part = max(part if du < part else 0.0, next_part(du, error))
        u = 1.0 if 1.0 - u - du < LEAST_PART else u + du
        tally[PASSED] = u * h
        for j in range(STATE):
            work.stages[0, j] = work.stages[6, j]
    return GOES_ON, part
