"""Levels of shaking as people type them: --pga-levels, --sa-levels, --target-spectrum."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.errors import InputError, quoted
from shaketable.inputs import NUMBER
from shaketable.units import STANDARD_GRAVITY, acceleration_factor

if TYPE_CHECKING:
    from shaketable.assess import Level
    from shaketable.building import Building
    from shaketable.signal import IntensityMeasure

Levels = Annotated[
    str | None,
    typer.Option(help="Levels of the ground's peak acceleration, such as 0.2g,0.4g,0.6g."),
]
SpectralLevels = Annotated[
    str | None,
    typer.Option(
        "--sa-levels",
        help="Levels of the ground's 5 % spectral acceleration, such as 1.0s:0.3g,0.5g.",
    ),
]
TargetSpectrum = Annotated[
    Path | None,
    typer.Option(
        "--target-spectrum",
        help="File of a spectrum of the ground that every motion is scaled to fit: period_s,sa_g.",
    ),
]

_LEVEL = re.compile(rf"({NUMBER})\s*([A-Za-z/%²^*0-9]*)", re.ASCII)
_PERIOD = re.compile(rf"({NUMBER})\s*s?", re.ASCII)
_SCALED = (
    "Each horizontal component is scaled by itself to the level, its vertical with it{ground}; "
)
_PAIRED = (
    "Both components of a recording are scaled by one factor, so that their geometric mean has the "
    "level, the vertical with them{ground}; "
)
_RECORDED = (
    "Each earthquake is scaled by one factor, so that the larger component on the lowest floor has "
    "the level, and the other floors with it; "
)
_STAYS = (
    "durations and mixes of frequencies stay as they were recorded, and a real earthquake of that "
    "level may last longer or shake more slowly."
)
STRONGEST = 5.0 * STANDARD_GRAVITY  # m/s²: no ground ever shook so strongly


@dataclass(frozen=True)
class Scaling:
    """What is made equal in all motions, and to which levels.

    Attributes:
        measure: each motion is first scaled to 1 of it (1 m/s² for accelerations).
        levels: names, with the factor on such a motion, rising.
        about: what the levels are, in a sentence.
    """

    measure: IntensityMeasure
    levels: list[Level]
    about: str

    def told(self, building: Building | None, planar: bool = False) -> str:
        """What scaling means, in sentences.

        Args:
            building: whose ground is scaled, if there is one.
            planar: whether each component of motions without a building was scaled by itself.
        """
        names = ", ".join(level.name for level in self.levels)
        if building is not None and not building.computed:
            how = _RECORDED
        else:
            how = (_SCALED if planar and building is None else _PAIRED).format(
                ground=", as the ground's motion, and the floors with it" if building else ""
            )
        return f"{names}. {self.about} {how}{_STAYS}"


def scaling_of(
    levels: str | None, sa: str | None, spectrum: Path | None, scale: float
) -> Scaling | None:
    """What the options ask for, None if nothing.

    Raises:
        InputError: several of them, a factor beside them, or a level that cannot be read.
    """
    given = {"--pga-levels": levels, "--sa-levels": sa, "--target-spectrum": spectrum}
    named = [name for name, value in given.items() if value is not None]
    if not named:
        return None
    if len(named) > 1:
        raise InputError(f"{' and '.join(named)}: give one of them")
    if scale != 1.0:
        raise InputError(f"{named[0]} says how strong the motions are: leave out --scale")
    from shaketable.assess import Level
    from shaketable.signal import (
        peak_ground_acceleration,
        spectral_acceleration_at,
        spectral_ratio_to,
    )
    from shaketable.synthesis import read_spectrum

    if spectrum is not None:
        measure = spectral_ratio_to(read_spectrum(spectrum))
        said = f"The level is the spectrum in {spectrum}."
        return Scaling(measure, [Level(name=measure.name, scale=1.0)], said)
    if sa is not None:
        period, values = _spectral(sa)
        measure = spectral_acceleration_at(period)
        said = f"Levels are spectral accelerations of the ground at {period:g} s, 5 % damped."
    else:
        assert levels is not None
        measure, values = peak_ground_acceleration(), _values("--pga-levels", levels)
        said = "Levels are peak ground accelerations."
    found = [
        Level(name=f"{measure.name} {value / STANDARD_GRAVITY:.3g} g", scale=value)
        for value in sorted(values)
    ]
    if len({level.name for level in found}) < len(found):
        raise InputError(f"{named[0]}: a level is named more than once")
    return Scaling(measure, found, said)


def _spectral(text: str) -> tuple[float, list[float]]:
    """Period [s] and levels [m/s²] of "1.0s:0.3g,0.5g"."""
    before, colon, after = text.partition(":")
    period = _PERIOD.fullmatch(before.strip())
    if not colon or not period or not float(period[1]) > 0.0:
        raise InputError(
            f"--sa-levels: expected a period and levels, such as 1.0s:0.3g, found {quoted(text)}"
        )
    return float(period[1]), _values("--sa-levels", after)


def _values(option: str, text: str) -> list[float]:
    """Levels [m/s²] of "0.2g,0.4g"; a unit stands at each of them, or g is meant."""
    found = [(part.strip(), _LEVEL.fullmatch(part.strip())) for part in text.split(",")]
    units = {match[2] for _, match in found if match}
    values = []
    for part, match in found:
        if not match or not float(match[1]) > 0.0:
            raise InputError(f"{option}: expected levels such as 0.2g,0.4g, found {quoted(part)}")
        if "" in units and len(units) > 1:
            raise InputError(
                f"{option}: found {quoted(text)}; give every level its unit, as in 0.2g,0.4g, and "
                "decimals with a point"
            )
        value = float(match[1]) * acceleration_factor(match[2] or "g")
        if value > STRONGEST:
            raise InputError(
                f"{option}: {quoted(part)} is {value / STANDARD_GRAVITY:.3g} g; at most "
                f"{STRONGEST / STANDARD_GRAVITY:g} g are accepted"
            )
        values.append(value)
    return values
