"""Modes of touches that are asked: is one admissible?

It is where all that carry press and hold, and none is accelerated into its surface. What is called
`try_...` writes the mode that it asks about.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.choice import BACKWARD_SLIP_TOLERANCE
from shaketable.physics.space.cones import limit
from shaketable.physics.space.rates import rates
from shaketable.physics.space.touches import (
    note_moving,
    plane_of,
    touch_acceleration,
    touch_velocity,
)
from shaketable.physics.space.vectors import Axes, Vec
from shaketable.physics.space.walled import LIKE_LEAST, is_dependent, write_mode
from shaketable.physics.space.workspace import (
    DEPENDENT,
    MAY_PRESS,
    PRESSES,
    PULLS,
    SLIPS,
    WALLED,
    SolidParameters,
    Touch,
    V,
    W,
    Workspace,
    vec,
)

SLACK = 5e-10  # m/s²: a touch may be accelerated into its plane by this much
#: m/s²: likewise one on a wall that carries nothing, and whose row all but follows from those that
#: are kept: these hold it as well.
DEPENDENT_SLACK = 1e-3
AT_EDGE = 1e-6  # of the friction: a touch whose reaction is further inside its cone sticks
STARTS = 1e-6  # m/s²: what is accelerated by less neither slips, nor leaves, nor ends its rest
MOST_TRIES = 8  # to find which touches carry, and which slip
MOST_CHANGES = 24  # of those that carry, one after the other
# Of `try_by_planes`: what touches do, how many planes at the most, and how often slips are turned.
SLIDES, LEAVES, MOST_PLANES, TURNS = 1, 2, 4, 4


@routine
def try_letting_slip(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Write the mode in which those begin to slip that would need more friction to hold.

    They slip against the friction that would hold them. Tells whether it is admissible.
    """
    for _ in range(min(work.mode.touches, MOST_TRIES) + 1):
        if try_as_they_move(shape, work, q, f):
            return True
        if work.judged.press < -SLACK:
            break
        if work.judged.cone >= -SLACK:
            if not turn_slips(shape, work, q):
                break
            for place in range(work.mode.touches):
                work.touches[place].carries = PRESSES
            continue
        for place in range(work.mode.touches):
            touch = work.touches[place]
            share = touch.share
            pull = math.sqrt(share[0] * share[0] + share[1] * share[1])
            # of those alike, which need as much, none slips alone
            most = (1.0 - AT_EDGE) * limit(touch.static, share[2])
            if touch.carries > 0 and touch.moves == 0 and pull > most:
                begin_slip(shape, work, q, place)
            touch.carries = PRESSES
    return False


@routine
def begin_slip(shape: SolidParameters, work: Workspace, q: Axes, place: int) -> None:
    """Let a touch that stands still slip: against the friction that would hold it.

    Without such friction it goes where it is accelerated.
    """
    touch = work.touches[place]
    x, y = -touch.share[0], -touch.share[1]
    if x == 0.0 and y == 0.0:
        dy = work.stages[0]
        a = touch_acceleration(work, q, work.state, vec(dy, V), vec(dy, W), place)
        x, y = a.x, a.y
    size = math.sqrt(x * x + y * y)
    touch.moves = 1
    touch.slip_x, touch.slip_y = x / size, y / size


@routine
def try_by_planes(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Write the mode in which what touches a plane sticks, slips or leaves together, if one fits.

    All ways are tried: where touches are nearly in line with one another, as between a table and
    the lip before it, reactions are found too slowly.
    """
    planes, ways = 0, 1
    for place in range(work.mode.touches):
        if is_first_on_plane(work, place):
            planes, ways = planes + 1, 3 * ways
    for way in range(ways if planes <= MOST_PLANES else 0):
        set_by_plane(shape, work, q, way)
        for _ in range(TURNS):
            if try_as_they_move(shape, work, q, f):
                return True
            if not turn_slips(shape, work, q):
                break
            set_carrying(work, way)
    return False


@kernel
def is_first_on_plane(work: Workspace, place: int) -> bool:
    """Whether no touch before this one is on its plane."""
    found = True
    for other in range(place):
        found = found and plane_of(work, other) != plane_of(work, place)
    return found


@kernel
def does_in(work: Workspace, place: int, way: int) -> int:
    """What a touch does in one of the ways of `try_by_planes`: it sticks, slips or leaves."""
    rest, does = way, 0
    for other in range(work.mode.touches):
        if is_first_on_plane(work, other):
            if plane_of(work, other) == plane_of(work, place):
                does = rest % 3
            rest //= 3
    return does


@kernel
def set_carrying(work: Workspace, way: int) -> None:
    """Let all touches carry that do not leave in a way."""
    for place in range(work.mode.touches):
        work.touches[place].carries = PRESSES if does_in(work, place, way) < LEAVES else PULLS


@routine
def set_by_plane(shape: SolidParameters, work: Workspace, q: Axes, way: int) -> None:
    """Write what all touches do in a way; what begins to slip does so as it is accelerated now."""
    set_carrying(work, way)
    note_moving(shape, work, q, work.mode.touches, shape.limits.slow)
    dy = work.stages[0]
    for place in range(work.mode.touches):
        touch = work.touches[place]
        may = touch.moves == 0 and touch.static < math.inf
        if may and does_in(work, place, way) == SLIDES:
            a = touch_acceleration(work, q, work.state, vec(dy, V), vec(dy, W), place)
            size = math.sqrt(a.x * a.x + a.y * a.y)
            touch.moves = 1
            touch.slip_x, touch.slip_y = (a.x / size, a.y / size) if size > 0.0 else (1.0, 0.0)


@routine
def turn_slips(shape: SolidParameters, work: Workspace, q: Axes) -> bool:
    """Turn the slips that begin against their acceleration toward it; False if none does."""
    y, dy, turned = work.state, work.stages[0], False
    for place in range(work.mode.touches):
        touch = work.touches[place]
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        if touch.moves > 0 and not (follows_slip(touch, a) or is_fast(shape, work, q, place)):
            size = math.sqrt(a.x * a.x + a.y * a.y)
            touch.slip_x, touch.slip_y = a.x / size, a.y / size
            turned = True
    return turned


@kernel
def follows_slip(touch: Touch, a: Vec) -> bool:
    """Whether a touch that begins to slip is not accelerated against its slip."""
    return a.x * touch.slip_x + a.y * touch.slip_y >= -BACKWARD_SLIP_TOLERANCE


@routine
def is_fast(shape: SolidParameters, work: Workspace, q: Axes, place: int) -> bool:
    """Whether a touch slips already."""
    u = touch_velocity(work, q, work.state, place)
    return bool(math.sqrt(u.x * u.x + u.y * u.y) > shape.limits.slow)


@routine
def try_as_they_move(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> bool:
    """Write the mode in which touches slip as is noted; whether it is admissible.

    It is where all of them press, hold and let none sink, and no slip begins backward.
    """
    y, dy = work.state, work.stages[0]
    work.mode.kind, work.mode.grip = WALLED, SLIPS
    write_carrying(shape, work, q, f)
    found = work.judged.press >= -SLACK and work.judged.cone >= -SLACK
    for place in range(work.mode.touches):
        touch = work.touches[place]
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        found = found and not sinks(shape, work, place, a)
        if touch.moves > 0 and not is_fast(shape, work, q, place):
            found = found and follows_slip(touch, a)
    return bool(found)


@routine
def write_carrying(shape: SolidParameters, work: Workspace, q: Axes, f: Vec) -> None:
    """Write which touches carry, as they move: none pulls, and none sinks that carries nothing.

    First those that pull most are dropped together. If others sink then, one after the other
    changes, always the first that is not as it should be (Murty 1974, Opsearch 11: where there is
    one solution this finds it), at most MOST_CHANGES times.
    """
    y, dy = work.state, work.stages[0]
    for _ in range(min(work.mode.touches, MOST_TRIES)):
        write_mode(shape, work, q)
        rates(shape, work, y, f, True, dy)
        if work.judged.press >= -SLACK or not drop_pull(work):
            break
    for _ in range(MOST_CHANGES):
        place = first_wrong(shape, work, q)
        if place < 0:
            break
        touch = work.touches[place]
        touch.carries = PULLS if touch.carries == PRESSES else PRESSES
        write_mode(shape, work, q)
        rates(shape, work, y, f, True, dy)


@routine
def first_wrong(shape: SolidParameters, work: Workspace, q: Axes) -> int:
    """The first touch that pulls, or sinks and carries nothing; -1 if none does."""
    y, dy, found = work.state, work.stages[0], -1
    for place in range(work.mode.touches):
        touch = work.touches[place]
        wrong = touch.share[2] < -SLACK
        if touch.carries != PRESSES:
            a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
            wrong = sinks(shape, work, place, a)
        if wrong:
            found = place
            break
    return found


@routine
def sinks(shape: SolidParameters, work: Workspace, place: int, a: Vec) -> bool:
    """Whether a touch with an acceleration goes into its surface."""
    if a.z >= -SLACK:
        return False
    on_wall = 0 < plane_of(work, place) <= shape.walls
    may = on_wall and work.touches[place].carries != PRESSES and a.z >= -DEPENDENT_SLACK
    return not (may and is_dependent(shape, work, place))


@routine
def let_slip(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Let those touches begin to slip whose reaction is at its cone's edge and that accelerate."""
    y, dy = work.state, work.stages[0]
    for place in range(work.mode.touches):
        touch = work.touches[place]
        share = touch.share
        a = touch_acceleration(work, q, y, vec(dy, V), vec(dy, W), place)
        along = math.sqrt(a.x * a.x + a.y * a.y)
        pull = math.sqrt(share[0] * share[0] + share[1] * share[1])
        mu = min(touch.static, touch.kinetic)
        inside = pull < (1.0 - AT_EDGE) * limit(mu, share[2])
        if touch.moves > 0 or along <= STARTS or inside or touch.static == math.inf:
            continue
        begin_slip(shape, work, q, place)


@routine
def drop_pull(work: Workspace) -> bool:
    """Let the touches that pull most carry nothing; False if none pulls.

    Both that hold a side leave it at once.
    """
    least = 0.0
    for place in range(work.mode.touches):
        least = min(least, work.touches[place].share[2])
    for place in range(work.mode.touches):
        if work.touches[place].carries == DEPENDENT:
            work.touches[place].carries = MAY_PRESS
        if least < -SLACK and work.touches[place].share[2] < LIKE_LEAST * least:
            work.touches[place].carries = PULLS
    return least < -SLACK
