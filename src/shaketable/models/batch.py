"""Memory for the results of many bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.models.model import ManyRuns, Table

if TYPE_CHECKING:
    from shaketable.engine.batch import Batch


def batch_of(table: Table, polarity: NDArray[np.float64]) -> tuple[Batch, ManyRuns]:
    """The engine's batch of a table's bodies, and a view of the results it will hold."""
    from shaketable.engine.batch import Batch, Result
    from shaketable.physics.plane.layout import length, struct_view

    results = np.zeros((polarity.size, length(Result)))
    run = struct_view(results, Result)
    run["polarity"] = polarity
    run["overturning_time"] = np.nan
    return Batch(table.blocks, table.bodies, table.corners, results), runs_of(results)


def runs_of(results: NDArray[np.float64]) -> ManyRuns:
    """A view of results, the numbers of a Result for each body."""
    from shaketable.engine.batch import Result
    from shaketable.physics.plane.layout import struct_view

    run = struct_view(results, Result)
    named: dict[str, Any] = {name: run[name] for name in ManyRuns._fields if name != "held"}
    return ManyRuns(**named)
