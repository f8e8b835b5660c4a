"""Many rooms: in which of them the way out closes, and where people are hit.

Rooms do not know of each other: each is assessed by itself, here or as a campaign, whose store
keeps what is done and which the workers of a Dask client may share.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.assess import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.errors import Fault, InputError, named, quoted, refusal
from shaketable.language import spoken, tell
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records import DEFAULT_SUITE, suite
from shaketable.rooms.results import PlaceResult, RoomAssessment, WayResult
from shaketable.rooms.room import Room
from shaketable.tilting import TURNS

if TYPE_CHECKING:
    from shaketable.campaign.rooms import Rooms

MOST_NAMED = 10


@dataclass(frozen=True, eq=False)
class RoomSurvey:
    """Rooms that were shaken.

    Attributes:
        rooms: what becomes of each, in the order in which they were given.
        refused: rooms that cannot be shaken, such as empty ones, each with the reason.
    """

    rooms: tuple[RoomAssessment, ...]
    refused: tuple[tuple[Room, str], ...] = ()

    def closing(self, limit: float) -> list[RoomAssessment]:
        """The rooms of which a way out closes in more than a share of the runs, the worst first.

        What the recordings cannot exclude is not counted here: `worst_way(...).closed.high` tells.
        """
        worst = [(worst_way(room), room) for room in self.rooms]
        found = [(way, room) for way, room in worst if way and closed_share(way) > limit]
        return [room for _, room in sorted(found, key=lambda each: -closed_share(each[0]))]


def survey_rooms(
    rooms: Sequence[Room],
    motions: Sequence[Motion] | Mapping[str, Sequence[Motion]] | None = None,
    *,
    scale: float = 1.0,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    frictions: Sequence[float] = FRICTIONS,
    turns: int = TURNS,
    store: str | Path | None = None,
    client: Any = None,
    fresh: bool = False,
    progress: Progress = True,
) -> RoomSurvey:
    """Shake many rooms.

    Args:
        rooms: each with a name of its own.
        motions: with both components, or by the labels of floors, such as `Building.floors`.
        scale, model, castors, frictions, turns: as for `assess_room`.
        store: a folder, or a URL that fsspec knows, which keeps each room that is done: a survey
            that was stopped goes on where it was.
        client: a dask.distributed.Client whose workers share the rooms of a store.
        fresh: begin anew, whatever the store holds.
        progress: whether to tell how many rooms are done.

    Raises:
        InputError: two rooms of one name, rooms on floors that are not there, or no room that can
            be shaken: what `assess_room` refuses, for each; a client without a store, or what
            `run_campaign` says of a store.
        SimulationError: what `run_campaign` says of a store.
    """
    if not rooms:
        raise InputError("there are no rooms")
    names = [room.name for room in rooms]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(
            tell("several rooms have one name: {names}", names=named(twice, MOST_NAMED))
        )
    from shaketable.campaign.objects import Objects
    from shaketable.campaign.rooms import read_rooms
    from shaketable.campaign.run import run

    work = _work(rooms, motions, scale, model, castors, frictions, turns)
    if store is not None:
        run(work, store, client=client, fresh=fresh, progress=progress)
        found = read_rooms(work, Objects(store))
    elif client is not None:
        raise InputError("client=: its workers keep what they do in a store; give store=")
    else:
        with meter("rooms", len(rooms), progress) as done:
            found = []
            for number in range(len(rooms)):
                found.append(work.assessed(number))
                done(1)
    refused = [
        (room, each) for room, each in zip(rooms, found, strict=True) if isinstance(each, str)
    ]
    if len(refused) == len(rooms):
        raise refusal([Fault("", "", quoted(room.name), "room", why) for room, why in refused])
    shaken = tuple(each for each in found if isinstance(each, RoomAssessment))
    return RoomSurvey(shaken, tuple(refused))


def _work(
    rooms: Sequence[Room],
    motions: Sequence[Motion] | Mapping[str, Sequence[Motion]] | None,
    scale: float,
    model: Model | str | None,
    castors: CastorFriction | None,
    frictions: Sequence[float],
    turns: int,
) -> Rooms:
    """What is to be done; each floor's motions are in it once."""
    from shaketable.campaign.rooms import Rooms

    if motions is None:
        motions = suite(DEFAULT_SUITE, pairs=True)
    floors = motions if isinstance(motions, Mapping) else {room.floor: motions for room in rooms}
    lost = [room.name for room in rooms if room.floor not in floors]
    if lost:
        raise InputError(
            tell(
                "{rooms}: on a floor that is not among {floors}",
                rooms=named(lost, MOST_NAMED),
                floors=named(list(floors), MOST_NAMED),
            )
        )
    every: list[Motion] = []
    parts: dict[int, tuple[int, int]] = {}  # by the identity of a floor's motions
    for room in rooms:
        those = floors[room.floor]
        if id(those) not in parts:
            parts[id(those)] = (len(every), len(every) + len(those))
            every += those
    return Rooms(
        rooms=rooms, motions=every, parts=[parts[id(floors[room.floor])] for room in rooms],
        scale=scale, model=model_of(model), castors=castors or CastorFriction(),
        frictions=frictions, turns=turns, language=spoken(),
    )  # fmt: skip


def worst_way(found: RoomAssessment) -> WayResult | None:
    """The way to any exit that is closed most often; None where no way begins.

    One that is closed before anything is shaken is always closed.
    """
    doors = {way.exit for way in found.ways}
    last = [way for way in found.ways if not way.exit or len(doors) == 1]
    return max(last, key=lambda way: (closed_share(way), way.closed.high), default=None)


def closed_share(way: WayResult) -> float:
    """In what share of the runs a way is closed."""
    return way.closed.value if way.open_before else 1.0


def worst_hit(found: RoomAssessment) -> PlaceResult | None:
    """The place on which something falls most often; None where there are no places."""
    return max(found.places, key=lambda each: (each.hit.value, each.hit.high), default=None)
