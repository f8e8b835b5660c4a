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
    Scene,
    Workspace,
    X,
)
from shaketable.physics.surrounded.straps import note_forces, pull_or_not
from shaketable.physics.surrounded.touches import CLOSED, closing, gather, look_behind, place_of


@routine
def accept(scene: Scene, work: Workspace, h: float) -> None:
    """Accept the trial state after h [s]; update the extremes."""
    tally, before, after = work.tally, work.state, work.trial
    if scene.straps > 0:
        note_forces(scene, work, h)
    for side in (1.0, -1.0):
        top = top_of(
            side * before[TURN], side * after[TURN], side * h * before[SPIN],
            side * h * after[SPIN],
        )  # fmt: skip
        tally[PEAK] = max(tally[PEAK], top)
    if not on_support(work):
        lower = 0 if after[TURN] >= 0.0 else 1  # the corner that is lower, at both ends
        if (before[TURN] >= 0.0) == (lower == 0):
            a, b = place_of(scene, before, lower), place_of(scene, after, lower)
            if max(a.gap, b.gap) < math.inf:
                top = top_of(a.gap, b.gap, h * closing(before, a), h * closing(after, b))
                tally[LIFT] = max(tally[LIFT], top)
    for j in range(STATE):
        work.state[j] = work.trial[j]
    look_behind(scene, work)
    note_place(scene, work)


@routine
def note_place(scene: Scene, work: Workspace) -> None:
    """Note how far corners on the support are from where they stood, and a clearance under both."""
    tally, y = work.tally, work.state
    right, left = place_of(scene, y, 0), place_of(scene, y, 1)
    for number in range(2):
        place = right if number == 0 else left
        if place.gap <= CLOSED:
            slip = y[X] + place.q_x - (scene.right if number == 0 else -scene.left)
            tally[FARTHEST_LEFT] = min(tally[FARTHEST_LEFT], slip)
            tally[FARTHEST_RIGHT] = max(tally[FARTHEST_RIGHT], slip)
    if not on_support(work) and max(right.gap, left.gap) < math.inf:
        tally[LIFT] = max(tally[LIFT], min(right.gap, left.gap))


@routine
def respond(
    scene: Scene, work: Workspace, f_x: float, f_y: float, kind: int, impact_times: Floats
) -> None:
    """What follows an event: an impact where contacts have closed, and the next mode."""
    touched = on_support(work)
    touches = gather(scene, work, CLOSED, math.inf, 0.0)
    struck = collide(scene, work, touches)
    if struck:
        hit = int(work.tally[IMPACTS]) - 1
        if hit < impact_times.size:
            impact_times[hit] = work.tally[CLOCK] + work.tally[PASSED]
        rock_with_losses(scene, work, touches)
    pull_or_not(scene, work)
    if struck and touches > 1 and settles(scene, work, touches, f_x, f_y):
        return
    choose(scene, work, f_x, f_y, kind == FORCE and not struck)
    if touched and not on_support(work):
        work.tally[LEFT_AT] = work.tally[CLOCK] + work.tally[PASSED]


@kernel
def on_support(work: Workspace) -> bool:
    """Whether the mode is on the support, or with its base on the edge."""
    found = False
    for e in range(mode_size(work)):
        number = work.mode[1 + e, 0]
        found = found or number < ON_WALLS or AT_LIP <= number <= AT_SIDES + BASE
    return found


@routine
def settles(scene: Scene, work: Workspace, touches: int, f_x: float, f_y: float) -> bool:
    """Whether a body whose closed contacts all but stay is held on two of them; then it is."""
    for j in range(STATE):
        work.kept[j] = work.state[j]
    if bring_to_rest(scene, work, touches):
        choose(scene, work, f_x, f_y, False)
        if mode_size(work) > 1:
            return True
    for j in range(STATE):
        work.state[j] = work.kept[j]
    return False
