"""Response spectra to aim at, from codes or from a file."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable.errors import InputError, quoted, refused, require_damping, require_positive
from shaketable.records.columns import header_of, numeric, rows_of, table_of, unit_of
from shaketable.records.text import read_bytes, read_text
from shaketable.signal.spectra import Spectrum

_PERIOD = re.compile(r"(t|periods?)(_s|\s*[(\[]\s*s(ec)?\s*[)\]])?$", re.IGNORECASE)
#: Periods of code spectra: dense, with their corners among them [s].
_PERIODS = np.geomspace(0.01, 4.0, 300)


class GroundClass(NamedTuple):
    """Soil factor and corner periods TB, TC, TD [s] of EN 1998-1."""

    S: float
    TB: float
    TC: float
    TD: float


#: EN 1998-1:2004, tables 3.2 (type 1) and 3.3 (type 2).
EUROCODE_8_GROUNDS = {
    1: {
        "A": GroundClass(1.0, 0.15, 0.4, 2.0),
        "B": GroundClass(1.2, 0.15, 0.5, 2.0),
        "C": GroundClass(1.15, 0.20, 0.6, 2.0),
        "D": GroundClass(1.35, 0.20, 0.8, 2.0),
        "E": GroundClass(1.4, 0.15, 0.5, 2.0),
    },
    2: {
        "A": GroundClass(1.0, 0.05, 0.25, 1.2),
        "B": GroundClass(1.35, 0.05, 0.25, 1.2),
        "C": GroundClass(1.5, 0.10, 0.25, 1.2),
        "D": GroundClass(1.8, 0.10, 0.30, 1.2),
        "E": GroundClass(1.6, 0.05, 0.25, 1.2),
    },
}


def eurocode_8(
    ground_acceleration: float, ground: str = "A", *, kind: int = 1, damping: float = 0.05
) -> Spectrum:
    """The horizontal elastic spectrum of EN 1998-1:2004, eqs. 3.2-3.6, from 0.01 to 4 s.

    Args:
        ground_acceleration: a_g on rock [m/s²], with the importance factor.
        ground: ground type, "A" to "E".
        kind: 1, or 2 for regions whose earthquakes have surface-wave magnitudes up to 5.5.
        damping: ratio of critical damping.

    Raises:
        InputError: an unknown ground or kind, an acceleration or a damping out of range.
    """
    require_positive("ground_acceleration [m/s²]", ground_acceleration)
    try:
        S, TB, TC, TD = EUROCODE_8_GROUNDS[kind][ground.upper()]
    except KeyError:
        raise InputError(
            f"Eurocode 8 has grounds A to E and kinds 1 and 2, got {ground!r} and {kind!r}"
        ) from None
    require_damping(damping)
    eta = max(math.sqrt(10.0 / (5.0 + 100.0 * damping)), 0.55)
    T = np.unique(np.concatenate([_PERIODS, [TB, TC, TD]]))
    plateau = 2.5 * eta
    shape = np.select(
        [T <= TB, T <= TC, T <= TD],
        [1.0 + T / TB * (plateau - 1.0), np.full_like(T, plateau), plateau * TC / T],
        plateau * TC * TD / T**2,
    )
    name = f"Eurocode 8 type {kind}, ground {ground.upper()}, {ground_acceleration:g} m/s²"
    return Spectrum(T, ground_acceleration * S * shape, damping, name)


def asce_7(short: float, one_second: float, *, long_period: float = 8.0) -> Spectrum:
    """The 5 % design spectrum of ASCE 7-16, section 11.4.6, from 0.01 to 10 s.

    Args:
        short, one_second: S_DS and S_D1 [m/s²].
        long_period: T_L [s].

    Raises:
        InputError: accelerations or a period that are not positive.
    """
    require_positive("S_DS [m/s²]", short)
    require_positive("S_D1 [m/s²]", one_second)
    require_positive("T_L [s]", long_period)
    TS = one_second / short
    T0 = 0.2 * TS
    T = np.unique(np.concatenate([np.geomspace(0.01, 10.0, 350), [T0, TS, long_period]]))
    shape = np.select(
        [T < T0, T <= TS, long_period >= T],
        [short * (0.4 + 0.6 * T / T0), np.full_like(T, short), one_second / T],
        one_second * long_period / T**2,
    )
    return Spectrum(T, shape, 0.05, f"ASCE 7, S_DS {short:g}, S_D1 {one_second:g} m/s²")


def read_spectrum(path: str | Path, *, units: str | None = None, damping: float = 0.05) -> Spectrum:
    """A target from a file of two columns: period [s] and pseudo-acceleration.

    A first line of names may say the unit: "period_s,sa_g", "T (s); SA (m/s2)".

    Args:
        units: of acceleration, where the file does not say.
        damping: ratio of critical damping that the spectrum is for.

    Raises:
        InputError: names the file, the line, what was found and what is accepted.
    """
    path = Path(path)
    text = read_text(path, read_bytes(path), units, None)
    rows = rows_of(text)
    names = [] if not rows or numeric(rows[0][1]) else header_of(rows.pop(0)[1])
    if names and not _PERIOD.match(names[0]):
        raise text.fault(f"the first column must be the period in s, found {quoted(names[0])}")
    if names and len(names) != 2:
        raise text.fault(f"expected two columns, found {len(names)}: {', '.join(names)}")
    table, _ = table_of(text, rows, 2)
    stated = unit_of(names[1]) if names else None
    factor = text.factor(stated, f"column {quoted(names[1])}" if names else "the file")
    try:
        return Spectrum(table[:, 0], table[:, 1] * factor, damping, path.stem)
    except InputError as error:
        raise refused(path, f"{error}") from None
