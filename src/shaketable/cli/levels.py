"""Levels of shaking as people type them: --levels, --sa, --spectrum."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.errors import InputError, quoted
from shaketable.inputs import NUMBER
from shaketable.units import STANDARD_GRAVITY, acceleration_factor

if TYPE_CHECKING:
    from shaketable.assess import Level
    from shaketable.signal import Intensity

Levels = Annotated[
    str | None,
    typer.Option(help="Levels of the ground's peak acceleration, such as 0.2g,0.4g,0.6g."),
]
SpectralLevels = Annotated[
    str | None,
    typer.Option(
        "--sa", help="Levels of the ground's 5 % spectral acceleration, such as 1.0s:0.3g,0.5g."
    ),
]
TargetSpectrum = Annotated[
    Path | None,
    typer.Option(
        "--spectrum",
        help="File of a spectrum of the ground that every motion is scaled to fit: period_s,sa_g.",
    ),
]

_LEVEL = re.compile(rf"({NUMBER})\s*([A-Za-z/%²^*0-9]*)", re.ASCII)
_PERIOD = re.compile(rf"({NUMBER})\s*s?", re.ASCII)
_SAID = (
    "Each horizontal component is scaled by itself to the level, its vertical with it{ground}; "
    "its duration and its mix of frequencies stay as they were recorded, and a real earthquake of "
    "that level may last longer or shake more slowly."
)


@dataclass(frozen=True)
class Scaling:
    """What is made equal in all motions, and to which levels.

    Attributes:
        intensity: scaled to 1 in SI units.
        levels: factors on motions that were scaled so, rising.
        told: what scaling means, in a sentence.
    """

    intensity: Intensity
    levels: list[Level]
    told: str


def scaling_of(
    levels: str | None, sa: str | None, spectrum: Path | None, scale: float, *, building: bool
) -> Scaling | None:
    """What the options ask for, None if nothing.

    Raises:
        InputError: several of them, a factor beside them, or a level that cannot be read.
    """
    given = {"--levels": levels, "--sa": sa, "--spectrum": spectrum}
    named = [name for name, value in given.items() if value is not None]
    if not named:
        return None
    if len(named) > 1:
        raise InputError(f"{' and '.join(named)}: give one of them")
    if scale != 1.0:
        raise InputError(f"{named[0]} says how strong the motions are: leave out --scale")
    from shaketable.assess import Level
    from shaketable.signal import acceleration_at, closeness_to, peak_ground_acceleration
    from shaketable.synthesis import read_spectrum

    if spectrum is not None:
        intensity, values = closeness_to(read_spectrum(spectrum)), [1.0]
        said = f"The level is the spectrum in {spectrum}."
        name: Callable[[float], str] = lambda _: intensity.name  # noqa: E731  one of three names
    elif sa is not None:
        period, values = _spectral(sa)
        intensity = acceleration_at(period)
        said = f"Levels are spectral accelerations of the ground at {period:g} s, 5 % damped."
        name = lambda value: f"{intensity.name} {value / STANDARD_GRAVITY:.3g} g"  # noqa: E731
    else:
        assert levels is not None
        intensity, values = peak_ground_acceleration(), _values("--levels", levels)
        said = "Levels are peak ground accelerations."
        name = lambda value: f"PGA {value / STANDARD_GRAVITY:.3g} g"  # noqa: E731
    ground = ", as the ground's motion, and the floors with it" if building else ""
    found = [Level(name(value), value) for value in sorted(values)]
    names = ", ".join(level.name for level in found)
    return Scaling(intensity, found, f"{names}. {said} {_SAID.format(ground=ground)}")


def _spectral(text: str) -> tuple[float, list[float]]:
    """Period [s] and levels [m/s²] of "1.0s:0.3g,0.5g"."""
    before, colon, after = text.partition(":")
    period = _PERIOD.fullmatch(before.strip())
    if not colon or not period or not float(period[1]) > 0.0:
        raise InputError(
            f"--sa: expected a period and levels, such as 1.0s:0.3g, found {quoted(text)}"
        )
    return float(period[1]), _values("--sa", after)


def _values(option: str, text: str) -> list[float]:
    """Levels [m/s²] of "0.2g,0.4g"; without a unit they are in g."""
    values = []
    for part in text.split(","):
        found = _LEVEL.fullmatch(part.strip())
        if not found or not float(found[1]) > 0.0:
            raise InputError(
                f"{option}: expected levels such as 0.2g,0.4g, found {quoted(part.strip())}"
            )
        values.append(float(found[1]) * acceleration_factor(found[2] or "g"))
    repeated = len(set(values)) < len(values)
    if repeated:
        raise InputError(f"{option}: a level is named more than once: {quoted(text)}")
    return values
