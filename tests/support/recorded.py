"""Random bodies under recorded motions, and how well conditioned such a case is."""

from __future__ import annotations

import math

import numpy as np

from shaketable import Body, Motion, Support, simulate

PERTURBATION = 1e-9  # of the width, to measure how a case is conditioned
WELL_CONDITIONED = 1e3  # rad per relative change of the width: 1e-13 grows to 1e-10


def random_case(rng: np.random.Generator, p695: list[Motion]) -> tuple[Body, Motion, Support]:
    """A recorded motion with the other component of its record as vertical, body and tilt."""
    pair = 2 * rng.integers(len(p695) // 2)
    across, up = p695[pair], p695[pair + 1]
    count = min(across.horizontal.size, up.horizontal.size)
    motion = Motion(
        across.horizontal[:count] * rng.choice([-1, 1]),
        across.time_step,
        vertical=up.horizontal[:count] * rng.choice([0.0, 0.6]),
    ).scaled(rng.uniform(0.5, 1.5))
    height = rng.uniform(0.2, 2.0)
    body = Body.rectangle(
        height * rng.uniform(0.15, 0.4), height, eccentricity=rng.uniform(0.3, 0.7)
    )
    tilt = rng.choice([0.0, 1.0]) * rng.uniform(0.0, 0.5) * body.slenderness_left
    return body, motion, Support(tilt=tilt)


def conditioning(body: Body, motion: Motion, support: Support) -> float:
    near = Body(
        base=body.base * (1 + PERTURBATION),
        cg_height=body.cg_height,
        left=body.left,
        gyration_radius=body.gyration_radius,
    )
    runs = [simulate(b, motion, support) for b in (body, near)]
    if runs[0].outcome != runs[1].outcome:
        return math.inf
    change = abs(runs[0].peak_rotation - runs[1].peak_rotation)
    if runs[0].outcome:
        change = abs(runs[0].overturning_time - runs[1].overturning_time)
    return change / PERTURBATION
