"""What else is known of motions: their duration, and the magnitude and distance of their source."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.fragility.intensities import intensities
from shaketable.motion import Motion
from shaketable.signal import measure_named

DURATION, MAGNITUDE, DISTANCE = "D5-95", "magnitude", "distance"


class Covariate(NamedTuple):
    """A quantity of each motion.

    Attributes:
        values: (motion,).
        label: its name and unit, for axes.
        is_logarithmic: whether its logarithm is what acts; the magnitude is a logarithm already.
    """

    values: NDArray[np.float64]
    label: str
    is_logarithmic: bool = True

    @property
    def scale(self) -> NDArray[np.float64]:
        """What acts, (motion,)."""
        return np.log(self.values) if self.is_logarithmic else self.values

    @property
    def standard(self) -> NDArray[np.float64]:
        """The same less its mean, over its standard deviation; zeros where all are equal."""
        spread = float(self.scale.std())
        return np.asarray((self.scale - self.scale.mean()) / (spread or 1.0))


def known_covariates(
    motions: Sequence[Motion], given: Mapping[str, ArrayLike] | None = None
) -> dict[str, Covariate]:
    """The significant duration, magnitude and distance where all motions' are known, and others.

    Args:
        motions: whose origins may tell the magnitude and the distance to the rupture.
        given: other quantities above 0, (motion,) each.

    Raises:
        InputError: given ones of another length, or not above 0.
    """
    durations = np.maximum(intensities(motions, measure_named(DURATION))[:, 0], 1e-12)
    found = {DURATION: Covariate(durations, f"{DURATION} [s]")}
    magnitudes = [motion.origin.magnitude if motion.origin else None for motion in motions]
    if _all_known(magnitudes):
        found[MAGNITUDE] = Covariate(np.array(magnitudes, np.float64), "magnitude", False)
    distances = [motion.origin.distance if motion.origin else None for motion in motions]
    if _all_known(distances):
        found[DISTANCE] = Covariate(np.array(distances, np.float64), "distance [km]")
    for name, values in (given or {}).items():
        each = np.asarray(values, np.float64)
        if each.shape != (len(motions),) or not ((each > 0.0) & np.isfinite(each)).all():
            raise InputError(
                f"covariate {name!r}: one finite value above 0 for each of the {len(motions)} "
                f"motions, got shape {each.shape}"
            )
        found[name] = Covariate(each, name)
    return found


def _all_known(values: Sequence[float | None]) -> bool:
    return all(value is not None and 0.0 < value < np.inf for value in values)
