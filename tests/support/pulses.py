"""Random pulses, bodies and supports that bring out every phase of the general model."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from shaketable import Body, General, Motion, Response, Support, simulate
from tests.support.builders import G

SAMPLES = 201


class Case(NamedTuple):
    body: Body
    motion: Motion
    support: Support
    model: General

    def run(self, **options: Any) -> Response:
        return simulate(self.body, self.motion, self.support, model=self.model, **options)


def random_pulse(rng: np.random.Generator, *, tilted: bool = True, kinetic: bool = False) -> Case:
    """A body of any slenderness under a pulse of up to 1.5 g, in every second case with a
    vertical one of up to 3 g, with friction 0.1-0.9 and, in every second case, restitution."""
    height = rng.uniform(0.2, 1.5)
    body = Body.rectangle(
        height * rng.uniform(0.15, 0.7), height, eccentricity=rng.uniform(0.35, 0.65)
    )
    static = rng.uniform(0.1, 0.9)
    tilt = rng.choice([0.0, rng.uniform(0.0, 0.1)]) if tilted else 0.0
    if math.tan(tilt) > 0.8 * static:
        tilt = 0.0
    t = np.linspace(0.0, 1.0, SAMPLES)
    shapes = [
        np.sin(2 * np.pi * t),
        np.cos(2 * np.pi * t) * np.sin(np.pi * t),
        np.sin(np.pi * t),
    ]
    push = rng.uniform(0.2, 1.5) * G * rng.choice([1, -1]) * shapes[rng.integers(3)]
    lift = rng.integers(2) * rng.uniform(1.0, 3.0) * G * np.sin(np.pi * t)
    lift = lift * np.sin(2 * np.pi * t + rng.uniform(0.0, 6.0))
    motion = Motion(push, rng.uniform(0.15, 0.8) / (SAMPLES - 1), vertical=lift)
    model = General(
        static_friction=static,
        kinetic_friction=static * rng.uniform(0.6, 1.0) if kinetic else None,
        normal_restitution=rng.choice([0.0, 0.0, 0.3, 0.6]),
    )
    return Case(body, motion, Support(tilt=tilt), model)
