"""The sheet of a workbook that describes the building: a word, and beside it what is so."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence

from shaketable.errors import Fault, InputError, named, quoted, refusal, remark
from shaketable.inputs import number_of
from shaketable.inventory.item import Item
from shaketable.inventory.vocabulary import heading, plain, words_of
from shaketable.language import tell
from shaketable.tables import Cell, Sheet, read_sheet, with_a_point

log = logging.getLogger(__name__)

MOST_NAMED = 5
#: What a building's file calls what the sheet says.
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
        InputError: structure or storeys alone, something twice, or what is neither a number nor a
            known word.
    """
    title = next((each for each in objects.sheets if heading(each) in titles("building")), None)
    if title is None or title == objects.name:
        return None
    others = {each.strip().lower() for each in objects.sheets}
    sheet = read_sheet(
        objects.path, title, lambda _: False, sheet=title, strict=False, known=others
    )
    described: dict[str, object] = {}
    faults: list[Fault] = []
    known, unread = _by_meaning(sheet, faults)
    for meaning, cell in known.items():
        found, wrong = _value(sheet, meaning, cell)
        if wrong:
            faults.append(sheet.fault(cell, "building", wrong, title))
        else:
            described[KEYS[meaning]] = found
    needed = [each for each in NEEDED if each in described]
    if not faults and described.keys() - {"name"} and len(needed) < len(NEEDED):
        text = tell("the building's sheet does not say both storeys and structure; both are needed")
        faults.append(Fault(objects.path, "", title, "building", text))
    if faults:
        raise refusal(faults)
    if unread:
        text = tell(
            "of the sheet {sheet} is not understood, and not used: {rows}",
            sheet=quoted(title),
            rows=named([quoted(each) for each in unread], MOST_NAMED),
        )
        log.warning(remark(objects.path, text))
    return described if needed else None


def _by_meaning(sheet: Sheet, faults: list[Fault]) -> tuple[dict[str, Cell], list[str]]:
    """The cell beside each word that is known, and first cells of other rows that say anything."""
    found: dict[str, Cell] = {}
    unread = []
    for row in sheet.filled():
        meaning = words_of("building").get(plain(row[0].text).rstrip(":"))
        answer = row[1] if len(row) > 1 else None
        if meaning is None:
            unread.append(next(cell.text or cell.where for cell in row if cell.text or cell.wrong))
        elif answer is not None and meaning in found:
            text = tell("is said twice: {found}", found=quoted(row[0].text))
            faults.append(sheet.fault(answer, "building", text, sheet.name))
        elif answer is not None and answer.wrong:
            faults.append(sheet.fault(answer, "building", answer.wrong, sheet.name))
        elif answer is not None and answer.text:
            found[meaning] = answer
    return found, unread


def require_one_building(items: Sequence[Item]) -> None:
    """InputError where objects stand in several buildings, of which one is described."""
    buildings = sorted({item.building for item in items if item.building})
    if len(buildings) > 1:
        raise InputError(
            tell(
                "one building is described, and the list's column building has {count} ({names}): "
                "give the objects of one alone, or use shaketable scenario or hazard, which take "
                "several",
                count=len(buildings),
                names=named(buildings, MOST_NAMED),
            )
        )


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
