"""The base that would keep an item standing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.results import ACCEPTED_FALLS
from shaketable.body import Body
from shaketable.models import Rocking
from shaketable.simulate import ShakingSet
from shaketable.tilting import pieces, steepest

BASE_GRID = np.r_[np.geomspace(0.25, 1.0, 13), np.geomspace(1.0, 6.0, 16)[1:]]  # times the base
FINER_BASES = 8  # bases tried between two bases of the grid

#: The share of simulations that overturns each body on the tilt, (body,).
Runner = Callable[[Sequence[Body]], NDArray[np.float64]]


def widened(body: Body, base: float) -> Body:
    """The same body on a base of another size [m].

    It stands for feet or a plate under an object: the centre of gravity keeps its height and its
    place between the corners, and the radius of gyration stays the same.
    """
    return replace(body, base=base, left=body.left / body.base * base)


def safe_bases(
    bodies: Sequence[Body], tilt: float, trial: ShakingSet, done: Callable[[int], None]
) -> NDArray[np.float64]:
    """The smallest base [m] from which on a share ACCEPTED_FALLS at most falls; NaN if none.

    Args:
        bodies: as they are.
        tilt: β [rad] of what they stand on.
        trial: motions, their scale, and the model.
        done: is told how many more simulations were made.
    """

    def run(trials: Sequence[Body]) -> NDArray[np.float64]:
        parts = [
            trial.count(trials[some], [tilt], done)
            for some in pieces(len(trials), 2 * len(trial.motions))
        ]
        return np.concatenate(
            [part.falls.sum(axis=(1, 2)) / part.simulations.sum(axis=1) for part in parts]
        )

    # on BASE_GRID, then between its last unsafe base and the next one
    rows = np.arange(len(bodies))
    bases = np.outer([body.base for body in bodies], BASE_GRID)
    unsafe = _unsafe(bodies, bases, tilt, run)
    # by chance a wider base may fall a little more often: a body safe as it is needs no wider one
    present = int(np.argmin(np.abs(BASE_GRID - 1.0)))
    unsafe[~unsafe[:, present], present:] = False
    below = _last(unsafe)
    hopeless = below == BASE_GRID.size - 1
    low = bases[rows, np.maximum(below, 0)]
    high = bases[rows, np.minimum(below + 1, BASE_GRID.size - 1)]
    finer = np.linspace(low, high, FINER_BASES + 2, axis=1)[:, 1:]
    found = finer[rows, _last(_unsafe(bodies, finer[:, :-1], tilt, run)) + 1]
    found = np.where(below < 0, bases[:, 0], found)
    return np.where(hopeless, np.nan, found)


def _unsafe(
    bodies: Sequence[Body], bases: NDArray[np.float64], tilt: float, run: Runner
) -> NDArray[np.bool_]:
    """Whether a body falls too often at each of its `bases`, (body, k)."""
    wide = [[widened(body, base) for base in row]
            for body, row in zip(bodies, bases, strict=True)]  # fmt: skip
    stable = np.array([tilt < steepest(row, Rocking()) for row in wide])
    unsafe = ~stable
    trials = [wide[i][k] for i, k in np.argwhere(stable)]
    if trials:
        unsafe[stable] = run(trials) > ACCEPTED_FALLS
    return unsafe


def _last(unsafe: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Index of the last True of each row, or -1."""
    backwards = np.c_[unsafe[:, ::-1], np.ones(len(unsafe), np.bool_)]
    return np.asarray(unsafe.shape[1] - 1 - np.argmax(backwards, axis=1))
