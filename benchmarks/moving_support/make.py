"""Writes cases.json: `python -m benchmarks.moving_support.make`, some minutes.

Closed forms for what stays and what only slides; the tests' independent integrator (DOP853 at a
relative tolerance of 1e-13) for what only rocks in a plane; the tests' time stepping (Moreau 1988)
in space, where steps of a quarter of the length change the peak by less than 0.1 %.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from tests.support.moreau import march
from tests.support.reference import integrate

from benchmarks.moving_support.cases import FILE, Answers, Case, written
from benchmarks.moving_support.sliding import slip_of
from shaketable import Body, Motion
from shaketable.units import STANDARD_GRAVITY as G

STEP = 0.01
COARSE, FINE = 300, 1200  # time steps a sample
SAME = 1e-3  # of the peak
IN_SPACE = 8
ABOUT = (
    "A homogeneous box at rest on a plane support that begins to move. SI units; x and y are level,"
    " z is up; accelerations are the support's, linear between samples; friction is Coulomb's;"
    " nothing bounces: each corner's restitution is 0, with friction in impacts as well. g is"
    " 9.80665 m/s2. null: not given. within: metres of a slip, a fraction of a peak."
)


def triangle(peak: float, length: float, seconds: float) -> NDArray[np.float64]:
    """One pulse of ground acceleration that rises and falls linearly."""
    t = np.arange(round(seconds / STEP) + 1) * STEP
    return peak * np.maximum(0.0, 1.0 - np.abs(2.0 * t / length - 1.0))


def sine(peak: float, length: float, seconds: float) -> NDArray[np.float64]:
    t = np.arange(round(seconds / STEP) + 1) * STEP
    return np.where(t < length, peak * np.sin(2.0 * math.pi * t / length), 0.0)


def noise(peak: float, seconds: float, seed: int) -> NDArray[np.float64]:
    t = np.arange(round(seconds / STEP) + 1) * STEP
    random = np.random.default_rng(seed)
    wave = np.sum(
        [
            np.sin(2.0 * math.pi * f * t + random.uniform(0.0, 6.3))
            for f in random.uniform(0.5, 6.0, 12)
        ],
        axis=0,
    ) * np.sin(math.pi * t / seconds)  # fmt: skip
    return np.asarray(peak * wave / np.abs(wave).max())


def along_x(x: NDArray[np.float64], up: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
    return np.column_stack([x, np.zeros_like(x), np.zeros_like(x) if up is None else up])


def what_slides() -> Iterator[Case]:
    stout = (0.6, 0.5, 0.2)
    still = np.zeros(301)
    told = (
        ("rests on a slope", "Friction holds: nothing may creep within 3 s.", 0.35, 0.3, still,
         None),
        ("is carried along", "The support speeds up to 1.2 m/s and goes on, within friction.", 0.5,
         0.0, triangle(0.49 * G, 0.5, 3.0), None),
        ("slides once", "One pulse of twice the friction, after which the support goes on.", 0.3,
         0.0, triangle(0.6 * G, 0.4, 2.0), None),
        ("slides down a slope", "A level pulse on a support that leans by 0.1.", 0.3, 0.1,
         sine(0.5 * G, 0.5, 3.0), None),
        ("slides to and fro", "Six seconds of noise, with as much of it upward.", 0.25, 0.05,
         noise(0.6 * G, 6.0, 1), noise(0.4 * G, 6.0, 2)),
    )  # fmt: skip
    for name, about, friction, tilt, x, up in told:
        case = Case(
            name, about, stout, friction, tilt, 0.0, STEP, along_x(x, up),
            Answers(None, 0.0, falls=False), "closed form (Newmark 1965)", 1e-9,
        )  # fmt: skip
        push, _, down = case.force.T
        slip = slip_of(push, -down, friction, STEP)
        yield case._replace(answers=Answers(slip, None, falls=False))


def what_rocks() -> Iterator[Case]:
    slender = (0.4, 2.0, 1.2)
    body = Body.rectangle(slender[0], slender[2])
    least = slender[0] / slender[2] * G
    for name, about, x in (
        ("does not tip", "The strongest push is 0.99 of what tips it.",
         triangle(0.99 * least, 1.0, 2.0)),
        ("rocks once", "A sine of one period, 1.4 times what tips it.",
         sine(1.4 * least, 0.6, 4.0)),
        ("nearly falls", "A sine of one period that is 1 % weaker than the next.",
         sine(3.0 * least, 0.6, 4.0)),
        ("falls", "A sine of one period.", sine(3.0 * least, 0.6, 4.0)),
        ("rocks on", "Six seconds of noise.", noise(2.0 * least, 6.0, 5)),
    ):  # fmt: skip
        scale = 1.0
        if name in ("nearly falls", "falls"):
            scale = critical(body, x) * (1.005 if name == "falls" else 0.995)
        found = integrate(body, Motion(scale * x, STEP))
        fell = bool(found.outcome)
        yield Case(
            name, about, slender, 2.0, 0.0, 0.0, STEP, along_x(scale * x),
            Answers(None, None if fell else found.peak, fell),
            "planar rocking (Housner 1963), DOP853 at 1e-13", 1e-7,
        )  # fmt: skip


def critical(body: Body, x: NDArray[np.float64]) -> float:
    """The scale from which it falls, by bisection."""
    low, high = 0.2, 3.0
    while high / low > 1.0005:
        middle = math.sqrt(low * high)
        fell = bool(integrate(body, Motion(middle * x, STEP)).outcome)
        low, high = (low, middle) if fell else (middle, high)
    return high


def what_does_all_in_space() -> Iterator[Case]:
    seed, found = 0, 0
    while found < IN_SPACE:
        seed += 1
        random = np.random.default_rng(seed)
        width, depth = random.uniform(0.15, 0.5, 2)
        slender = random.uniform(2.0, 4.0)
        toward = random.uniform(-math.pi, math.pi)
        push = sine(random.uniform(1.0, 2.0) * G / slender, 0.5, 1.2)
        case = Case(
            f"in space, {found + 1}",
            f"A pulse askew to its sides, with a fifth of it upward; draw {seed}.",
            (width, depth, slender * min(width, depth)), random.uniform(0.3, 0.9),
            float(random.choice([0.0, 0.05])), random.uniform(-math.pi, math.pi), STEP,
            np.column_stack([math.cos(toward) * push, math.sin(toward) * push, 0.2 * push]),
            Answers(), "time stepping (Moreau 1988) that has converged", 2 * SAME,
        )  # fmt: skip
        corners = np.column_stack([case.solid.corners, np.full(4, -case.solid.cg_height)])
        coarse, fine = (
            march(
                corners, case.solid.inertia, case.force, STEP, friction=case.friction,
                restitution=0.0, parts=parts, orientation=0.0,
            )
            for parts in (COARSE, FINE)
        )  # fmt: skip
        if fine.fell or fine.peak < 0.01 or abs(coarse.peak - fine.peak) > SAME * fine.peak:
            continue
        found += 1
        yield case._replace(answers=Answers(None, float(fine.peak), falls=False))


def main() -> None:
    cases = [*what_slides(), *what_rocks(), *what_does_all_in_space()]
    lines = ",\n".join(json.dumps(written(case)) for case in cases)
    FILE.write_text(
        f'{{"about": {json.dumps(ABOUT)},\n"cases": [\n{lines}\n]}}\n', encoding="utf-8"
    )
    for case in cases:
        print(f"{case.name:20} {case.answers}")


if __name__ == "__main__":
    main()
