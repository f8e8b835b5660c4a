"""A record file's text, its errors and its numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from shaketable.errors import InputError
from shaketable.units import ACCELERATION_UNITS, acceleration_factor

_EXPONENT = re.compile(r"(?<=\d)[EeDd][+-]?\d*$|(?<=\.)[EeDd][+-]?\d*$")
_LINE_END = re.compile(r"\r\n|\n|\r")
_NUMBERS = re.compile(r"\s*[-+.\d][-+.\dEeDd\s]*")


class NoAccelerationError(InputError):
    """A file that is no record of acceleration; a folder of records may hold such files."""


@dataclass(frozen=True)
class RecordText:
    """A record file's lines, with what the caller said about them."""

    path: Path
    lines: list[str] = field(repr=False)
    units: str | None = None
    time_step: float | None = None

    def fault(self, message: str, line: int | None = None) -> InputError:
        """An error that names the file and, counted from 1, the line."""
        where = f"{self.path}" if line is None else f"{self.path}, line {line}"
        return InputError(f"{where}: {message}")

    def no_acceleration(self, message: str) -> NoAccelerationError:
        """An error for a file that cannot hold an acceleration."""
        return NoAccelerationError(f"{self.path}: {message}")

    def factor(self, stated: str | None, where: str) -> float:
        """One unit, as the file states it or the caller gave it, in m/s²; the two must agree."""
        if stated is None and self.units is None:
            raise self.fault(
                f"{where} names no unit of acceleration; give it: {', '.join(ACCELERATION_UNITS)}"
            )
        try:
            factor = acceleration_factor(stated or self.units or "")
        except InputError as error:
            raise self.fault(f"{where}: {error}") from None
        if self.units is not None and acceleration_factor(self.units) != factor:
            raise self.fault(f"{where} is in {stated}, but the unit given is {self.units}")
        return factor

    def number(self, text: str, line: int) -> float:
        """A finite number, or an error that names its line."""
        try:
            number = float(text)
        except ValueError:
            number = self._fortran(text, line)
        if not math.isfinite(number):
            raise self.fault(f"expected a finite number, found {text!r}", line)
        if "_" in text:  # float() takes 1_0 for ten
            raise self.fault(f"expected a number, found {text!r}", line)
        return number

    def _fortran(self, text: str, line: int) -> float:
        """A number with Fortran's exponent: 1.5D-3."""
        try:
            return float(text.upper().replace("D", "E"))
        except ValueError:
            raise self.fault(f"expected a number, found {text!r}", line) from None

    def step(self, stated: float, line: int | None = None) -> float:
        """The time step that the file states [s], if it is positive and agrees with the caller's.

        It is rounded to nine digits: any more are the round-off of a division.
        """
        if not 0.0 < stated < math.inf:
            raise self.fault(f"the time step must be positive, found {stated:g}", line)
        if self.time_step is not None and abs(self.time_step - stated) > 1e-9:
            raise self.fault(
                f"the file says a time step of {stated:g} s; the one given is {self.time_step:g} s",
                line,
            )
        return float(f"{stated:.9g}")

    def require_count(self, stated: int, found: int, what: str = "values") -> None:
        """Raise an error if the header says another number of values than was found."""
        if found != stated or found < 2:
            short = "cut short: " if found < stated else ""
            raise self.fault(f"{short}the header says {stated} {what}, found {found}")

    def channels(self, *, ended: bool = True) -> list[tuple[int, int]]:
        """Start and end of each channel, as indices of lines; a line "/&" ends a channel.

        Args:
            ended: whether the last channel must have an end line; if not, and no channel has one,
                all lines are one channel.

        Raises:
            InputError: text after the last end line.
        """
        ends = [n for n, line in enumerate(self.lines) if line.startswith("/&")]
        if not ends and not ended:
            return [(0, len(self.lines))]
        # old files end in a control-Z
        after = self.lines[ends[-1] + 1 :] if ends else self.lines
        if any(line.strip("\x1a\0 ") for line in after):
            raise self.fault("cut short: the last channel has no end '/&'", len(self.lines))
        return list(zip([0, *(end + 1 for end in ends[:-1])], ends, strict=True))

    def words(self, rows: Iterable[tuple[int, str]]) -> list[float]:
        """The numbers, separated by blanks, of rows (line number, line)."""
        found = [(word, n) for n, line in rows for word in line.split()]
        if found:
            self.require_last(found[0][0], *found[-1])
        return [self.number(word, n) for word, n in found]

    def require_last(self, first: str, last: str, line: int) -> None:
        """Raise an error if a file ends within its last number: 1.5E-0 where others end in E-03."""
        usual, found = _EXPONENT.search(first), _EXPONENT.search(last)
        if usual is None or "." not in last:
            return
        if found is None or len(found[0]) < len(usual[0]):
            raise self.fault(
                f"cut short within a number: {last!r}, where others are {first!r}", line
            )

    def fixed(
        self, start: int, count: int, width: int, margin: int = 0, *, last: bool = False
    ) -> tuple[list[float], int]:
        """`count` numbers in fields of `width` characters, from the line of index `start` on.

        Stops early at a line that is blank, ends the file, or says "End of".

        Args:
            margin: characters at the start of a line that belong to no field.
            last: whether no more numbers may follow.

        Returns:
            The numbers and the index of the line after them.

        Raises:
            InputError: a row that is not a whole number of fields, or is shorter than the first
                although others follow; more numbers than expected.
        """
        values: list[float] = []
        at = start
        full = 0
        while len(values) < count and at < len(self.lines):
            line = self.lines[at].rstrip()
            if not line or "END" in line[:40].upper():
                break
            fields = [line[k : k + width] for k in range(margin, len(line), width)]
            full = full or len(fields)
            short = len(fields) != full and len(values) + len(fields) < count
            if short or len(fields[-1]) != width:
                raise self.fault(
                    f"expected {full} fields of {width} characters, found {len(line)} characters",
                    at + 1,
                )
            values += [self.number(word, at + 1) for word in fields]
            at += 1
        if last and at < len(self.lines) and _NUMBERS.fullmatch(self.lines[at]):
            raise self.fault(f"more numbers than the {count} that the header says", at + 1)
        return values, at


def read_bytes(path: Path) -> bytes:
    """What a file holds, or an error that says why it cannot be read."""
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: no such file") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None


def read_text(path: Path, raw: bytes, units: str | None, time_step: float | None) -> RecordText:
    """The lines of a text file, or an error that says why there are none."""
    if not raw.strip():
        raise InputError(f"{path}: the file is empty")
    if b"\0" in raw[:4096]:
        raise NoAccelerationError(f"{path}: not a text file")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return RecordText(path, _LINE_END.split(text), units, time_step)


def match_in(pattern: re.Pattern[str], lines: Iterable[str]) -> re.Match[str] | None:
    """The first match in any of the lines."""
    return next((found for line in lines if (found := pattern.search(line))), None)


def fields_of(lines: Iterable[str], separator: str = ":") -> dict[str, str]:
    """ "Key: value" lines as a dictionary; the first of equal keys wins."""
    found: dict[str, str] = {}
    for line in lines:
        key, colon, value = line.partition(separator)
        if colon:
            found.setdefault(key.strip(), value.strip())
    return found
