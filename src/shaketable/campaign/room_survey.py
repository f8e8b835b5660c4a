"""Many rooms, each by itself: here, or as a campaign, whose store keeps what is done.

The workers of a Dask client may share the rooms of a store.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from shaketable.assess import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.campaign.objects import Objects
from shaketable.campaign.rooms import Rooms, read_rooms
from shaketable.campaign.run import run
from shaketable.errors import Fault, InputError, named, quoted, refusal
from shaketable.language import spoken, tell
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records import DEFAULT_SUITE, suite
from shaketable.rooms import Room, RoomAssessment, RoomSurvey
from shaketable.tilting import TURNS

MOST_NAMED = 10


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
