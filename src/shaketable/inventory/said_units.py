"""Units of length that a text says: alone in a cell, or of all sizes in a title or a note."""

from __future__ import annotations

import re

from shaketable.inventory.columns import (
    KNOWN_UNITS,
    METRES,
)
from shaketable.inventory.vocabulary import heading, plain, row_words
from shaketable.tables.sheet import Cell

WITHOUT_BLANKS = "\u3000"  # letters beyond it are of languages without them
_UNIT_SAID = {"in", "en", "単位", ":", "："}  # before a unit of one letter
SEVERAL = "?"  # of a unit: a text names more than one
Row = list[Cell]


def unit_alone(text: str) -> str:
    """The unit that a cell holds and nothing else: "cm", "[cm]", "in cm"; "" if it does not."""
    words = plain(text).strip("[](){} ").split()
    if len(words) == 2 and words[0] in _UNIT_SAID:
        words = words[1:]
    return words[0] if len(words) == 1 and words[0] in KNOWN_UNITS else ""


def units_below(row: Row) -> dict[int, str]:
    """Units in a row below the header, by their columns; none if it is another row."""
    filled = {k: cell.text for k, cell in enumerate(row) if cell.text}
    known = {k: unit for k, text in filled.items() if (unit := unit_alone(text))}
    others = [text for k, text in filled.items() if k not in known]
    label = row_words("all_sizes")
    return (
        {} if any(text.strip("-–— ") and heading(text) not in label for text in others) else known
    )


def unit_of_all(text: str) -> str:
    """The unit of which a text says that all sizes are in it, "" if it says nothing.

    SEVERAL, where it names more than one.
    """
    told = heading(text)
    if not any(_has_words(told, words) for words in row_words("all_sizes")):
        return ""
    units = units_in(text)
    return units[0] if len({METRES[each] for each in units}) == 1 else SEVERAL if units else ""


def units_in(text: str) -> list[str]:
    """The units of length that a text names."""
    tokens = [
        each.strip("[](){}.!")
        for each in re.split(r"[\s、。,;]+|(?<=[:：])|(?=[:：])", plain(text))
    ]
    tokens = [each for each in tokens if each]
    # "in" is a word before it is a unit, and one letter alone says nothing
    return [
        each
        for before, each in zip(["", *tokens], tokens, strict=False)
        if each in METRES and ((len(each) > 1 and each != "in") or before in _UNIT_SAID)
    ]


def _has_words(text: str, words: str) -> bool:
    """Whether a text has some words as wholes; in languages without blanks anywhere."""
    if max(words) > WITHOUT_BLANKS:
        return words in text
    return re.search(rf"(?<!\w){re.escape(words)}(?!\w)", text) is not None
