"""Response spectra to aim at: of codes, and of a file."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable.body import require_positive
from shaketable.errors import InputError
from shaketable.signal.spectra import Spectrum
from shaketable.units import acceleration_factor

#: Periods of code spectra: dense, with their corners among them [s].
_PERIODS = np.geomspace(0.01, 4.0, 300)


class Ground(NamedTuple):
    """Soil factor and corner periods TB, TC, TD [s] of EN 1998-1."""

    S: float
    TB: float
    TC: float
    TD: float


#: EN 1998-1:2004, tables 3.2 (type 1) and 3.3 (type 2).
EUROCODE_8_GROUNDS = {
    1: {
        "A": Ground(1.0, 0.15, 0.4, 2.0),
        "B": Ground(1.2, 0.15, 0.5, 2.0),
        "C": Ground(1.15, 0.20, 0.6, 2.0),
        "D": Ground(1.35, 0.20, 0.8, 2.0),
        "E": Ground(1.4, 0.15, 0.5, 2.0),
    },
    2: {
        "A": Ground(1.0, 0.05, 0.25, 1.2),
        "B": Ground(1.35, 0.05, 0.25, 1.2),
        "C": Ground(1.5, 0.10, 0.25, 1.2),
        "D": Ground(1.8, 0.10, 0.30, 1.2),
        "E": Ground(1.6, 0.05, 0.25, 1.2),
    },
}


def eurocode_8(
    ground_acceleration: float, ground: str = "A", *, kind: int = 1, damping: float = 0.05
) -> Spectrum:
    """The horizontal elastic spectrum of EN 1998-1:2004, eqs. 3.2-3.6, from 0.01 to 4 s.

    Args:
        ground_acceleration: a_g on rock [m/s²], with the importance factor.
        ground: type of ground, "A" to "E".
        kind: 1, or 2 for regions whose earthquakes have surface magnitudes up to 5.5.
        damping: ratio of critical damping.

    Raises:
        InputError: an unknown ground or kind.
    """
    require_positive("ground_acceleration [m/s²]", ground_acceleration)
    try:
        S, TB, TC, TD = EUROCODE_8_GROUNDS[kind][ground.upper()]
    except KeyError:
        raise InputError(
            f"Eurocode 8 has grounds A to E and kinds 1 and 2, got {ground!r} and {kind!r}"
        ) from None
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
    """A target from a CSV file of two columns: period [s] and pseudo-acceleration.

    A first line of names may say the unit: "period_s,sa_g", "T (s), SA (m/s2)".

    Args:
        units: of acceleration, where the file does not say.

    Raises:
        InputError: names the file, the line, what was found and what is accepted.
    """
    path = Path(path)
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = [
                (n, row) for n, row in enumerate(csv.reader(file), 1) if any(map(str.strip, row))
            ]
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read ({error})") from None
    stated = None
    if rows and not _numbers(rows[0][1]):
        name = rows.pop(0)[1][-1].strip().lower()
        stated = (
            name.rstrip(")]").replace("[", "(").rpartition("(")[2] if name[-1:] in ")]" else None
        )
        if stated is None and "_" in name:
            stated = name.split("_", 1)[1].replace("_", "/")
    unit = stated or units
    if unit is None:
        raise InputError(f"{path}: no unit of acceleration; name the column sa_g, or give units")
    factor = acceleration_factor(unit)
    table = []
    for n, row in rows:
        values = _numbers(row)
        if values is None or len(values) != 2:
            raise InputError(
                f"{path}, line {n}: expected a period and an acceleration, found {row}"
            )
        table.append(values)
    if len(table) < 2:
        raise InputError(f"{path}: holds {len(table)} periods; at least 2 are needed")
    periods, accelerations = np.array(table).T
    try:
        return Spectrum(periods, accelerations * factor, damping, path.stem)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _numbers(row: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in row]
    except ValueError:
        return None
