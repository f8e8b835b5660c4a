"""How the line of an edge moves along a side of a body, against differences."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from shaketable import Edge, General, Solid, Surroundings
from shaketable.models.solid_input import shapes_of
from shaketable.physics.space.contacts import axes_at
from shaketable.physics.space.edge import crossing, line_plane, note_past, side_count, stand_at_edge
from shaketable.physics.space.touches import (
    add_touch,
    look_at_touches,
    touch_acceleration,
    touch_velocity,
)
from shaketable.physics.space.vectors import ZERO, on_support
from shaketable.physics.space.workspace import P, Q, V, W

SOLIDS = {"box": Solid.box(0.4, 0.5, 0.6), "cylinder": Solid.cylinder(0.5, 0.6)}
STEP = 1e-4  # s: second differences are then right to some 1e-6 of what they are


def moved(state: NDArray[np.float64], time: float) -> NDArray[np.float64]:
    """A state that goes on with its velocity and its spin."""
    out = state.copy()
    out[P : P + 3] += time * state[V : V + 3]
    turned = Rotation.from_quat(state[[Q + 1, Q + 2, Q + 3, Q]])
    turned = turned * Rotation.from_rotvec(time * state[W : W + 3])
    out[Q : Q + 4] = turned.as_quat()[[3, 0, 1, 2]]
    return out


@pytest.mark.parametrize("lip", [0.0, 0.05])
@pytest.mark.parametrize("name", SOLIDS)
def test_velocity_and_acceleration_of_the_gap(name: str, lip: float) -> None:
    """Of 150 random states in which a side touches the line and neither enters nor leaves.

    The rate of a gap and the rate of that, by central differences of the gap.
    """
    rng = np.random.default_rng(3)
    shapes, workspaces = shapes_of(
        SOLIDS[name], General(), Surroundings(edge=Edge(at=0.3, lip=lip))
    )
    shape, work = shapes[0], workspaces[0]
    stand_at_edge(shape, work)
    sides, tried = set(), 0
    for _ in range(20000):
        turn = Rotation.from_euler("zyx", rng.uniform(-1.0, 1.0, 3) * (3.1, 1.2, 0.3))
        up = turn.apply((0.0, 0.0, 0.3)) + rng.uniform(-0.2, 0.2, 3)
        state = work.state
        state[P : P + 3] = np.array((0.3, 0.0, lip)) + up
        state[Q : Q + 4] = turn.as_quat()[[3, 0, 1, 2]]
        state[V : V + 3], state[W : W + 3] = rng.normal(0.0, 1.0, (2, 3))
        note_past(shape, work, True)
        q, side = axes_at(state), int(rng.integers(side_count(shape)))
        found = crossing(shape, work, q, state, side)
        if not abs(found.gap) < 0.2 or found.left < 0.02:
            continue
        state[P : P + 3] -= found.gap * np.array(on_support(q, found.normal))
        note_past(shape, work, True)
        found = crossing(shape, work, q, state, side)
        if not abs(found.gap) < 1e-12 or found.left < 0.02:
            continue
        work.mode.touches = 0
        add_touch(work, line_plane(shape), side)
        look_at_touches(shape, work, q, state)
        speed = touch_velocity(work, q, state, 0).z
        state[V : V + 3] -= speed * np.array(on_support(q, found.normal))  # it stays closed
        look_at_touches(shape, work, q, state)
        assert touch_velocity(work, q, state, 0).z == pytest.approx(0.0, abs=1e-12)
        here = float(touch_acceleration(work, q, state, ZERO, ZERO, 0).z)
        # a body without acceleration: its centre goes on, its spin stays in its own frame
        gaps = []
        for time in (-STEP, 0.0, STEP):
            there = moved(state, time)
            gaps.append(crossing(shape, work, axes_at(there), there, side).gap)
        if not all(map(math.isfinite, gaps)):
            continue
        assert gaps[2] - gaps[0] == pytest.approx(0.0, abs=1e-5 * STEP)
        second = (gaps[2] - 2 * gaps[1] + gaps[0]) / STEP**2
        assert here == pytest.approx(second, rel=2e-3, abs=2e-3), (side, tried)
        sides.add(side)
        tried += 1
        if tried == 150:
            break
    assert tried == 150
    assert len(sides) >= (2 if name == "cylinder" else 6)
