"""The intensity measures of a library: of the ground, or of the floor on which things stand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, quoted
from shaketable.fragility.intensities import intensities
from shaketable.motion import Motion
from shaketable.signal import Measure, measure_named

FLOOR = "floor "


class LibraryMeasure(NamedTuple):
    """A measure of a library.

    Attributes:
        name: with a leading "floor " where it is of the floor's motion.
        measure: in SI.
        of_floor: whether it is of the floor's motion, and not of the ground's.
    """

    name: str
    measure: Measure
    of_floor: bool


def require_measure(name: str) -> str:
    """The name of a measure that grows with the motion.

    Raises:
        InputError: none of this name, or one that does not grow with it.
    """
    if not measure_of(name).measure.power:
        raise InputError(f"measure {quoted(name)} does not grow with the motion")
    return name


def measure_of(name: str) -> LibraryMeasure:
    """The measure of a name.

    Raises:
        InputError: none of this name.
    """
    return LibraryMeasure(name, measure_named(name.removeprefix(FLOOR)), name.startswith(FLOOR))


def levels_of(measure: Measure, motions: Sequence[Motion]) -> NDArray[np.float64]:
    """The geometric mean of a measure of both components of each motion [SI], (motion,)."""
    both = (intensities(motion.components(), measure)[:, 0] for motion in motions)
    return np.array([float(np.exp(np.log(each).mean())) for each in both])
