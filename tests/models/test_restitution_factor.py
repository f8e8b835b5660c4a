"""The factor on the angular velocity that a rocking impact leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Rocking,
    Support,
    simulate,
    simulate_each,
    simulate_many,
)
from shaketable.physics.plane.layout import struct_view
from shaketable.physics.plane.rocking import Block
from tests.support.builders import G
from tests.support.pulses import random_pulse

BODY = Body.rectangle(0.3, 1.2)
STILL = Motion(np.zeros(3), 0.01)


def speeds_at_impacts(run, count: int) -> np.ndarray:
    """|ω| just after the first impacts, from the height of the next turning point."""
    turning = [
        np.abs(run.rotation[(run.time >= first) & (run.time <= last)]).max()
        for first, last in zip(
            run.impact_times[:count], run.impact_times[1 : count + 1], strict=True
        )
    ]
    body = run.body
    # energy between an impact and the turning point: ½ (i² + r²) ω² = g r (cos(α - θ) - cos α)
    alpha, r2 = body.slenderness_left, body.left**2 + body.cg_height**2
    rise = np.sqrt(r2) * (np.cos(alpha - np.array(turning)) - np.cos(alpha))
    return np.sqrt(2 * G * rise / (body.gyration_radius**2 + r2))


@pytest.mark.parametrize(
    "model", [Rocking(), General(static_friction=5.0)], ids=["rock", "general"]
)
def test_every_rocking_impact_loses_the_factor(model: Rocking | General) -> None:
    e = 1 - 1.5 * np.sin(BODY.slenderness_left) ** 2  # Housner 1963
    for factor in (1.0, 0.9, 0.6):
        lossy = replace(model, restitution_factor=factor)
        run = simulate(BODY, STILL, model=lossy, initial_rotation=0.12)
        speeds = speeds_at_impacts(run, 3)  # later flights are a few samples long
        # turning points lie between samples 0.02/√(k g) apart: (0.02)²/8 of the rotation
        assert speeds[1:] / speeds[:-1] == pytest.approx(factor * e, rel=1e-3)


def test_a_factor_of_one_changes_no_bit(p695: list[Motion]) -> None:
    for model in (Rocking(), General(static_friction=0.4, normal_restitution=0.2)):
        plain, lossless = (
            simulate_many([body], p695[:4], scales=[1.5], model=model, progress=False)
            for body in (BODY, replace(BODY, restitution_factor=1.0))
        )
        assert plain.equals(lossless.drop_vars("restitution_factor"))


def test_it_multiplies_a_given_restitution() -> None:
    both = simulate(
        BODY, STILL, model=Rocking(restitution=0.8, restitution_factor=0.9), initial_rotation=0.1
    )
    product = simulate(BODY, STILL, model=Rocking(restitution=0.72), initial_rotation=0.1)
    assert both.impact_times[:5] == pytest.approx(product.impact_times[:5], rel=1e-12)


@pytest.mark.parametrize("kind", [Rocking, General])
def test_a_bodys_own_factor_wins(kind: type[Rocking] | type[General], p695: list[Motion]) -> None:
    own = replace(BODY, restitution_factor=0.8)
    by_body = simulate_many([own, BODY], p695[:3], model=kind(), progress=False)
    ignored = kind(restitution_factor=0.5)
    by_model = simulate_many([own], p695[:3], model=ignored, progress=False)
    all_of_it = simulate_many([BODY], p695[:3], model=kind(restitution_factor=0.8), progress=False)
    one = by_body.peak_rotation.isel(body=0).values
    assert np.array_equal(one, by_model.peak_rotation.isel(body=0).values)
    assert np.array_equal(one, all_of_it.peak_rotation.isel(body=0).values)
    assert not np.array_equal(one, by_body.peak_rotation.isel(body=1).values)


def test_with_high_friction_both_models_lose_the_same(p695: list[Motion]) -> None:
    for motion in p695[:12]:
        runs = [
            simulate(BODY, motion, Support(tilt=0.02), model=model)
            for model in (
                Rocking(restitution_factor=0.85),
                General(static_friction=5.0, restitution_factor=0.85),
            )
        ]
        assert runs[0].outcome == runs[1].outcome
        # ends of bounce sequences and round-off differ, as without a factor
        assert runs[0].peak_rotation == pytest.approx(runs[1].peak_rotation, abs=1e-6)


@pytest.mark.parametrize("seed", range(12))
def test_energy_never_rises_on_a_support_at_rest(seed: int) -> None:
    case = random_pulse(np.random.default_rng(700 + seed), kinetic=True)
    case = case._replace(model=replace(case.model, restitution_factor=0.7))
    still = np.zeros(400)
    motion = Motion(
        np.r_[case.motion.horizontal, still],
        case.motion.time_step,
        vertical=np.r_[case.motion.vertical, still],
    )
    run = case._replace(motion=motion).run()
    height = run.position @ [np.sin(case.support.tilt), np.cos(case.support.tilt)]
    speed = (run.velocity**2).sum(axis=1) + (run.body.gyration_radius * run.angular_velocity) ** 2
    energy = (speed / 2 + G * height)[run.time > case.motion.duration + 1e-9]
    # guards fire up to 1e-12 of their unit late
    assert np.diff(energy).max(initial=0.0) < 1e-9


@pytest.mark.parametrize("kind", [Rocking, General])
@pytest.mark.parametrize("factor", [0.0, -0.1, 1.01, np.nan])
def test_factors_out_of_range(kind: type[Rocking] | type[General], factor: float) -> None:
    with pytest.raises(InputError, match=r"restitution_factor, the share .* in \(0, 1\]"):
        kind(restitution_factor=factor)


def test_a_given_restitution_adds_no_energy_off_centre() -> None:
    # b_L = 1, b_R = 0.1, h = 0.5, i² = 0.25: from R to L, √((i² + h² + b_R²)/(i² + h² + b_L²))
    # = √(0.51/1.5); the other way it is larger than 1 and η is kept
    body = Body(base=1.1, cg_height=0.5, left=1.0, gyration_radius=0.5)
    blocks = struct_view(Rocking(restitution=0.9).tabulate([body], np.zeros(1)).blocks, Block)
    assert blocks["right"]["velocity_ratio"] == pytest.approx(np.sqrt(0.51 / 1.5), rel=1e-14)
    assert blocks["left"]["velocity_ratio"] == 0.9
    run = simulate(body, STILL, model=Rocking(restitution=0.9), initial_rotation=0.15)
    # from one stop to the next the centre of gravity can only sink
    rises = run.position[:, 1] - body.cg_height
    crossed = np.searchsorted(run.time, run.impact_times)
    tops = [part.max() for part in np.split(rises, crossed)[:6]]
    assert len(tops) == 6
    # a stop between samples 0.02/√(k g) apart is seen (0.02)²/8 too low
    assert (np.diff(tops) <= 1e-4 * rises.max()).all()


def test_with_normal_restitution_a_user_is_warned(caplog: pytest.LogCaptureFixture) -> None:
    simulate(BODY, STILL, model=General(normal_restitution=0.1, restitution_factor=0.8))
    assert "set one of them only" in caplog.text


def test_a_dataset_tells_the_bodies_own_factors(p695: list[Motion]) -> None:
    own, model = replace(BODY, restitution_factor=0.8), Rocking(restitution_factor=0.9)
    many = simulate_many([own, BODY], p695[:1], model=model, progress=False)
    assert many.restitution_factor.values.tolist() == [0.8, 0.9]
    each = simulate_each([own, BODY], p695[0], model=model, progress=False)
    assert each.restitution_factor.values.tolist() == [0.8, 0.9]
    assert "restitution_factor" not in simulate_many([BODY], p695[:1], progress=False).coords
