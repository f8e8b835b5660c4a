"""Numbers in cells: decimal points and commas, and units beside a number."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from statistics import median
from typing import NamedTuple

from shaketable.body import SIZES
from shaketable.errors import Fault, quoted
from shaketable.inputs import number_of
from shaketable.inventory.columns import LENGTHS, METRES, SIZE, UNITS, ZERO, Column, plain_unit
from shaketable.inventory.lengths import Written, written
from shaketable.inventory.vocabulary import normalized, plain
from shaketable.language import tell
from shaketable.tables import Cell, Sheet, with_a_point
from shaketable.tables.sheet import THOUSANDS

_WITH_UNIT = re.compile(r"([-+\d.,]+)\s*([^\W\d_]+)\.?")
_BEHIND = re.compile(r"[\d.,]\s*([^\W\d_]+)\.?$")
_RANGE = re.compile(
    r"([\d.,]+)\s*(?:[-–—~〜～]|\b(?:to|bis|a|hasta|fino a|до)\b)\s*([\d.,]+)\s*([A-Za-z]*)"
)
#: A number of pieces with the word for them: "3台", "2 x", "4 pcs".
_COUNTED = re.compile(
    r"x?\s*(\d+)\s*(?:x|×|台|個|本|脚|基|枚|点|ea|each|pcs?|pieces?|stk|stck|st|stück|uds?|unid|"
    r"unidades|pz|pezzi)?\.?"
)
_PLAIN = re.compile(r"\d+")
_DECIMALS = re.compile(r"[-+]?\d*([.,])\d+")
_BOTH = re.compile(r"\d{1,3}(?:([.,])\d{3})+([.,])\d+")
IMPERIAL = {unit for unit, size in METRES.items() if size in (0.0254, 0.3048, 0.9144)}
UNCERTAIN = "?"  # of a decimal sign: 1.250 may be a thousand times more
FAR = 30.0  # times the other numbers of a column: beyond it a number is not one of them
#: Of a range what makes an object less stable, or its straps bear more.
LESS = ("depth", "width", "length", "diameter")
MORE = ("height", "cg_height", "mass")


class Read(NamedTuple):
    """What a cell holds: a number in SI, or what is wrong with it.

    Attributes:
        number: NaN where something is wrong.
        fault: what is.
        remark: what was made of a range, or of a number that is not exact.
        across: whether it is said to be a diameter.
    """

    number: float
    fault: Fault | None = None
    remark: str = ""
    across: bool = False


def says_a_number(text: str) -> bool:
    """Whether a text has a digit: "?", "-" and "unknown" say none."""
    return any(each.isdigit() for each in normalized(text))


def has_a_unit(cell: Cell) -> bool:
    """Whether a length's unit stands beside its number, or beside a range."""
    beside = _BEHIND.search(written(normalized(cell.text)).text)
    return plain_unit(plain(cell.unit)) in METRES or bool(beside and beside[1].lower() in METRES)


def decimal_sign(cells: Sequence[Cell], meaning: str) -> str:
    """The decimal sign of a column's numbers, as all of them tell.

    "1.850" is 1,850 beside "860", and in a column of costs.

    Returns:
        "." or ","; UNCERTAIN for masses and quantities that may be a thousand times more; "" where
        no number leaves a doubt, or the sizes of the whole sheet decide.
    """
    if meaning not in (*LENGTHS, SIZE, "mass", "quantity", "cost"):
        return ""
    texts = [_bare(cell.text) for cell in cells if not cell.typed]
    both = {match[2] for text in texts if (match := _BOTH.fullmatch(text)) and match[1] != match[2]}
    doubtful = [text for text in texts if THOUSANDS.fullmatch(text)]
    told = {
        match[1] for text in texts if text not in doubtful and (match := _DECIMALS.fullmatch(text))
    } | both
    grouped = {match[1] for text in doubtful if (match := THOUSANDS.fullmatch(text)) and match[2]}
    told |= {_other(sign) for sign in grouped}
    if len(told) == 1:
        return told.pop()
    if told or not doubtful:
        return ""
    signs = {match[1] for text in doubtful if (match := THOUSANDS.fullmatch(text))}
    if len(signs) > 1:
        return UNCERTAIN
    (sign,) = signs
    if meaning == "cost":
        return _other(sign)  # money has no thousandths
    usual = [float(text) for text in texts if _PLAIN.fullmatch(text)]
    found = _nearer(doubtful, sign, median(usual)) if usual and meaning != "quantity" else ""
    if meaning in ("mass", "quantity") and found != _other(sign):
        return UNCERTAIN  # whole numbers beside it say nothing of thousandths
    return found


def _nearer(doubtful: Sequence[str], sign: str, usual: float) -> str:
    """The decimal sign with which numbers are like the others of their column."""
    large = median(float(text.replace(sign, "")) for text in doubtful)
    fits = [
        1 / FAR <= number / usual <= FAR if usual else False for number in (large, large / 1000.0)
    ]
    if fits == [True, False]:
        return _other(sign)
    return sign if fits == [False, True] else UNCERTAIN


def _other(sign: str) -> str:
    return "," if sign == "." else "."


def _bare(text: str) -> str:
    """A number's text without its unit and what says that it is not exact."""
    found = written(normalized(text)).text
    beside = _WITH_UNIT.fullmatch(found)
    return beside[1] if beside else found


def number_in(sheet: Sheet, cell: Cell, column: Column) -> Read:
    """The positive number in a cell: a length [m], a mass [kg], a force [N], or a bare number.

    Distances may be zero. Of a range of sizes the smaller base and the larger height and mass are
    taken, and "ca. 140" is 140.
    """
    if column.meaning == "quantity" and (counted := _COUNTED.fullmatch(plain(cell.text))):
        cell = cell._replace(text=counted[1])
    both = _RANGE.fullmatch(plain(written(cell.text).text))
    if both and column.meaning in (*LESS, *MORE):
        ends = [
            number_in(sheet, cell._replace(text=f"{both[k]} {both[3]}".strip()), column)
            for k in (1, 2)
        ]
        if not any(each.fault for each in ends):
            choose = min if column.meaning in LESS else max
            taken = choose(ends, key=lambda each: each.number)
            return taken._replace(remark=_taken(cell, taken.number / column.factor))
    is_length = column.meaning in LENGTHS
    units = UNITS.get(column.meaning, {})
    shown = plain_unit(plain(cell.unit)) if units else ""
    if shown and shown not in units:
        text = tell(
            "its format shows {found} beside the number, which is no unit that is known: write the "
            "unit in the heading, as in {example}",
            found=quoted(cell.unit),
            example=quoted(f"{column.cell.text} ({next(iter(units))})"),
        )
        return Read(math.nan, sheet.fault(cell, "number", text, column.cell.text))
    told = Written(cell.text)
    if not cell.typed:
        raw = normalized(cell.text)
        metric = column.stated and column.unit not in IMPERIAL
        fraction = (
            "/" in raw
            and metric
            and not any(each in raw for each in "\"'″′”’")
            and not re.search(r"(in|ft|inch(es)?|feet|zoll|fuß)\.?\s*$", raw.lower())
        )
        told = written(raw, imperial=is_length and not fraction)
    text, factor = told.text, column.factor if column.unit else 1.0
    beside = _WITH_UNIT.fullmatch(text)
    unit = shown or (beside[2].lower() if beside else "")
    if unit in units and (shown or math.isnan(number_of(text))):
        text, factor = beside[1] if beside else text, units[unit]
    text, message = (text, "") if cell.typed else with_a_point(sheet, text, column.decimal)
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
    about = _taken(cell, number / factor) if told.about else ""
    return Read(number, remark=about, across=told.across and is_length)


def _taken(cell: Cell, number: float) -> str:
    return tell("{found} is taken as {number:g}", found=quoted(cell.text), number=number)


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
