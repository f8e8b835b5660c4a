"""Impacts of all closed contacts together (theory, sections 4 and 12).

Newton's law for each surface: a contact that approaches leaves with e times its speed at least,
and just so where there is an impulse; one that does not approach is not driven in. Coulomb's law
for each. Where that would add energy, all e of the impact are lowered by one factor.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.surrounded.admissible import (
    NONE_FITS,
    along_row,
    first_that_fits,
    row_of,
)
from shaketable.physics.surrounded.scene import (
    IMPACTS,
    ON_WALLS,
    SPIN,
    U_N,
    U_T,
    USED,
    V_X,
    V_Y,
    WHICH,
    E,
    Scene,
    Workspace,
)
from shaketable.units import STANDARD_GRAVITY

BOUNCE = 1e-4  # m/s: what lands more slowly does not bounce
SETTLE = 5e-5  # times √(g h) [m/s]: contacts that all leave more slowly are tried as if they stayed
ROUND_OFF = 1e-12  # of the speeds involved
ENERGY_SLACK = 1e-12  # of the energy
HALVINGS, SWEEPS = 50, 500


@kernel
def kinetic(scene: Scene, v_x: float, v_y: float, spin: float) -> float:
    """By the mass [m²/s²]."""
    return 0.5 * (v_x * v_x + v_y * v_y + scene.i2 * spin * spin)


@kernel
def speeds(scene: Scene, work: Workspace) -> float:
    """A measure of all [m/s]."""
    y = work.state
    reach = scene.h + scene.over + scene.right + scene.left
    return float(abs(y[V_X]) + abs(y[V_Y]) + abs(y[SPIN]) * reach)


@kernel
def put_free(work: Workspace) -> None:
    work.free[0], work.free[1], work.free[2] = work.state[V_X], work.state[V_Y], work.state[SPIN]


@kernel
def keep_after(work: Workspace) -> None:
    work.state[V_X], work.state[V_Y], work.state[SPIN] = work.after[0], work.after[1], work.after[2]


@routine
def impulses(scene: Scene, work: Workspace, touches: int, share: float) -> bool:
    """Write velocities after the impact with a share of every restitution; whether there are any.

    Nothing is written to the state.
    """
    first, fastest = 1, 0.0
    for k in range(touches):
        touch = work.touch[k]
        bounces = touch[U_N] < -BOUNCE
        work.goal[k] = -share * touch[E] * touch[U_N] if bounces else 0.0
        if abs(touch[U_T]) > fastest:
            fastest, first = abs(touch[U_T]), 1 if touch[U_T] > 0.0 else -1
    put_free(work)
    slack = ROUND_OFF * speeds(scene, work)
    count = first_that_fits(scene, work, touches, False, slack, False, first)
    return count != NONE_FITS


@routine
def stop_pressing(scene: Scene, work: Workspace, touches: int) -> None:
    """Plastic impulses without friction, one contact after another: where nothing else is found."""
    for j in range(3):
        work.after[j] = work.free[j]
    for _ in range(SWEEPS):
        for k in range(touches):
            row = row_of(work.touch[k], 1.0, 0.0)
            rate = along_row(work.after, row)
            if rate < 0.0:
                size = rate / (row[0] ** 2 + row[1] ** 2 + row[2] ** 2 / scene.i2)
                work.after[0] -= size * row[0]
                work.after[1] -= size * row[1]
                work.after[2] -= size * row[2] / scene.i2


@routine
def collide(scene: Scene, work: Workspace, touches: int) -> bool:
    """Give the state the velocities after the impact of the closed contacts, if there is one."""
    y, strikes, elastic = work.state, False, False
    slack = ROUND_OFF * speeds(scene, work)
    for k in range(touches):
        strikes = strikes or work.touch[k, U_N] < -slack
        elastic = elastic or work.touch[k, E] > 0.0
        if work.touch[k, WHICH] >= ON_WALLS:
            work.tally[USED] = 1.0
    if not strikes:
        return False
    work.tally[IMPACTS] += 1.0
    before = kinetic(scene, y[V_X], y[V_Y], y[SPIN])
    allowed = before * (1.0 + ENERGY_SLACK)
    found = impulses(scene, work, touches, 1.0)
    if elastic and not (found and energy_after(scene, work) <= allowed):
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            fine = impulses(scene, work, touches, middle)
            if fine and energy_after(scene, work) <= allowed:
                low = middle
            else:
                high = middle
        found = impulses(scene, work, touches, low)
    if not found:
        stop_pressing(scene, work, touches)
    keep_after(work)
    return True


@kernel
def energy_after(scene: Scene, work: Workspace) -> float:
    return kinetic(scene, work.after[0], work.after[1], work.after[2])


@routine
def rock_with_losses(scene: Scene, work: Workspace, touches: int) -> None:
    """Multiply the spin that is left by the restitution factor (`physics.plane.impact.lossy`).

    Where both corners struck the support, and nothing else, and one of them stays.
    """
    if scene.factor == 1.0 or touches != 2:
        return
    left, stays = 0, 0
    for k in range(2):
        if work.touch[k, WHICH] >= ON_WALLS:
            return
        if along_row(work.after, row_of(work.touch[k], 1.0, 0.0)) <= 1e-12:
            left += 1
            stays = k
    if left != 1:
        return
    y, touch = work.state, work.touch[stays]
    along = along_row(work.after, row_of(touch, 0.0, 1.0))
    normal = along_row(work.after, row_of(touch, 1.0, 0.0))
    lever = row_of(touch, 0.0, 1.0)[2], row_of(touch, 1.0, 0.0)[2]
    size = scene.i2 + lever[0] ** 2 + lever[1] ** 2
    calmest = (lever[0] * along + lever[1] * normal) / size
    factor = scene.factor
    if y[SPIN] != 0.0:
        factor = min(1.0, max(factor, 2.0 * calmest / y[SPIN] - 1.0))
    y[SPIN] *= factor
    y[V_X], y[V_Y] = along - y[SPIN] * lever[0], normal - y[SPIN] * lever[1]


@routine
def bring_to_rest(scene: Scene, work: Workspace, touches: int) -> bool:
    """Take the velocities along all normals away, if all are small; whether they were.

    What is left moves along the contacts alone: the motion of least distance to the one before.
    """
    slow = SETTLE * math.sqrt(STANDARD_GRAVITY * scene.h)
    for k in range(touches):
        if along_row_of_state(work, k) > slow:
            return False
    put_free(work)
    for j in range(3):
        work.after[j] = work.free[j]
    for _ in range(SWEEPS):
        worst = 0.0
        for k in range(touches):
            row = row_of(work.touch[k], 1.0, 0.0)
            rate = along_row(work.after, row)
            size = rate / (row[0] ** 2 + row[1] ** 2 + row[2] ** 2 / scene.i2)
            work.after[0] -= size * row[0]
            work.after[1] -= size * row[1]
            work.after[2] -= size * row[2] / scene.i2
            worst = max(worst, abs(rate))
        if worst < 1e-14:
            break
    keep_after(work)
    return True


@kernel
def along_row_of_state(work: Workspace, k: int) -> float:
    """ġ of a closed contact in the present state."""
    row = row_of(work.touch[k], 1.0, 0.0)
    y = work.state
    return float(y[V_X] * row[0] + y[V_Y] * row[1] + y[SPIN] * row[2])
