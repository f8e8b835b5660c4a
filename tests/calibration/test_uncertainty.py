"""Bodies and motions that are not known exactly."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Outcome, Rocking, Support, simulate
from shaketable.calibration import Uncertainty, overturning_probability
from shaketable.calibration.uncertainty import uncertain

NONE = Uncertainty(**{field.name: 0.0 for field in fields(Uncertainty)})
SHELF = Body.rectangle(0.3, 1.5, restitution_factor=0.95)


@pytest.mark.parametrize("scale", [0.3, 1.0, 2.0])
def test_without_uncertainty_it_is_one_run(p695: list[Motion], scale: float) -> None:
    found = overturning_probability(SHELF, p695[0], NONE, 8, scale=scale)
    run = simulate(SHELF, p695[0].scaled(scale))
    assert found.value == float(run.outcome != Outcome.STANDING)
    assert found.members == 8


def test_near_the_limit_it_is_between(p695: list[Motion]) -> None:
    """Between the factor under which the shelf stands and the one under which it falls."""
    motion = next(m for m in p695 if simulate(SHELF, m.scaled(1.0)).outcome)
    factors = np.geomspace(0.2, 1.0, 60)
    falls = [bool(simulate(SHELF, motion.scaled(f)).outcome) for f in factors]
    edge = float(factors[falls.index(True)])
    found = overturning_probability(SHELF, motion, Uncertainty(), 512, scale=edge)
    assert 0.05 < found.value < 0.95
    assert found.low < found.value < found.high


def test_each_quantity_spreads_as_it_says() -> None:
    """4,096 scrambled Sobol points of a normal variable: deviations to 1 %."""
    given = Uncertainty()
    for name, of in (
        ("slenderness", lambda b, t, f: np.log([x.base / x.cg_height for x in b])),
        ("size", lambda b, t, f: np.log([x.cg_height for x in b])),
        ("cg_offset", lambda b, t, f: [x.left / x.base for x in b]),
        ("tilt", lambda b, t, f: t),
        ("motion", lambda b, t, f: np.log(f)),
    ):
        spread = np.std(of(*uncertain(SHELF, 0.01, given.only(name), 4096)))
        assert spread == pytest.approx(getattr(given, name), rel=0.01), name


def test_loss_varies_downwards_only() -> None:
    bodies, _, _ = uncertain(SHELF, 0.0, Uncertainty(), 256)
    kept = np.array([body.restitution_factor for body in bodies])
    assert kept.max() <= 0.95
    assert kept.min() < 0.9


def test_a_body_keeps_the_loss_of_the_model(p695: list[Motion]) -> None:
    """Without a factor of its own the body has the model's, and uncertainty begins there."""
    body = Body.rectangle(0.3, 1.5)
    lossy = Rocking(restitution_factor=0.8)
    for motion in p695[:12:2]:
        found = overturning_probability(body, motion, NONE, 1, model=lossy, scale=1.5)
        assert found.value == float(bool(simulate(body, motion.scaled(1.5), model=lossy).outcome))
    assert all(one.restitution_factor is None for one in uncertain(body, 0.0, NONE, 4)[0])


def test_every_member_stands(p695: list[Motion]) -> None:
    """On a tilt near the slenderness no uncertain body may fall by itself."""
    wide = Uncertainty(slenderness=0.3, cg_offset=0.3, tilt=0.1)
    body = Body.rectangle(0.1, 1.0)
    found = overturning_probability(body, p695[0], wide, 64, support=Support(tilt=0.05), scale=1e-6)
    assert 0.0 <= found.value < 1.0


def test_bad_input() -> None:
    with pytest.raises(InputError, match=r"Uncertainty\.tilt must be finite and not negative"):
        Uncertainty(tilt=-0.1)
    with pytest.raises(InputError, match="n must be a positive whole number"):
        overturning_probability(SHELF, Motion(np.zeros(4), 0.1), NONE, 0)
