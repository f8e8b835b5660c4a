"""The units in which measures are shown and exported; inside everything is in SI."""

from __future__ import annotations

from typing import NamedTuple

from shaketable.language import number
from shaketable.signal import Measure
from shaketable.units import STANDARD_GRAVITY


class MeasureUnit(NamedTuple):
    """A unit of a measure."""

    name: str
    factor: float  # from SI


G = MeasureUnit("g", 1.0 / STANDARD_GRAVITY)
#: Those of OpenQuake.
SHOWN = {
    "PGA": G,
    "SA": G,
    "AvgSA": G,
    "PGV": MeasureUnit("cm/s", 100.0),
    "PGD": MeasureUnit("cm", 100.0),
}


def unit_shown(measure: Measure) -> MeasureUnit:
    """The unit in which a measure is shown: that of OpenQuake, or SI."""
    return SHOWN.get(measure.name.split("(")[0], MeasureUnit(measure.unit, 1.0))


def in_words(measure: Measure, value: float) -> str:
    """A value [SI] with its measure and unit, as "PGV = 41 cm/s"."""
    unit = unit_shown(measure)
    return f"{measure.name} = {number(unit.factor * value, '.3g')} {unit.name}"
