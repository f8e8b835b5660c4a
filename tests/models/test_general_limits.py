"""What the general model refuses, and what it warns of."""

from __future__ import annotations

import logging
import math

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Phase, Support, simulate, simulate_many
from shaketable.engine.endings import Ending

BODY = Body.rectangle(0.4, 0.5)
QUIET = Motion(np.zeros(50), 0.01)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"static_friction": -0.1}, "static_friction must not be negative"),
        ({"static_friction": math.nan}, "static_friction"),
        ({"static_friction": 0.3, "kinetic_friction": 0.4}, "between 0 and static_friction = 0.3"),
        ({"static_friction": 0.3, "kinetic_friction": -0.1}, "kinetic_friction"),
        ({"normal_restitution": 1.0}, r"\[0, 1\)"),
        ({"normal_restitution": -0.1}, r"\[0, 1\)"),
        ({"restitution_factor": 0.0}, r"\(0, 1\]"),
        ({"restitution_factor": 1.1}, r"\(0, 1\]"),
    ],
)
def test_values_out_of_range(values: dict[str, float], said: str) -> None:
    with pytest.raises(InputError, match=said):
        General(**values)


def test_unknown_model() -> None:
    with pytest.raises(InputError, match="accepted: 'rocking', 'general', or one of Rocking"):
        simulate(BODY, QUIET, model="sliding")


def test_a_body_that_slides_by_itself(caplog: pytest.LogCaptureFixture) -> None:
    # allowed, with a warning; it slides with g (sin β - μ_k cos β) until the motion ends
    support, model = Support(tilt=0.2), General(static_friction=0.15, kinetic_friction=0.1)
    with caplog.at_level(logging.WARNING):
        run = simulate(BODY, QUIET, support, model=model)
    assert "tilted by 11.46° a body slides by itself: a static friction of 0.15" in caplog.text
    assert "with nothing to stop it" in caplog.text
    gain = 9.80665 * (math.sin(0.2) - 0.1 * math.cos(0.2))
    assert run.slip[-1] == pytest.approx(-gain * 0.49**2 / 2, rel=1e-12)
    assert run.phases == (Phase.SLIDE_DOWNHILL,)
    runs = simulate_many(
        [BODY],
        [QUIET],
        tilts=[0.2],
        model=model,
        progress=False,
    )
    assert (runs.ending == Ending.STILL_SLIDING).all()
    assert runs.ending.attrs["flag_meanings"].split()[3] == "still_sliding"
    assert runs.displacement_x.values.ravel() == pytest.approx(run.slip[-1], rel=1e-12)


def test_static_friction_holds_what_kinetic_would_not(caplog: pytest.LogCaptureFixture) -> None:
    support, model = Support(tilt=0.12), General(static_friction=0.15, kinetic_friction=0.1)
    with caplog.at_level(logging.WARNING):
        run = simulate(BODY, QUIET, support, model=model)
    assert not caplog.records
    assert run.phases == (Phase.REST,)
    assert run.peak_slip == 0.0


def test_variables_of_many() -> None:
    runs = simulate_many([BODY], [QUIET], model="general", progress=False)
    assert {"displacement_x", "slip_downhill", "slip_uphill", "max_lift", "ending"} < set(
        runs.data_vars
    )
    assert runs.displacement_x.attrs["units"] == runs.max_lift.attrs["units"] == "m"
    assert runs.attrs["model"].startswith("General(")


def test_threads_and_company_change_nothing(p695: list[Motion]) -> None:
    bodies = [Body.rectangle(width, 1.0) for width in np.linspace(0.15, 0.6, 9)]
    model = General(static_friction=0.35, normal_restitution=0.1)

    def run(some: list[Body], threads: int):
        return simulate_many(
            some,
            p695[:4],
            model=model,
            scales=[1.5],
            progress=False,
            threads=threads,
        )

    together, apart = run(bodies, 2), [run([body], 1) for body in bodies]
    for k, alone in enumerate(apart):
        for name in together.data_vars:
            ours = together[name].isel(body=k).values
            assert np.array_equal(ours, alone[name].isel(body=0).values, equal_nan=True)


def test_what_never_stops_bouncing_is_given_up(caplog: pytest.LogCaptureFixture) -> None:
    # static friction holds it, kinetic friction does not, and hardly anything of a bounce is lost
    body = Body(base=0.4026, cg_height=0.9278, left=0.2013, gyration_radius=0.1245)
    support, model = (
        Support(tilt=0.1524),
        General(static_friction=0.684, kinetic_friction=0.0426, normal_restitution=0.99),
    )
    quiet = Motion(np.zeros(20), 0.0065)
    with caplog.at_level(logging.WARNING):
        run = simulate(body, quiet, support, model=model, initial_rotation=3.32e-4)
    assert 1_000_000 < run.impacts < 1_100_000
    assert "still rocked" in caplog.text


def test_extremes_end() -> None:
    # squat, needle, 100 g, nothing but a vertical motion, restitution all but one
    rng = np.random.default_rng(9)
    loud = Motion(rng.normal(size=60) * 300, 0.02, vertical=rng.normal(size=60) * 300)
    for body in (Body.rectangle(5.0, 0.05), Body.rectangle(0.005, 2.0), BODY):
        for model in (
            General(static_friction=0.0),
            General(static_friction=0.5, normal_restitution=0.95),
            General(static_friction=50.0, normal_restitution=0.5),
            General(normal_restitution=0.3),
            General(static_friction=0.4, kinetic_friction=0.0),
        ):
            for motion in (loud, Motion(np.zeros(60), 0.02, vertical=loud.vertical)):
                run = simulate(body, motion, model=model)
                assert np.isfinite(run.position).all()
                assert 0.0 <= run.peak_rotation <= math.pi / 2


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_a_support_that_drops_away_is_seen_without_friction_too(friction: float) -> None:
    t = np.arange(100) * 0.01
    drop = Motion(np.zeros(100), 0.01, vertical=-12 * np.sin(np.pi * t / 0.5) * (t < 0.5))
    model = General(static_friction=friction)
    one = simulate(BODY, drop, model=model)
    many = simulate_many([BODY], [drop], model=model, progress=False)
    assert one.max_lift > 0.04
    assert many.max_lift.values.ravel() == pytest.approx(one.max_lift, rel=1e-9)


def test_what_only_the_motion_held_slides_when_it_ends() -> None:
    # tan β > μ_s, and the ground's acceleration alone keeps the body up to the last sample
    support, model = Support(tilt=0.3), General(static_friction=0.2)
    body, held = Body.rectangle(1.0, 1.0), np.full(50, -3.0)
    run = simulate(body, Motion(held, 0.01), support, model=model)
    assert run.phases == (Phase.REST, Phase.SLIDE_DOWNHILL)
    assert run.phase_times[1] == pytest.approx(0.49)


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_free_fall_with_forces_that_vanish_together(friction: float) -> None:
    t = np.arange(100) * 0.01
    fall = Motion(np.sin(20 * t), 0.01, vertical=np.full(100, -9.80665))
    run = simulate(Body.rectangle(1.0, 1.0), fall, model=General(static_friction=friction))
    assert run.outcome == 0
    assert np.isfinite(run.position).all()
