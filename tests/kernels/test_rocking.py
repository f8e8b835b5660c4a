"""The kernels of rocking: order of the step, its short ways, and the end of bouncing."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest

from shaketable.engine.batch import demands_of
from shaketable.engine.lanes import LANES
from shaketable.engine.rocking_many import rock_many
from shaketable.engine.rocking_one import short_ways
from shaketable.engine.tables import tabulate_blocks
from shaketable.kernels import events, rocking, taylor
from shaketable.kernels.flight import fly
from shaketable.kernels.forcing import Interval, Shaking, forcing_at
from shaketable.models.batch import batch_of
from shaketable.models.model import Table
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
        math.hypot(state.height - best.state.height, state.rate - best.state.rate)
        for state in states
    ]
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    # a finite set of steps shows the order to within some tenths (found: 7.9 and 7.8)
    assert order == pytest.approx(taylor.ORDER, abs=0.5)
    assert errors[-1] > 1e-14  # not yet round-off, which has no order


def random_start(rng: np.random.Generator) -> tuple[rocking.State, Shaking]:
    """A body above the ground, and one interval of a motion."""
    height, rate, h = 10 ** rng.uniform(-5, -0.8), rng.normal(0, 0.7), 10 ** rng.uniform(-3, -1.7)
    push, gravity = rng.normal(0, 3.0, 2), G + rng.normal(0, 2.0, 2)
    if rng.random() < 0.5:  # so slow, and pushed so evenly, that it comes down again and again
        h, rate = rng.uniform(0.01, 0.02), -rng.uniform(0.01, 0.1)
        height = -rate * h * rng.uniform(0.0, 0.5)
        push, gravity = rng.normal(0, 0.3, 2), G + rng.normal(0, 0.3, 2)
    side = rng.choice([-1.0, 1.0])
    phase = rocking.side_of(BLOCK, side).phase - height
    state = rocking.State(side, height, rate, math.sin(phase), math.cos(phase))
    return state, Shaking(push, gravity, h)


def test_short_ways_equal_the_long_one() -> None:
    # step and fly leave to cross_interval what they cannot do, and agree where they can
    rng = np.random.default_rng(7)
    steps, landings, left = 0, Counter[int](), 0
    for _ in range(6000):
        state, shaking = random_start(rng)
        peak = state.height + rng.choice([0.0, 0.01])
        passage = rocking.Passage(state, peak, 0, -1.0)
        long = events.cross_interval(passage, BLOCK, shaking, Interval(0, 0.0, 1.0), NOWHERE)
        force = forcing_at(shaking, 0, state.side)
        _, eventful = rocking.step(
            state, rocking.side_of(BLOCK, state.side).k, peak, shaking.time_step, force
        )
        times = np.full(4, NAN)
        short, done = short_ways(passage, BLOCK, shaking, Interval(0, 0.0, 1.0), times)
        if not done:
            left += 1
            continue
        steps += not eventful
        if eventful:
            landings[short.impacts] += 1
        assert (short.impacts, short.state.side) == (long.impacts, long.state.side)
        # to round-off of one interval, which each impact passes on (found: 3e-14)
        assert short.state == pytest.approx(long.state, abs=1e-12)
        assert short.peak == pytest.approx(long.peak, abs=1e-13)
        assert np.count_nonzero(times == times) == short.impacts
        assert (np.diff(times[: short.impacts], prepend=0.0) > 0.0).all()
    assert steps > 500
    assert min(landings[k] for k in range(4)) > 15
    assert left < 0.2 * 6000  # tops that are not arches, bounces that die out


def test_plain_flights_are_told_from_others() -> None:
    """Where a flight is said to be plain, a dense look at its polynomial finds nothing else."""
    rng = np.random.default_rng(8)
    u = np.linspace(0.0, 1.0, 2001)
    plain = 0
    for _ in range(3000):
        state, shaking = random_start(rng)
        here, there = (rocking.side_of(BLOCK, s * state.side) for s in (1.0, -1.0))
        if rng.random() < 0.5:  # just after an impact
            state = rocking.State(state.side, 0.0, abs(state.rate), here.sine, here.cosine)
        force, h = forcing_at(shaking, 0, state.side), shaking.time_step
        flight = fly(state, here, there, here.keep, 0.0, h, force)
        if not flight.plain:
            continue
        plain += 1
        w = rocking.velocity_over(state.rate, state.sine, state.cosine, here.k, h, force)
        q = np.polynomial.Polynomial(rocking.height_over(state.height, w))(u)
        before = u <= flight.until
        assert (q[before][1:] > -1e-15).all()  # the first may be the ground that it leaves
        assert flight.landed == (q[-1] < 0.0)
        # the dense look misses a maximum by at most |q''| (1/4000)²/2, with |q''| < 0.1
        assert q[before].max() <= flight.peak + 1e-15 <= q[before].max() + 4e-9
        if flight.landed:
            assert (q[u > flight.until] < 0.0).all()
            assert flight.state.height == 0.0
            assert flight.state.rate == pytest.approx(-here.keep * flight.fall)
    assert plain > 1500


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
            keep = max(side.keep, 0.0)
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
