"""The sheet of a workbook that describes the building: a word, and beside it what is so."""

from __future__ import annotations

import math
from collections.abc import Mapping

from shaketable.errors import Fault, quoted, refusal
from shaketable.inputs import number_of
from shaketable.inventory.vocabulary import heading, plain, words_of
from shaketable.language import tell
from shaketable.tables import Cell, Sheet, read_sheet, with_a_point

#: What a building's file calls what the sheet says, and whether it is a number.
KEYS = {
    "name": "name",
    "storeys": "storeys",
    "structure": "structure",
    "storey_height": "storey_height_m",
}
NEEDED = ("storeys", "structure")


def titles(kind: str) -> set[str]:
    """Names of the sheets of a kind, as names are compared: objects, columns or building."""
    return {heading(word) for word, meaning in words_of("sheets").items() if meaning == kind}


def building_said(objects: Sheet) -> Mapping[str, object] | None:
    """What a workbook says of its building, as its file would; None if it says nothing.

    Args:
        objects: the sheet of the workbook's objects.

    Raises:
        InputError: structure or storeys alone, or what is neither a number nor a known word.
    """
    title = next((each for each in objects.sheets if heading(each) in titles("building")), None)
    if title is None or title == objects.name:
        return None
    others = {each.strip().lower() for each in objects.sheets}
    sheet = read_sheet(
        objects.path, title, lambda _: False, sheet=title, strict=False, known=others
    )
    cells = _by_meaning(sheet)
    described: dict[str, object] = {}
    faults: list[Fault] = []
    for meaning, cell in cells.items():
        found, fault = _value(sheet, meaning, cell)
        if fault:
            faults.append(sheet.fault(cell, "building", fault, title))
        elif found is not None:
            described[KEYS[meaning]] = found
    some = [each for each in NEEDED if each in described]
    if not faults and len(some) == 1:
        text = tell("the building's sheet says storeys or structure alone; both are needed")
        faults.append(Fault(objects.path, "", title, "building", text))
    if faults:
        raise refusal(faults)
    return described if some else None


def _by_meaning(sheet: Sheet) -> dict[str, Cell]:
    """The cell beside each word that is known."""
    found = {}
    for row in sheet.filled():
        meaning = words_of("building").get(plain(row[0].text).rstrip(":"))
        if meaning and len(row) > 1 and row[1].text:
            found[meaning] = row[1]
    return found


def _value(sheet: Sheet, meaning: str, cell: Cell) -> tuple[object, str]:
    """What a cell says, or what is wrong with it."""
    if meaning == "name":
        return cell.text, ""
    if meaning == "structure":
        known = words_of("structures").get(plain(cell.text))
        accepted = ", ".join(dict.fromkeys(words_of("structures").values()))
        text = tell(
            "expected {accepted}, found {found}", accepted=accepted, found=quoted(cell.text)
        )
        return known, "" if known else text
    text, fault = (cell.text, "") if cell.typed else with_a_point(sheet, cell.text)
    number = number_of(text)
    if not fault and not 0.0 < number < math.inf:
        fault = tell("expected a positive number, found {found}", found=quoted(cell.text))
    if not fault and meaning == "storeys":
        whole = number == int(number)
        fault = (
            "" if whole else tell("expected a whole number, found {quantity:g}", quantity=number)
        )
        return int(number), fault
    return number, fault
