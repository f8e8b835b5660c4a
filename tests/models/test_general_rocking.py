"""With enough friction and no restitution the general model is the rocking model."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    Motion,
    Outcome,
    Phase,
    Rocking,
    Support,
    simulate,
    simulate_many,
)
from tests.support.builders import TABLE_1
from tests.support.recorded import WELL_CONDITIONED, conditioning, random_case

CASES = 150
PEAK = 1e-6  # rad and m, the bound; ends of bounce sequences and round-off differ


def same(one: float, other: float) -> bool:
    return abs(one - other) < PEAK


@pytest.mark.parametrize("friction", [math.inf, 1e4])
def test_recorded_motions(p695: list[Motion], friction: float) -> None:
    rng = np.random.default_rng(20261121)
    compared, unlike, outcomes = 0, 0, set()
    while compared < CASES:
        body, motion, support = random_case(rng, p695)
        rocking = simulate(body, motion, support)
        if rocking.peak_rotation == 0.0:
            continue
        compared += 1
        gripping = General(static_friction=friction)
        general = simulate(body, motion, support, model=gripping)
        alike = rocking.outcome == general.outcome and same(
            rocking.peak_rotation, general.peak_rotation
        )
        if not alike:
            unlike += 1
            assert conditioning(body, motion, support) > WELL_CONDITIONED
        outcomes.add(int(general.outcome))
        if not general.outcome:
            assert general.peak_slip < 1e-9
    assert outcomes == {-1, 0, 1}
    assert unlike <= 1  # none here; one in a hundred is as ill conditioned as that


def test_both_models_agree_on_the_controlled_rate(p695: list[Motion]) -> None:
    # Boroschek and Iruretagoyena (2006): "both methods differ by less than 4 %"; a third of W1's
    # motions, all of its bodies
    bodies = [Body.rectangle(*size) for size in TABLE_1]
    tilts = np.radians([0.5, 1.0, 2.0, 4.0, 7.0])
    rates = {}
    for model in (Rocking(), General(static_friction=2.0)):
        runs = simulate_many(bodies, p695[::3], tilts=tilts, model=model, progress=False)
        everything = ("body", "motion", "polarity", "scale")
        falls = (runs.outcome != Outcome.STANDING).sum(everything)
        rates[model.name] = ((runs.outcome == Outcome.DOWNHILL).sum(everything) / falls).values
    assert rates["general"] == pytest.approx(rates["rocking"], rel=0.04)


def test_many_is_one_many_times(p695: list[Motion]) -> None:
    # the lanes, the certified short way and the phases: every way through an interval
    bodies = [Body.rectangle(0.3, 1.0, eccentricity=0.45), Body.rectangle(0.25, 0.5)]
    slippery = General(static_friction=0.32, kinetic_friction=0.25, normal_restitution=0.2)
    motions = [p695[3].scaled(1.5), p695[12].scaled(2.0), p695[40].scaled(1.5)]
    motions.append(Motion(p695[3].horizontal, 0.01, vertical=2.5 * p695[3].horizontal))
    tilt = 0.03
    for model in (slippery, General(static_friction=2.0), General()):
        runs = simulate_many(bodies, motions, tilts=[tilt], model=model, progress=False)
        for b, body in enumerate(bodies):
            for m, motion in enumerate(motions):
                for polarity in (1, -1):
                    shaken = motion if polarity == 1 else motion.reversed()
                    one = simulate(body, shaken, Support(tilt=tilt), model=model)
                    member = runs.isel(body=b, motion=m, tilt=0, scale=0).sel(polarity=polarity)
                    assert int(member.outcome) == one.outcome
                    # the ways through an interval agree to round-off, bounces make it more
                    assert float(member.peak_rotation) == pytest.approx(one.peak_rotation, abs=PEAK)
                    farthest = max(float(member.slip_uphill), float(member.slip_downhill))
                    assert farthest == pytest.approx(one.peak_slip, abs=PEAK)
                    assert float(member.max_lift) == pytest.approx(one.max_lift, abs=PEAK)
                    if not one.outcome:
                        assert float(member.displacement_x) == pytest.approx(one.slip[-1], abs=PEAK)


def test_slender_bodies_never_slide_from_rest(p695: list[Motion]) -> None:
    # Boroschek and Romo (2004) eq. 26: with μ >= b/h, that is 1/γ, a body at rest begins to rock,
    # not to slide
    body = Body.rectangle(0.2, 1.0)
    for motion in p695[:20]:
        run = simulate(body, motion.scaled(2.0), model=General(static_friction=0.21))
        first = run.phases[1:2]
        assert not first or first[0] in (Phase.ROCK_RIGHT, Phase.ROCK_LEFT)
