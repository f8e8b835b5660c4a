"""Small linear systems."""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.workspace import Floats

Row = tuple[float, float, float, float]

SINGULAR = 1e-13  # of the largest entry: a smaller pivot is zero


@routine
def solve(system: Floats, k: int, solved: Floats) -> bool:
    """Solve the k equations in system[:k, :k + 1], the last column their right sides.

    Returns False, with nothing solved, where they depend on one another.
    """
    if k == 3:
        return solve_three(system, solved)
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
        pivot = system[i, i]
        for row in range(i + 1, k):
            factor = system[row, i] / pivot
            if factor != 0.0:  # rows of contacts apart have nothing in common
                for j in range(i + 1, k + 1):
                    system[row, j] -= factor * system[i, j]
    for back in range(k):
        i = k - 1 - back
        rest = system[i, k]
        for j in range(i + 1, k):
            rest -= system[i, j] * solved[j]
        solved[i] = rest / system[i, i]
    return True


@routine
def solve_three(system: Floats, solved: Floats) -> bool:
    """The same of three equations, to the bit: a fifth of the time of what slides flat was here."""
    first = system[0, 0], system[0, 1], system[0, 2], system[0, 3]
    second = system[1, 0], system[1, 1], system[1, 2], system[1, 3]
    third = system[2, 0], system[2, 1], system[2, 2], system[2, 3]
    least = SINGULAR * max(
        abs(first[0]), abs(first[1]), abs(first[2]), abs(second[0]), abs(second[1]),
        abs(second[2]), abs(third[0]), abs(third[1]), abs(third[2]),
    )  # fmt: skip
    if abs(third[0]) > max(abs(first[0]), abs(second[0])):
        first, third = third, first
    elif abs(second[0]) > abs(first[0]):
        first, second = second, first
    if abs(first[0]) <= least:
        return False
    second, third = eliminated(first, second), eliminated(first, third)
    if abs(third[1]) > abs(second[1]):
        second, third = third, second
    if abs(second[1]) <= least:
        return False
    factor = third[1] / second[1]
    pivot = third[2] - factor * second[2]
    if abs(pivot) <= least:
        return False
    z = (third[3] - factor * second[3]) / pivot
    y = (second[3] - second[2] * z) / second[1]
    solved[0] = (first[3] - first[1] * y - first[2] * z) / first[0]
    solved[1], solved[2] = y, z
    return True


@kernel
def eliminated(by: Row, row: Row) -> Row:
    """An equation without its first unknown."""
    factor = row[0] / by[0]
    return (
        0.0,
        row[1] - factor * by[1],
        row[2] - factor * by[2],
        row[3] - factor * by[3],
    )
