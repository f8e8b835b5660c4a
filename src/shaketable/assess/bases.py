"""The base that would keep an item standing."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.inventory import Item
from shaketable.models import Rocking
from shaketable.simulate import Trial
from shaketable.tilting import pieces, steepest

ACCEPTED_FALLS = 0.10  # share of motions that may still overturn an object that has been made safer
BASE_GRID = np.r_[np.geomspace(0.25, 1.0, 13), np.geomspace(1.0, 6.0, 16)[1:]]  # times the width
FINER_BASES = 8  # widths tried between two widths of the grid

#: The share of simulations that overturns each body on the items' tilt, (body,).
Runner = Callable[[Sequence[Body]], NDArray[np.float64]]


def safe_bases(
    items: Sequence[Item], tilt: float, trial: Trial, done: Callable[[int], None]
) -> NDArray[np.float64]:
    """The smallest base width [m] from which on a share ACCEPTED_FALLS at most falls; NaN if none.

    Args:
        items: those of the inventory.
        tilt: β [rad] of what they stand on.
        trial: motions, their scale, and the model.
        done: is told how many more simulations were made.
    """

    def run(bodies: Sequence[Body]) -> NDArray[np.float64]:
        parts = [
            trial.count(bodies[some], [tilt], done)
            for some in pieces(len(bodies), 2 * len(trial.motions))
        ]
        return np.concatenate(
            [part.falls.sum(axis=(1, 2)) / part.simulations.sum(axis=1) for part in parts]
        )

    # on BASE_GRID, then between its last unsafe width and the next one
    rows = np.arange(len(items))
    widths = np.outer([item.body.width for item in items], BASE_GRID)
    unsafe = _unsafe(items, widths, tilt, run)
    # by chance a wider base may fall a little more often: an item safe as it is needs no wider one
    present = int(np.argmin(np.abs(BASE_GRID - 1.0)))
    unsafe[~unsafe[:, present], present:] = False
    below = _last(unsafe)
    hopeless = below == BASE_GRID.size - 1
    low = widths[rows, np.maximum(below, 0)]
    high = widths[rows, np.minimum(below + 1, BASE_GRID.size - 1)]
    finer = np.linspace(low, high, FINER_BASES + 2, axis=1)[:, 1:]
    found = finer[rows, _last(_unsafe(items, finer[:, :-1], tilt, run)) + 1]
    found = np.where(below < 0, widths[:, 0], found)
    return np.where(hopeless, np.nan, found)


def _unsafe(
    items: Sequence[Item], widths: NDArray[np.float64], tilt: float, run: Runner
) -> NDArray[np.bool_]:
    """Whether an item falls too often at each of its `widths`, (item, k)."""
    bodies = [
        [item.with_base(width) for width in row] for item, row in zip(items, widths, strict=True)
    ]
    stable = np.array([tilt < steepest(row, Rocking()) for row in bodies])
    unsafe = ~stable
    trials = [bodies[i][k] for i, k in np.argwhere(stable)]
    if trials:
        unsafe[stable] = run(trials) > ACCEPTED_FALLS
    return unsafe


def _last(unsafe: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Index of the last True of each row, or -1."""
    backwards = np.c_[unsafe[:, ::-1], np.ones(len(unsafe), np.bool_)]
    return np.asarray(unsafe.shape[1] - 1 - np.argmax(backwards, axis=1))
