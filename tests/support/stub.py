"""A model that costs nothing, for what surrounds the simulations."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable import Rocking
from shaketable.models.model import ManyRuns, Table
from shaketable.physics.plane.forcing import Shaking


@dataclass(frozen=True)
class Stub(Rocking):
    """Falls by a plain formula instead of a simulation."""

    def run_many(self, table: Table, polarity: NDArray[np.float64], shaking: Shaking) -> ManyRuns:
        zero = np.zeros(polarity.size)
        falls = (np.arange(polarity.size) % 3 > 0) * polarity
        lasting = np.where(falls == 0.0, np.nan, 1.0)
        return ManyRuns(zero, falls, lasting, zero + 0.1, zero, zero, zero, zero, zero)
