"""A room whose things have been shaken, with one friction, so that its runs can be judged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shaketable.assess import CastorFriction
from shaketable.assess.floor import floor_of
from shaketable.assess.results import Sides
from shaketable.assess.shares import Share, share_of
from shaketable.assess.solids import ShakingInSpace, sides_of
from shaketable.assess.stood import Ways, one_of_each
from shaketable.errors import Fault, InputError, named, quoted, refusal
from shaketable.inventory import solid_of
from shaketable.language import tell
from shaketable.models import General, Model, model_of, with_friction
from shaketable.motion import Motion
from shaketable.progress import Done, Progress, meter
from shaketable.records import DEFAULT_SUITE, suite
from shaketable.rooms.faults import faults_of
from shaketable.rooms.grid import Grid
from shaketable.rooms.grounds import Ground, ground_of
from shaketable.rooms.judged import Judge
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shaken import directions, shake, stands, ways_of
from shaketable.rooms.shapes import footprint, outline_of, own_angle
from shaketable.solid import ROLLING_RESISTANCE
from shaketable.tilting import CONTROL

MOST_NAMED = 10


@dataclass(frozen=True, eq=False)
class Prepared:
    """A room whose things have been shaken as they stand.

    Attributes:
        room: that was shaken.
        space: how.
        ways: how the plan met each motion, as of `ways_of`.
        grid: its cells.
        shaken: the things that were.
        grounds: what each of these covers in each run.
        sides: to which of its own sides the falls of each go.
        held_up: shares in which the walls and straps of each alone hold it up.
        left_out: the other things.
        judge: of its runs.
    """

    room: Room
    space: ShakingInSpace
    ways: Ways
    grid: Grid
    shaken: tuple[Thing, ...]
    grounds: tuple[Ground, ...]
    sides: tuple[Sides, ...]
    held_up: tuple[Share, ...]
    left_out: tuple[Thing, ...]
    judge: Judge

    @property
    def runs(self) -> int:
        """Motions, polarities and directions."""
        return int(self.grounds[0].fell.size)

    @property
    def friction(self) -> float:
        """Of things that stand on their feet."""
        model = self.space.trial.model
        assert isinstance(model, General)  # of solids it always is
        return model.static_friction


def prepare(
    room: Room,
    motions: Sequence[Motion] | None,
    *,
    scale: float,
    model: Model | str | None,
    castors: CastorFriction | None,
    turns: int,
    cell: float,
    progress: Progress,
    each: Callable[[], None] = lambda: None,
) -> Prepared:
    """Shake a room; arguments as for `assess_room`; `each` is called before each run is judged."""
    require_sound(room)
    if motions is None:
        motions = suite(DEFAULT_SUITE, pairs=True)
    space = floor_of(
        motions, False, scale, 0.0, CONTROL, (), model_of(model), castors or CastorFriction()
    ).space
    if space is None:
        raise InputError(
            "rooms are shaken in three dimensions: the motions need both horizontal components, as "
            "suite(name, pairs=True) gives them"
        )
    shaken = tuple(thing for thing in room.things if is_simulated(thing))
    left_out = tuple(thing for thing in room.things if not is_simulated(thing))
    if not shaken:
        why = named([thing.name for thing in left_out], MOST_NAMED)
        raise InputError(
            tell(
                "nothing in {room} can be shaken: what is there is anchored, stands on other "
                "things, or has no known depth or width ({names})",
                room=quoted(room.name),
                names=why,
            )
            if left_out
            else tell("nothing in {room} can be shaken: it is empty", room=quoted(room.name))
        )
    grid = Grid.of(room, cell)
    outline = outline_of(room)
    still = [
        Ground(grid.covered(footprint(thing, room).intersection(outline)), (), np.zeros(0, bool))
        for thing in left_out
        if not thing.on
    ]
    ways = ways_of(directions(space.trial.motions, room, turns))
    judge = Judge(room, grid, still, each)
    with meter("simulations", ways.size * len(shaken), progress) as done:
        return _shaken(space, ways, shaken, left_out, judge, done)


def with_friction_of(
    prepared: Prepared, friction: float, done: Done, *, once: bool = False
) -> Prepared:
    """A room whose things stand on another friction; so do castors that are locked.

    Args:
        prepared: the room with its own friction.
        friction: static and kinetic.
        done: is told how many more simulations were made.
        once: whether each motion is met in one way only.
    """
    own = prepared.space
    space = own._replace(
        trial=own.trial.changed(model=with_friction(own.trial.model, friction)),
        castors=replace(own.castors, locked=friction),
    )
    ways = one_of_each(prepared.ways) if once else prepared.ways
    return _shaken(space, ways, prepared.shaken, prepared.left_out, prepared.judge, done)


def _shaken(
    space: ShakingInSpace,
    ways: Ways,
    things: tuple[Thing, ...],
    left_out: tuple[Thing, ...],
    judge: Judge,
    done: Done,
) -> Prepared:
    room, grid = judge.room, judge.grid
    stood = [(thing, stands(room, thing, space)) for thing in things]
    fates = shake(room, stood, space, ways, done)
    return Prepared(
        room, space, ways, grid, things,
        tuple(ground_of(room, grid, *each) for each in zip(things, fates, strict=True)),
        tuple(
            sides_of(fate.toward[fate.fell] - own_angle(thing, room))
            for thing, fate in zip(things, fates, strict=True)
        ),
        tuple(share_of(fate.held_up & ~fate.fell, space.recordings) for fate in fates),
        left_out, judge,
    )  # fmt: skip


def require_sound(room: Room) -> None:
    """InputError with all faults of a room's plan: in a wall nothing moves as it would."""
    wrong = faults_of(room)
    if wrong:
        raise refusal([Fault("", "", each.where, "plan", each.text) for each in wrong])


def is_simulated(thing: Thing) -> bool:
    """Whether a thing is shaken; others are drawn, and nobody knows that they are safe."""
    item = thing.item
    return (
        item.loose
        and not (thing.on or item.stands_on)
        and solid_of(item, ROLLING_RESISTANCE) is not None
    )
