"""What the columns of an inventory are called, and the units in their names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache
from types import MappingProxyType

from shaketable.errors import Fault, quoted
from shaketable.inventory.hints import is_about_what_decides
from shaketable.inventory.vocabulary import heading, headings, plain, vocabularies
from shaketable.language import tell
from shaketable.tables.sheet import Cell, Sheet

#: English headings by their meanings; those of other languages are in `words`.
WORDS = vocabularies()[0].columns
#: Lengths of friction against rolling and turning.
LOSSES = ("rolling_friction", "contour_friction", "drilling_friction")
LENGTH = "length"  # of a base whose width is given: its depth, or the other way around
LENGTHS = (
    "depth", "width", "diameter", "height", "cg_height", "gyration_radius", "support_length",
    "wall_gap", "edge", "lip", "x", "y", LENGTH, *LOSSES,
)  # fmt: skip
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
    "in": 0.0254, "inch": 0.0254, "inches": 0.0254, "ft": 0.3048, "feet": 0.3048, "foot": 0.3048,
}  # fmt: skip
KILOGRAMS = {"kg": 1.0, "t": 1000.0, "g": 0.001, "lb": 0.45359237, "lbs": 0.45359237}
NEWTONS = {"n": 1.0, "kn": 1000.0, "dan": 10.0, "kgf": 9.80665, "lbf": 4.4482216}
#: Of what has units.
UNITS = {
    **dict.fromkeys(LENGTHS, METRES), "mass": KILOGRAMS, **dict.fromkeys(FORCES, NEWTONS)
}  # fmt: skip

_ENGLISH = {heading(word) for words in WORDS.values() for word in words}
_LONG = [word for word in headings() if len(word) > 3]  # slips are seen
NEAR = 0.83  # of a heading with a slip to the word that is meant: heigth, not label and level
#: What a heading with a slip may mean: sizes and names; what else decides is asked.
SLIPS = ("name", "depth", "width", LENGTH, "diameter", "height", "mass")
SIZES_OF_BODY = ("depth", "width", LENGTH, "diameter", "height", "cg_height")
KNOWN_UNITS = {unit for units in UNITS.values() for unit in units}
_UNIT = re.compile(r"[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*$")


@dataclass(frozen=True)
class Column:
    """A column as it was understood.

    Attributes:
        cell: its header.
        meaning: a key of WORDS.
        unit: as its name says; "m", "kg" or "n" where it says none, "" where it needs none.
        stated: whether the name says the unit.
        near: the known word that its name resembles, "" where it is one itself.
    """

    cell: Cell
    meaning: str
    unit: str = ""
    stated: bool = False
    near: str = ""

    @property
    def factor(self) -> float:
        """One unit in metres, kilograms or newtons."""
        return UNITS[self.meaning][self.unit]


def bracketed(text: str) -> str:
    """What stands in brackets at the end of a heading, "" if nothing does."""
    found = _UNIT.search(plain(text))
    return found[1] if found else ""


def is_header(texts: Iterable[str], said: ColumnsSaid = MappingProxyType({})) -> bool:
    """Whether a row names all that every inventory has."""
    found = {column.meaning for text in texts if (column := understood(Cell(text, ""), said))}
    return {"name", "height"} <= found and bool(found & {"depth", "width", "diameter"})


#: What a user says of columns: headings as they are compared, and the columns that they are; ""
#: for one that is not used.
ColumnsSaid = Mapping[str, str]


def said_of(cell: Cell, said: ColumnsSaid) -> str:
    """Under which heading the user says something of a column, with its unit or without it; ""."""
    for words in (heading(cell.text), heading(_UNIT.sub("", plain(cell.text)))):
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
    bracket = _UNIT.search(text)
    unit = ""
    if bracket:
        unit, text = bracket[1], text[: bracket.start()]
    words, known = heading(text), headings()
    if words not in known and not unit:
        words, _, unit = words.rpartition(" ")
    meaning = known.get(words)
    units = UNITS.get(meaning or "", {})
    if meaning is None or (unit and unit not in units) or (meaning in PLAN and not unit):
        return None
    return Column(cell, meaning, unit or next(iter(units), ""), bool(unit))


def columns_of(
    sheet: Sheet,
    header: list[Cell],
    said: ColumnsSaid = MappingProxyType({}),
    units: Mapping[int, str] = MappingProxyType({}),
    *,
    sizes: bool = True,
) -> tuple[list[Column | None], list[Fault]]:
    """The columns, None for one that is not used, and the faults of the header.

    Args:
        sheet: where it stands.
        header: its cells.
        said: what the user says of some; others of the same meaning are not used then.
        units: of columns whose names have none, by their places.
        sizes: whether columns of sizes are needed.
    """
    if not header:
        text = tell("the file is empty; its first row must name the columns")
        return [], [Fault(sheet.path, "", "", "empty", text)]
    faults = []
    columns = [understood(cell, said) if cell.text else None for cell in header]
    ruled = {column.meaning for column in columns if column and said_of(column.cell, said)}
    columns = [
        None if column and column.meaning in ruled and not said_of(column.cell, said) else column
        for column in columns
    ]
    exact = {column.meaning for column in columns if column}
    for k, cell in enumerate(header):
        if understood(cell, said):
            continue
        if columns[k] is None and cell.text and (near := nearly(cell, said)):
            columns[k] = near if near.meaning not in exact else None
            exact.add(near.meaning)
    columns = [
        replace(column, unit=units[k], stated=True)
        if column and k in units and not column.stated and units[k] in UNITS.get(column.meaning, {})
        else column
        for k, column in enumerate(columns)
    ]
    columns = _once(_with_length(columns))
    for cell, column in zip(header, columns, strict=True):
        known = bool(said_of(cell, said)) or understood(cell) is not None
        if column is None and cell.text and not known and (meant := _meant(cell.text)):
            message = tell(
                "unknown column {column}; is {meant} meant?", column=quoted(cell.text), meant=meant
            )
            faults.append(sheet.fault(cell, "column", message))
    faults += [
        sheet.fault(
            column.cell,
            "column",
            tell(
                "{unit} is no unit that is known for {meaning!r}; say it with what the column "
                "means, as in 'height_cm'",
                unit=quoted(bracketed(column.cell.text)),
                meaning=column.meaning,
            ),
        )
        for column in columns
        if column and said_of(column.cell, said) and _hides_a_unit(column)
    ]
    times = Counter(column.meaning for column in columns if column)
    faults += [
        sheet.fault(
            header[0],
            "column",
            tell(
                "{count} columns mean {meaning!r}: {columns}",
                count=count,
                meaning=meaning,
                columns=", ".join(
                    quoted(each.cell.text) for each in columns if each and each.meaning == meaning
                ),
            ),
        )
        for meaning, count in times.items()
        if count > 1
    ]
    if LENGTH in times:
        message = tell("is depth (front to back) or width (side to side) meant? Give both")
        faults.append(sheet.fault(header[0], "column", message, LENGTH))
    needed = ("name", "height") if sizes else ("name",)
    missing = [meaning for meaning in needed if meaning not in times]
    if sizes and not {"depth", "width", "diameter"} & times.keys():
        missing.append("depth")
    usual = tell("--catalogue takes sizes that are usual for things of that name")
    faults += [
        sheet.fault(
            header[0],
            "no column",
            tell("no column for the {meaning!r} of an object", meaning=meaning),
        )._replace(mend=usual if meaning != "name" else "")
        for meaning in missing
    ]
    if faults:
        faults.append(Fault(sheet.path, "", "", "accepted", accepted()))
    return columns, faults


def _hides_a_unit(column: Column) -> bool:
    """Whether a heading names in brackets what may be a unit, and none is known."""
    unit = bracketed(column.cell.text)
    units = UNITS.get(column.meaning, {})
    return bool(unit and units) and not column.stated and unit not in units


def nearly(cell: Cell, said: ColumnsSaid = MappingProxyType({})) -> Column | None:
    """What a heading with a slip means, None if that is not one thing alone.

    It has as many words as the known one.
    """
    text = plain(cell.text)
    if text.startswith("#") or said_of(cell, said) or is_about_what_decides(cell.text):
        return None  # it is left out on purpose, or asked
    bare, unit = heading(_UNIT.sub("", text)), bracketed(text)
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


def _with_length(columns: list[Column | None]) -> list[Column | None]:
    """Columns with a length as the side of the base that no other column gives."""
    given = {column.meaning for column in columns if column}
    sides = [side for side in ("depth", "width") if side not in given]
    if LENGTH not in given or len(sides) == 2:
        return columns
    return [
        replace(column, meaning=sides[0], near=column.near or LENGTH)
        if column and sides and column.meaning == LENGTH
        else None
        if column and column.meaning == LENGTH
        else column
        for column in columns
    ]


def _once(columns: list[Column | None]) -> list[Column | None]:
    """Columns of which those of ONCE are there once."""
    found: list[Column | None] = []
    seen: set[str] = set()
    for column in columns:
        again = column is not None and column.meaning in ONCE and column.meaning in seen
        found.append(None if again else column)
        seen |= {column.meaning} if column else set()
    return found


def _meant(header: str) -> str:
    """The known word that a header with a wrong unit has, "" if none: it would lose a column."""
    if header.startswith("#"):  # it is left out on purpose
        return ""
    bare = heading(_UNIT.sub("", plain(header)))
    begin, _, _ = bare.rpartition(" ")
    if bare in PLAN or begin in PLAN:  # "X" may be a column of ticks, "x direction" anything
        return ""
    if bare in headings() or begin in headings():  # with a unit that is none
        meaning = begin if begin in headings() else bare
        units = UNITS.get(headings()[meaning])
        if units:
            return tell("{meaning!r} in one of {units}", meaning=meaning, units=", ".join(units))
        # "Raum Nr", "Forma pago" and "remarks 2" are columns of their own
        own = meaning not in _ENGLISH or headings()[meaning] in ONCE
        return "" if own else f"{meaning!r}"
    return ""


def accepted() -> str:
    """The columns that are accepted, in words."""
    names = [f"{name}_{next(iter(UNITS[name]))}" if name in UNITS else name for name in WORDS]
    return tell(
        "accepted columns, in English (and in German, Italian, Japanese and Spanish): {names}; "
        "name, depth (front to back) or width (side to side) or diameter, and height are needed; "
        "lengths may be in cm, mm, in or ft, as in 'height_cm' or 'Height (cm)'; a file may say "
        "what other columns mean",
        names=", ".join(names),
    )
