"""Numbers in cells: decimal points and commas, and units beside a number."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from shaketable.body import SIZES
from shaketable.errors import Fault, quoted
from shaketable.inputs import number_of
from shaketable.inventory.columns import LENGTHS, UNITS, ZERO, Column
from shaketable.inventory.vocabulary import normalized, plain
from shaketable.language import tell
from shaketable.tables import Cell, Sheet, with_a_point

_WITH_UNIT = re.compile(r"([-+\d.,]+)\s*([A-Za-z]+)")
_RANGE = re.compile(
    r"([\d.,]+)\s*(?:[-–—~〜]|\b(?:to|bis|a|hasta|fino a|до)\b)\s*([\d.,]+)\s*([A-Za-z]*)"
)
#: Of a range what makes an object less stable, or its straps bear more.
LESS = ("depth", "width", "length", "diameter")
MORE = ("height", "cg_height", "mass")


class Read(NamedTuple):
    """What a cell holds: a number in SI, or what is wrong with it.

    Attributes:
        number: NaN where something is wrong.
        fault: what is.
        remark: what was made of a range.
    """

    number: float
    fault: Fault | None = None
    remark: str = ""


def number_in(sheet: Sheet, cell: Cell, column: Column) -> Read:
    """The positive number in a cell: a length [m], a mass [kg], a force [N], or a bare number.

    Distances may be zero. Of a range of sizes the smaller base and the larger height and mass are
    taken.
    """
    both = _RANGE.fullmatch(plain(cell.text))
    if both and column.meaning in (*LESS, *MORE):
        ends = [
            number_in(sheet, cell._replace(text=f"{both[k]} {both[3]}".strip()), column)
            for k in (1, 2)
        ]
        if not any(each.fault for each in ends):
            choose = min if column.meaning in LESS else max
            taken = choose(ends, key=lambda each: each.number)
            return taken._replace(
                remark=tell(
                    "{found} is taken as {number:g}",
                    found=quoted(cell.text),
                    number=taken.number / column.factor,
                )
            )
    text, factor = normalized(cell.text), column.factor if column.unit else 1.0
    beside = _WITH_UNIT.fullmatch(text)
    units = UNITS.get(column.meaning, {})
    if beside and math.isnan(number_of(text)) and beside[2].lower() in units:
        text, factor = beside[1], units[beside[2].lower()]
    text, message = (text, "") if cell.typed else with_a_point(sheet, text)
    number = number_of(text)
    none = number == 0.0 and column.meaning in ZERO
    if not message and not (math.isfinite(number) and (number > 0.0 or none)):
        message = tell("expected a positive number, found {found}", found=quoted(cell.text))
        if column.meaning in ZERO:
            message = tell("expected 0 or more, found {found}", found=quoted(cell.text))
        if beside and units:
            message += tell(
                "; write the number, in {unit}, or one of {units} with it",
                unit=column.unit,
                units=", ".join(units),
            )
    number *= factor
    if (
        not message
        and column.meaning in LENGTHS
        and not none
        and not SIZES[0] <= number <= SIZES[1]
    ):
        message = tell(
            "must lie between {least:g} and {most:g} m, found {number:g} m",
            least=SIZES[0],
            most=SIZES[1],
            number=number,
        )
    if message:
        return Read(math.nan, sheet.fault(cell, "number", message, column.cell.text))
    return Read(number)


def degrees_in(sheet: Sheet, cell: Cell, column: Column, most: float) -> Read:
    """The angle in a cell, a latitude perhaps: decimal degrees from -most to most."""
    text, message = (cell.text, "") if cell.typed else with_a_point(sheet, cell.text)
    number = number_of(text)
    if not message and not abs(number) <= most:
        message = tell(
            "expected decimal degrees from -{most:g} to {most:g}, found {found}",
            most=most,
            found=quoted(cell.text),
        )
    if message:
        return Read(math.nan, sheet.fault(cell, "number", message, column.cell.text))
    return Read(number)
