"""How a run ends: at rest, fallen, or given up."""

from __future__ import annotations

import math

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import axes_at, foot_of, on_rim
from shaketable.physics.space.edge import beyond, has_edge, is_off
from shaketable.physics.space.found import NOT_YET, STANDING, STILL_MOVING, STILL_SLIDING
from shaketable.physics.space.impact import kinetic_energy
from shaketable.physics.space.rest_beside import judge_rest_beside
from shaketable.physics.space.rest_flat import rest_margin
from shaketable.physics.space.straps import holds_any, strap_energy, with_straps
from shaketable.physics.space.touches import touches_more
from shaketable.physics.space.vectors import Vec, dot, subtract
from shaketable.physics.space.workspace import (
    FLAT,
    SLIPS,
    STICKS,
    WALLED,
    P,
    SolidParameters,
    V,
    Workspace,
    vec,
)
from shaketable.units import STANDARD_GRAVITY

#: What to tell the user of the irregular endings, after "the solid" or "3 of 100 simulations".
SENTENCES = {
    STILL_MOVING: "still moved when given up: ten seconds after the motion's end if straps hold "
    "it or its energy is too little to overturn (three if both is so and it hardly loses any), or "
    "ten minutes or 100,000 steps (20,000 of sliding) after it, or after 200,000 steps and ten for "
    "each sample in all; it counts as standing, and its displacement and turn are those until "
    "then. Rolling, contour or drilling friction would bring it to rest",
    STILL_SLIDING: "still slid when the motion had ended, with nothing to stop it: there is too "
    "little kinetic friction for the tilt; its displacement counts until then",
}
FREE_STEP = 0.01  # s: least interval after the motion's end
FREE_TIME = 10.0  # s after the motion's end: what still moves then but cannot fall is given up
FREE_LIMIT = 600.0  # s: and so is everything
SWING_TIME = 1.0  # s: longer than half a swing in a strap
# Of the most kinetic energy of a second so much is left in the next one without much loss; and so
# many seconds, one after the other: what loses energy at impacts alone may do so a while later.
SWINGS, MOST_SWINGS = 0.9, 2
# Steps after the motion's end, which are a few seconds of computing: likewise; fewer where a base
# lies flat and slips, whose steps are dear. An event counts as ten.
FREE_STEPS, FREE_SLIDES, PER_EVENT = 100_000, 20_000, 10
# Steps of a run, and more for each sample: a second of computing, a hundred times a usual run's.
MOST_STEPS, PER_SAMPLE = 200_000, 10
STICK_TOLERANCE = 1e-9  # m: a sticking body that moved less since the last sample is at rest
# A body that leans on a wall or hangs in a strap is at rest after so many intervals in each of
# which it moved with less energy than so small a part of g h: some 0.04 mm/s. What can fall would
# have gathered speed meanwhile; what swings or slips against a wall does so by ever less.
CALM, CALM_ENERGY = 50, 1e-10
MARGINAL = 1e-8  # m/s²: a slide that is slowed down by less goes on for ever


@routine
def ending_after(shape: SolidParameters, work: Workspace, f: Vec, since: float, spent: int) -> int:
    """How a body ends that nothing shakes any more, or NOT_YET.

    Args:
        f: the body force.
        since: how long ago the motion ended [s].
        spent: `effort` since then.
    """
    tally, kind = work.tally, work.mode.kind
    if kind != FLAT and (shape.straps > 0 or touches_more(shape)):
        calm = kinetic_energy(shape, work.state) < CALM_ENERGY * STANDARD_GRAVITY * shape.h
        tally.calm = tally.calm + 1 if calm else 0
        if tally.calm >= CALM:
            return STANDING
    if kind == FLAT:
        x, y = work.state[P], work.state[P + 1]
        stays = abs(x - tally.was_x) + abs(y - tally.was_y) < STICK_TOLERANCE
        tally.was_x, tally.was_y = x, y
        held = with_straps(shape, work, f)
        rests = not on_rim(work) and rest_margin(shape, work, held) >= 0.0
        if work.mode.grip == STICKS and (stays or rests):
            return STANDING
        if slides_on(shape, work, f):
            return STILL_SLIDING
    if kind == WALLED and work.mode.grip == STICKS and judge_rest_beside(shape, work, f):
        return STANDING
    most = FREE_SLIDES if kind == FLAT else FREE_STEPS
    if spent > most or judge_given_up(shape, work, f, since):
        return STILL_MOVING
    return NOT_YET


@routine
def judge_given_up(shape: SolidParameters, work: Workspace, f: Vec, since: float) -> bool:
    """Judge whether what still moves is given up, so long after the motion [s].

    What cannot fall is after FREE_TIME, as it may go on for ever, and in straps earlier, if it
    swings on without a loss that would bring it to rest. Whatever straps hold is after FREE_TIME:
    of 6,160 runs of boxes and cylinders in one strap 1,247 fell, one of them later than that.
    """
    if is_off(shape, work.state):
        return False
    held = holds_any(shape, work)
    swings = held and not has_edge(shape) and judge_swinging(shape, work, since)
    if since <= FREE_TIME and not (swings and is_before_tipping(shape, work, f)):
        return False
    return (held and since > FREE_TIME) or cannot_fall(shape, work, f)


@kernel
def is_before_tipping(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether a body is turned by less than its nearest side lets it, whichever way that is."""
    tilt = math.atan2(math.sqrt(f.x * f.x + f.y * f.y), -f.z)
    turned = math.acos(min(1.0, axes_at(work.state).z.z))
    return turned + tilt < math.atan2(shape.inscribed, shape.h)


@routine
def judge_swinging(shape: SolidParameters, work: Workspace, since: float) -> bool:
    """Judge, second by second, whether a body was nearly as lively in the last MOST_SWINGS.

    Notes how lively it is now.
    """
    tally, energy = work.tally, kinetic_energy(shape, work.state)
    tally.lively = max(tally.lively, energy)
    if since >= tally.looked_at + SWING_TIME:
        swings = tally.lively > SWINGS * tally.was_lively
        tally.swings = tally.swings + 1 if swings else 0
        tally.looked_at, tally.was_lively, tally.lively = since, tally.lively, energy
    return bool(tally.swings >= MOST_SWINGS)


@routine
def cannot_fall(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether the energy of a body is below what its least tipping needs.

    It counts from where the body stands flat with its foot where it is now; what tips over a side
    stands with its foot farther back by (1 - cos θ) of the distance, at the most. What a strap
    stores counts as its own; of what is tipped over already and hangs in its straps nobody asks.
    """
    q, foot = axes_at(work.state), foot_of(shape, work)
    raised = subtract(vec(work.state, P), Vec(foot.x, foot.y, shape.h))
    back = math.sqrt(f.x * f.x + f.y * f.y) * shape.reach * (1.0 - q.z.z)
    energy = kinetic_energy(shape, work.state) - dot(f, raised) + back
    if shape.straps > 0:
        energy += strap_energy(shape, work)
    least = math.inf
    if has_edge(shape):
        out = shape.edge_x * f.x + shape.edge_y * f.y
        least = tipping_energy(-beyond(shape, foot), shape.h, out, -f.z)
    if shape.radius > 0.0:  # over its rim, which stands lower than before by the rise
        along = math.sqrt(f.x * f.x + f.y * f.y)
        rim = tipping_energy(shape.radius, shape.h - shape.rise, along, -f.z)
        least = min(least, rim + shape.rise * f.z)
    else:
        f_x, f_y = q.x.x * f.x + q.y.x * f.y, q.x.y * f.x + q.y.y * f.y
        for k in range(shape.hull):
            j = k + 1 if k + 1 < shape.hull else 0
            dx = work.points[j].x - work.points[k].x
            dy = work.points[j].y - work.points[k].y
            length = math.sqrt(dx * dx + dy * dy)
            out_x, out_y = dy / length, -dx / length
            distance = out_x * work.points[k].x + out_y * work.points[k].y
            out = out_x * f_x + out_y * f_y
            least = min(least, tipping_energy(distance, shape.h, out, -f.z))
    return bool(energy < least)


@kernel
def tipping_energy(distance: float, h: float, out: float, down: float) -> float:
    """What tipping about a line takes, the force along its outward normal and down given."""
    return math.sqrt((out * out + down * down) * (distance * distance + h * h)) - (
        h * down - distance * out
    )


@kernel
def slides_on(shape: SolidParameters, work: Workspace, f: Vec) -> bool:
    """Whether a body slides flat, and nothing slows it down or lies ahead."""
    if work.mode.kind != FLAT or work.mode.grip != SLIPS:
        return False
    if holds_any(shape, work):
        return False
    v = vec(work.state, V)
    ahead = has_edge(shape) and shape.edge_x * v.x + shape.edge_y * v.y > 0.0
    for wall in range(1, shape.walls + 1):
        ahead = ahead or dot(vec(work.planes[wall].normal, 0), v) < 0.0
    if ahead:
        return False
    most = 0.0
    for k in range(shape.contacts):
        most = max(most, work.points[k].kinetic)
    return math.sqrt(f.x * f.x + f.y * f.y) + most * f.z >= -MARGINAL


@kernel
def effort(work: Workspace) -> int:
    """What a run has computed so far, in steps."""
    return work.tally.steps + PER_EVENT * work.tally.events
