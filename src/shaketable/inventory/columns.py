"""What the columns of an inventory are called, and the units in their names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache
from types import MappingProxyType

from shaketable.inventory.hints import is_about_what_decides
from shaketable.inventory.sizes import order_in, unit_beside_order
from shaketable.inventory.vocabulary import (
    Vocabulary,
    heading,
    headings,
    plain,
    row_words,
    vocabularies,
)
from shaketable.tables.sheet import Cell

#: English headings by their meanings; those of other languages are in `words`.
WORDS = vocabularies()[0].columns
#: Lengths of friction against rolling and turning.
LOSSES = ("rolling_friction", "contour_friction", "drilling_friction")
LENGTH = "length"  # of a base whose width is given: its depth, or the other way around
LENGTHS = (
    "depth", "width", "diameter", "height", "cg_height", "gyration_radius", "support_length",
    "wall_gap", "edge", "lip", "x", "y", LENGTH, *LOSSES,
)  # fmt: skip
UNIT = "unit"  # of a column that says the unit of each row's sizes
ONCE = ("name", "location", "note", "stands_on")  # of several such columns the first is used
ZERO = ("wall_gap", "edge", "lip", "x", "y")  # may be none
PLAN = ("x", "y")
FORCES = ("strap_strength", "pad")
ANSWERS = ("blocks_exit", "people_nearby", "must_not_fall", "anchored")  # yes or no
METRES = {
    "m": 1.0, "metre": 1.0, "metres": 1.0, "meter": 1.0, "meters": 1.0,
    "cm": 0.01, "mm": 0.001,
    **dict.fromkeys(
        ("centimetre", "centimetres", "centimeter", "centimeters", "zentimeter", "centímetros",
         "centimetros", "centimetri", "センチ"), 0.01,
    ),
    **dict.fromkeys(
        ("millimetre", "millimetres", "millimeter", "millimeters", "milímetros", "milimetros",
         "millimetri", "ミリ"), 0.001,
    ),
    **dict.fromkeys(("metros", "metri"), 1.0),
    **dict.fromkeys(("zoll", "pulgada", "pulgadas", "pollice", "pollici", '"', "″"), 0.0254),
    **dict.fromkeys(("fuß", "fuss", "pie", "pies", "piede", "piedi", "'", "′"), 0.3048),
    "yd": 0.9144, "yards": 0.9144, "mt": 1.0, "mts": 1.0,
    "in": 0.0254, "inch": 0.0254, "inches": 0.0254, "ft": 0.3048, "feet": 0.3048, "foot": 0.3048,
}  # fmt: skip
KILOGRAMS = {"kg": 1.0, "t": 1000.0, "g": 0.001, "lb": 0.45359237, "lbs": 0.45359237}
NEWTONS = {"n": 1.0, "kn": 1000.0, "dan": 10.0, "kgf": 9.80665, "lbf": 4.4482216}
SIZE = "size"  # of a column with several sizes in each cell
#: Of what has units.
UNITS = {
    **dict.fromkeys((*LENGTHS, SIZE), METRES), "mass": KILOGRAMS, **dict.fromkeys(FORCES, NEWTONS)
}  # fmt: skip

_LONG = [word for word in headings() if len(word) > 3]  # slips are seen
NEAR = 0.83  # of a heading with a slip to the word that is meant: heigth, not label and level
#: What a heading with a slip may mean: sizes and names; what else decides is asked.
SLIPS = ("name", "depth", "width", LENGTH, "diameter", "height", "mass")
SIZES_OF_BODY = ("depth", "width", LENGTH, "diameter", "height", "cg_height")
KNOWN_UNITS = {unit for units in UNITS.values() for unit in units}
#: A unit right behind a word of a language without blanks.
_JOINED = re.compile(r"(.*[\u3000-\u9fff])(mm|cm|m|kg|g|t)")
UNIT_IN_BRACKETS = re.compile(r"[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*$")


@dataclass(frozen=True)
class Column:
    """A column as it was understood.

    Attributes:
        cell: its header.
        meaning: a key of WORDS.
        unit: as its name says; "m", "kg" or "n" where it says none, "" where it needs none.
        stated: whether the name says the unit.
        near: the known word that its name resembles, "" where it is one itself.
        order: meanings of the sizes in its cells, in their order; () where they say it themselves.
        decimal: the decimal sign of its numbers, "" where it is not certain.
        is_length: whether it is called the length of the base, and is one of its sides therefore.
    """

    cell: Cell
    meaning: str
    unit: str = ""
    stated: bool = False
    near: str = ""
    order: tuple[str, ...] = ()
    decimal: str = ""
    is_length: bool = False

    @property
    def factor(self) -> float:
        """One unit in metres, kilograms or newtons."""
        return UNITS[self.meaning][self.unit]


def bracketed(text: str) -> str:
    """What stands in brackets at the end of a heading, "" if nothing does."""
    found = UNIT_IN_BRACKETS.search(plain(text))
    return found[1] if found else ""


def plain_unit(text: str) -> str:
    """A unit without what stands around it: "in cm", "ft." """
    return text.strip().removeprefix("in ").removeprefix("en ").strip().rstrip(".")


def _said_twice(words: str) -> Iterator[str]:
    """What a heading says twice, in words and a letter or in two languages: "Höhe H"."""
    parts = re.split(r"\s*/\s*|\s(?=\w$)", words)
    meanings = {headings().get(part) for part in parts}
    if len(parts) > 1 and len(meanings) == 1 and None not in meanings:
        yield parts[0]


def is_header(texts: Iterable[str], said: ColumnsSaid = MappingProxyType({})) -> bool:
    """Whether a row names all that every inventory has."""
    found = {column.meaning for text in texts if (column := understood(Cell(text, ""), said))}
    return "name" in found and (SIZE in found or _names_sizes(found))


def has_columns_of_sizes(texts: Iterable[str], said: ColumnsSaid = MappingProxyType({})) -> bool:
    """Whether a row names the height and a side of the base, each by itself."""
    return _names_sizes(
        {column.meaning for text in texts if (column := understood(Cell(text, ""), said))}
    )


def _names_sizes(meanings: Set[str]) -> bool:
    return "height" in meanings and bool(meanings & {"depth", "width", "diameter"})


#: What a user says of columns: headings as they are compared, and the columns that they are; ""
#: for one that is not used.
ColumnsSaid = Mapping[str, str]


def said_of(cell: Cell, said: ColumnsSaid) -> str:
    """Under which heading the user says something of a column, with its unit or without it; ""."""
    for words in (heading(cell.text), heading(UNIT_IN_BRACKETS.sub("", plain(cell.text)))):
        if words in said:
            return words
    return ""


def understood(cell: Cell, said: ColumnsSaid = MappingProxyType({})) -> Column | None:
    """What a header means, None if it says nothing known, or its column is not used."""
    told = said.get(said_of(cell, said))
    if told == "":
        return None
    if told is not None:
        unit = bracketed(cell.text)
        meant = understood(cell._replace(text=told))
        with_unit = understood(cell._replace(text=f"{told} ({unit})")) if unit else None
        column = meant if meant is None or meant.stated else with_unit or meant
        return column and replace(column, cell=cell)
    text = plain(cell.text)
    if len(text) > 1 and text.rstrip(".") in KILOGRAMS:  # "lbs" alone
        return Column(cell, "mass", text.rstrip("."), True)
    if order := order_in(text):
        unit = unit_beside_order(text)
        return Column(cell, SIZE, unit or "m", bool(unit), order=order)
    known = headings()
    for words, unit in _apart(text):
        meaning = known.get(words)
        units = UNITS.get(meaning or "", {})
        if meaning is None or (meaning in PLAN and not unit):
            continue
        of_none = not units and bracketed(cell.text) and unit not in KNOWN_UNITS
        if unit and unit not in units and not of_none:
            continue  # "Qty (pcs)" is a quantity; "Width (cubits)" and "Area (cm)" are nothing
        return Column(cell, meaning, unit if unit in units else next(iter(units), ""),
                      unit in units)  # fmt: skip
    return None


def _apart(text: str) -> Iterator[tuple[str, str]]:
    """A heading as words and a unit, in every way in which it may be written.

    "Height (cm)", "height_cm", "H/cm", "Höhe in cm", "幅mm".
    """
    bracket = UNIT_IN_BRACKETS.search(text)
    if bracket:
        words, unit = heading(text[: bracket.start()]), plain_unit(bracket[1])
        yield words, unit
        yield from ((each, unit) for each in _said_twice(words))
        return
    words = heading(text)
    yield words, ""
    begin, _, unit = words.rpartition(" ")
    yield begin, unit
    yield from ((each, unit) for each in _said_twice(begin))
    yield begin.removesuffix(" in").removesuffix(" en"), unit
    slashed, _, unit = words.rpartition("/")
    yield slashed.strip(), unit.strip()
    joined = _JOINED.fullmatch(words)
    if joined:
        yield joined[1], joined[2]


def nearly(cell: Cell, said: ColumnsSaid = MappingProxyType({})) -> Column | None:
    """What a heading with a slip means, None if that is not one thing alone.

    It has as many words as the known one.
    """
    text = plain(cell.text)
    if text.startswith("#") or said_of(cell, said) or is_about_what_decides(cell.text):
        return None  # it is left out on purpose, or asked
    if heading(text) in row_words("own"):
        return None  # a word of its own, such as "Dept"
    bare, unit = heading(UNIT_IN_BRACKETS.sub("", text)), bracketed(text)
    begin, _, after = bare.rpartition(" ")
    tries = [(begin, after)] if after in KNOWN_UNITS and not unit else []
    for words, rest in (*tries, (bare, unit)):
        found = _like(words)
        meanings = {headings()[word] for word in found}
        if len(meanings) == 1 and meanings <= {*SLIPS}:
            column = understood(cell._replace(text=f"{found[0]} ({rest})" if rest else found[0]))
            return column and replace(column, cell=cell, near=found[0])
    return None


@lru_cache(maxsize=1000)
def _like(words: str) -> list[str]:
    """Known headings of as many words that some words resemble, the most alike first."""
    found = get_close_matches(words, _LONG, 3, NEAR)
    return [word for word in found if word.count(" ") == words.count(" ")]


def written_heading(own: Vocabulary, meaning: str, lengths: str = "cm") -> str:
    """The heading of a column in a template, with its unit."""
    word = own.in_template.get(meaning, own.columns[meaning][0])
    word = word[:1].upper() + word[1:]
    units = UNITS.get(meaning)
    return f"{word} ({lengths if units is METRES else next(iter(units))})" if units else word
