"""Reactions of any contact as a few unknowns, and the constraints that they keep.

Unknown are the pressures, as N_c = Σ_j φ_j(c) z_j with as many φ as a rigid base leaves free (one
at a point, two along a line, three on a plane: of all shares with the same resultant the one of
least ΣN²), and what holds a contact from slipping: two forces at one point, with a torque about
the normal where two points or more stick. Each unknown is a wrench (a column: force in the
support's frame, torque in the body's), each constraint a row that gives the velocity or the
acceleration that has to vanish. Friction of points that slip is part of the pressures' columns.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import arm, drift, slip_direction, velocity
from shaketable.physics.space.linear import solve
from shaketable.physics.space.losses import resistance
from shaketable.physics.space.vectors import (
    Axes,
    Vec,
    add,
    applied,
    cross,
    dot,
    times,
)
from shaketable.physics.space.workspace import (
    CORNER,
    FLAT,
    PIVOTS,
    SLIPS,
    STICKS,
    Floats,
    SolidParameters,
    W,
    Workspace,
    vec,
)

EXHAUSTIVE_POINTS = 8  # points of which any three are tried; solids on feet have no more
ROUND_OFF = 1e-9  # of the pressure: a pull that is less is none
LINE = 1e-12  # of the spread of points: less of it across a line is none


class Three(NamedTuple):
    """Three of the closed touches: which of the closed they are."""

    a: int
    b: int
    c: int


@kernel
def free_turning(shape: SolidParameters, work: Workspace, spin: Vec) -> Vec:
    """ω̇ of a body without a contact, under the torque of its straps (Euler's equations)."""
    torque = times(-1.0, cross(spin, applied(shape.inertia, spin)))
    if shape.straps > 0:
        torque = add(torque, vec(work.torque, 0))
    return applied(shape.mobility, torque)


@kernel
def add_to(numbers: Floats, row: int, s: float, force: Vec, torque: Vec) -> None:
    numbers[row, 0] += s * force.x
    numbers[row, 1] += s * force.y
    numbers[row, 2] += s * force.z
    numbers[row, 3] += s * torque.x
    numbers[row, 4] += s * torque.y
    numbers[row, 5] += s * torque.z


@routine
def pressure(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, place: int, resists: Vec
) -> tuple[Vec, Vec]:
    """Force and torque of a unit of pressure at a touch, with the friction that it brings.

    Args:
        resists: the torque against rolling and drilling (`resistance`).
    """
    hold, touch = work.mode.grip, work.touches[place]
    point = touch.point
    r = arm(shape, work, point)
    force, torque = Vec(0.0, 0.0, 1.0), add(cross(r, q.z), resists)
    if hold != STICKS and not (hold == PIVOTS and place == work.mode.pivot):
        x, z = slip_direction(shape, work, place, velocity(shape, work, q, y, point))
        mu = touch.kinetic
        force = Vec(-mu * x, -mu * z, 1.0)
        torque = add(torque, cross(r, add(times(-mu * x, q.x), times(-mu * z, q.y))))
    return force, torque


@routine
def assemble(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> int:
    """Write rows and columns of the present mode; return how many there are."""
    rank, hold, n = work.mode.kind, work.mode.grip, work.mode.closed
    rows, columns = work.rows, work.columns
    resists = resistance(shape, q, vec(y, W))
    for i in range(6):
        for j in range(6):
            rows[i, j] = 0.0
            columns[i, j] = 0.0
    up = Vec(0.0, 0.0, 1.0)
    for c in range(n):
        touch = work.touches[work.closed[c]]
        torque = cross(arm(shape, work, touch.point), q.z)
        force, pull = pressure(shape, work, q, y, work.closed[c], resists)
        for j in range(rank):
            phi = touch.basis[j]
            add_to(rows, j, phi, up, torque)
            if touch.active:
                add_to(columns, j, phi, force, pull)
    k = rank
    if hold != SLIPS:
        place = work.mode.pivot if hold == PIVOTS else work.closed[0]
        r = arm(shape, work, work.touches[place].point)
        east, north = Vec(1.0, 0.0, 0.0), Vec(0.0, 1.0, 0.0)
        for matrix in (rows, columns):
            add_to(matrix, k, 1.0, east, cross(r, q.x))
            add_to(matrix, k + 1, 1.0, north, cross(r, q.y))
        k += 2
        if hold == STICKS and rank > CORNER:
            for matrix in (rows, columns):
                add_to(matrix, k, 1.0, Vec(0.0, 0.0, 0.0), q.z)
            k += 1
    return int(k)


@routine
def fill(shape: SolidParameters, work: Workspace, k: int) -> None:
    """Write the system's matrix: what each column changes in each row."""
    for j in range(k):
        turn = applied(shape.mobility, vec(work.columns[j], 3))
        for i in range(k):
            row = work.rows[i]
            work.system[i, j] = (
                row[0] * work.columns[j, 0]
                + row[1] * work.columns[j, 1]
                + row[2] * work.columns[j, 2]
                + dot(vec(row, 3), turn)
            )


@kernel
def measured(row: Floats, linear: Vec, angular: Vec) -> float:
    """What a row says of a velocity or an acceleration."""
    return dot(vec(row, 0), linear) + dot(vec(row, 3), angular)


@routine
def bias(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, k: int) -> None:
    """Add to the right sides what the rotation contributes to the accelerations of the rows."""
    rank, n = work.mode.kind, work.mode.closed
    spin = vec(y, W)
    for c in range(n):
        touch = work.touches[work.closed[c]]
        own = add(cross(spin, arm(shape, work, touch.point)), drift(shape, work, touch.point))
        lift = dot(q.z, cross(spin, own))
        for j in range(rank):
            work.system[j, k] -= touch.basis[j] * lift
    if work.mode.grip != SLIPS:
        place = work.mode.pivot if work.mode.grip == PIVOTS else work.closed[0]
        point = work.touches[place].point
        own = add(cross(spin, arm(shape, work, point)), drift(shape, work, point))
        along = cross(spin, own)
        work.system[rank, k] -= dot(q.x, along)
        work.system[rank + 1, k] -= dot(q.y, along)


@routine
def share_pressure(work: Workspace) -> bool:
    """Write the pressures from the unknowns; return whether others carry a flat base next.

    Of all pressures with a resultant those of least ΣN² without a pull are N = max(0, Σ φ z): where
    it is above zero for other points than those that z was found for, these are to carry.
    """
    rank, n, other = work.mode.kind, work.mode.closed, False
    for k in range(n):
        touch, share = work.touches[work.closed[k]], 0.0
        for j in range(rank):
            share += touch.basis[j] * work.solved[j]
        touch.share[2] = share if touch.active else 0.0
        active = 1 if share > 0.0 else 0
        if rank == FLAT and touch.active != active:
            touch.active = active
            other = True
    return other


@routine
def weigh(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, free_turn: Vec
) -> int:
    """Find the unknowns under a force; return how many there are. None react if it is singular."""
    k = assemble(shape, work, q, y)
    fill(shape, work, k)
    for i in range(k):
        work.system[i, k] = -measured(work.rows[i], f, free_turn)
        work.solved[i] = 0.0
    bias(shape, work, q, y, k)
    solve(work.system, k, work.solved)
    return k


@routine
def carried(work: Workspace) -> bool:
    """Whether the points that carry a flat base span a plane: Gram's determinant of their basis."""
    n = work.mode.closed
    count, x, y, xx, xy, yy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for k in range(n):
        touch = work.touches[work.closed[k]]
        if touch.active:
            a, b = touch.basis[1], touch.basis[2]
            count, x, y = count + 1.0, x + a, y + b
            xx, xy, yy = xx + a * a, xy + a * b, yy + b * b
    if count == 0.0:
        return False
    xx, xy, yy = xx - x * x / count, xy - x * y / count, yy - y * y / count
    return xx * yy - xy * xy > LINE * (xx + yy) * (xx + yy)


@kernel
def pulls(work: Workspace) -> bool:
    """Whether a point that carries a flat base is pulled by more than round-off."""
    total, least = 0.0, 0.0
    for k in range(work.mode.closed):
        share = work.touches[work.closed[k]].share[2]
        total += share
        least = min(least, share)
    return least < -ROUND_OFF * total


@routine
def stand_on_three(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, free_turn: Vec
) -> int:
    """Let those three points carry a flat base that do so without a pull, with the least ΣN².

    Where friction differs from point to point, pressure on a rough foot brings more friction, which
    tips the body on to that foot: there need be no pressures of the usual form.
    """
    n, best, least = work.mode.closed, Three(-1, -1, -1), math.inf
    k = write_effects(shape, work, q, y, f, free_turn)
    for a in range(n):
        for b in range(a + 1, n):
            for c in range(b + 1, n):
                three = Three(a, b, c)
                size = pressed_by(work, three, k)
                if size < least:
                    best, least = three, size
    if best.a < 0:
        return stand_on_all(shape, work, q, y, f, free_turn)
    carry(work, best)
    k = weigh(shape, work, q, y, f, free_turn)
    share_pressure(work)
    return k


@routine
def write_effects(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, free_turn: Vec
) -> int:
    """Write what each constraint gets from a unit of pressure at each closed place alone.

    The rows that follow those of the closed places are of what holds the contact from slipping;
    the last one holds the right sides.

    Returns: the number of constraints.
    """
    n, rank = work.mode.closed, work.mode.kind
    k = assemble(shape, work, q, y)
    resists = resistance(shape, q, vec(y, W))
    for place in range(n):
        force, torque = pressure(shape, work, q, y, work.closed[place], resists)
        turn = applied(shape.mobility, torque)
        for i in range(k):
            work.effects[place, i] = measured(work.rows[i], force, turn)
    fill(shape, work, k)
    for j in range(rank, k):
        for i in range(k):
            work.effects[n + j - rank, i] = work.system[i, j]
    for i in range(k):
        work.system[i, k] = -measured(work.rows[i], f, free_turn)
    bias(shape, work, q, y, k)
    for i in range(k):
        work.effects[n + k - rank, i] = work.system[i, k]
    return k


@routine
def pressed_by(work: Workspace, three: Three, k: int) -> float:
    """ΣN² where three places alone carry a flat base; infinite where one is pulled or all in line.

    Takes `effects`, of k constraints.
    """
    n, rank = work.mode.closed, work.mode.kind
    carry(work, three)
    if not carried(work):
        return math.inf
    for i in range(k):
        work.system[i, 0] = work.effects[three.a, i]
        work.system[i, 1] = work.effects[three.b, i]
        work.system[i, 2] = work.effects[three.c, i]
        for j in range(rank, k + 1):
            work.system[i, j] = work.effects[n + j - rank, i]
    if not solve(work.system, k, work.solved):
        return math.inf
    total, lowest, size = 0.0, 0.0, 0.0
    for j in range(rank):
        total += work.solved[j]
        lowest = min(lowest, work.solved[j])
        size += work.solved[j] ** 2
    return size if total > 0.0 and lowest >= -ROUND_OFF * total else math.inf


@routine
def stand_on_all(
    shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec, free_turn: Vec
) -> int:
    """Let all points carry a flat base, though some of them are pulled."""
    carry_all(work)
    k = weigh(shape, work, q, y, f, free_turn)
    share_pressure(work)
    return k


@kernel
def nothing_presses(work: Workspace) -> bool:
    largest = 0.0
    for k in range(work.mode.closed):
        largest = max(largest, abs(work.touches[work.closed[k]].share[2]))
    return largest == 0.0


@kernel
def carry(work: Workspace, three: Three) -> None:
    for k in range(work.mode.closed):
        work.touches[work.closed[k]].active = 1 if k in (three.a, three.b, three.c) else 0


@kernel
def carry_all(work: Workspace) -> None:
    for k in range(work.mode.closed):
        work.touches[work.closed[k]].active = 1


@routine
def react(shape: SolidParameters, work: Workspace, q: Axes, y: Floats, f: Vec) -> tuple[Vec, Vec]:
    """v̇ and ω̇ in any mode with a contact; the reactions are written to the shares."""
    spin, n = vec(y, W), work.mode.closed
    free_turn = free_turning(shape, work, spin)
    carry_all(work)
    k = weigh(shape, work, q, y, f, free_turn)
    for _ in range(n):
        if not share_pressure(work) or not carried(work):
            break
        k = weigh(shape, work, q, y, f, free_turn)
    if work.mode.kind == FLAT and nothing_presses(work):  # those that were to carry are in line
        k = stand_on_all(shape, work, q, y, f, free_turn)
    if work.mode.kind == FLAT and n <= EXHAUSTIVE_POINTS and pulls(work):
        k = stand_on_three(shape, work, q, y, f, free_turn)
    linear, torque = f, Vec(0.0, 0.0, 0.0)
    for j in range(k):
        linear = add(linear, times(work.solved[j], vec(work.columns[j], 0)))
        torque = add(torque, times(work.solved[j], vec(work.columns[j], 3)))
    write_friction(shape, work, q, y)
    return linear, add(free_turn, applied(shape.mobility, torque))


@routine
def write_friction(shape: SolidParameters, work: Workspace, q: Axes, y: Floats) -> None:
    """Write the friction of each closed place beside its pressure, where it is determined."""
    hold = work.mode.grip
    for k in range(work.mode.closed):
        place = work.closed[k]
        touch = work.touches[place]
        if hold == STICKS or (hold == PIVOTS and place == work.mode.pivot):
            touch.share[0] = work.solved[work.mode.kind]
            touch.share[1] = work.solved[work.mode.kind + 1]
        else:
            u = velocity(shape, work, q, y, touch.point)
            x, z = slip_direction(shape, work, place, u)
            size = touch.kinetic * touch.share[2]
            touch.share[0], touch.share[1] = -size * x, -size * z
