"""Modes: which contacts press and whether they stick, until a guard ends it; and motion in one.

A mode is a subset that `admissible` found for forces: nothing, one contact that sticks, one or two
that slip, or as many as hold the body at rest. Its numbers of forces follow at every instant from
the accelerations of its contacts, which are none.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel, routine
from shaketable.physics.surrounded.admissible import (
    NONE_FITS,
    SLIP_SPEED,
    eliminate,
    first_that_fits,
    solve,
)
from shaketable.physics.surrounded.impacts import keep_after, put_free, stop_pressing
from shaketable.physics.surrounded.scene import (
    AT_SIDES,
    BEND_N,
    GLUED,
    ON_WALLS,
    PAST,
    SPIN,
    STICK,
    TURN,
    U_T,
    USED,
    V_X,
    V_Y,
    WHICH,
    Floats,
    Scene,
    Workspace,
    X,
    Y,
)
from shaketable.physics.surrounded.straps import pull_straps
from shaketable.physics.surrounded.touches import (
    CLOSED,
    LEAVING,
    Place,
    closing,
    contact_count,
    fill_touch,
    gather,
    number_of,
    place_of,
    slipping,
)

SIGN = 1e-10  # m/s²: a force or an acceleration may miss its sign by this much
SWEEPS = 4  # of Newton's method, which puts a state back on its contacts
PUSHES, IN_IT = 50, 2e-10  # m: what is deeper is pushed out
ON_IT = 1e-6  # m: what misses by less is on it after one of them
OFF_IT = 1e-4  # m: what is moved by more to be put back on its contacts is not


class Force(NamedTuple):
    """Body force per unit mass in an interval, linear in it."""

    along: float  # f_t [m/s²]
    along_change: float
    normal: float
    normal_change: float


@kernel
def force_at(force: Force, u: float) -> tuple[float, float]:
    return force.along + u * force.along_change, force.normal + u * force.normal_change


@kernel
def mode_size(work: Workspace) -> int:
    return int(work.mode[0, 0])


@kernel
def rests(work: Workspace) -> bool:
    """Whether the mode holds the body."""
    size, total = mode_size(work), 0
    for e in range(size):
        total += 2 if work.mode[1 + e, 1] == STICK else 1
    return total == 3


@routine
def put_free_accelerations(
    scene: Scene, work: Workspace, y: Floats, f_x: float, f_y: float
) -> None:
    """Accelerations without reaction in a state; feet that are glued pull it down."""
    pull_straps(scene, work, y)
    work.free[0] = f_x + work.pull[0]
    work.free[1] = f_y + work.pull[1]
    work.free[2] = work.pull[2] / scene.i2
    if work.tally[GLUED] > 0.0:  # at rest, each foot: its moment is that of both corners
        work.free[1] -= 2.0 * scene.glue
        work.free[2] += scene.glue * (scene.right - scene.left) / scene.i2


@routine
def rates(scene: Scene, work: Workspace, y: Floats, f_x: float, f_y: float, out: Floats) -> None:
    """The rates of a state in the mode; its forces are left in `work.force`."""
    count = mode_size(work)
    put_free_accelerations(scene, work, y, f_x, f_y)
    for e in range(count):
        number = work.mode[1 + e, 0]
        fill_touch(scene, y, work.touch[e], number, place_of(scene, y, number))
        work.goal[e] = -work.touch[e, BEND_N]
        work.entries[e, 0], work.entries[e, 1] = e, work.mode[1 + e, 1]
    if not solve(scene, work, count, True):
        for j in range(3):
            work.after[j] = math.nan
    for j in range(3):
        work.reaction[j] = work.force[j]
    out[X], out[Y], out[TURN] = y[V_X], y[V_Y], y[SPIN]
    out[V_X], out[V_Y], out[SPIN] = work.after[0], work.after[1], work.after[2]


@routine
def choose(scene: Scene, work: Workspace, f_x: float, f_y: float, ended: bool) -> None:
    """Write the mode that the closed contacts admit in the present state under a force.

    Args:
        ended: whether the mode before, which a guard has ended, may not follow itself.
    """
    for e in range(4):
        work.ended[e, 0], work.ended[e, 1] = work.mode[e, 0], work.mode[e, 1]
    if not take_mode(scene, work, f_x, f_y, ended):
        jam(scene, work, gather(scene, work, CLOSED, LEAVING, 0.0))
        take_mode(scene, work, f_x, f_y, False)
    same = True
    for e in range(mode_size(work) + 1):
        same = same and work.mode[e, 0] == work.ended[e, 0]
        same = same and (e == 0 or work.mode[e, 1] == work.ended[e, 1])
    # no other mode is admissible: this one goes on, and its guards are heard only later
    work.tally[PAST] = 10.0 * work.tally[PAST] if same and ended else SIGN
    if work.tally[GLUED] > 0.0 and not rests(work):
        work.tally[GLUED] = 0.0
        take_mode(scene, work, f_x, f_y, False)  # the feet have let go
    put_back(scene, work, work.state, True)
    push_out(scene, work)


@routine
def take_mode(scene: Scene, work: Workspace, f_x: float, f_y: float, ended: bool) -> bool:
    """Write the mode that the closed contacts admit; nothing presses where none does: False."""
    touches = gather(scene, work, CLOSED, LEAVING, 0.0)
    put_free_accelerations(scene, work, work.state, f_x, f_y)
    count = _choose(scene, work, touches, ended)
    work.mode[0, 0] = max(count, 0)
    for e in range(count):
        number = int(work.touch[work.entries[e, 0], WHICH])
        work.mode[1 + e, 0], work.mode[1 + e, 1] = number, work.entries[e, 1]
        if number >= ON_WALLS:
            work.tally[USED] = 1.0
    return count != NONE_FITS


@routine
def _choose(scene: Scene, work: Workspace, touches: int, ended: bool) -> int:
    """The subset of forces that fits, exactly if one does, else to round-off."""
    first = 1 if work.free[0] > 0.0 else -1
    for k in range(touches):
        work.goal[k] = -work.touch[k, BEND_N]
        if abs(work.touch[k, U_T]) > SLIP_SPEED:
            first = 1 if work.touch[k, U_T] > 0.0 else -1
    count = first_that_fits(scene, work, touches, True, 0.0, ended, first)
    if count == NONE_FITS:
        count = first_that_fits(scene, work, touches, True, SIGN, ended, first)
    if count == NONE_FITS and ended:
        count = first_that_fits(scene, work, touches, True, SIGN, False, first)
    return count


@routine
def jam(scene: Scene, work: Workspace, touches: int) -> None:
    """Stop the contact that slips and cannot (Painlevé), by an impulse inside its cone."""
    worst, at = -1.0, -1
    for k in range(touches):
        if abs(work.touch[k, U_T]) > worst:
            worst, at = abs(work.touch[k, U_T]), k
    if at < 0:
        return
    put_free(work)
    work.goal[at] = 0.0
    work.entries[0, 0], work.entries[0, 1] = at, STICK
    if not solve(scene, work, 1, False):
        stop_pressing(scene, work, touches)
    keep_after(work)


@routine
def put_back(scene: Scene, work: Workspace, y: Floats, anchors: bool) -> None:
    """Put a state back on the contacts of the mode, from which a step's errors have taken it.

    By the smallest change, in the sense of the kinetic energy.

    Args:
        anchors: whether a contact that sticks is to stay where it is now, rather than where it was.
    """
    if mode_size(work) == 0:
        return
    if anchors:
        for e in range(mode_size(work)):
            if work.mode[1 + e, 1] == STICK and work.mode[1 + e, 0] < AT_SIDES:
                work.anchor[0] = along_tangent(y, place_of(scene, y, work.mode[1 + e, 0]))
    x, up, turn = y[X], y[Y], y[TURN]
    for _ in range(SWEEPS):
        if shift(scene, work, y, X, False) < ON_IT:
            break
    moved = max(abs(y[X] - x), abs(y[Y] - up), abs(y[TURN] - turn) * scene.h)
    if anchors and not moved < OFF_IT:
        # closed contacts miss by far less: those of a body in a corner all but depend on each
        # other, and what is left of them by rounding is no motion
        y[X], y[Y], y[TURN] = x, up, turn
    shift(scene, work, y, V_X, True)


@routine
def shift(scene: Scene, work: Workspace, y: Floats, first: int, rates: bool) -> float:
    """Move a state, or change its rates, so that its contacts miss nothing; how much they missed.

    Args:
        first: where the three numbers that change begin.
        rates: whether these are velocities.
    """
    n, worst = 0, 0.0
    for e in range(mode_size(work)):
        number = work.mode[1 + e, 0]
        place = place_of(scene, y, number)
        if place.gap == math.inf:
            continue
        miss = closing(y, place) if rates else place.gap
        n = add_row(work, n, place, place.n_x, place.n_y, miss)
        worst = max(worst, abs(miss))
        if work.mode[1 + e, 1] == STICK and (rates or number < AT_SIDES):
            miss = slipping(y, place) if rates else along_tangent(y, place) - work.anchor[0]
            n = add_row(work, n, place, place.n_y, -place.n_x, miss)
            worst = max(worst, abs(miss))
    for i in range(n):
        work.system[i, n] = -work.rows[i, 3]
        for j in range(n):
            a, b = work.rows[i], work.rows[j]
            work.system[i, j] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] / scene.i2
    if not eliminate(work, n, 0.0):
        return 0.0
    for i in range(n):
        y[first] += work.rows[i, 0] * work.force[i]
        y[first + 1] += work.rows[i, 1] * work.force[i]
        y[first + 2] += work.rows[i, 2] * work.force[i] / scene.i2
    return worst


@routine
def push_out(scene: Scene, work: Workspace) -> None:
    """Move the state out of every surface that it is in, one after another."""
    y = work.state
    for _ in range(PUSHES):
        worst = 0.0
        for k in range(contact_count(scene)):
            number = number_of(scene, k)
            place = place_of(scene, y, number)
            if place.gap < -IN_IT and work.behind[number] == 0:
                worst = max(worst, -place.gap)
                turn = place.q_y * place.n_x - place.q_x * place.n_y
                size = -place.gap / (1.0 + turn * turn / scene.i2)
                y[X] += size * place.n_x
                y[Y] += size * place.n_y
                y[TURN] += size * turn / scene.i2
        if worst == 0.0:
            break


@kernel
def add_row(work: Workspace, n: int, place: Place, d_x: float, d_y: float, miss: float) -> int:
    """Note a direction at a contact, and what is missed along it; how many there are then."""
    row = work.rows[n]
    row[0], row[1], row[2] = d_x, d_y, place.q_y * d_x - place.q_x * d_y
    row[3] = miss
    return n + 1


@kernel
def along_tangent(y: Floats, place: Place) -> float:
    return float((y[X] + place.q_x) * place.n_y - (y[Y] + place.q_y) * place.n_x)
