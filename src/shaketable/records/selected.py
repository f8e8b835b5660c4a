"""A selection: a table of motions from suites, folders and files, each with a factor.

    source,motion,factor,sha256,units,time_step_s
    fema-p695-far-field,NORTHR/MUL009,1.31,5f0c…,,
    records,RSN1004_SPV270,0.82,a91b…,g,0.01

A source is the name of a suite, or a path relative to the table; sha256 is that of the motion's
samples and finds it, so that no other is taken for it; units and time step are those that had to be
said to read the source.
"""

from __future__ import annotations

import csv
import hashlib
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import InputError, quoted, refused
from shaketable.inputs import read_file
from shaketable.language import tell
from shaketable.motion import Motion

HEADER = ("source", "motion", "factor", "sha256", "units", "time_step_s")
FACTORS = (1e-6, 1e6)


class Row(NamedTuple):
    """A motion of a selection, and the line on which it stands."""

    line: int
    source: str
    motion: str
    factor: float
    sha256: str
    units: str
    time_step: float | None


class Reading(NamedTuple):
    """How a source is read."""

    source: str
    units: str | None
    time_step: float | None


def is_selection(path: Path) -> bool:
    """Whether a file begins like a selection."""
    try:
        file = path.open("rb")
    except OSError:
        return False  # whoever reads it says why it cannot be read
    with file:
        first = file.readline(256).removeprefix(b"\xef\xbb\xbf").strip().lower()
    return any(first.startswith(mark.join(HEADER).encode()) for mark in ",;\t")


def fingerprint(motion: Motion) -> str:
    """What tells a motion from another of the same name: a hash of its samples and time step."""
    told = hashlib.sha256(motion.horizontal.tobytes())
    told.update(repr(motion.time_step).encode())
    return told.hexdigest()


def read_rows(path: Path) -> list[Row]:
    """The rows of a selection.

    Raises:
        InputError: names the line, what was found and what is accepted.
    """
    lines = read_file(path).decode("utf-8-sig", errors="replace").splitlines()
    rows = []
    try:
        mark = next(
            mark for mark in ",;\t" if lines[0].strip().lower().startswith(mark.join(HEADER))
        )
        table = list(csv.reader(lines[1:], delimiter=mark))
    except csv.Error as error:
        raise refused(path, tell("not a table ({error})", error=error)) from None
    for line, cells in enumerate(table, 2):
        if not cells:
            continue
        if len(cells) < len(HEADER):
            text = tell(
                "expected {header}, found {count} cells", header=", ".join(HEADER), count=len(cells)
            )
            raise refused(path, text, where=tell("line {line}", line=line))
        source, motion, factor, sha256, units, step = (cell.strip() for cell in cells[:6])
        numbers = {"factor": factor, "time_step_s": step}
        for name, told in numbers.items():
            if (name == "factor" or told) and not FACTORS[0] <= _number(told) <= FACTORS[1]:
                text = tell("expected a number above 0, found {found}", found=quoted(told))
                raise refused(path, text, where=tell("line {line}", line=line), column=name)
        time_step = float(step) if step else None
        source = source.removeprefix("'")  # put before what spreadsheets take for a formula
        rows.append(Row(line, source, motion, float(factor), sha256, units, time_step))
    if not rows:
        raise refused(path, tell("a selection without a motion"))
    return rows


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def selected(
    path: Path,
    rows: Sequence[Row],
    motions_of: Callable[[Reading, bool], Sequence[Motion]],
    vertical: bool,
) -> list[Motion]:
    """The motions of a selection, scaled, in its order.

    Args:
        path: of the selection.
        rows: of it.
        motions_of: the motions of a source, without vertical components or with them.
        vertical: whether to pair the motions with their vertical components.

    Raises:
        InputError: a source that is not there, a motion that it does not have, has with other
            samples, or has without a vertical component.
    """
    sources = {}
    for row in rows:
        how = _reading(row)
        if how not in sources:
            sources[how] = _by_fingerprint(path, row, how, motions_of, vertical)
    found = []
    for row in rows:
        motion, names = sources[_reading(row)].get(row.sha256), sources[_reading(row)]
        if motion is None:
            called = any(one.name == row.motion for one in names.values())
            names_of = {"motion": quoted(row.motion), "source": quoted(row.source)}
            text = tell("{motion} of {source} is not there", **names_of)
            if called:
                text = tell(
                    "{motion} of {source} has other samples than when it was selected", **names_of
                )
            raise refused(path, text, where=tell("line {line}", line=row.line))
        found.append(motion.scaled(row.factor))
    return found


def _reading(row: Row) -> Reading:
    return Reading(row.source, row.units or None, row.time_step)


def _by_fingerprint(
    path: Path,
    row: Row,
    how: Reading,
    motions_of: Callable[[Reading, bool], Sequence[Motion]],
    vertical: bool,
) -> dict[str, Motion]:
    """The motions of a source by their samples, which a vertical component may lengthen."""
    try:
        bare = motions_of(how, False)
        if not vertical:
            return {fingerprint(motion): motion for motion in bare}
        paired = {_recorded(motion): motion for motion in motions_of(how, True)}
    except InputError as error:
        text = tell(
            "its source is looked for beside this file: {error}; correct the column source, or "
            "select again",
            error=error,
        )
        raise refused(path, text, where=tell("line {line}", line=row.line)) from None
    return {
        fingerprint(motion): paired[_recorded(motion)]
        for motion in bare
        if _recorded(motion) in paired
    }


def _recorded(motion: Motion) -> tuple[object, ...]:
    """What a motion is of, whether or not its vertical component is beside it."""
    origin = motion.origin
    if origin is None:
        return (motion.name,)
    return (motion.name, origin.file, origin.component, origin.azimuth, origin.location)
