"""The kernels of rocking: order of the step, its short ways, and the end of bouncing."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable.engine.batch import demands_of
from shaketable.engine.body_tables import tabulate_blocks
from shaketable.engine.lanes import LANES
from shaketable.engine.rocking_many import rock_many
from shaketable.models.batch import batch_of
from shaketable.models.model import Table
from shaketable.physics.plane import events, rocking, taylor
from shaketable.physics.plane.forcing import Interval, Shaking, forcing_at
from tests.support.builders import G

NAN = math.nan
# A block on a tilted support, off centre: every term of the equations counts.
SIZE = rocking.Size(0.3, 0.5, 0.13, 0.31, 1.0)
BLOCK = rocking.make_block(SIZE, 0.03, NAN)
NOWHERE = np.empty(0)


def cross(height: float, rate: float, side: float, push: np.ndarray, gravity: np.ndarray, h: float):
    """All intervals of a motion with the event-by-event routine; the last state."""
    phase = rocking.side_of(BLOCK, side).phase - height
    state = rocking.State(side, height, rate, math.sin(phase), math.cos(phase))
    passage = rocking.Passage(state, height, 0, -1.0)
    shaking = Shaking(push, gravity, h)
    for i in range(push.size - 1):
        interval = Interval(i, i * h, 1.0)
        passage = events.cross_interval(passage, BLOCK, shaking, interval, NOWHERE)
    return passage


def forcing(parts: int) -> tuple[np.ndarray, np.ndarray]:
    """A straight line of a_x and g + a_y, cut into parts."""
    return np.linspace(1.0, -2.0, parts + 1), G + np.linspace(-1.0, 1.5, parts + 1)


@pytest.mark.parametrize(
    ("height", "rate", "length", "impacts"),
    [(0.15, 0.4, 0.4, 0), (0.05, -0.4, 0.4, 1)],
    ids=["free", "impact"],
)
def test_order_of_convergence(height: float, rate: float, length: float, impacts: int) -> None:
    # The forcing is linear from end to end, so that any number of steps solves the same problem.

    def end(parts: int):
        push, gravity = forcing(parts)
        return cross(height, rate, 1.0, push, gravity, length / parts)

    best = end(64)
    assert best.impacts == impacts
    counts = np.array([4, 6, 8, 12])
    states = [end(n).state for n in counts]
    errors = [
        math.hypot(state.rotation - best.state.rotation, state.rate - best.state.rate)
        for state in states
    ]
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    # a finite set of steps shows the order to within some tenths (found: 7.9 and 7.8)
    assert order == pytest.approx(taylor.ORDER, abs=0.5)
    assert errors[-1] > 1e-14  # not yet round-off, which has no order


def test_short_ways_equal_the_long_one() -> None:
    # step and bounce leave to cross_interval what they cannot do, and agree where they can
    rng = np.random.default_rng(7)
    done = {"step": 0, "bounce": 0}
    for _ in range(3000):
        height, rate = 10 ** rng.uniform(-5, -0.8), rng.normal(0, 0.7)
        side = rng.choice([-1.0, 1.0])
        push = rng.normal(0, 3.0, 2)
        gravity = G + rng.normal(0, 2.0, 2)
        h = 10 ** rng.uniform(-3, -1.7)
        here, there = rocking.side_of(BLOCK, side), rocking.side_of(BLOCK, -side)
        phase = here.phase - height
        sine, cosine = math.sin(phase), math.cos(phase)
        state = rocking.State(side, height, rate, sine, cosine)
        shaking = Shaking(push, gravity, h)
        force = forcing_at(shaking, 0, side)
        peak = height + 0.01
        passage = rocking.Passage(state, peak, 0, -1.0)
        long = events.cross_interval(passage, BLOCK, shaking, Interval(0, 0.0, 1.0), NOWHERE)
        short, eventful = rocking.step(state, here.k, peak, h, force)
        if not eventful:
            done["step"] += 1
            assert long.impacts == 0
            assert long.state == pytest.approx(short, abs=1e-13)
            continue
        short, impact, clean = rocking.bounce(
            state, here.k, here.velocity_ratio, here.onward, there, peak, h, force
        )
        if clean:
            done["bounce"] += 1
            assert 0 < impact.u < 1
            assert long.impacts == 1
            assert long.state.side == -side
            assert long.state == pytest.approx(short, abs=1e-12)
    assert min(done.values()) > 150


def test_energy_never_rises_at_an_impact() -> None:
    # for random bodies, η and tilts: e² I_other <= I_own, so that rocking energy falls or stays
    rng = np.random.default_rng(3)
    for _ in range(500):
        width, height = rng.uniform(0.05, 2, 2)
        left = width * rng.uniform(0.05, 0.95)
        i2 = rng.uniform(0.02, 1.0) * (width**2 + height**2) / 12
        size = rocking.Size(width, height / 2, left, math.sqrt(i2), 1.0)
        block = rocking.make_block(size, 0.0, NAN)
        inertia = {
            1.0: i2 + height**2 / 4 + (width - left) ** 2,
            -1.0: i2 + height**2 / 4 + left**2,
        }
        for side in (block.right, block.left):
            keep = max(side.velocity_ratio, 0.0)
            assert keep**2 * inertia[-side.sign] <= inertia[side.sign] * (1 + 1e-14)


def test_padding_lanes_are_idle() -> None:
    # a group with one body in it must do what a full one does
    count = LANES + 1
    shaking = Shaking(np.sin(np.arange(400) * 0.1) * 4.0, np.full(400, G), 0.01)
    results = []
    for n in (1, count):
        nothing = np.empty((0, 0))
        rows = tabulate_blocks(np.array([SIZE] * n), np.full(n, 0.03), NAN)
        batch, runs = batch_of(Table(rows, nothing, nothing), np.ones(n))
        rock_many(shaking, demands_of(shaking), batch)
        results.append([runs.peak, runs.impacts, runs.direction])
    for alone, together in zip(*results, strict=True):
        assert set(together) == set(alone)
