"""What is wrong with the header of a list, and what is asked about its columns."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence

from shaketable.errors import Fault, named, quoted
from shaketable.inventory.columns import (
    KNOWN_UNITS,
    LENGTH,
    METRES,
    ONCE,
    PLAN,
    SIZE,
    SIZES_OF_BODY,
    UNIT,
    UNIT_IN_BRACKETS,
    UNITS,
    WORDS,
    Column,
    ColumnsSaid,
    bracketed,
    plain_unit,
    said_of,
    understood,
    written_heading,
)
from shaketable.inventory.numbers import IMPERIAL, has_a_unit, says_a_number
from shaketable.inventory.sizes import OTHER_SIZES, SPELLED, parts_of
from shaketable.inventory.vocabulary import (
    ENGLISH,
    heading,
    headings,
    plain,
    vocabularies,
    weak_headings,
)
from shaketable.language import spoken, tell, translated
from shaketable.tables.sheet import Cell, Sheet

NEEDED = {"name": "the name", "height": "the height", "depth": "the depth or the width"}
LONGEST_UNIT = 5  # letters of what may be a unit that is not known
MOST_NAMED = 40  # headings in a question
_ENGLISH = {heading(word) for words in WORDS.values() for word in words}
#: Of these a word more makes another heading: "Unit cost", "Number plate".
_OWN = (*ONCE, UNIT, SIZE, "quantity", "cost")
_WITH_LETTERS = re.compile(r"\d\s*(kg|g|t|lbs?)\b", re.IGNORECASE)
BASES = ("depth", "width", "diameter")

Columns = list[Column | None]


def faults_of(
    sheet: Sheet,
    header: list[Cell],
    columns: Columns,
    values: Sequence[Sequence[Cell]],
    said: ColumnsSaid,
    *,
    sizes: bool,
) -> list[Fault]:
    """The faults of a header; what is missing is asked only where nothing else is wrong.

    Args:
        sheet: where it stands.
        header: its cells.
        columns: what they mean.
        values: the filled cells of each.
        said: what the user says of columns.
        sizes: whether columns of sizes are needed.
    """
    faults = [
        *_lost(sheet, header, columns, said),
        *_units_of_the_user(sheet, columns, said),
        *_twice(sheet, header, columns),
        *_beside(sheet, header),
        *_asked(sheet, header, columns, values),
        *_mass_asked(sheet, columns, values),
    ]
    return faults or list(_missing(sheet, header, columns, sizes=sizes))


def _lost(sheet: Sheet, header: list[Cell], columns: Columns, said: ColumnsSaid) -> Iterator[Fault]:
    """Faults of headings that are a known word with a wrong unit: they would lose a column."""
    for cell, column in zip(header, columns, strict=True):
        known = bool(said_of(cell, said)) or understood(cell) is not None
        if column is None and cell.text and not known and (meant := _meant(cell.text)):
            message = tell(
                "unknown column {column}; is {meant} meant?", column=quoted(cell.text), meant=meant
            )
            yield sheet.fault(cell, "column", message)


def _meant(header: str) -> str:
    """The known word that a header with a wrong unit has, "" if none: it would lose a column."""
    if header.startswith("#"):  # it is left out on purpose
        return ""
    bare = heading(UNIT_IN_BRACKETS.sub("", plain(header)))
    begin, _, _ = bare.rpartition(" ")
    if bare in PLAN or begin in PLAN:  # "X" may be a column of ticks, "x direction" anything
        return ""
    if bare in headings() or begin in headings():  # with a unit that is none
        meaning = begin if begin in headings() else bare
        if headings()[meaning] in _OWN or meaning in weak_headings():
            return ""
        units = UNITS.get(headings()[meaning])
        last = bare.removeprefix(meaning).strip()
        if plain_unit(bracketed(header)) in KNOWN_UNITS or (last and len(last) > LONGEST_UNIT):
            return ""  # "Weight of stack (kg)" and "peso unitario" are columns of their own
        if units:
            return tell("{meaning!r} in one of {units}", meaning=meaning, units=", ".join(units))
        # "Raum Nr", "Forma pago" and "remarks 2" are columns of their own
        return f"{meaning!r}" if meaning in _ENGLISH else ""
    return ""


def _units_of_the_user(sheet: Sheet, columns: Columns, said: ColumnsSaid) -> Iterator[Fault]:
    """Faults of what a user says of a column against its own heading."""
    for column in columns:
        if column is None or not said_of(column.cell, said):
            continue
        own = understood(column.cell)
        told = column.meaning
        units = UNITS.get(told, {})
        bracket = bracketed(column.cell.text)
        stated = own.unit if own and own.stated and own.meaning == told else bracket
        if stated in units and units[stated] != column.factor:
            text = tell(
                "the heading says {one} and what is said of the column {other}: mend the one that "
                "is wrong",
                one=stated,
                other=column.unit,
            )
            yield sheet.fault(column.cell, "column", text, column.cell.text)
        elif bracket and units and not column.stated and bracket not in units:
            text = tell(
                "{unit} is no unit that is known for {meaning!r}; say it with what the column "
                "means, as in 'height_cm'",
                unit=quoted(bracket),
                meaning=told,
            )
            yield sheet.fault(column.cell, "column", text)


def _twice(sheet: Sheet, header: list[Cell], columns: Columns) -> Iterator[Fault]:
    """Faults of meanings that several columns have."""
    times = Counter(column.meaning for column in columns if column)
    for meaning, count in times.items():
        if count > 1:
            same = [each for each in columns if each and each.meaning == meaning]
            text = tell(
                "{count} columns mean {meaning!r}: {columns}",
                count=count,
                meaning=translated(meaning.replace("_", " ")),
                columns=", ".join(quoted(each.cell.text) for each in same),
            )
            yield sheet.fault(header[0], "column", text)
    if LENGTH in times:
        text = tell("is depth (front to back) or width (side to side) meant? Give both")
        yield sheet.fault(header[0], "column", text, translated(LENGTH))


def _asked(
    sheet: Sheet, header: list[Cell], columns: Columns, values: Sequence[Sequence[Cell]]
) -> Iterator[Fault]:
    """Faults of columns of sizes without a unit where others name one, or without an order."""
    by_row = any(column and column.meaning == UNIT for column in columns)
    stated = [c for c in columns if c and c.meaning in SIZES_OF_BODY and c.stated]
    for column, cells in zip(columns, values, strict=True):
        if column is None:
            continue
        bare = [cell for cell in cells if says_a_number(cell.text) and not has_a_unit(cell)]
        if column.meaning in SIZES_OF_BODY and not column.stated and stated and bare and not by_row:
            text = tell(
                "names no unit, and {other} names {unit}: in which unit is it? Say it in the "
                "heading, as in {example}",
                other=quoted(stated[0].cell.text),
                unit=stated[0].unit,
                example=quoted(f"{column.cell.text} ({stated[0].unit})"),
            )
            yield sheet.fault(column.cell, "column", text, column.cell.text)
        if column.meaning != SIZE:
            continue
        several = [(cell, parts_of(cell.text)) for cell in cells]
        for cell, parts in several:
            if parts and not column.order and not all(part.meaning for part in parts):
                text = tell(
                    "{found} holds several sizes: which is the height, which the width, which the "
                    "depth? Say it in the heading, as in {example}",
                    found=quoted(cell.text),
                    example=quoted(f"{column.cell.text} H x W x D (cm)"),
                )
                mend = tell(
                    "or in a file of columns, as one of {orders}",
                    orders=", ".join(f"size_{each}_cm" for each in SPELLED),
                )
                yield sheet.fault(column.cell, "order", text, column.cell.text)._replace(mend=mend)
                break
        bare = [cell for cell, parts in several if parts and not parts[-1].unit]
        if bare and not (column.stated or by_row):
            text = tell(
                "{found} names no unit, and neither does the heading: say it there, as in "
                "{example}",
                found=quoted(bare[0].text),
                example=quoted(f"{column.cell.text} (cm)"),
            )
            yield sheet.fault(column.cell, "column", text, column.cell.text)


def _beside(sheet: Sheet, header: list[Cell]) -> Iterator[Fault]:
    """Faults of a second table beside the first: its names come again behind an empty heading."""
    names = [heading(cell.text) for cell in header]
    gap = names.index("") if "" in names[1:] else len(names)
    for k, name in enumerate(names):
        if k > gap > 0 and name and headings().get(name) == "name" and name in names[:gap]:
            text = tell(
                "is there twice, with an empty column between: are these two tables side by side? "
                "Give each as a list of its own"
            )
            yield sheet.fault(header[k], "column", text, header[k].text)


def _mass_asked(
    sheet: Sheet, columns: Columns, values: Sequence[Sequence[Cell]]
) -> Iterator[Fault]:
    """Faults of masses without a unit where sizes are in inches or feet: they may be in pounds."""
    imperial = any(c and c.meaning in SIZES_OF_BODY and c.unit in IMPERIAL for c in columns)
    for column, cells in zip(columns, values, strict=True):
        if column is None or column.meaning != "mass" or column.stated or not imperial:
            continue
        if any(says_a_number(cell.text) and not _WITH_LETTERS.search(cell.text) for cell in cells):
            text = tell(
                "names no unit, and sizes are in inches or feet: is it in kg or in lb? Say it in "
                "the heading, as in {example}",
                example=quoted(f"{column.cell.text} (lb)"),
            )
            yield sheet.fault(column.cell, "column", text, column.cell.text)


def _missing(sheet: Sheet, header: list[Cell], columns: Columns, *, sizes: bool) -> Iterator[Fault]:
    """Questions for columns that every list needs."""
    given = {column.meaning for column in columns if column}
    if SIZE in given:
        given |= {"height", "depth"}
    if given & {*BASES}:
        given.add("depth")
    told = named([quoted(cell.text) for cell in header if cell.text], MOST_NAMED)
    unused = [
        cell for cell, column in zip(header, columns, strict=True)
        if column is None and _has_a_length(cell.text)
    ]  # fmt: skip
    alone = "width" in given and not {SIZE, "depth", "diameter"} & {c.meaning for c in columns if c}
    if sizes and unused and alone:
        text = tell(
            "I found no column for {what}, and {unused} is not used: is it that? Then call it "
            "{name}; if not, put # before its name",
            what=translated("the depth"),
            unused=quoted(unused[0].text),
            name=quoted(_in_template("depth")),
        )
        yield sheet.fault(unused[0], "column", text)
    for meaning in NEEDED if sizes else ("name",):
        if meaning in given:
            continue
        text = tell(
            "I found no column for {what}. Your headings are: {headings}. Which of them is {what}?",
            what=translated(NEEDED[meaning]),
            headings=told,
        )
        mend = tell("call it {name}, as the template does", name=quoted(_in_template(meaning)))
        if meaning != "name":
            mend += tell("; --catalogue takes sizes that are usual for things of that name")
        yield sheet.fault(header[0], "no column", text)._replace(mend=mend)


def _has_a_length(text: str) -> bool:
    """Whether a heading names a unit of length, and is not left out on purpose."""
    words = heading(text).replace("/", " ").split()
    unit = plain_unit(bracketed(text)) or (words[-1] if len(words) > 1 else "")
    thick = OTHER_SIZES.search(plain(text)) is not None
    return unit in METRES and len(unit) > 1 and not text.startswith("#") and not thick


def _in_template(meaning: str) -> str:
    """The heading that the template writes, in the language that is spoken."""
    every = {each.language: each for each in vocabularies()}
    return written_heading(every.get(spoken(), every[ENGLISH]), meaning)
