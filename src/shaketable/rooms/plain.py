"""The tables of a room's file with the names of columns and the units that an editor of plans uses.

An inventory has many names and units for one thing ("Höhe [cm]"); here each has one (`height_m`),
so that a program need not know them all. What it does not know is kept as it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shaketable.inventory.answers import YES_OR_NO
from shaketable.inventory.columns import ANSWERS, FORCES, LENGTHS, Column, understood
from shaketable.inventory.numbers import number_in
from shaketable.rooms.read import OWN, named_door, named_place
from shaketable.rooms.room import Room
from shaketable.tables.sheet import Cell, Sheet
from shaketable.toml_file import is_number
from shaketable.units import degrees

SUFFIXES = {**dict.fromkeys(LENGTHS, "m"), **dict.fromkeys(FORCES, "n"), "mass": "kg"}


def plain(table: Mapping[str, Any], room: Room | None = None) -> dict[str, Any]:
    """The table of a whole file: doors, places and things in one spelling, all else as it is.

    Args:
        table: as it was read.
        room: what it means, if it has no faults: what its cells write with words and units
            ("35 cm") is then given as numbers.
    """
    found = dict(table)
    for section in ("door", "place", "thing"):
        some = table.get(section, [])
        if isinstance(some, list) and all(isinstance(each, dict) for each in some):
            found |= {section: [_told(section, k, each, room) for k, each in enumerate(some)]}
    return {key: value for key, value in found.items() if value != []}


def _told(section: str, number: int, table: dict[str, Any], room: Room | None) -> dict[str, Any]:
    if section == "door":
        return {**table, "name": table.get("name") or named_door(number)}
    if section == "place":
        name = table.get("name") or named_place(str(table.get("kind", "place")), number)
        return {**table, "name": name}
    return _thing(table) | (_numbers(table, room, number) if room else {})


def _thing(table: Mapping[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in table.items():
        column = None if key in OWN else understood(Cell(key, ""))
        name, told = (key, value) if column is None else _plain(column, key, value)
        found[name if name not in found else key] = told
    return found


def _plain(column: Column, key: str, value: Any) -> tuple[str, Any]:
    meaning = column.meaning
    if meaning == "facing":
        return "facing_deg", value
    if meaning in ANSWERS and isinstance(value, str) and value.lower() in YES_OR_NO:
        return meaning, "yes" if YES_OR_NO[value.lower()] else "no"
    suffix = SUFFIXES.get(meaning)
    if suffix is None:
        return meaning, value
    if is_number(value):
        return f"{meaning}_{suffix}", value * column.factor
    read = number_in(Sheet(Path(), "", []), Cell(str(value), ""), column)  # as the file is read
    return f"{meaning}_{suffix}", value if read.fault else read.number


def _numbers(table: Mapping[str, Any], room: Room, number: int) -> dict[str, Any]:
    """The sizes of a thing that its cells write as texts."""
    item = room.things[number].item
    known = {
        "height_m": item.height,
        "depth_m": item.body.base,
        "width_m": item.sideways.base if item.sideways else item.body.base,
        "diameter_m": item.body.base,
        "mass_kg": item.mass,
        "facing_deg": None if item.facing is None else degrees(item.facing),
    }
    told = _thing(table)
    return {key: value for key, value in known.items() if isinstance(told.get(key), str)}
