"""One recorded component, and the text it was read from."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.units import ACCELERATION_UNITS, acceleration_factor

#: What networks call the vertical component.
VERTICAL_CODES = {"UP", "DOWN", "DWN", "DN", "UD", "V", "VER", "VERT", "VERTICAL", "Z"}


@dataclass(frozen=True, kw_only=True, eq=False)
class Component:
    """A recorded acceleration component as its file gives it.

    Attributes:
        acceleration: [m/s²], shape (n,).
        time_step: [s].
        code: the network's word for the component ("H1", "UP", "NS"), "" if none.
        azimuth: clockwise from north [degrees], None if the file does not say.
        start: time of the first sample [s], 0 if the file does not say.
        station, event: as in the file, "" if none.
        path: the file.
    """

    acceleration: NDArray[np.float64] = field(repr=False)
    time_step: float
    code: str = ""
    azimuth: float | None = None
    start: float = 0.0
    station: str = ""
    event: str = ""
    path: Path = Path()

    @property
    def is_vertical(self) -> bool:
        """Whether the file calls it a vertical component."""
        return self.code.upper() in VERTICAL_CODES


@dataclass(frozen=True)
class RecordText:
    """A record file's lines, with what the caller said about them."""

    path: Path
    lines: list[str]
    units: str | None
    time_step: float | None

    def fault(self, message: str, line: int | None = None) -> InputError:
        """An error that names the file and, counted from 1, the line."""
        where = f"{self.path}" if line is None else f"{self.path}, line {line}"
        return InputError(f"{where}: {message}")

    def factor(self, stated: str | None, where: str) -> float:
        """m/s² in the unit that the file states or the caller gave; both must agree."""
        if stated is None and self.units is None:
            raise self.fault(
                f"{where} names no unit of acceleration; give it: {', '.join(ACCELERATION_UNITS)}"
            )
        if stated is not None and stated.lower() not in ACCELERATION_UNITS:
            raise self.fault(
                f"{where}: unknown unit {stated!r}; accepted: {', '.join(ACCELERATION_UNITS)}"
            )
        factor = acceleration_factor(stated or self.units or "")
        if self.units is not None and acceleration_factor(self.units) != factor:
            raise self.fault(f"{where} is in {stated}, the unit given is {self.units}")
        return factor

    def number(self, text: str, line: int) -> float:
        """A finite number, or an error that names its line."""
        try:
            number = float(text.replace("D", "E").replace("d", "e").replace("_", "?"))
        except ValueError:
            raise self.fault(f"expected a number, found {text!r}", line) from None
        if not math.isfinite(number):
            raise self.fault(f"expected a finite number, found {text!r}", line)
        return number


def read_text(path: Path, units: str | None, time_step: float | None) -> RecordText:
    """The lines of a text file, or an error that says why there are none."""
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: no such file") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from None
    if not raw.strip():
        raise InputError(f"{path}: the file is empty")
    if b"\0" in raw[:4096]:
        raise InputError(f"{path}: not a text file")
    return RecordText(
        path, raw.decode("utf-8-sig", errors="replace").splitlines(), units, time_step
    )
