"""Words in the cells of a row: which are known, and what is left out where one is not."""

from __future__ import annotations

import re

from shaketable.errors import Fault, quoted
from shaketable.inventory.answers import anchored_in, answer_in, castors_in
from shaketable.inventory.cells import Cells
from shaketable.inventory.columns import ANSWERS, LOSSES
from shaketable.inventory.numbers import number_in
from shaketable.inventory.shapes import SHAPES
from shaketable.inventory.surroundings import SIDES
from shaketable.inventory.vocabulary import normalized, plain
from shaketable.language import tell
from shaketable.tables.sheet import Sheet

#: Numbers without which an object can be simulated, by what is usual.
OPTIONAL = (
    "cg_height", "eccentricity", "gyration_radius", "support_length", "mass", "quantity", "cost",
    *LOSSES,
)  # fmt: skip
SHAPING = ("cg_height", "eccentricity", "gyration_radius", "support_length")  # likewise numbers
DECIDING = ("castors", "shape", "anchored")  # words without which nothing good is said
WORDS_THAT_MAY_BE_UNKNOWN = (*DECIDING, *ANSWERS, "critical")
#: No word: a number, or a slip in one.
_BARE = re.compile(r"[-+\d.,\s]*|[-+]?(nan|inf|infinity)|[-+\d.]+e[-+\d]+", re.IGNORECASE)
DASHES = ("-", "–", "—", "/", "./.")  # in place of a number that is not given
MOST_CRITICAL = 5


def without_what_is_not_read(
    sheet: Sheet, cells: Cells, remarks: list[Fault]
) -> tuple[Cells, tuple[str, ...]]:
    """Cells of a row, those that cannot be read and are not needed empty; headers that decide."""
    found, deciding = dict(cells), []
    for meaning, (cell, column) in cells.items():
        if cell.shared and cell.text and meaning in ("mass", "quantity", "cost"):
            text = tell("is merged over several rows, and left out: whose it is cannot be told")
            remarks.append(sheet.fault(cell, "left blank", text, column.cell.text))
            found[meaning] = (cell._replace(text=""), column)
            continue
        if meaning in OPTIONAL and cell.text in DASHES and not cell.wrong:
            found[meaning] = (cell._replace(text=""), column)
            continue
        is_number = meaning in OPTIONAL and bool(number_in(sheet, cell, column).fault)
        if (
            not cell.text
            or cell.wrong
            or not (
                (is_number and not _BARE.fullmatch(normalized(cell.text)))
                or (meaning in WORDS_THAT_MAY_BE_UNKNOWN and unknown_word(meaning, cell.text))
            )
        ):
            continue
        text = tell("{found} cannot be read, and is left out", found=quoted(cell.text))
        if meaning in DECIDING or meaning in SHAPING:
            deciding.append(column.cell.text)
            text = tell(
                "{found} cannot be read, accepted: {accepted}; until it is mended the object gets "
                "no class",
                found=quoted(cell.text),
                accepted=unknown_word(meaning, cell.text) or tell("a number"),
            )
        remarks.append(sheet.fault(cell, "left blank", text, column.cell.text))
        found[meaning] = (cell._replace(text=""), column)
    return found, tuple(deciding)


def unknown_word(meaning: str, text: str) -> str:
    """What is accepted in a cell of words, "" if its text is."""
    word = plain(text)
    if meaning == "anchored" and anchored_in(text) is None:
        return tell("yes or no")
    if meaning in ANSWERS and meaning != "anchored" and answer_in(text) is None:
        return tell("yes or no")
    if meaning == "castors" and word and castors_in(text) is None:
        return tell("none, free, locked, or yes if that is not known")
    if meaning == "wall_side" and word not in SIDES:
        return tell("back, front, left or right")
    if meaning == "shape" and word not in ("", *SHAPES):
        return tell("box, cylinder or feet")
    if meaning == "critical" and criticality(word) is None:
        return tell("yes, no or a whole number from 1 to {most}", most=MOST_CRITICAL)
    return ""


def criticality(word: str) -> int | None:
    """0 to MOST_CRITICAL, of which "yes" is the largest and 1 a step; None for any other word."""
    if word.isdecimal() and word.isascii():
        return int(word) if int(word) <= MOST_CRITICAL else None
    answer = answer_in(word)
    return None if answer is None else MOST_CRITICAL * answer
