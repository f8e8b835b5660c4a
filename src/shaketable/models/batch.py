"""Room for what becomes of many bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.models.model import ManyRuns, Table

if TYPE_CHECKING:
    from shaketable.engine.lane_loop import Batch


def batch_of(table: Table, polarity: NDArray[np.float64]) -> tuple[Batch, ManyRuns]:
    """The engine's batch of a table's bodies, and what it will hold of them: the same memory."""
    from shaketable.engine.lane_loop import Batch, Run
    from shaketable.kernels.layout import length, named

    runs = np.zeros((polarity.size, length(Run)))
    run = named(runs, Run)
    run["polarity"] = polarity
    run["overturning_time"] = np.nan
    return Batch(*table, runs), ManyRuns(*(run[name] for name in ManyRuns._fields))
