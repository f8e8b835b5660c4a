"""Motions scaled to a level: of peak acceleration, of spectral acceleration, or of a spectrum."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from shaketable.errors import InputError, require_positive
from shaketable.motion import Motion
from shaketable.signal.intensity import Measure, Record
from shaketable.signal.spectra import Spectrum, spectral_acceleration


@dataclass(frozen=True, eq=False)
class IntensityMeasure:
    """The intensity measure to which all motions are scaled.

    Attributes:
        name: what to call it.
        of: its value for the horizontal component of a motion, > 0; proportional to it.
    """

    name: str
    of: Callable[[Motion], float]

    def factor(self, motion: Motion) -> float:
        """The factor that brings a motion to 1 of this measure.

        Of one with both horizontal components it is the geometric mean of theirs that becomes 1.

        Raises:
            InputError: a motion without any.
        """
        values = [self.of(component) for component in motion.components()]
        value = math.prod(values) ** (1.0 / len(values))
        if not value > 0.0:
            raise InputError(
                f"motion {motion.name!r}: its {self.name} is zero; it cannot be scaled"
            )
        return 1.0 / value


def by_measure(measure: Measure) -> IntensityMeasure:
    """Any measure that grows with the motion [SI].

    Raises:
        InputError: one that does not, such as a duration.
    """
    if measure.power != 1:
        raise InputError(f"{measure.name}: a motion cannot be scaled to it")
    return IntensityMeasure(
        measure.name, lambda motion: measure.of(Record(motion.horizontal, motion.time_step))
    )


def peak_ground_acceleration() -> IntensityMeasure:
    """PGA of the horizontal component [m/s²]."""
    return IntensityMeasure("PGA", lambda motion: motion.peak_ground_acceleration)


def spectral_acceleration_at(period: float, damping: float = 0.05) -> IntensityMeasure:
    """Pseudo-acceleration of the horizontal component at a period [s], in m/s².

    Raises:
        InputError: a period or a damping out of range.
    """
    require_positive("period [s]", period)

    def of(motion: Motion) -> float:
        series, step = motion.horizontal, motion.time_step
        return float(spectral_acceleration(series, step, [period], damping=damping)[0])

    return IntensityMeasure(f"Sa({period:g} s)", of)


def spectral_ratio_to(target: Spectrum) -> IntensityMeasure:
    """How large a motion's spectrum is beside a target: the geometric mean of their ratios.

    It is taken at the target's periods; a factor of one over it leaves the smallest sum of squared
    differences of the logarithms (as in ground motion selection, e.g. Baker & Lee 2018, eq. 6).
    """

    def of(motion: Motion) -> float:
        own = spectral_acceleration(
            motion.horizontal, motion.time_step, target.periods, damping=target.damping
        )
        both = (own > 0.0) & (target.acceleration > 0.0)
        if not both.any():
            return 0.0
        return math.exp(float(np.mean(np.log(own[both] / target.acceleration[both]))))

    return IntensityMeasure(f"spectrum {target.name}", of)
