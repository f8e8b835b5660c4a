"""Tests on a shake table, and the tables in which laboratories keep them."""

from __future__ import annotations

import logging
import math
import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path

from shaketable.errors import Fault, InputError, named, quoted, refusal, refused, require_positive
from shaketable.inputs import number_of
from shaketable.motion import Motion
from shaketable.records import read_motion, suite
from shaketable.records.suites import info_of
from shaketable.tables import Cell, Sheet, condensed, read_sheet, with_a_point

log = logging.getLogger(__name__)

#: Columns, with the words that are accepted for them.
COLUMNS = {
    "test": ("test", "test number", "test no", "run", "id"),
    "motion": ("motion", "file", "motion file"),
    "scale": ("scale", "factor", "scale factor"),
    "fell": ("fell", "toppled", "overturned", "fallen"),
    "record": ("record", "recording", "earthquake"),
    "component": ("component", "channel"),
    "order": ("order", "sequence"),
}
MOST_NAMED = 6  # files in an error
NEEDED = ("test", "motion")
ANSWERS = {
    **dict.fromkeys(("yes", "y", "true", "1"), True),
    **dict.fromkeys(("no", "n", "false", "0"), False),
}
_GAPS = re.compile(r"[\s_.\-]+")
_MEANINGS = {word: meaning for meaning, words in COLUMNS.items() for word in words}


@dataclass(frozen=True, kw_only=True, eq=False)
class ShakeTest:
    """A body under a motion of a shake table, and whether it fell.

    Args:
        name: of the test.
        motion: what the table did.
        scale: factor on the motion.
        fell: whether the body overturned; None if that is not known.
        record: the earthquake record that the motion was made from, "" if that is not known.
        order: its place in the order in which the tests were made; None if that is not known.
        motion_name: what a table calls the motion, "" for the motion's own name.

    Raises:
        InputError: a scale that is not positive, or an order that is not finite.
    """

    name: str
    motion: Motion
    scale: float = 1.0
    fell: bool | None = None
    record: str = ""
    order: float | None = None
    motion_name: str = ""

    def __post_init__(self) -> None:
        require_positive(f"test {quoted(self.name)}: scale", self.scale)
        if self.order is not None and not math.isfinite(self.order):
            raise InputError(f"test {quoted(self.name)}: order must be finite, got {self.order!r}")


def read_tests(
    path: str | Path,
    folder: str | Path,
    *,
    outcomes: bool = True,
    units: str | None = None,
    time_step: float | None = None,
) -> list[ShakeTest]:
    """Read shake-table tests from a table: CSV, .xlsx or .ods.

    Args:
        path: of the table. Its columns are test, motion (a file in `folder`), and, if known,
            scale (1 by default), fell (yes or no), record, component (for files that hold
            several) and order. Others are not used.
        folder: where the motions lie, or the name of a suite that holds them.
        outcomes: whether every test must say if the body fell.
        units, time_step: as for `read_motion`.

    Raises:
        InputError: lists the faults of the table, with the line of each, and of the motions.
    """
    path = Path(path)
    motion_of = _motions_in(folder, units, time_step)
    sheet = read_sheet(path, "Tests", lambda texts: set(NEEDED) <= {_meaning(t) for t in texts})
    filled = list(sheet.filled())
    if not filled:
        raise refused(path, f"the file is empty; {_accepted()}")
    columns = [_meaning(cell.text) for cell in filled[0]]
    faults = _header_faults(sheet, filled[0], columns, outcomes)
    if faults:
        raise refusal([*faults, Fault(path, "", "", "accepted", _accepted())])
    motions: dict[tuple[str, str], Motion] = {}
    tests: list[ShakeTest] = []
    lines: dict[str, Cell] = {}
    for row in filled[1:]:
        cells = {
            meaning: cell
            for meaning, cell in zip(columns, row, strict=False)
            if meaning and cell.text
        }
        found, test = _test(sheet, row[0], cells, outcomes)
        if "order" in columns and "order" not in cells:
            message = "is empty; give every test its place, or leave the column out"
            found.append(sheet.fault(row[0], "order", message, "order"))
        if any(cell.text for cell in row[len(columns) :]):
            found.append(sheet.fault(row[0], "more cells", _too_long(len(row), len(columns))))
        name = cells["test"].text if "test" in cells else ""
        if name and name in lines:
            found.append(
                sheet.fault(cells["test"], "again", f"the name is also on {lines[name].where}")
            )
        lines.setdefault(name, row[0])
        file = (cells["motion"].text, test.get("component", "")) if "motion" in cells else None
        if file and file not in motions:
            try:
                motions[file] = motion_of(*file)
            except InputError as error:
                place, called = Path(folder) / file[0], quoted(file[0])
                for one in error.listed:
                    known = one.called(place, called)
                    told = known if known.path else known._replace(path=called)
                    found.append(sheet.fault(cells["motion"], "motion", str(told), "motion"))
        faults += found
        if not found and file:
            tests.append(
                ShakeTest(
                    name=name,
                    motion=motions[file],
                    scale=number_of(test.get("scale", "1")),
                    fell=None if "fell" not in test else ANSWERS[test["fell"]],
                    record=test.get("record", ""),
                    order=number_of(test["order"]) if "order" in test else None,
                    motion_name=cells["motion"].text,
                )
            )
    if faults:
        raise refusal(condensed(faults))
    if not tests:
        raise refused(path, "holds no test; each needs a row below the header")
    return tests


def ordered_by_number(
    tests: Sequence[ShakeTest], others: Sequence[ShakeTest] = ()
) -> tuple[list[ShakeTest], list[ShakeTest]]:
    """Order tests by the numbers in their names, unless an order is given.

    Laboratories number their tests as they make them. Other tests get a place only if their numbers
    are of the same sequence: between the first and the last, and none of them taken.
    """
    numbers = [number_of(test.name) for test in tests]
    if any(map(math.isnan, numbers)) or any(test.order is not None for test in (*tests, *others)):
        return list(tests), list(others)
    log.warning(
        "no column 'order': the tests are taken to be made in the order of their numbers; if they "
        "were not, name them otherwise"
    )
    known = [replace(test, order=number) for test, number in zip(tests, numbers, strict=True)]
    same = all(
        min(numbers) <= number_of(test.name) <= max(numbers) and number_of(test.name) not in numbers
        for test in others
    )
    if others and not same:
        log.warning("the other tests are not of this sequence of numbers, and get no place in it")
        return known, list(others)
    return known, [replace(test, order=number_of(test.name)) for test in others]


def _motions_in(
    folder: str | Path, units: str | None, time_step: float | None
) -> Callable[[str, str], Motion]:
    """What finds a motion by its name and component, in a folder or among those of a suite."""
    if info_of(str(folder)) is not None and not Path(folder).is_dir():
        if units is not None or time_step is not None:
            log.warning("%s: says its unit and time step itself; those given are not used", folder)
        known = {motion.name: motion for motion in suite(folder)}

        def named_so(name: str, component: str) -> Motion:
            if name not in known:
                near = get_close_matches(name, known, 1) or list(known)[:1]
                raise InputError(
                    f"is no motion of {folder}; one is called {near[0]!r}. For motions of your "
                    "own give the folder in which they lie"
                )
            return known[name]

        return named_so
    if not Path(folder).is_dir():
        raise refused(
            folder, "is neither a folder nor a suite; the motions of the tests are looked for in it"
        )

    def lying_there(name: str, component: str) -> Motion:
        path = Path(folder) / name
        if not os.path.exists(path):  # noqa: PTH110  # of a name that no system accepts, too
            raise InputError(f"no such file in {folder}{_near(name, Path(folder))}")
        return read_motion(path, component=component or None, units=units, time_step=time_step)

    return lying_there


def _near(name: str, folder: Path) -> str:
    """Which file of a folder may be meant, or which ones there are."""
    held = sorted(entry.name for entry in folder.iterdir() if entry.is_file())
    alike = {each.lower(): each for each in held} | {Path(each).stem.lower(): each for each in held}
    near = get_close_matches(name.lower(), alike, 1, 0.75)
    if near:
        return f"; is {quoted(alike[near[0]])} meant?"
    return f", which holds {named(held, MOST_NAMED)}" if held else ", which holds no file"


def _too_long(cells: int, columns: int) -> str:
    return (
        f"has {cells} cells, the header {columns}; is a comma a decimal point? Write 0.5, or "
        "separate cells by semicolons"
    )


def _meaning(header: str) -> str:
    """The column that a header names, "" if none."""
    return _MEANINGS.get(_GAPS.sub(" ", header.lower()).strip(), "")


def _accepted() -> str:
    return (
        f"accepted columns: {', '.join(COLUMNS)}; test and motion are needed, and fell (yes or "
        "no), but where tests are to be predicted; 'shaketable template --tests' writes a table"
    )


def _header_faults(
    sheet: Sheet, header: list[Cell], columns: list[str], outcomes: bool
) -> list[Fault]:
    needed = [*NEEDED, *(["fell"] if outcomes else [])]
    faults = [
        sheet.fault(header[0], "no column", f"no column {meaning!r}")
        for meaning in needed
        if meaning not in columns
    ]
    faults += [
        sheet.fault(header[0], "column", f"{columns.count(meaning)} columns mean {meaning!r}")
        for meaning in COLUMNS
        if columns.count(meaning) > 1
    ]
    unused = []
    for cell, meaning in zip(header, columns, strict=True):
        if not cell.text or meaning:
            continue
        near = get_close_matches(cell.text.lower(), list(_MEANINGS), 1, 0.75)
        if near:
            message = f"unknown column {quoted(cell.text)}; is {near[0]!r} meant?"
            faults.append(sheet.fault(cell, "column", message))
        else:
            unused.append(quoted(cell.text))
    if unused:
        log.warning("%s: columns that are not used: %s", sheet.path, ", ".join(unused))
    return faults


def _test(
    sheet: Sheet, first: Cell, cells: Mapping[str, Cell], outcomes: bool
) -> tuple[list[Fault], dict[str, str]]:
    """The faults of a row, and the texts of its cells."""
    needed = [*NEEDED, *(["fell"] if outcomes else [])]
    faults = [sheet.fault(first, "empty", "is empty", name) for name in needed if name not in cells]
    found = {meaning: cell.text for meaning, cell in cells.items()}
    if "fell" in cells:
        found["fell"] = found["fell"].lower().removesuffix(".0")
        if found["fell"] not in ANSWERS:
            message = f"expected yes or no, or 1 or 0, found {quoted(cells['fell'].text)}"
            faults.append(sheet.fault(cells["fell"], "word", message, "fell"))
    for name, lowest, expected in (
        ("scale", 0.0, "a positive number"),
        ("order", -1e9, "a number"),
    ):
        if name in cells:
            cell = cells[name]
            text, message = (cell.text, "") if cell.typed else with_a_point(sheet, cell.text)
            if not message and not lowest < number_of(text) < 1e9:
                message = f"expected {expected}, found {quoted(cell.text)}"
            if message:
                faults.append(sheet.fault(cell, "number", message, name))
            found[name] = text
    return faults, found
