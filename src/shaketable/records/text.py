"""A record file's text, and the errors that name its lines."""

from __future__ import annotations

import logging
import math
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import Fault, InputError, quoted, refusal, refused
from shaketable.inputs import NUMBER, TooLargeError, read_file
from shaketable.language import tell, translated
from shaketable.units import OFFERED_UNITS, acceleration_factor

log = logging.getLogger(__name__)

MOST_LINES = 2_000_000
LONGEST_LINE = 20_000  # characters
HEADER_WIDTH = 200  # characters of a line in which patterns are looked for
STEPS = (1e-5, 1.0)  # s: shortest and longest time step of a record

_LINE_END = re.compile(r"\r\n|\n|\r")
_NUMBER = re.compile(NUMBER, re.ASCII)
_NO_NUMBER = re.compile(r"[-+]?(nan|inf|infinity)", re.IGNORECASE)
_WHOLE = re.compile(r"\d{1,9}", re.ASCII)
_COUNTS = re.compile(r"(raw|digital)?\s*(counts?|cnts?|digits?|lsb|dus?)", re.IGNORECASE)


#: Kinds of faults that a caller can mend by saying what the file does not.
NO_UNIT, NO_TIME_STEP = "no unit", "no time step"


class NoAccelerationError(InputError):
    """A file that is no record of acceleration; a folder of records may hold such files."""


def no_acceleration(path: Path, text: str, line: int | None = None) -> NoAccelerationError:
    """The error for a file that cannot hold an acceleration."""
    return refusal([Fault(path, _at(line), "", "no acceleration", text)], NoAccelerationError)


def _at(line: int | None) -> str:
    return "" if line is None else tell("line {line}", line=line)


class Match(NamedTuple):
    """A pattern's match, and the number of its line."""

    match: re.Match[str]
    line: int

    def word(self, group: int | str = 1) -> tuple[str, int]:
        """A group and its line, as `RecordText.number` and others take them."""
        return self.match.group(group), self.line


@dataclass(frozen=True)
class RecordText:
    """A record file's lines, with what the caller said about them."""

    path: Path
    lines: list[str] = field(repr=False)
    units: str | None = None
    time_step: float | None = None
    _looked_at: list[int] = field(default_factory=lambda: [1], init=False, repr=False)

    def fault(self, message: str, line: int | None = None) -> InputError:
        """An error that names the file and, counted from 1, the line."""
        return refused(self.path, message, where=_at(line), kind="record")

    def unsaid(self, kind: str, message: str, mend: str) -> InputError:
        """The error for what the file does not say, and a caller can; `kind` is one of the two."""
        return refusal([Fault(self.path, "", "", kind, message, mend)])

    def damaged(self, error: Exception) -> InputError:
        """What a reader's own arithmetic or indexing met, as an error.

        Its line is the last one on which a pattern of the header or a single number was found;
        series of numbers, which stand below it, are not followed.
        """
        said = f"{type(error).__name__}: {error}"[:200]
        return self.fault(
            tell(
                "on this line or below it the file is not as its format prescribes ({said})",
                said=said,
            ),
            self._looked_at[0],
        )

    def no_acceleration(self, message: str) -> NoAccelerationError:
        """An error for a file that cannot hold an acceleration."""
        return no_acceleration(self.path, message)

    def factor(self, stated: str | None, where: str) -> float:
        """One unit in m/s², as the file states it; the caller's is for files that do not.

        Raises:
            NoAccelerationError: it holds a digitizer's raw counts.
            InputError: the unit is not known, or not stated.
        """
        if stated is not None and _COUNTS.fullmatch(stated.strip()):
            raise self.no_acceleration(
                tell(
                    "{where}: holds the raw counts of a digitizer ({found}), which are no "
                    "accelerations; give the processed file of the same record",
                    where=where,
                    found=quoted(stated.strip()),
                )
            )
        if stated is None and self.units is None:
            raise self.unsaid(
                NO_UNIT,
                tell("{where} names no unit of acceleration", where=where),
                tell(
                    "give it with --units (in Python units=), one of {accepted}",
                    accepted=", ".join(OFFERED_UNITS),
                ),
            )
        try:
            return acceleration_factor(stated or self.units or "")
        except InputError as error:
            raise self.fault(tell("{where}: {error}", where=where, error=error)) from None

    def number(self, text: str, line: int) -> float:
        """A finite number in ASCII digits, Fortran's 1.5D-3 among them."""
        self._looked_at[0] = line
        if not _NUMBER.fullmatch(text.strip()):
            kind = "a finite number" if _NO_NUMBER.fullmatch(text.strip()) else "a number"
            raise self.fault(
                tell("expected {kind}, found {found}", kind=translated(kind), found=quoted(text)),
                line,
            )
        number = float(text.upper().replace("D", "E"))
        if not math.isfinite(number):
            raise self.fault(
                tell("expected a finite number, found {found}", found=quoted(text)), line
            )
        return number

    def whole(self, text: str, line: int) -> int:
        """A count of at most nine digits."""
        self._looked_at[0] = line
        if not _WHOLE.fullmatch(text.strip()):
            raise self.fault(
                tell(
                    "expected a whole number of at most 9 digits, found {found}", found=quoted(text)
                ),
                line,
            )
        return int(text)

    def step(self, stated: float, line: int | None = None) -> float:
        """The time step that the file states [s], if it can be one and agrees with the caller's.

        It is rounded to nine digits: any more are the round-off of a division.
        """
        if not stated > 0.0:
            raise self.fault(
                tell("the time step must be positive, found {stated:g}", stated=stated), line
            )
        if not STEPS[0] <= stated <= STEPS[1]:
            raise self.fault(
                tell(
                    "a time step of {stated:g} s; accepted: {least:g} to {most:g} s",
                    stated=stated,
                    least=STEPS[0],
                    most=STEPS[1],
                ),
                line,
            )
        if self.time_step is not None and abs(self.time_step - stated) > 1e-9:
            raise self.fault(
                tell(
                    "the file says a time step of {stated:g} s; the one given is {time_step:g} s",
                    stated=stated,
                    time_step=self.time_step,
                ),
                line,
            )
        return float(f"{stated:.9g}")

    def step_of_rate(self, rate: float, line: int | None = None) -> float:
        """The time step [s] of so many samples a second."""
        if not rate > 0.0:
            raise self.fault(
                tell("the sampling rate must be positive, found {rate:g}", rate=rate), line
            )
        return self.step(1.0 / rate, line)

    def rows(self, start: int = 0, stop: int | None = None) -> list[tuple[int, str]]:
        """(line number, line) of the lines of index `start` to `stop`."""
        return list(enumerate(self.lines[start:stop], start + 1))

    def search(
        self, pattern: re.Pattern[str], start: int = 0, stop: int | None = None
    ) -> Match | None:
        """The first match in the lines of index `start` to `stop`."""
        for n, line in enumerate(self.lines[start:stop], start + 1):
            found = pattern.search(line[:HEADER_WIDTH])
            if found:
                self._looked_at[0] = n
                return Match(found, n)
        return None

    def word(
        self, pattern: re.Pattern[str], start: int = 0, stop: int | None = None, group: int = 1
    ) -> str:
        """A group of the first match, without blanks around it; "" if there is no match."""
        found = self.search(pattern, start, stop)
        return (found.match.group(group) or "").strip() if found else ""

    def after(self, start: int, stop: int | None = None) -> int | None:
        """The index of the first line from `start` on that says something, None if there is none.

        Old files end in a control-Z.
        """
        stop = len(self.lines) if stop is None else stop
        return next((n for n in range(start, stop) if self.lines[n].strip("\x1a\0 ")), None)

    def warn_if_cut(self, found: int, recorded: int, what: str = "the format has") -> None:
        """Warn if a file holds some of the recorded components; many hold one each."""
        if 1 < found < recorded:
            log.warning(
                "%s: holds %d of the %d components that %s; was it cut?",
                self.path,
                found,
                recorded,
                what,
            )


def read_bytes(path: Path) -> bytes:
    """What a record file holds.

    Raises:
        InputError: says why it cannot be read.
        NoAccelerationError: it is larger than any record, and no text.
    """
    try:
        return read_file(path)
    except TooLargeError as error:
        with path.open("rb") as file:
            if b"\0" in file.read(4096):
                raise refusal(error.listed, NoAccelerationError) from None
        raise


def read_text(path: Path, raw: bytes, units: str | None, time_step: float | None) -> RecordText:
    """The lines of a text file, or an error that says why there are none."""
    if not raw.strip():
        raise refused(path, tell("the file is empty"))
    if b"\0" in raw[:4096]:
        raise no_acceleration(path, tell("not a text file"))
    if raw.count(b"\n") + raw.count(b"\r") > MOST_LINES:
        raise refused(
            path, tell("has more than {most:,} lines, the most that are read", most=MOST_LINES)
        )
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    lines = _LINE_END.split(text)
    longest = max(map(len, lines))
    if longest > LONGEST_LINE:
        at = next(n for n, line in enumerate(lines, 1) if len(line) == longest)
        raise no_acceleration(
            path,
            tell(
                "has {longest:,} characters; a record's lines have at most {longest_line:,}",
                longest=longest,
                longest_line=LONGEST_LINE,
            ),
            at,
        )
    return RecordText(path, lines, units, time_step)
