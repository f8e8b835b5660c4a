"""The tables of a room's file with the names of columns and the units that an editor of plans uses.

An inventory has many names and units for one thing ("Höhe [cm]"); here each has one (`height_m`),
so that a program need not know them all. What it does not know is kept as it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from shaketable.inventory.columns import FORCES, LENGTHS, Column, understood
from shaketable.rooms.read import OWN
from shaketable.tables.sheet import Cell
from shaketable.toml_file import is_number

SUFFIXES = {**dict.fromkeys(LENGTHS, "m"), **dict.fromkeys(FORCES, "n"), "mass": "kg"}


def plain(table: Mapping[str, Any]) -> dict[str, Any]:
    """The table of a whole file: its things in one spelling, all else as it is."""
    things = table.get("thing", [])
    if not isinstance(things, list):
        return dict(table)
    told = [_thing(each) if isinstance(each, dict) else each for each in things]
    return {**table, "thing": told} if told else dict(table)


def _thing(table: Mapping[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in table.items():
        column = None if key in OWN else understood(Cell(key, ""))
        name, value = (key, value) if column is None else _plain(column, key, value)
        found[name if name not in found else key] = value
    return found


def _plain(column: Column, key: str, value: Any) -> tuple[str, Any]:
    meaning = column.meaning
    if meaning == "facing":
        return "facing_deg", value
    suffix = SUFFIXES.get(meaning)
    if suffix is None:
        return meaning, value
    if isinstance(value, str):  # "35" or "35 cm" is what a cell of a sheet may hold
        return key, value
    return f"{meaning}_{suffix}", value * column.factor if is_number(value) else value
