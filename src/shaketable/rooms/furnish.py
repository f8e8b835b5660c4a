"""Things of a room that stand in an inventory: rows with its name, and a place in its plan."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from shaketable.errors import Fault, named, quoted, refusal
from shaketable.inventory import Item
from shaketable.language import tell
from shaketable.rooms.room import Room, Thing

log = logging.getLogger(__name__)

MOST_NAMED = 10


def furnished(room: Room, items: Sequence[Item], path: str | Path = "") -> Room:
    """A room with the things of an inventory whose location is the room's name.

    Rows of the room without a place (x_m, y_m) are not in its plan: a warning names them.

    Args:
        room: with an outline, doors and places, and things or none.
        items: of an inventory.
        path: of its file, as faults name it.

    Raises:
        InputError: no row is of this room and has a place, or several pieces are at one place.
    """
    own = [item for item in items if item.location.casefold() == room.name.casefold()]
    placed = [item for item in own if item.position is not None]
    if not placed:
        text = tell(
            "no row of {room} has a place: give location (or room), x_m and y_m",
            room=quoted(room.name),
        )
        raise refusal([Fault(path, "", "", "room", text)])
    several = [item for item in placed if item.quantity != 1]
    if several:
        raise refusal([_of_several(path, item) for item in several])
    lost = [item.name for item in own if item.position is None]
    if lost:
        log.warning(
            "%s: %d rows of this room have no place (x_m, y_m): they are not shaken, and not known "
            "to be safe: %s", room.name, len(lost), named(lost, MOST_NAMED),
        )  # fmt: skip
    taken = {thing.name for thing in room.things} | {place.name for place in room.places}
    taken |= {door.name for door in room.doors}
    times = Counter(item.name for item in placed)
    things = []
    for item in placed:
        name = item.name
        if times[name] > 1 or name in taken:
            name = tell("{name} (row {row})", name=name, row=item.row)
        body = replace(item.body, name=name)
        around = item.surroundings and replace(item.surroundings, walls=())  # the plan has them
        assert item.position is not None
        stands = replace(item, body=body, surroundings=around or None)
        things.append(Thing(item=stands, at=item.position))
    return replace(room, things=(*room.things, *things))


def _of_several(path: str | Path, item: Item) -> Fault:
    text = tell(
        "is of {count:,} pieces at one place: give each a row of its own", count=item.quantity
    )
    where = tell("row {row}", row=item.row)
    return Fault(path, where, "quantity", "room", text)
