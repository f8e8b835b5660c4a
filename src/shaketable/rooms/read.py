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
import re
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import Any, TypeVar

from shaketable.errors import Fault, quoted, refusal
from shaketable.inventory.columns import columns_of
from shaketable.inventory.item import Item
from shaketable.inventory.read import warn_of_hints
from shaketable.inventory.rows import item_of
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
)
from shaketable.tables.sheet import Cell, Sheet
from shaketable.toml_file import TomlFile, is_number
from shaketable.units import radians

ROOM = ("name", "north_deg", "outline_m", "floor", "way_m", "scatter_m", "door", "place", "thing")
DOOR = ("name", "at_m", "width_m", "swing", "hinge", "exit")
PLACE = ("name", "kind", "at_m", "size_m", "turned_deg", "people")
OWN = ("at_m", "on")  # of a thing; all else is a column of an inventory
FARTHEST = 1000.0  # m: no room is larger
MOST_PEOPLE = 1000.0
_WALLS = re.compile(r"wall[ _]?(gap|side)", re.IGNORECASE)

E = TypeVar("E", bound=StrEnum)


def read_room(path: str | Path, *, check: bool = True) -> Room:
    """The room that a TOML file describes.

    Args:
        path: of the file.
        check: whether faults of the plan, such as things in walls, are errors as well.

    Raises:
        InputError: the file cannot be read, or lists its faults, each with its line.
    """
    file = TomlFile(Path(path))
    reader = _Reader(file)
    room = reader.room()
    if reader.faults:
        raise refusal(reader.faults)
    assert room is not None
    warn_of_hints(file.path, [thing.item for thing in room.things if not thing.on])
    wrong = [Fault(file.path, "", each.where, "plan", each.text) for each in faults_of(room)]
    if check and wrong:
        raise refusal(wrong)
    return room


class _Reader:
    """Reads the tables of a room's file, and notes their faults."""

    def __init__(self, file: TomlFile) -> None:
        self.file, self.faults = file, list[Fault]()
        self._lines = file.path.read_text(encoding="utf-8-sig").splitlines()

    def room(self) -> Room | None:
        """The room; None if something is wrong."""
        table = self.file.table
        top = _Table(self, "", 0, table)
        top.accept(ROOM)
        outline = top.points("outline_m")
        north = top.number("north_deg", None, -360.0, 360.0)
        way = top.number("way_m", WAY, 0.3, 3.0)
        scatter = top.number("scatter_m", 0.0, 0.0, 5.0)
        doors = [self._door(each) for each in self._tables("door", DOOR)]
        places = [self._place(each) for each in self._tables("place", PLACE)]
        things = self._things()
        names = [each.name for each in (*doors, *places, *things) if each]
        for name in sorted({name for name in names if names.count(name) > 1}):
            self.note(
                "", "name", tell("{name} is there twice; give each its own", name=quoted(name))
            )
        if self.faults or way is None or scatter is None:
            return None
        return Room(
            name=top.text("name", self.file.path.stem),
            outline=tuple(outline),
            doors=tuple(each for each in doors if each),
            places=tuple(each for each in places if each),
            things=tuple(things),
            north=None if north is None else radians(north),
            floor=top.text("floor", ""),
            way=way,
            scatter=scatter,
        )

    def note(self, where: str, key: str, text: str) -> None:
        """Note a fault."""
        self.faults.append(Fault(self.file.path, where, key, "field", text))

    def line_of(self, section: str, number: int, key: str) -> str:
        """Where a key of the number-th table of a name stands, "" if it is not found."""
        heads = [
            k
            for k, line in enumerate(self._lines)
            if re.match(rf"\s*\[\[\s*{section}\s*\]\]", line)
        ]
        first = heads[number] if section and number < len(heads) else 0
        for k in range(first, len(self._lines)):
            if k > first and section and self._lines[k].lstrip().startswith("["):
                break
            if re.match(rf"\s*{re.escape(key)}\s*=", self._lines[k]):
                return f"line {k + 1}"
        return f"line {first + 1}" if section else ""

    def _tables(self, section: str, accepted: Sequence[str]) -> list[_Table]:
        """The tables of a name, each with its keys looked at unless none are named."""
        found = self.file.table.get(section, [])
        if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
            self.note("", section, tell("must be tables, each begun by [[{name}]]", name=section))
            return []
        tables = [_Table(self, section, k, each) for k, each in enumerate(found)]
        for table in tables if accepted else ():
            table.accept(accepted)
        return tables

    def _door(self, table: _Table) -> Door | None:
        at, width = table.point("at_m"), table.number("width_m", 0.9, 0.3, 10.0)
        swing = table.word("swing", Swing, Swing.INWARD)
        hinge = table.word("hinge", Hinge, Hinge.LEFT)
        leads_out = table.yes("exit", True)
        if at is None or width is None:
            return None
        name = table.text("name", f"door {table.number_of + 1}")
        return Door(name=name, at=at, width=width, swing=swing, hinge=hinge, exit=leads_out)

    def _place(self, table: _Table) -> Place | None:
        at, size = table.point("at_m"), table.point("size_m", least=0.1)
        kind = table.word("kind", PlaceKind, None)
        turned = table.number("turned_deg", 0.0, -360.0, 360.0)
        people = table.number("people", 0.0, 0.0, MOST_PEOPLE)
        if at is None or size is None or kind is None or turned is None or people is None:
            return None
        name = table.text("name", f"{kind} {table.number_of + 1}")
        turn = radians(turned)
        return Place(name=name, kind=kind, at=at, size=size, turned=turn, people=people)

    def _things(self) -> list[Thing]:
        """The things, each read as a row of an inventory."""
        tables = self._tables("thing", ())
        places = [(table.point("at_m"), table.text("on", "")) for table in tables]
        items = [self._item(table) for table in tables]
        names = {item.name for item in items if item}
        found = []
        for table, item, (at, on) in zip(tables, items, places, strict=True):
            if on and (on not in names or (item and on == item.name)):
                table.fault("on", tell("no other thing is called {name}", name=quoted(on)))
            if item is not None and at is not None:
                found.append(Thing(item=item, at=at, on=on))
        return found

    def _item(self, table: _Table) -> Item | None:
        keys = [key for key in table.table if key not in OWN]
        cells, header = [], []
        for key in keys:
            value = table.table[key]
            if _WALLS.match(key):
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
        sheet = Sheet(self.file.path, "TOML", [header, cells], False)
        columns, faults = columns_of(sheet, header)
        for head, column in zip(header, columns, strict=True):
            if column is None and not faults:
                faults = [sheet.fault(head, "column", tell("unknown column"), head.text)]
        if faults:
            self.faults += faults
            return None
        faults, item = item_of(sheet, columns, cells, accept_sizes=False)
        self.faults += faults
        return item


class _Table:
    """A table of a file, whose faults are told with their lines."""

    def __init__(
        self, reader: _Reader, section: str, number: int, table: Mapping[str, Any]
    ) -> None:
        self._reader, self._section = reader, section
        self.number_of, self.table = number, table

    def line(self, key: str) -> str:
        """Where a key stands."""
        return self._reader.line_of(self._section, self.number_of, key)

    def fault(self, key: str, text: str) -> None:
        """Note what is wrong with a key."""
        self._reader.note(self.line(key), key, text)

    def accept(self, keys: Sequence[str]) -> None:
        """Note the keys that are unknown."""
        for key in self.table.keys() - {*keys}:
            self.fault(key, tell("unknown; accepted: {accepted}", accepted=", ".join(keys)))

    def text(self, key: str, default: str) -> str:
        """A text."""
        value = self.table.get(key, default)
        if not isinstance(value, str):
            self.fault(key, tell("expected text, found {value!r}", value=value))
            return default
        return value.strip()

    def yes(self, key: str, default: bool) -> bool:
        """True or false."""
        value = self.table.get(key, default)
        if not isinstance(value, bool):
            self.fault(key, tell("expected true or false, found {value!r}", value=value))
            return default
        return value

    def number(self, key: str, default: float | None, least: float, most: float) -> float | None:
        """A number between two others."""
        value = self.table.get(key, default)
        if value is None:
            return None
        if not is_number(value) or not least <= value <= most:
            self.fault(
                key,
                tell(
                    "expected a number from {least:g} to {most:g}, found {value!r}",
                    least=least,
                    most=most,
                    value=value,
                ),
            )
            return None
        return float(value)

    def word(self, key: str, kinds: type[E], default: E | None) -> Any:
        """One of some words; None if it is none of them."""
        value = self.table.get(key, default)
        if value in list(kinds):
            return kinds(value)
        accepted = ", ".join(kinds)
        self.fault(
            key, tell("expected one of {accepted}, found {value!r}", accepted=accepted, value=value)
        )
        return None

    def point(self, key: str, least: float = -FARTHEST) -> Point | None:
        """Two numbers."""
        value = self.table.get(key)
        if not _is_point(value, least):
            self.fault(
                key,
                tell("expected two numbers in metres, as [1.5, 2], found {value!r}", value=value),
            )
            return None
        assert isinstance(value, list)
        return (float(value[0]), float(value[1]))

    def points(self, key: str) -> list[Point]:
        """Three points or more."""
        value = self.table.get(key)
        if (
            not isinstance(value, list)
            or len(value) < 3
            or not all(_is_point(each, -FARTHEST) for each in value)
        ):
            self.fault(
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
