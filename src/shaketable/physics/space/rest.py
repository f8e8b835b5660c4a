"""Whether a body rests, and how long within an interval."""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import on_rim
from shaketable.physics.space.ground import GroundAcceleration, RunSetup, Tilted, force_at
from shaketable.physics.space.impact import kinetic_energy
from shaketable.physics.space.rest_beside import rest_beside_until
from shaketable.physics.space.rest_flat import rest_margin, rest_until, rests_surely
from shaketable.physics.space.step import NEVER, Pull, pull_at
from shaketable.physics.space.straps import hold_on, pulls_any, with_straps
from shaketable.physics.space.touches import closed_on_support, is_at_edge
from shaketable.physics.space.workspace import FLAT, STICKS, WALLED, SolidParameters, Workspace

NO_MOTION = 1e-24  # m²/s²: kinetic energy, by the mass, of what does not move


@kernel
def is_at_rest(shape: SolidParameters, work: Workspace) -> bool:
    """Whether a body lies flat and sticks, or is held beside a wall."""
    flat = work.mode.kind == FLAT and not on_rim(work)
    sticks = work.mode.grip == STICKS
    return sticks and (flat or work.mode.kind == WALLED)


@routine
def last_of_rest(
    shape: SolidParameters,
    work: Workspace,
    ground: GroundAcceleration,
    stand: RunSetup,
    frame: Tilted,
    i: int,
) -> int:
    """The last sample, from the ith on, up to which a body that stands flat surely rests."""
    last = ground.acceleration.shape[0] - 1
    flat = work.mode.kind == FLAT and work.mode.grip == STICKS and not on_rim(work)
    if not flat or i >= last:
        return i
    if shape.straps > 0:
        hold_on(shape, work)
        if pulls_any(shape, work):
            return i
    if rests_surely(shape, force_at(ground, i, stand, frame)):
        while i < last and rests_surely(shape, force_at(ground, i + 1, stand, frame)):
            i += 1
    return i


@kernel
def comes_to_rest(shape: SolidParameters, work: Workspace) -> bool:
    """Whether nothing moves any more beside a wall, though its mode is not that of rest."""
    moves = work.mode.kind == WALLED and work.mode.grip != STICKS
    return moves and kinetic_energy(shape, work.state) < NO_MOTION


@routine
def rest_ends(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> float:
    """The u in the interval at which a body leaves its rest, or may, or NEVER."""
    if shape.straps > 0:
        hold_on(shape, work)
    if work.mode.kind == WALLED:
        holds = judge_support(shape, work, pull, u)
        if holds:  # without its walls; what touches a lip stays as it is
            return NEVER if is_at_edge(shape, work) else u
        return rest_beside_until(shape, work, pull, u)
    held = pull
    if shape.straps > 0:  # it does not move: the straps' force stays as it is
        held = Pull(with_straps(shape, work, pull.start), pull.change, pull.length)
    return rest_until(shape, work, held, u)


@routine
def judge_support(shape: SolidParameters, work: Workspace, pull: Pull, u: float) -> bool:
    """Judge whether the support alone holds a flat body through what is left of an interval.

    Rests end where sliding begins, so that a margin of none is none.
    """
    if closed_on_support(work) < shape.contacts or on_rim(work):
        return False
    start = with_straps(shape, work, pull_at(pull, u))
    end = with_straps(shape, work, pull_at(pull, 1.0))
    return min(rest_margin(shape, work, start), rest_margin(shape, work, end)) > 0.0
