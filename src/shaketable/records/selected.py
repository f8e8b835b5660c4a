"""A selection: a table of motions from suites, folders and files, each with a factor.

    source,motion,factor,sha256
    fema-p695-far-field,NORTHR/MUL009,1.31,5f0c…
    records,RSN1004_SPV270,0.82,a91b…

A source is the name of a suite, or a path relative to the table; sha256 is that of the motion's
samples, so that another file of the same name is not taken for it.
"""

from __future__ import annotations

import csv
import hashlib
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import InputError, quoted
from shaketable.inputs import read_file
from shaketable.motion import Motion

HEADER = ("source", "motion", "factor", "sha256")
FACTORS = (1e-6, 1e6)


class Row(NamedTuple):
    """A motion of a selection, and the line on which it stands."""

    line: int
    source: str
    motion: str
    factor: float
    sha256: str


def is_selection(path: Path) -> bool:
    """Whether a file begins like a selection."""
    try:
        file = path.open("rb")
    except OSError:
        return False  # whoever reads it says why it cannot be read
    with file:
        return file.readline(256).strip().lower().startswith(",".join(HEADER).encode())


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
        table = list(csv.reader(lines[1:]))
    except csv.Error as error:
        raise InputError(f"{path}: not a table ({error})") from None
    for line, cells in enumerate(table, 2):
        if not cells:
            continue
        if len(cells) < len(HEADER):
            raise InputError(
                f"{path}, line {line}: expected {', '.join(HEADER)}, found {len(cells)} cells"
            )
        source, motion, factor, sha256 = (cell.strip() for cell in cells[: len(HEADER)])
        try:
            value = float(factor)
        except ValueError:
            value = math.nan
        if not FACTORS[0] <= value <= FACTORS[1]:
            raise InputError(
                f"{path}, line {line}, factor: expected a number above 0, found {quoted(factor)}"
            )
        rows.append(Row(line, source, motion, value, sha256))
    if not rows:
        raise InputError(f"{path}: a selection without a motion")
    return rows


def selected(
    path: Path, rows: Sequence[Row], motions_of: Callable[[str], Sequence[Motion]]
) -> list[Motion]:
    """The motions of a selection, scaled, in its order.

    Args:
        path: of the selection.
        rows: of it.
        motions_of: the motions of a source.

    Raises:
        InputError: a motion that its source does not have, or has with other samples.
    """
    sources = {
        source: [(motion.name, fingerprint(motion), motion) for motion in motions_of(source)]
        for source in dict.fromkeys(row.source for row in rows)
    }
    found = []
    for row in rows:
        called = [entry for entry in sources[row.source] if entry[0] == row.motion]
        same = [motion for _, told, motion in called if told == row.sha256]
        if not same:
            why = "has other samples than when it was selected" if called else "is not there"
            raise InputError(
                f"{path}, line {row.line}: {quoted(row.motion)} of {quoted(row.source)} {why}"
            )
        found.append(same[0].scaled(row.factor))
    return found
