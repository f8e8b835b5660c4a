"""A row of an inventory, and the body that stands for it."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from shaketable.body import SIZES, Body
from shaketable.errors import quoted
from shaketable.inputs import NUMBER
from shaketable.inventory.castors import speaks_of_castors
from shaketable.inventory.columns import ANSWERS, LENGTHS, Column
from shaketable.inventory.item import Castors, Item
from shaketable.inventory.sheet import LONGEST_TEXT, Cell, Sheet

NUMBERS = (*LENGTHS, "mass", "eccentricity", "quantity")
MOST_OBJECTS = 1_000_000  # of one kind
FURNITURE = (0.02, 5.0)  # m: sizes beyond these are hardly in metres

YES_OR_NO = {
    **dict.fromkeys(("yes", "y", "true", "1", "x"), True),
    **dict.fromkeys(("", "no", "n", "false", "0", "-"), False),
}
CASTORS = {
    **dict.fromkeys(("none", "no", "-"), Castors.NONE),
    "free": Castors.FREE,
    "locked": Castors.LOCKED,
}
MOST_CRITICAL = 5

_NUMBER = re.compile(NUMBER, re.ASCII)
_COMMA = re.compile(r"[-+]?\d*,\d+")


def item_of(
    sheet: Sheet, columns: list[Column | None], row: list[Cell], *, accept_sizes: bool
) -> tuple[list[str], Item | None]:
    """The faults of a row, and its item if it has none.

    Args:
        sheet: where the row stands.
        columns: what its cells mean.
        row: its cells.
        accept_sizes: whether sizes may lie outside FURNITURE.
    """
    cells = {
        column.meaning: (cell, column) for column, cell in zip(columns, row, strict=False) if column
    }
    faults = _texts(sheet, columns, row)
    numbers: dict[str, float] = {}
    for meaning, (cell, column) in cells.items():
        if meaning in NUMBERS and cell.text:
            fault, number = _number(sheet, cell, column)
            if fault:
                faults.append(fault)
            else:
                numbers[meaning] = number
    text = {meaning: cell.text for meaning, (cell, _) in cells.items()}
    faults += [
        sheet.fault(cell, f"expected {accepted}, found {quoted(cell.text)}", column.cell.text)
        for meaning, (cell, column) in cells.items()
        if (accepted := _unknown_word(meaning, cell.text))
    ]
    headers = {column.meaning: column.cell.text for column in columns if column}
    empty = [need for need in ("name", "height") if need not in cells or not cells[need][0].text]
    base = [size for size in ("depth", "width") if size in headers]
    if not any(size in cells and cells[size][0].text for size in base):
        empty.append(base[0])
    faults += [
        sheet.fault(row[0], "is empty; it is needed for every object", headers[need])
        for need in empty
    ]
    faults += [
        sheet.fault(row[0], message, headers[meaning])
        for meaning, message in ([] if faults else _contradictions(numbers))
    ]
    faults += [] if faults or accept_sizes else _implausible(sheet, cells, numbers)
    if faults:
        return faults, None
    return [], _item(numbers, text)


def _unknown_word(meaning: str, text: str) -> str:
    """What is accepted in a cell of words, "" if its text is."""
    word = text.lower()
    if meaning in ANSWERS and word not in YES_OR_NO:
        return "yes or no"
    if meaning == "castors" and word not in ("", *CASTORS):
        return "none, free or locked"
    if meaning == "critical" and _critical(word) is None:
        return f"yes, no or a whole number from 1 to {MOST_CRITICAL}"
    return ""


def _critical(word: str) -> int | None:
    """0 to MOST_CRITICAL, None for a word that is neither; 1 is the least, and no "yes"."""
    if word.isdecimal() and word.isascii():
        return int(word) if int(word) <= MOST_CRITICAL else None
    answer = YES_OR_NO.get(word)
    return None if answer is None else MOST_CRITICAL * answer


def _texts(sheet: Sheet, columns: list[Column | None], row: list[Cell]) -> list[str]:
    """Faults of a row's cells as texts."""
    faults = [
        sheet.fault(cell, f"has more cells than the header has columns: {quoted(cell.text)}")
        for cell in row[len(columns) :]
        if cell.text
    ][:1]
    faults += [
        sheet.fault(
            cell,
            f"has {len(cell.text):,} characters; at most {LONGEST_TEXT:,}",
            column.cell.text if column else "",
        )
        for column, cell in zip(columns, row, strict=False)
        if len(cell.text) > LONGEST_TEXT
    ]
    return faults


def _number(sheet: Sheet, cell: Cell, column: Column) -> tuple[str, float]:
    """The fault of a cell, "" if it has none, and its number, a length in metres."""
    text, header = cell.text, column.cell.text
    if sheet.decimal_comma and _COMMA.fullmatch(text):
        text = text.replace(",", ".")
    elif _COMMA.fullmatch(text):
        return sheet.fault(
            cell,
            f"found {quoted(text)}: commas separate cells here; write a point, or separate cells "
            "by semicolons",
            header,
        ), math.nan
    number = float(text.upper().replace("D", "E")) if _NUMBER.fullmatch(text) else math.nan
    if not (math.isfinite(number) and number > 0.0):
        return sheet.fault(
            cell, f"expected a positive number, found {quoted(cell.text)}", header
        ), math.nan
    if column.unit:
        number *= column.factor
    if column.meaning in LENGTHS and not SIZES[0] <= number <= SIZES[1]:
        return sheet.fault(
            cell,
            f"must lie between {SIZES[0]:g} and {SIZES[1]:g} m, found {number:g} m",
            header,
        ), math.nan
    return "", number


def size_of(sheet: Sheet, cell: Cell, column: Column) -> float:
    """The length in a cell without faults [m]."""
    return _number(sheet, cell, column)[1]


def _contradictions(numbers: Mapping[str, float]) -> list[tuple[str, str]]:
    """What a row's numbers cannot be, or cannot be together: which, and why."""
    faults = []
    quantity = numbers.get("quantity", 1.0)
    if quantity != int(quantity):
        faults.append(("quantity", f"expected a whole number, found {quantity:g}"))
    elif quantity > MOST_OBJECTS:
        faults.append(("quantity", f"found {quantity:g}; at most {MOST_OBJECTS:,} accepted"))
    eccentricity = numbers.get("eccentricity", 0.5)
    if eccentricity >= 1.0:
        faults.append(
            (
                "eccentricity",
                "must lie between 0 and 1, where the centre of gravity is inside the base; found "
                f"{eccentricity:g}",
            )
        )
    base = numbers.get("depth", numbers.get("width", 0.0))
    length = numbers.get("support_length", math.inf)
    if length < base:
        faults.append(
            (
                "support_length",
                f"found {length:g} m, shorter than the base of {base:g} m that stands on it",
            )
        )
    cg_height, height = numbers.get("cg_height", 0.0), numbers["height"]
    if cg_height >= height:
        faults.append(
            ("cg_height", f"{cg_height:g} m is not inside the body of height {height:g} m")
        )
    radius = numbers.get("gyration_radius", 0.0)
    if not faults and radius > (most := _largest_gyration_radius(base, numbers)):
        faults.append(
            (
                "gyration_radius",
                f"found {radius:g} m; a body within its base and height with this centre of "
                f"gravity has at most {most:.3g} m",
            )
        )
    return faults


def _implausible(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], numbers: Mapping[str, float]
) -> list[str]:
    """Sizes that no furniture has, with the unit that they may be in."""
    faults = []
    for meaning in ("depth", "width", "height"):
        size = numbers.get(meaning)
        if size is None or FURNITURE[0] <= size <= FURNITURE[1]:
            continue
        cell, column = cells[meaning]
        likely = [
            f"{size / column.factor * factor:g} m, if it is in {unit}"
            for unit, factor in (("cm", 0.01), ("mm", 0.001), ("m", 1.0))
            if unit != column.unit and FURNITURE[0] <= size / column.factor * factor <= FURNITURE[1]
        ]
        would = f" (it would be {' and '.join(likely)})" if likely else ""
        message = f"{size:g} m is no size of furniture{would}"
        faults.append(sheet.fault(cell, message, column.cell.text))
    return faults


def _item(numbers: Mapping[str, float], text: Mapping[str, str]) -> Item:
    """The item of a row without faults.

    Eccentricity, radius of gyration and support length are given front to back, and hold in no
    other direction.
    """
    depth, width = numbers.get("depth"), numbers.get("width")
    heights = {key: numbers[key] for key in ("height", "cg_height") if key in numbers}
    base = width if depth is None else depth
    assert base is not None
    sideways = None if depth is None or width is None else _body(width, heights, text["name"])
    castors = CASTORS.get(text.get("castors", "").lower())
    if castors is None:
        told = speaks_of_castors(text["name"], text.get("note", ""))
        castors = Castors.UNKNOWN if told else Castors.NONE
    answers = {name: YES_OR_NO[text.get(name, "").lower()] for name in ANSWERS}
    return Item(
        body=_body(base, numbers, text["name"]),
        height=numbers["height"],
        sideways=sideways,
        depth_known=depth is not None,
        support_length=numbers.get("support_length"),
        castors=castors,
        mass=numbers.get("mass"),
        quantity=int(numbers.get("quantity", 1.0)),
        floor=text.get("floor", ""),
        location=text.get("location", ""),
        note=text.get("note", ""),
        critical=_critical(text.get("critical", "").lower()) or 0,
        **answers,
    )


def _body(base: float, numbers: Mapping[str, float], name: str) -> Body:
    """The body on a base [m]: a uniform rectangle as far as the row gives no other numbers."""
    height = numbers["height"]
    uniform = math.hypot(base, height) / math.sqrt(12)
    return Body(
        width=base,
        cg_height=numbers.get("cg_height", height / 2),
        left=numbers.get("eccentricity", 0.5) * base,
        gyration_radius=numbers.get(
            "gyration_radius", min(uniform, _largest_gyration_radius(base, numbers))
        ),
        name=name,
    )


def _largest_gyration_radius(base: float, numbers: Mapping[str, float]) -> float:
    """The largest of all bodies in the rectangle with this centre of gravity: all mass in corners.

    i² <= h (H - h) + b_L b_R (Bhatia & Davis 2000, in each direction).
    """
    height = numbers["height"]
    cg_height = numbers.get("cg_height", height / 2)
    eccentricity = numbers.get("eccentricity", 0.5)
    return math.sqrt(cg_height * (height - cg_height) + eccentricity * (1 - eccentricity) * base**2)
