"""What falls where in a room, whom it hits, and whether the ways out stay free."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.assess import CastorFriction
from shaketable.assess.floor import floor_of
from shaketable.assess.results import Sides
from shaketable.assess.shares import Share, share_of
from shaketable.assess.solids import ShakingInSpace, sides_of
from shaketable.errors import Fault, InputError, named, quoted, refusal
from shaketable.inventory import solid_of
from shaketable.language import tell
from shaketable.models import General, Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records import DEFAULT_SUITE, suite
from shaketable.rooms.faults import faults_of
from shaketable.rooms.grid import CELL, Grid
from shaketable.rooms.grounds import Ground, ground_of
from shaketable.rooms.judged import Judge
from shaketable.rooms.room import Place, Room, Thing
from shaketable.rooms.shaken import directions, shake, stands
from shaketable.rooms.shapes import footprint, outline_of, own_angle
from shaketable.solid import ROLLING_RESISTANCE
from shaketable.tilting import CONTROL, TURNS

MOST_NAMED = 10


@dataclass(frozen=True)
class ThingResult:
    """What becomes of a thing.

    Attributes:
        name: of it.
        falls: in how many of all runs.
        sides: to which of its own sides the falls go.
        leans: in how many it stands leaning.
        covers: the ground that it covers when it has fallen, on an average over all runs [m²].
    """

    name: str
    falls: Share
    sides: Sides
    leans: Share
    covers: float


@dataclass(frozen=True)
class PlaceResult:
    """What happens to a place.

    Attributes:
        place: of the room.
        hit: the share of runs in which something falls on it.
        by: what does, and in what share of all runs, the worst first.
        hits: how many people are hit, on an average over all runs, if they do not move away.
    """

    place: Place
    hit: Share
    by: tuple[tuple[str, float], ...]
    hits: float


@dataclass(frozen=True)
class WayResult:
    """What happens to a way out.

    Attributes:
        place: where it begins.
        exit: the door to which it goes, "" for all of them at once.
        closed: the share of runs in which it is closed: of all doors, in which none is reached.
        by: what closes it alone, and in what share of all runs, the worst first.
        open_before: whether it is open before anything is shaken.
    """

    place: str
    exit: str
    closed: Share
    by: tuple[tuple[str, float], ...]
    open_before: bool


@dataclass(frozen=True)
class WorstShaking:
    """The run in which most things fall; of several the first.

    Attributes:
        motion: its name.
        reversed: whether its signs were changed.
        along: direction of its first component in the plan [rad].
        falls: how many things fall.
    """

    motion: str
    reversed: bool
    along: float
    falls: int


@dataclass(frozen=True, eq=False)
class RoomAssessment:
    """A room under recorded motions.

    Attributes:
        room: that was shaken.
        grid: its cells.
        covered: the share of runs in which something that fell covers each cell, (y, x).
        things: of those that were simulated.
        places: of all places.
        ways: from each bed and desk to each exit, and to all of them.
        left_out: things that were drawn and not simulated.
        recordings: independent ones, from which intervals are.
        runs: in all: motions, polarities and directions.
        motions: their names.
        worst: run, to look at with `shake_once`.
        friction: of things that stand on their feet; infinite where they cannot slide.
    """

    room: Room
    grid: Grid
    covered: NDArray[np.float64]
    things: tuple[ThingResult, ...]
    places: tuple[PlaceResult, ...]
    ways: tuple[WayResult, ...]
    left_out: tuple[Thing, ...]
    recordings: int
    runs: int
    motions: tuple[str, ...]
    worst: WorstShaking
    friction: float

    @property
    def hits(self) -> float:
        """How many people are hit, on an average over all runs."""
        return sum(each.hits for each in self.places)


def assess_room(
    room: Room,
    motions: Sequence[Motion] | None = None,
    *,
    scale: float = 1.0,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    turns: int = TURNS,
    cell: float = CELL,
    progress: Progress = True,
) -> RoomAssessment:
    """Shake a room: all its things together, by both horizontal components at once.

    Args:
        room: such as `read_room(path)` gives.
        motions: with both components; the default suite if None. Those of a floor are those of
            `Building.floors`.
        scale: factor on all motions.
        model, castors, progress: as for `assess`.
        turns: in how many directions each motion shakes the room, where north or a motion's azimuth
            is not known.
        cell: side of the cells of the plan [m].

    Raises:
        InputError: a plan with faults, nothing to shake, or motions without their second
            components.
    """
    prepared = prepare(
        room, motions, scale=scale, model=model, castors=castors, turns=turns, cell=cell,
        progress=progress,
    )  # fmt: skip
    return assessed(prepared)


@dataclass(frozen=True, eq=False)
class Prepared:
    """A room whose things have been shaken as they stand.

    Attributes:
        room: that was shaken.
        space: how.
        along: directions of the motions in the plan, as of `directions`.
        grid: its cells.
        shaken: the things that were.
        grounds: what each of these covers in each run.
        sides: to which of its own sides the falls of each go.
        leans: whether each stands leaning.
        left_out: the other things.
        judge: of its runs.
    """

    room: Room
    space: ShakingInSpace
    along: NDArray[np.float64]
    grid: Grid
    shaken: tuple[Thing, ...]
    grounds: tuple[Ground, ...]
    sides: tuple[Sides, ...]
    leans: tuple[Share, ...]
    left_out: tuple[Thing, ...]
    judge: Judge

    @property
    def runs(self) -> int:
        """Motions, polarities and directions."""
        return int(self.grounds[0].fell.size)


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
    along = directions(space.trial.motions, room, turns)
    runs = 2 * along.size
    with meter("simulations", runs * len(shaken), progress) as done:
        stood = [(thing, stands(room, thing, space)) for thing in shaken]
        fates = shake(room, stood, space, along, done)
    grid = Grid.of(room, cell)
    outline = outline_of(room)
    still = [
        Ground(grid.covered(footprint(thing, room).intersection(outline)), (), np.zeros(0, bool))
        for thing in left_out
        if not thing.on
    ]
    return Prepared(
        room, space, along, grid, shaken,
        tuple(ground_of(room, grid, *each) for each in zip(shaken, fates, strict=True)),
        tuple(
            sides_of(fate.toward[fate.fell] - own_angle(thing, room))
            for thing, fate in zip(shaken, fates, strict=True)
        ),
        tuple(share_of(fate.leans & ~fate.fell, space.recordings) for fate in fates),
        left_out, Judge(room, grid, still, each),
    )  # fmt: skip


def require_sound(room: Room) -> None:
    """InputError with all faults of a room's plan: in a wall nothing moves as it would."""
    wrong = faults_of(room)
    if wrong:
        raise refusal([Fault("", "", each.where, "plan", each.text) for each in wrong])


def is_simulated(thing: Thing) -> bool:
    """Whether a thing is shaken; others are drawn, and nobody knows that they are safe."""
    item = thing.item
    return not (thing.on or item.anchored) and solid_of(item, ROLLING_RESISTANCE) is not None


def assessed(prepared: Prepared) -> RoomAssessment:
    """What becomes of a room that has been shaken."""
    judged = prepared.judge.judged(prepared.grounds)
    room, grid, grounds = prepared.room, prepared.grid, prepared.grounds
    names, recordings = [thing.name for thing in prepared.shaken], prepared.space.recordings
    judge, runs = prepared.judge, prepared.runs
    covered = np.zeros(grid.shape)
    for run in range(runs):
        lying = [ground.after[run] for ground in grounds if ground.fell[run]]
        if lying:
            covered.flat[np.unique(np.concatenate(lying))] += 1 / runs
    things = tuple(
        ThingResult(
            name, share_of(ground.fell, recordings), sides, lean,
            grid.area * sum(ground.after[run].size for run in np.flatnonzero(ground.fell)) / runs,
        )
        for name, ground, sides, lean in zip(
            names, grounds, prepared.sides, prepared.leans, strict=True
        )
    )  # fmt: skip
    places = []
    for row, place in enumerate(room.places):
        hit = share_of(judged.hit[row].any(axis=0), recordings)
        by = _worst(names, judged.hit[row])
        places.append(PlaceResult(place, hit, by, place.people * hit.value))
    before = judge.open_at_rest(grounds)
    exits = [room.doors[k].name for k in judge.ways.exits]
    ways = []
    for row, name in enumerate(judge.ways.names):
        for column, door in enumerate(exits):
            ways.append(
                WayResult(
                    name, door, share_of(judged.closed[row, column], recordings),
                    _worst(names, judged.by[row, column]), bool(before[row, column]),
                )
            )  # fmt: skip
        if len(exits) > 1:
            shut = judged.closed[row].all(axis=0)
            by = _worst(names, judged.by[row].any(axis=0) & shut)
            open_before = bool(before[row].any())
            ways.append(WayResult(name, "", share_of(shut, recordings), by, open_before))
    return RoomAssessment(
        room, grid, covered, things, tuple(places), tuple(ways), prepared.left_out, recordings,
        runs, tuple(motion.name for motion in prepared.space.trial.motions), _worst_run(prepared),
        _friction(prepared.space),
    )  # fmt: skip


def _friction(space: ShakingInSpace) -> float:
    model = space.trial.model
    assert isinstance(model, General)  # of solids it always is
    return model.static_friction


def _worst_run(prepared: Prepared) -> WorstShaking:
    falls = np.sum([ground.fell for ground in prepared.grounds], axis=0)
    run = int(falls.argmax())
    row, turn = divmod(run, prepared.along.shape[1])
    number, polarity = divmod(row, 2)  # as recorded, and reversed
    motion = prepared.space.trial.motions[number]
    along = float(prepared.along[number, turn])
    return WorstShaking(motion.name, polarity == 1, along, int(falls[run]))


def _worst(names: Sequence[str], happened: NDArray[np.bool_]) -> tuple[tuple[str, float], ...]:
    """Names and shares of what happens at all, (thing, run), the most frequent first."""
    shares = happened.mean(axis=1) if happened.size else np.zeros(len(names))
    order = sorted(range(len(names)), key=lambda k: -shares[k])
    return tuple((names[k], float(shares[k])) for k in order if not math.isclose(shares[k], 0.0))
