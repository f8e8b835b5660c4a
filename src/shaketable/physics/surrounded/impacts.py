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
    Room,
    Scene,
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
def speeds(scene: Scene, room: Room) -> float:
    """A measure of all [m/s]."""
    y = room.state
    reach = scene.h + scene.over + scene.right + scene.left
    return float(abs(y[V_X]) + abs(y[V_Y]) + abs(y[SPIN]) * reach)


@kernel
def put_free(room: Room) -> None:
    room.free[0], room.free[1], room.free[2] = room.state[V_X], room.state[V_Y], room.state[SPIN]


@kernel
def keep_after(room: Room) -> None:
    room.state[V_X], room.state[V_Y], room.state[SPIN] = room.after[0], room.after[1], room.after[2]


@routine
def impulses(scene: Scene, room: Room, touches: int, share: float) -> bool:
    """Write velocities after the impact with a share of every restitution; whether there are any.

    Nothing is written to the state.
    """
    first, fastest = 1, 0.0
    for k in range(touches):
        touch = room.touch[k]
        bounces = touch[U_N] < -BOUNCE
        room.goal[k] = -share * touch[E] * touch[U_N] if bounces else 0.0
        if abs(touch[U_T]) > fastest:
            fastest, first = abs(touch[U_T]), 1 if touch[U_T] > 0.0 else -1
    put_free(room)
    slack = ROUND_OFF * speeds(scene, room)
    count = first_that_fits(scene, room, touches, False, slack, False, first)
    return count != NONE_FITS


@routine
def stop_pressing(scene: Scene, room: Room, touches: int) -> None:
    """Plastic impulses without friction, one contact after another: where nothing else is found."""
    for j in range(3):
        room.after[j] = room.free[j]
    for _ in range(SWEEPS):
        for k in range(touches):
            row = row_of(room.touch[k], 1.0, 0.0)
            rate = along_row(room.after, row)
            if rate < 0.0:
                size = rate / (row[0] ** 2 + row[1] ** 2 + row[2] ** 2 / scene.i2)
                room.after[0] -= size * row[0]
                room.after[1] -= size * row[1]
                room.after[2] -= size * row[2] / scene.i2


@routine
def collide(scene: Scene, room: Room, touches: int) -> bool:
    """Give the state the velocities after the impact of the closed contacts, if there is one."""
    y, strikes, elastic = room.state, False, False
    slack = ROUND_OFF * speeds(scene, room)
    for k in range(touches):
        strikes = strikes or room.touch[k, U_N] < -slack
        elastic = elastic or room.touch[k, E] > 0.0
        if room.touch[k, WHICH] >= ON_WALLS:
            room.told[USED] = 1.0
    if not strikes:
        return False
    room.told[IMPACTS] += 1.0
    before = kinetic(scene, y[V_X], y[V_Y], y[SPIN])
    allowed = before * (1.0 + ENERGY_SLACK)
    found = impulses(scene, room, touches, 1.0)
    if elastic and not (found and energy_after(scene, room) <= allowed):
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            fine = impulses(scene, room, touches, middle)
            if fine and energy_after(scene, room) <= allowed:
                low = middle
            else:
                high = middle
        found = impulses(scene, room, touches, low)
    if not found:
        stop_pressing(scene, room, touches)
    keep_after(room)
    return True


@kernel
def energy_after(scene: Scene, room: Room) -> float:
    return kinetic(scene, room.after[0], room.after[1], room.after[2])


@routine
def rock_with_losses(scene: Scene, room: Room, touches: int) -> None:
    """Multiply the spin that is left by the restitution factor (`physics.plane.impact.lossy`).

    Where both corners struck the support, and nothing else, and one of them stays.
    """
    if scene.factor == 1.0 or touches != 2:
        return
    left, stays = 0, 0
    for k in range(2):
        if room.touch[k, WHICH] >= ON_WALLS:
            return
        if along_row(room.after, row_of(room.touch[k], 1.0, 0.0)) <= 1e-12:
            left += 1
            stays = k
    if left != 1:
        return
    y, touch = room.state, room.touch[stays]
    along = along_row(room.after, row_of(touch, 0.0, 1.0))
    normal = along_row(room.after, row_of(touch, 1.0, 0.0))
    lever = row_of(touch, 0.0, 1.0)[2], row_of(touch, 1.0, 0.0)[2]
    size = scene.i2 + lever[0] ** 2 + lever[1] ** 2
    calmest = (lever[0] * along + lever[1] * normal) / size
    factor = scene.factor
    if y[SPIN] != 0.0:
        factor = min(1.0, max(factor, 2.0 * calmest / y[SPIN] - 1.0))
    y[SPIN] *= factor
    y[V_X], y[V_Y] = along - y[SPIN] * lever[0], normal - y[SPIN] * lever[1]


@routine
def bring_to_rest(scene: Scene, room: Room, touches: int) -> bool:
    """Take the velocities along all normals away, if all are small; whether they were.

    What is left moves along the contacts alone: the motion of least distance to the one before.
    """
    slow = SETTLE * math.sqrt(STANDARD_GRAVITY * scene.h)
    for k in range(touches):
        if along_row_of_state(room, k) > slow:
            return False
    put_free(room)
    for j in range(3):
        room.after[j] = room.free[j]
    for _ in range(SWEEPS):
        worst = 0.0
        for k in range(touches):
            row = row_of(room.touch[k], 1.0, 0.0)
            rate = along_row(room.after, row)
            size = rate / (row[0] ** 2 + row[1] ** 2 + row[2] ** 2 / scene.i2)
            room.after[0] -= size * row[0]
            room.after[1] -= size * row[1]
            room.after[2] -= size * row[2] / scene.i2
            worst = max(worst, abs(rate))
        if worst < 1e-14:
            break
    keep_after(room)
    return True


@kernel
def along_row_of_state(room: Room, k: int) -> float:
    """ġ of a closed contact in the present state."""
    row = row_of(room.touch[k], 1.0, 0.0)
    y = room.state
    return float(y[V_X] * row[0] + y[V_Y] * row[1] + y[SPIN] * row[2])
