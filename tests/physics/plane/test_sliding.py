"""Bodies that can only slide: their short way against the phase-by-phase way of single runs."""

import numpy as np
import pytest

from shaketable.body import Body
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.simulate import simulate, simulate_many
from shaketable.support import Support


@pytest.mark.parametrize("seed", range(12))
def test_like_phase_by_phase(seed: int) -> None:
    rng = np.random.default_rng(seed)
    samples = int(rng.integers(60, 300))
    vertical = np.clip(rng.normal(0.0, 1.5, samples), -6.0, 6.0) if seed % 2 else None
    motion = Motion(rng.normal(0.0, 4.0, samples), 0.01, vertical=vertical)
    body = Body.rectangle(rng.uniform(0.4, 1.0), rng.uniform(0.4, 1.5), eccentricity=0.4)
    # below the friction at which a corner lifts, b/h (Shenton 1996)
    static = rng.uniform(0.01, 0.9) * min(body.left, body.right) / body.cg_height
    model = General(static_friction=static, kinetic_friction=static * rng.uniform(0.5, 1.0))
    tilt = 0.0 if seed % 3 else 0.5 * np.arctan(model.sliding_friction)
    many = simulate_many([body], [motion], tilts=[tilt], model=model, progress=False).squeeze()
    for polarity, push in ((1, motion), (-1, Motion(-motion.horizontal, 0.01, vertical=vertical))):
        one = simulate(body, push, support=Support(tilt=tilt), model=model)
        short = many.sel(polarity=polarity)
        # both are exact up to round-off, which a hundred changes of phase add up
        assert float(short.displacement_x) == pytest.approx(one.slip[-1], abs=1e-10)
        farthest = max(float(short.slip_downhill), float(short.slip_uphill))
        assert farthest == pytest.approx(one.peak_slip, abs=1e-10)
        assert int(short.outcome) == 0
        assert float(short.peak_rotation) == 0.0


def test_newmark_block() -> None:
    """A push of A for t0 slides a block by A t0² (A/(μg) - 1)/2 (Newmark 1965)."""
    push, friction, g = 3.0, 0.1, 9.80665
    motion = Motion(np.r_[np.full(101, push), np.zeros(300)], 0.01)
    flat = Body.rectangle(1.0, 0.5)
    model = General(static_friction=friction)
    runs = simulate_many([flat], [motion], polarities=[1], model=model, progress=False)
    # the push falls to zero within one sample: 1 s, and a ramp of 0.01 s that adds half of its area
    ramp = simulate(flat, motion, model=model).slip[-1]
    assert float(runs.displacement_x.squeeze()) == pytest.approx(ramp, abs=1e-12)
    expected = -push * (push / (friction * g) - 1.0) / 2.0
    assert ramp == pytest.approx(expected, rel=0.02)  # of which the ramp is 1 %


@pytest.mark.parametrize("shape", [(-1.0, 3.0, 0.0), (1.0, -3.0, 0.0), (-1.0, 2.0, -2.0)])
@pytest.mark.parametrize("friction", [0.05, 0.15, 0.31])
def test_at_the_very_limit_of_friction(shape: tuple[float, ...], friction: float) -> None:
    """A push that reaches the friction limit to one side and turns slips to the other."""
    motion = Motion(np.array(shape) * friction * 9.80665, 0.02)
    flat, model = Body.rectangle(3.0, 1.0), General(static_friction=friction)
    one = simulate(flat, motion, model=model)
    many = simulate_many([flat], [motion], polarities=[1], model=model, progress=False)
    # the push is linear: where it passes the limit is known to round-off
    assert float(many.displacement_x.squeeze()) == pytest.approx(one.slip[-1], rel=1e-9, abs=1e-12)


def test_what_hardly_brakes_is_given_up_after_an_hour(caplog: pytest.LogCaptureFixture) -> None:
    flat = Body.rectangle(3.0, 1.0)
    model = General(static_friction=0.05, kinetic_friction=0.0035)
    tilt, motion = np.arctan(0.00345), Motion(np.array([0.0, 9.0, 0.0]), 1.0)
    one = simulate(flat, motion, support=Support(tilt=tilt), model=model)
    many = simulate_many(
        [flat], [motion], tilts=[tilt], polarities=[1], model=model, progress=False
    ).squeeze()
    # the single run counts its hour in whole steps: what it slides in a fraction of one
    assert float(many.displacement_x) == pytest.approx(one.slip[-1], rel=1e-4)
    assert "still slid" in caplog.text


def test_what_is_small_is_given_up_after_a_million_steps(caplog: pytest.LogCaptureFixture) -> None:
    """A die on ice, pushed at 9 m/s: it would slide for 50 minutes, in steps of 0.3 ms."""
    die, motion = Body.rectangle(0.005, 0.005), Motion(np.array([0.0, 9.0, 9.0, 0.0]), 0.001)
    model = General(static_friction=1e-6)
    one = simulate(die, motion, model=model)
    many = simulate_many([die], [motion], polarities=[1], model=model, progress=False).squeeze()
    assert one.time.size == 1_000_003
    assert not one.settled
    # the closed form stops where the steps do, to a step
    assert float(many.displacement_x) == pytest.approx(one.slip[-1], rel=1e-5)
    assert caplog.text.count("a million steps later") == 2
