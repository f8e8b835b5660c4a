"""The file of a room: a TOML table of its outline, and one for each door, place and thing.

    name = "Room 12"
    north_deg = 20                        # direction of north, clockwise from up
    outline_m = [[0, 0], [5, 0], [5, 4], [0, 4]]
    way_m = 0.8                           # how wide a way out has to be
    scatter_m = 0.3                       # how far the contents of what falls lie around it

    [[door]]
    name = "door"
    at_m = [4.2, 0]                       # the middle of its opening, on the outline
    width_m = 0.9
    swing = "inward"                      # outward, sliding
    hinge = "left"                        # right, seen from inside
    exit = true

    [[place]]
    name = "bed"
    kind = "bed"                          # desk, turning (of a wheelchair), corridor
    at_m = [1.0, 3.0]                     # its middle
    size_m = [0.95, 2.1]                  # along x and y
    turned_deg = 0                        # clockwise
    people = 1                            # on an average

    [[thing]]
    name = "bookcase"
    at_m = [3.0, 3.84]                    # the middle of its base
    facing_deg = 180                      # to where its front looks, clockwise from north
    depth_m = 0.3
    width_m = 0.9
    height_m = 1.8
    on = ""                               # the name of the thing on which it stands

A thing takes what a row of an inventory takes, by the names of its columns, but no walls: these are
those of the room.
"""

from __future__ import annotations

import math
from pathlib import Path

from shaketable.errors import Fault, quoted, refusal
from shaketable.inventory.columns import understood
from shaketable.inventory.header import columns_of
from shaketable.inventory.item import Item
from shaketable.inventory.rows import item_of
from shaketable.inventory.told import warn_of_hints
from shaketable.language import tell
from shaketable.rooms.faults import faults_of
from shaketable.rooms.room import (
    WAY,
    Door,
    Hinge,
    Place,
    PlaceKind,
    Point,
    Room,
    Swing,
    Thing,
    placed_item,
)
from shaketable.tables.sheet import Cell, Sheet
from shaketable.toml_file import TomlFile, TomlTable, is_number
from shaketable.units import radians

ROOM = ("name", "north_deg", "outline_m", "floor", "way_m", "scatter_m", "door", "place", "thing")
DOOR = ("name", "at_m", "width_m", "swing", "hinge", "exit")
PLACE = ("name", "kind", "at_m", "size_m", "turned_deg", "people")
OWN = ("at_m", "on")  # of a thing; all else is a column of an inventory
FARTHEST = 1000.0  # m: no room is larger
MOST_PEOPLE = 1000.0


def read_room(path: str | Path, *, check: bool = True) -> Room:
    """Read a room from a TOML file.

    Args:
        path: of the file.
        check: whether faults of the plan, such as things in walls, are errors as well.

    Raises:
        InputError: the file cannot be read, or lists its faults, each with its line.
    """
    file = TomlFile(Path(path))
    room = _room(file)
    warn_of_hints(file.path, [thing.item for thing in room.things if not thing.on])
    wrong = [Fault(file.path, "", each.where, "plan", each.text) for each in faults_of(room)]
    if check and wrong:
        raise refusal(wrong)
    return room


def _room(file: TomlFile) -> Room:
    """The room of a file.

    Raises:
        InputError: all faults of its tables.
    """
    top = TomlTable(file, file.table)
    top.accept(ROOM)
    outline = _points(top, "outline_m")
    north = top.number_from("north_deg", None, -360.0, 360.0)
    way = top.number_from("way_m", WAY, 0.3, 3.0)
    scatter = top.number_from("scatter_m", 0.0, 0.0, 5.0)
    doors = [_door(each) for each in file.tables("door")]
    places = [_place(each) for each in file.tables("place")]
    things = _things(file)
    names = [each.name for each in (*doors, *places, *things) if each]
    for name in sorted({name for name in names if names.count(name) > 1}):
        twice = tell("{name} is there twice; give each its own", name=quoted(name))
        file.note("", "name", twice)
    file.require()
    assert way is not None
    assert scatter is not None
    return Room(
        name=top.text("name", file.path.stem),
        outline=tuple(outline),
        doors=tuple(each for each in doors if each),
        places=tuple(each for each in places if each),
        things=tuple(things),
        north=None if north is None else radians(north),
        floor=top.text("floor", ""),
        way=way,
        scatter=scatter,
    )


def _door(table: TomlTable) -> Door | None:
    table.accept(DOOR)
    at, width = _point(table, "at_m"), table.number_from("width_m", 0.9, 0.3, 10.0)
    swing = table.word("swing", Swing, Swing.INWARD)
    hinge = table.word("hinge", Hinge, Hinge.LEFT)
    leads_out = table.yes("exit", True)
    if at is None or width is None or swing is None or hinge is None:
        return None
    name = table.text("name", "") or named_door(table.number)
    return Door(name=name, at=at, width=width, swing=swing, hinge=hinge, exit=leads_out)


def _place(table: TomlTable) -> Place | None:
    table.accept(PLACE)
    at, size = _point(table, "at_m"), _point(table, "size_m", least=0.1)
    kind = table.word("kind", PlaceKind, None)
    turned = table.number_from("turned_deg", 0.0, -360.0, 360.0)
    people = table.number_from("people", 0.0, 0.0, MOST_PEOPLE)
    if at is None or size is None or kind is None or turned is None or people is None:
        return None
    name = table.text("name", "") or named_place(kind, table.number)
    return Place(name=name, kind=kind, at=at, size=size, turned=radians(turned), people=people)


def named_door(number: int) -> str:
    """What a door without a name is called, the number-th from 0."""
    return f"door {number + 1}"


def named_place(kind: str, number: int) -> str:
    """What a place without a name is called."""
    return f"{kind} {number + 1}"


def _things(file: TomlFile) -> list[Thing]:
    """The things, each read as a row of an inventory."""
    tables = file.tables("thing")
    items = [_item(table) for table in tables]
    names = {item.name for item in items if item}
    found = []
    for table, item in zip(tables, items, strict=True):
        at, on = _point(table, "at_m"), table.text("on", "")
        if on and (on not in names or (item and on == item.name)):
            table.fault("on", tell("no other thing is called {name}", name=quoted(on)))
        if item is not None and at is not None:
            found.append(Thing(item=placed_item(item), at=at, on=on))
    return found


def _item(table: TomlTable) -> Item | None:
    file, keys = table.file, [key for key in table.table if key not in OWN]
    cells, header = [], []
    for key in keys:
        value = table.table[key]
        column = understood(Cell(key, ""))
        if column is not None and column.meaning in ("wall", "wall_gap", "wall_side"):
            table.fault(key, tell("the plan says where walls are; leave it out"))
            return None
        if isinstance(value, (dict, list)):
            table.fault(key, tell("expected a number or text, found {value!r}", value=value))
            return None
        number = is_number(value)
        word = {True: "yes", False: "no"}[value] if isinstance(value, bool) else str(value)
        where = table.line(key)
        row = int(where.split()[-1]) if where else 0
        header.append(Cell(key, where, row))
        cells.append(Cell(word.strip(), where, row, number))
    if not cells:
        table.fault("name", tell("is empty; it is needed for every object"))
        return None
    sheet = Sheet(file.path, "TOML", [header, cells])
    columns, faults = columns_of(sheet, header, [cells])
    for head, column in zip(header, columns, strict=True):
        if column is None and not faults:
            faults = [sheet.fault(head, "column", tell("unknown column"), head.text)]
    item = None
    if not faults:
        read = item_of(sheet, columns, cells, accept_sizes=False)
        faults, item = [*read.faults, *read.missing], read.item
    file.faults += faults
    return item


def _point(table: TomlTable, key: str, least: float = -FARTHEST) -> Point | None:
    """Two numbers; None if they are not."""
    value = table.table.get(key)
    if not _is_point(value, least):
        table.fault(
            key,
            tell("expected two numbers in metres, as [1.5, 2], found {value!r}", value=value),
        )
        return None
    assert isinstance(value, list)
    return (float(value[0]), float(value[1]))


def _points(table: TomlTable, key: str) -> list[Point]:
    """Three points or more; none if they are not."""
    value = table.table.get(key)
    if (
        not isinstance(value, list)
        or len(value) < 3
        or not all(_is_point(each, -FARTHEST) for each in value)
    ):
        table.fault(
            key,
            tell(
                "expected three corners or more in metres, as [[0, 0], [4, 0], [4, 3]], found "
                "{value!r}",
                value=value,
            ),
        )
        return []
    return [(float(x), float(y)) for x, y in value]


def _is_point(value: object, least: float) -> bool:
    if not isinstance(value, list) or len(value) != 2 or not all(is_number(each) for each in value):
        return False
    return all(least <= float(each) <= FARTHEST and math.isfinite(each) for each in value)
