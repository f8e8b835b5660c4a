"""Small linear systems."""

from __future__ import annotations

from shaketable.compiled import routine
from shaketable.physics.space.workspace import Floats

SINGULAR = 1e-13  # of the largest entry: a smaller pivot is zero


@routine
def solve(system: Floats, k: int, solved: Floats) -> bool:
    """Solve the k equations in system[:k, :k + 1], the last column their right sides.

    Returns False, with nothing solved, where they depend on one another.
    """
    largest = 0.0
    for i in range(k):
        for j in range(k):
            largest = max(largest, abs(system[i, j]))
    for i in range(k):
        best = i
        for row in range(i + 1, k):
            if abs(system[row, i]) > abs(system[best, i]):
                best = row
        if abs(system[best, i]) <= SINGULAR * largest:
            return False
        if best != i:
            for j in range(i, k + 1):
                system[i, j], system[best, j] = system[best, j], system[i, j]
        for row in range(i + 1, k):
            factor = system[row, i] / system[i, i]
            for j in range(i, k + 1):
                system[row, j] -= factor * system[i, j]
    for back in range(k):
        i = k - 1 - back
        rest = system[i, k]
        for j in range(i + 1, k):
            rest -= system[i, j] * solved[j]
        solved[i] = rest / system[i, i]
    return True
