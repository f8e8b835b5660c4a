"""The workloads."""

from __future__ import annotations

import numpy as np
from tests.support.builders import TABLE_1
from tests.support.pulses import Case, random_pulse

from shaketable import Body, Motion, suite

BODIES = [Body.rectangle(width, height) for width, height in TABLE_1]
TILTS = np.radians(np.arange(0.0, 7.01, 0.5))


def motions() -> list[Motion]:
    """The 100 components of FEMA P-695."""
    return suite("fema-p695")


def sample(count: int, seed: int = 1) -> list[tuple[Body, Motion, float]]:
    """Members of W1 drawn at random: body, motion, tilt."""
    rng = np.random.default_rng(seed)
    available = motions()
    cases = []
    for _ in range(count):
        motion = available[rng.integers(len(available))]
        cases.append(
            (
                BODIES[rng.integers(len(BODIES))],
                motion if rng.integers(2) else motion.reversed(),
                float(rng.choice(TILTS)),
            )
        )
    return cases


def pulses(count: int, seed: int = 2) -> list[Case]:
    """Plastic pulses from the tests on which bodies slide, rock, jump or fall."""
    rng = np.random.default_rng(seed)
    chosen: list[Case] = []
    while len(chosen) < count:
        case = random_pulse(rng)
        run = case.run()
        if case.model.normal_restitution == 0.0 and max(run.peak_rotation, run.peak_slip) > 0.02:
            chosen.append(case)
    return chosen
