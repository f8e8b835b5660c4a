"""A row of an inventory, and the body that stands for it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from shaketable.body import Body
from shaketable.errors import Fault, quoted
from shaketable.inventory.answers import anchored_in, answer_in, castors_in
from shaketable.inventory.carriers import hangs_or_is_fixed, what_it_stands_on
from shaketable.inventory.cells import (
    cells_of,
    conflicts,
    in_unit_of_row,
    not_given,
    without_words,
)
from shaketable.inventory.columns import (
    ANSWERS,
    FORCES,
    LENGTHS,
    Column,
)
from shaketable.inventory.hints import mentions_castors, mentions_round
from shaketable.inventory.item import BaseShape, Castors, Item
from shaketable.inventory.left_out import taken_sizes
from shaketable.inventory.numbers import degrees_in, number_in
from shaketable.inventory.plausible import (
    BASES,
    contradictions,
    implausible,
    largest_gyration_radius,
)
from shaketable.inventory.row_words import criticality, unknown_word, without_what_is_not_read
from shaketable.inventory.shapes import SHAPES, against_shape
from shaketable.inventory.surroundings import with_surroundings
from shaketable.inventory.vocabulary import plain
from shaketable.language import tell, translated
from shaketable.tables.sheet import LONGEST_TEXT, Cell, Sheet
from shaketable.units import radians

NUMBERS = (*LENGTHS, *FORCES, "mass", "eccentricity", "quantity", "cost")
FULL_CIRCLE = 360.0
PLACES = {"latitude": 90.0, "longitude": 180.0}  # degrees, at most


class RowRead(NamedTuple):
    """What a row holds.

    Attributes:
        faults: why it cannot be used.
        item: its object, None with faults or without its sizes.
        missing: the sizes that it does not give, as faults; then the object is not assessed.
    """

    faults: list[Fault]
    item: Item | None = None
    missing: tuple[Fault, ...] = ()


def item_of(
    sheet: Sheet,
    columns: list[Column | None],
    row: list[Cell],
    *,
    accept_sizes: bool,
    unread: tuple[str, ...] = (),
    remarks: list[Fault] | None = None,
    catalogue: bool = False,
) -> RowRead:
    """The item of a row, or its faults, or the sizes that it does not give.

    With `remarks`, cells that are not needed and hold text in place of a number ("ca. 350", "?")
    or a word that is not known are taken as empty, and told there. Where that is a word that
    decides (castors, anchored, shape) nothing good is said of the object.

    Args:
        sheet: where the row stands.
        columns: what its cells mean.
        row: its cells.
        accept_sizes: whether sizes may lie outside FURNITURE.
        unread: headers of columns that may say castors, anchors or shapes, and are not understood.
        remarks: takes what is to be told; None to refuse such cells.
        catalogue: whether sizes that are left out are taken from the catalogue of common things.
    """
    cells, faults = in_unit_of_row(sheet, cells_of(columns, row))
    faults = [*_texts(sheet, columns, row), *faults, *conflicts(sheet, columns, row)]
    cells, words = without_words(cells)
    if remarks is not None:
        cells, more = without_what_is_not_read(sheet, cells, remarks)
        unread = (*unread, *more)
    numbers: dict[str, float] = {}
    across: list[str] = []
    for meaning, (cell, column) in cells.items():
        if meaning in NUMBERS and cell.text and not cell.wrong:
            read = number_in(sheet, cell, column)
            if read.fault:
                faults.append(read.fault)
                continue
            numbers[meaning] = read.number
            if read.across:
                across.append(meaning)
            if read.remark and remarks is not None:
                remarks.append(sheet.fault(cell, "range", read.remark, column.cell.text))
    faults += _place(sheet, cells, numbers)
    if "facing" in cells and cells["facing"][0].text:
        read = degrees_in(sheet, *cells["facing"], FULL_CIRCLE)
        faults += [read.fault] if read.fault else []
        numbers["facing"] = read.number
    text = {meaning: cell.text for meaning, (cell, _) in cells.items()}
    faults += [
        sheet.fault(
            cell,
            "word",
            tell("expected {accepted}, found {found}", accepted=accepted, found=quoted(cell.text)),
            column.cell.text,
        )
        for meaning, (cell, column) in cells.items()
        if (accepted := unknown_word(meaning, cell.text))
    ]
    headers = {meaning: column.cell.text for meaning, (_, column) in cells.items()}
    shape = SHAPES.get(plain(text.get("shape", "")))
    numbers = _with_diameter(numbers, across)
    if {"depth", "width"} <= numbers.keys() and cells["depth"][1].is_length:
        # length and width: the long side of furniture goes along its wall, whichever it is called
        numbers["depth"], numbers["width"] = sorted((numbers["depth"], numbers["width"]))
    filled = {meaning for meaning, (cell, _) in cells.items() if cell.text or cell.wrong}
    filled = _with_diameter(dict.fromkeys(filled, 0.0), across).keys() | set()
    is_round = shape is BaseShape.CYLINDER or (
        not text.get("shape") and mentions_round(text.get("name", ""))
    )
    missing = not_given(filled, set(headers), is_round=is_round)
    left_out = catalogue or bool(missing)
    usual = taken_sizes(text.get("name", ""), numbers, shape, filled) if left_out else None
    taken = usual if catalogue else None
    if taken:
        numbers, shape = taken.numbers, taken.shape
        filled = filled | {each.what for each in taken.assumed}
        missing = not_given(filled, set(headers), is_round=True)
    mend = ""
    if usual and not catalogue:
        mend = tell(
            "the catalogue has usual sizes of {thing}: --catalogue takes them",
            thing=quoted(usual.thing.key),
        )
    if "name" not in filled:
        text_of = tell("is empty; it is needed for every object")
        faults.append(sheet.fault(row[0], "empty", text_of, headers.get("name", "name")))
    lost = tuple(
        sheet.fault(
            cells[need][0] if need in words else row[0],
            "number" if need in words else "empty",
            tell("expected a positive number, found {found}", found=quoted(words[need]))
            if need in words
            else tell("is empty; it is needed for every object"),
            headers.get(need, need),
        )._replace(mend=mend)
        for need in sorted(missing, key=[*headers, *missing].index)
    )
    faults += [
        sheet.fault(row[0], "contradiction", message, headers.get(meaning, meaning))
        for meaning, message in (
            [] if faults or missing else [*contradictions(numbers), *against_shape(numbers, shape)]
        )
    ]
    faults += [] if faults or lost or accept_sizes else implausible(sheet, cells, numbers)
    if faults or lost:
        return RowRead(faults, missing=lost)
    one_size = "depth" in headers and "width" in numbers and "depth" not in numbers
    if one_size and is_round and remarks is not None and "diameter" not in numbers:
        told = tell("gives one size across of something round: it is taken as its diameter")
        remarks.append(sheet.fault(row[0], "round", told, text["name"]))
        shape = BaseShape.CYLINDER
    if "diameter" in numbers or shape is BaseShape.CYLINDER:
        base = next(numbers[size] for size in BASES if size in numbers)
        shape = BaseShape.CYLINDER
        numbers["depth"] = numbers["width"] = base
    item = _item(numbers, text, shape or BaseShape.BOX)
    if taken:
        rolls = item.castors is Castors.NONE and not text.get("castors") and taken.thing.castors
        item = replace(
            item,
            castors=Castors.UNKNOWN if rolls else item.castors,
            # the catalogue knows what is round, and a name may say that this one is, too
            may_be_round=item.shape is BaseShape.BOX
            and not text.get("shape")
            and mentions_round(item.name),
            assumed=taken.assumed,
            assumed_as=taken.thing.key,
        )
    item, wrong = with_surroundings(item, numbers, text)
    if wrong:
        return RowRead(
            [
                sheet.fault(
                    cells[meaning][0] if meaning in cells else row[0],
                    "contradiction",
                    message,
                    headers.get(meaning, meaning),
                )
                for meaning, message in wrong
            ]
        )
    said = (text.get("note", ""), text.get("location", ""), text.get("stands_on", ""))
    strapped = item.surroundings is not None and bool(item.surroundings.straps)
    on_castors = item.castors in (Castors.FREE, Castors.LOCKED, Castors.SOME)
    asked = not (text.get("anchored") or strapped or on_castors)
    hangs = asked and hangs_or_is_fixed(item.name, *said)
    return RowRead([], replace(item, row=row[0].row, unread=unread, hangs=hangs))


def _with_diameter(numbers: Mapping[str, float], across: Sequence[str]) -> dict[str, float]:
    """Numbers with a side that is said to be a diameter as one, if both sides say so as one."""
    sides = [side for side in across if side in ("depth", "width")]
    found = dict(numbers)
    if sides and len({found[side] for side in sides}) == 1:
        found["diameter"] = found[sides[0]]
        for side in sides:
            del found[side]
    return found


def _place(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], numbers: dict[str, float]
) -> list[Fault]:
    """Faults of a latitude and a longitude; without any, both are put among the numbers."""
    given = {meaning: cells[meaning] for meaning in PLACES if meaning in cells}
    filled = {meaning: pair for meaning, pair in given.items() if pair[0].text}
    if len(filled) == 1:
        ((meaning, (cell, column)),) = filled.items()
        other = next(name for name in PLACES if name != meaning)
        return [
            sheet.fault(cell, "place", translated(f"is given without a {other}"), column.cell.text)
        ]
    faults = []
    for meaning, (cell, column) in filled.items():
        read = degrees_in(sheet, cell, column, PLACES[meaning])
        if read.fault:
            faults.append(read.fault)
        else:
            numbers[meaning] = read.number
    return faults


def _texts(sheet: Sheet, columns: list[Column | None], row: list[Cell]) -> list[Fault]:
    """Faults of a row's cells as texts."""
    faults = [
        sheet.fault(
            cell,
            "more cells",
            tell("has more cells than the header has columns: {found}", found=quoted(cell.text)),
        )
        for cell in row[len(columns) :]
        if cell.text
    ][:1]
    faults += [
        sheet.fault(cell, "cell", cell.wrong, column.cell.text)
        for column, cell in zip(columns, row, strict=False)
        if column and cell.wrong
    ]
    faults += [
        sheet.fault(
            cell,
            "long",
            tell(
                "has {count:,} characters; at most {most:,}",
                count=len(cell.text),
                most=LONGEST_TEXT,
            ),
            column.cell.text if column else "",
        )
        for column, cell in zip(columns, row, strict=False)
        if len(cell.text) > LONGEST_TEXT
    ]
    return faults


def _item(numbers: Mapping[str, float], text: Mapping[str, str], shape: BaseShape) -> Item:
    """The item of a row without faults.

    Eccentricity, radius of gyration and support length are given front to back, and hold in no
    other direction.
    """
    depth, width = numbers.get("depth"), numbers.get("width")
    heights = {key: numbers[key] for key in ("height", "cg_height") if key in numbers}
    base = width if depth is None else depth
    assert base is not None
    sideways = None if depth is None or width is None else _body(width, heights, text["name"])
    castors = castors_in(text["castors"]) if text.get("castors") else None
    if castors is None:
        told = mentions_castors(text["name"], text.get("note", ""))
        castors = Castors.UNKNOWN if told else Castors.NONE
    answers = {name: bool(answer_in(text.get(name, ""))) for name in ANSWERS}
    answers["anchored"] = bool(anchored_in(text.get("anchored", "")))
    as_wide = depth is None or width is None or depth == width
    unsaid = not text.get("shape") and shape is BaseShape.BOX and not answers["anchored"]
    return Item(
        body=_body(base, numbers, text["name"]),
        height=numbers["height"],
        sideways=sideways,
        depth_known=depth is not None,
        support_length=numbers.get("support_length"),
        shape=shape,
        may_be_round=unsaid and as_wide and mentions_round(text["name"]),
        rolling_friction=numbers.get("rolling_friction", 0.0),
        contour_friction=numbers.get("contour_friction", 0.0),
        drilling_friction=numbers.get("drilling_friction", 0.0),
        facing=radians(numbers["facing"]) if "facing" in numbers else None,
        castors=castors,
        mass=numbers.get("mass"),
        quantity=int(numbers.get("quantity", 1.0)),
        cost=numbers.get("cost"),
        building=text.get("building", ""),
        site=(numbers["longitude"], numbers["latitude"]) if "latitude" in numbers else None,
        floor=text.get("floor", ""),
        location=text.get("location", ""),
        position=(numbers["x"], numbers["y"]) if {"x", "y"} <= numbers.keys() else None,
        wall=text.get("wall", ""),
        note=text.get("note", ""),
        critical=criticality(plain(text.get("critical", ""))) or 0,
        blocks_exit=answers["blocks_exit"],
        people_nearby=answers["people_nearby"],
        must_not_fall=answers["must_not_fall"],
        anchored=answers["anchored"],
        stands_on=what_it_stands_on(
            text.get("stands_on", ""), text["name"], text.get("note", ""),
            text.get("location", ""), numbers["height"],
        ) if castors in (Castors.NONE, Castors.UNKNOWN) else "",
    )  # fmt: skip


def _body(base: float, numbers: Mapping[str, float], name: str) -> Body:
    """The body on a base [m]: a uniform rectangle as far as the row gives no other numbers."""
    height = numbers["height"]
    uniform = math.hypot(base, height) / math.sqrt(12)
    return Body(
        base=base,
        cg_height=numbers.get("cg_height", height / 2),
        left=numbers.get("eccentricity", 0.5) * base,
        gyration_radius=numbers.get(
            "gyration_radius", min(uniform, largest_gyration_radius(base, numbers))
        ),
        name=name,
    )
