"""Runs of one solid under one motion, before and after."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate.solid_input import upright
from shaketable.solid import Solid
from shaketable.support import Support


class Batch(NamedTuple):
    """Runs of one solid under one motion.

    Attributes:
        members: their numbers in the ensemble, (run,).
        stands: the numbers of a `solids.run.Stand` for each, (run, 5).
    """

    solid: Solid
    motion: Motion
    members: NDArray[np.intp]
    stands: NDArray[np.float64]

    def split(self, count: int) -> tuple[Batch, Batch]:
        """The first so many runs, and the others."""
        return (
            self._replace(members=self.members[:count], stands=self.stands[:count]),
            self._replace(members=self.members[count:], stands=self.stands[count:]),
        )


class SolidPart(NamedTuple):
    """Results of some members of an ensemble.

    Attributes:
        members: their numbers, (run,).
        outcome: see `Outcome`, (run,).
        found: the numbers of a `solids.run.Found` for each, (run, field).
    """

    members: NDArray[np.intp]
    outcome: NDArray[np.int8]
    found: NDArray[np.float64]

    def column(self, field: str) -> NDArray[np.float64]:
        """One number of each run, by its name in `solids.run.Found`."""
        from shaketable.solids.run import Found

        return self.found[:, Found._fields.index(field)]


def stands_of(
    supports: Iterable[Support],
    orientations: Iterable[float],
    scales: Iterable[float],
    polarities: Iterable[float],
) -> NDArray[np.float64]:
    """The numbers of a `solids.run.Stand` for runs side by side, (run, 5)."""
    rows = [
        (*upright(support), orientation, scale, polarity)
        for support, orientation, scale, polarity in zip(
            supports, orientations, scales, polarities, strict=True
        )
    ]
    return np.array(rows, np.float64).reshape(-1, 5)


def part_of(
    members: NDArray[np.intp], stands: NDArray[np.float64], found: NDArray[np.float64]
) -> SolidPart:
    """The results of runs; a fall is downhill within 90° of it."""
    from shaketable.solids.run import Found

    toward = np.cos(found[:, Found._fields.index("fall_azimuth")] - stands[:, 1])
    outcome = np.where(toward >= 0.0, Outcome.DOWNHILL, Outcome.UPHILL)
    outcome[np.isnan(toward)] = Outcome.STANDING
    return SolidPart(members, outcome.astype(np.int8), found)
