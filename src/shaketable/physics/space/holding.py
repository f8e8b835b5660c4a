"""Whether some reactions of all touches hold a body, as where it is wedged."""

from __future__ import annotations

from shaketable.compiled import routine
from shaketable.physics.space.complementarity import moved_at, own_of, with_reaction, write_own
from shaketable.physics.space.cones import in_cone, to_cone
from shaketable.physics.space.vectors import ZERO, Vec, applied, inverse, subtract, times
from shaketable.physics.space.workspace import SolidParameters, Workspace, put, vec

HOLD_SWEEPS = 200
STUCK = 1e-4  # of the largest acceleration: reactions that change by less have come to an end


@routine
def hold_touches(shape: SolidParameters, work: Workspace, small: float) -> float:
    """Find reactions inside the touches' cones that leave the least acceleration; return it [m/s²].

    The least acceleration (in the metric of the mass) over a product of cones is a convex problem:
    one block after the other, exactly where its reaction sticks, else by a projected gradient.

    Args:
        small: an acceleration that is none [m/s²].
    """
    n, most = work.mode.touches, 0.0
    linear, turn = Vec(0.0, 0.0, 0.0), Vec(0.0, 0.0, 0.0)
    for place in range(n):
        write_own(shape, work, place)
        put(work.touches[place].share, 0, ZERO)
    for _ in range(HOLD_SWEEPS):
        change, most = 0.0, 0.0
        for place in range(n):
            touch, own = work.touches[place], own_of(work, place)
            before, now = vec(touch.share, 0), moved_at(work, place, linear, turn)
            most = max(most, abs(now.x), abs(now.y), abs(now.z))
            after = subtract(before, applied(inverse(own), now))
            if not in_cone(after, touch.static):
                step = 1.0 / (own.xx + own.yy + own.zz)
                after = to_cone(subtract(before, times(step, now)), touch.static)
            put(touch.share, 0, after)
            difference = subtract(after, before)
            linear, turn = with_reaction(shape, work, place, difference, ZERO, linear, turn)
            change = max(change, abs(difference.x), abs(difference.y), abs(difference.z))
        if most <= small or change <= STUCK * most:
            break
    return most
