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
from shaketable.rooms.room import Room, Thing, placed_item
from shaketable.rooms.shapes import before_wall, is_beside

log = logging.getLogger(__name__)

MOST_NAMED = 10
BESIDE = 0.01  # m: from a wall, where a row gives no distance


def furnished(room: Room, items: Sequence[Item], path: str | Path = "") -> Room:
    """A room with the things of an inventory whose location is the room's name.

    Rows of the room without a place (x_m, y_m) are not in its plan: a warning names them. What has
    the number of a wall stands before it, at the place on it that is nearest: its back to it where
    nothing else is said, with the row's own distance or BESIDE.

    Args:
        room: with an outline, doors and places, and things or none.
        items: of an inventory.
        path: of its file, as faults name it.

    Raises:
        InputError: no row is of this room and has a place, several pieces are at one place, or the
            room has no wall of that number.
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
        walls = item.surroundings.walls if item.surroundings else ()
        around = item.surroundings and replace(item.surroundings, walls=())  # the plan has them
        assert item.position is not None
        stands = replace(placed_item(item), body=body, surroundings=around or None)
        thing = Thing(item=stands, at=item.position)
        if item.wall:
            number = _wall_number(room, item, path)
            if walls and walls[0].azimuth:
                raise refusal(
                    [
                        _at_wall(
                            path,
                            item,
                            tell(
                                "stands with its back to the wall of the "
                                "plan: leave wall_side out, or give facing_deg in place of wall"
                            ),
                        )
                    ]
                )
            thing = before_wall(room, thing, number, walls[0].gap if walls else BESIDE)
            if not is_beside(room, thing, number):
                text = tell("{found} ends before the place that x_m and y_m tell", found=item.wall)
                raise refusal([_at_wall(path, item, text)])
        things.append(thing)
    return replace(room, things=(*room.things, *things))


def _wall_number(room: Room, item: Item, path: str | Path) -> int:
    """The number of the wall before which an item stands, from 0."""
    count = len(room.outline)
    if item.wall.isdecimal() and 1 <= int(item.wall) <= count:
        return int(item.wall) - 1
    text = tell(
        "expected the number of a wall, from 1 (from the first corner of outline_m to the second) "
        "to {count}, found {found}",
        count=count,
        found=quoted(item.wall),
    )
    raise refusal([_at_wall(path, item, text)])


def _at_wall(path: str | Path, item: Item, text: str) -> Fault:
    return Fault(path, tell("row {row}", row=item.row), "wall", "room", text)


def _of_several(path: str | Path, item: Item) -> Fault:
    text = tell(
        "is of {count:,} pieces at one place: give each a row of its own", count=item.quantity
    )
    where = tell("row {row}", row=item.row)
    return Fault(path, where, "quantity", "room", text)
