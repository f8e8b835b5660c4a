"""What follows an event, and what a run notes as it goes on."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.hermite import top_of
from shaketable.physics.surrounded.guards import FORCE
from shaketable.physics.surrounded.impacts import bring_to_rest, collide, rock_with_losses
from shaketable.physics.surrounded.modes import choose, mode_size
from shaketable.physics.surrounded.scene import (
    AT_LIP,
    AT_SIDES,
    BASE,
    CLOCK,
    FARTHEST_LEFT,
    FARTHEST_RIGHT,
    IMPACTS,
    LEFT_AT,
    LIFT,
    ON_WALLS,
    PASSED,
    PEAK,
    SPIN,
    STATE,
    TURN,
    Floats,
    Room,
    Scene,
    X,
)
from shaketable.physics.surrounded.straps import note_forces, pull_or_not
from shaketable.physics.surrounded.touches import CLOSED, closing, gather, look_behind, place_of


@routine
def accept(scene: Scene, room: Room, h: float) -> None:
    """Accept the trial state after h [s]; update the extremes."""
    told, before, after = room.told, room.state, room.trial
    if scene.straps > 0:
        note_forces(scene, room, h)
    for side in (1.0, -1.0):
        top = top_of(
            side * before[TURN], side * after[TURN], side * h * before[SPIN],
            side * h * after[SPIN],
        )  # fmt: skip
        told[PEAK] = max(told[PEAK], top)
    if not on_support(room):
        lower = 0 if after[TURN] >= 0.0 else 1  # the corner that is lower, at both ends
        if (before[TURN] >= 0.0) == (lower == 0):
            a, b = place_of(scene, before, lower), place_of(scene, after, lower)
            if max(a.gap, b.gap) < math.inf:
                top = top_of(a.gap, b.gap, h * closing(before, a), h * closing(after, b))
                told[LIFT] = max(told[LIFT], top)
    for j in range(STATE):
        room.state[j] = room.trial[j]
    look_behind(scene, room)
    note_place(scene, room)


@routine
def note_place(scene: Scene, room: Room) -> None:
    """Note how far corners on the support are from where they stood, and a clearance under both."""
    told, y = room.told, room.state
    right, left = place_of(scene, y, 0), place_of(scene, y, 1)
    for number in range(2):
        place = right if number == 0 else left
        if place.gap <= CLOSED:
            slip = y[X] + place.q_x - (scene.right if number == 0 else -scene.left)
            told[FARTHEST_LEFT] = min(told[FARTHEST_LEFT], slip)
            told[FARTHEST_RIGHT] = max(told[FARTHEST_RIGHT], slip)
    if not on_support(room) and max(right.gap, left.gap) < math.inf:
        told[LIFT] = max(told[LIFT], min(right.gap, left.gap))


@routine
def respond(
    scene: Scene, room: Room, f_x: float, f_y: float, kind: int, impact_times: Floats
) -> None:
    """What follows an event: an impact where contacts have closed, and the next mode."""
    touched = on_support(room)
    touches = gather(scene, room, CLOSED, math.inf, 0.0)
    struck = collide(scene, room, touches)
    if struck:
        hit = int(room.told[IMPACTS]) - 1
        if hit < impact_times.size:
            impact_times[hit] = room.told[CLOCK] + room.told[PASSED]
        rock_with_losses(scene, room, touches)
    pull_or_not(scene, room)
    if struck and touches > 1 and settles(scene, room, touches, f_x, f_y):
        return
    choose(scene, room, f_x, f_y, kind == FORCE and not struck)
    if touched and not on_support(room):
        room.told[LEFT_AT] = room.told[CLOCK] + room.told[PASSED]


@kernel
def on_support(room: Room) -> bool:
    """Whether the mode is on the support, or with its base on the edge."""
    found = False
    for e in range(mode_size(room)):
        number = room.mode[1 + e, 0]
        found = found or number < ON_WALLS or AT_LIP <= number <= AT_SIDES + BASE
    return found


@routine
def settles(scene: Scene, room: Room, touches: int, f_x: float, f_y: float) -> bool:
    """Whether a body whose closed contacts all but stay is held on two of them; then it is."""
    for j in range(STATE):
        room.kept[j] = room.state[j]
    if bring_to_rest(scene, room, touches):
        choose(scene, room, f_x, f_y, False)
        if mode_size(room) > 1:
            return True
    for j in range(STATE):
        room.state[j] = room.kept[j]
    return False
