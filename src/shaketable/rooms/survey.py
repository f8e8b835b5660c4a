"""Many rooms: in which of them the way out closes, and where people are hit.

Rooms do not know of each other, so that each is assessed by itself, one after another or on the
workers of a Dask client.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from shaketable.assess import CastorFriction
from shaketable.errors import Fault, InputError, named, quoted, refusal
from shaketable.language import tell
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.rooms.assessment import assess_room
from shaketable.rooms.results import PlaceResult, RoomAssessment, WayResult
from shaketable.rooms.room import Room
from shaketable.tilting import TURNS

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
    turns: int = TURNS,
    client: Any = None,
    progress: Progress = True,
) -> RoomSurvey:
    """Shake many rooms.

    Args:
        rooms: each with a name of its own.
        motions: with both components, or by the labels of floors, such as `Building.floors`.
        scale, model, castors, turns: as for `assess_room`.
        client: a dask.distributed.Client on whose workers rooms are assessed; here if None.
        progress: whether to tell how many rooms are done.

    Raises:
        InputError: two rooms of one name, rooms on floors that are not there, or no room that can
            be shaken: what `assess_room` refuses, for each.
    """
    if not rooms:
        raise InputError("there are no rooms")
    names = [room.name for room in rooms]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(
            tell("several rooms have one name: {names}", names=named(twice, MOST_NAMED))
        )
    if isinstance(motions, Mapping):
        lost = [room.name for room in rooms if room.floor not in motions]
        if lost:
            raise InputError(
                tell(
                    "{rooms}: on a floor that is not among {floors}",
                    rooms=named(lost, MOST_NAMED),
                    floors=named(list(motions), MOST_NAMED),
                )
            )
        of_rooms: list[Sequence[Motion] | None] = [motions[room.floor] for room in rooms]
    else:
        of_rooms = [motions] * len(rooms)
    settings = {"scale": scale, "model": model, "castors": castors, "turns": turns}
    one = partial(_one, settings=settings)
    with meter("rooms", len(rooms), progress) as done:
        found = _here(one, rooms, of_rooms, done) if client is None else _there(
            client, one, rooms, of_rooms, done
        )  # fmt: skip
    refused = [
        (room, str(each))
        for room, each in zip(rooms, found, strict=True)
        if isinstance(each, InputError)
    ]
    if len(refused) == len(rooms):
        raise refusal([Fault("", "", quoted(room.name), "room", why) for room, why in refused])
    shaken = tuple(each for each in found if isinstance(each, RoomAssessment))
    return RoomSurvey(shaken, tuple(refused))


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


Found = RoomAssessment | InputError


def _one(room: Room, motions: Sequence[Motion] | None, settings: Mapping[str, Any]) -> Found:
    """What becomes of a room, or why it cannot be told: the others are told nevertheless."""
    try:
        return assess_room(room, motions, progress=False, **settings)
    except InputError as error:
        return error


def _here(
    one: Callable[..., Found], rooms: Sequence[Room], motions: Sequence[Any], done: Any
) -> list[Found]:
    found = []
    for room, some in zip(rooms, motions, strict=True):
        found.append(one(room, some))
        done(1)
    return found


def _there(
    client: Any, one: Callable[..., Found], rooms: Sequence[Room], motions: Sequence[Any], done: Any
) -> list[Found]:
    """On a client's workers, to which the motions of each floor go once."""
    from distributed import as_completed

    kinds = {id(some): some for some in motions}
    sent = {key: client.scatter([some], broadcast=True)[0] for key, some in kinds.items()}
    futures = [
        client.submit(one, room, sent[id(some)], pure=False)
        for room, some in zip(rooms, motions, strict=True)
    ]
    for _ in as_completed(futures):  # type: ignore[no-untyped-call]
        done(1)
    found: list[Found] = client.gather(futures)
    return found
