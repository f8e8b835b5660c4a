"""Small linear systems, also the one of three equations that is written out."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable.physics.space.linear import solve


@pytest.mark.parametrize("count", [2, 3, 5])
def test_systems_are_solved_in_any_order_of_their_rows(count: int) -> None:
    random = np.random.default_rng(count)
    for _ in range(200):
        matrix = random.normal(size=(count, count)) * (random.random((count, count)) < 0.7)
        matrix += 0.3 * np.eye(count)[random.permutation(count)]
        right = random.normal(size=count)
        if np.linalg.cond(matrix) > 1e6:
            continue
        system, solved = np.zeros((count + 2, count + 3)), np.full(count + 2, np.nan)
        system[:count, : count + 1] = np.column_stack([matrix, right])
        assert solve(system, count, solved)
        # round-off times the largest condition that is taken
        assert solved[:count] == pytest.approx(np.linalg.solve(matrix, right), rel=1e-8, abs=1e-9)


@pytest.mark.parametrize("count", [2, 3, 4])
def test_equations_that_depend_on_one_another_are_told(count: int) -> None:
    random = np.random.default_rng(9)
    rows = random.normal(size=(count, count + 1))
    rows[-1] = 2.0 * rows[0]
    solved = np.full(count, 7.0)
    assert not solve(rows, count, solved)
    assert (solved == 7.0).all()
