"""The polynomial through a step, on which the end of a contact mode is looked for."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import General, Solid
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.events import write_between, write_polynomial
from shaketable.physics.space.rates import rates
from shaketable.physics.space.step import Pull, pull_at, take_step
from shaketable.physics.space.vectors import Vec
from shaketable.physics.space.workspace import STATE, Q, V, W


@pytest.mark.slow  # it compiles the steps for Python
def test_it_is_of_order_four() -> None:
    """A solid that flies and tumbles: half the step leaves a 32nd of the error (order h⁵)."""
    shapes, workspaces = shapes_of(Solid.box(0.4, 0.3, 1.0), General(static_friction=0.5))
    shape, work = shapes[0], workspaces[0]
    work.state[Q] = 1.0
    work.state[V : V + 3] = 0.3, -0.2, 0.1
    work.state[W : W + 3] = 3.0, -2.0, 5.0
    found = []
    for length in (0.04, 0.02):
        pull = Pull(Vec(1.0, 2.0, -9.8), Vec(0.5, -1.0, 0.2), length)
        rates(shape, work, work.state, pull_at(pull, 0.0), True, work.stages[0])
        truth = {}
        for part in (0.3, 0.7):
            take_step(shape, work, pull, 0.0, part)
            truth[part] = work.trial.copy()
        take_step(shape, work, pull, 0.0, 1.0)
        end = work.trial.copy()
        write_polynomial(work, length)
        write_between(work, 0.0)
        np.testing.assert_array_equal(work.trial, work.state)
        write_between(work, 1.0)
        # but for the quaternion's length, which a step puts right
        np.testing.assert_allclose(work.trial, end, rtol=0.0, atol=1e-12)
        errors = []
        for part, expected in truth.items():
            write_between(work, part)
            errors.append(np.abs(work.trial - expected).max())
        found.append(max(errors))
    assert work.trial.size == STATE
    assert found[0] < 1e-4
    assert found[0] / found[1] == pytest.approx(32.0, rel=0.4)
