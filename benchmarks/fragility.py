"""`python -m benchmarks.fragility`: how often intervals cover the truth, what levels do, and speed.

Coverage: outcomes are drawn for the far-field suite's 44 motions, of 22 recordings of 14
earthquakes, in both directions at eight scales. Each motion has a capacity that is drawn once, so
that its outcomes belong together; a part of its variance is shared by a recording, and by an event.
"""

from __future__ import annotations

import argparse
import logging
import time
from typing import Any

import numpy as np
import statsmodels.api as sm
from numpy.typing import NDArray

from benchmarks.cases import BODIES, motions
from shaketable import Body, fragility, ida, overturning_spectrum, suite
from shaketable.fragility import efficiency, goodness, vector_fragility
from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.intensities import intensities
from shaketable.fragility.lognormal import Points, fit_many, reflected
from shaketable.fragility.wild_score import score_p
from shaketable.resampling import ends, events_of, nested_resamples, recordings_of
from shaketable.signal import measure_named

SCALES = np.array([0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0])
MEDIAN, BETA = 0.43, 0.4  # of the truth
DRAWS = 400
#: Parts of the variance that are an event's, a recording's and a motion's own; a shaking has the
#: rest.
SHARED = {
    "independent shakings": (0.0, 0.0, 0.0),
    "shared by a motion": (0.0, 0.0, 1.0),
    "a half by recordings": (0.0, 0.5, 0.5),
    "a quarter by events, a quarter by recordings": (0.25, 0.25, 0.5),
}
FEW = (3, 4, 6, 8, 10)  # earthquakes
SETS = {
    "0.25 to 3 in eight steps": SCALES,
    "0.5, 1, 1.5": (0.5, 1.0, 1.5),
    "0.25 to 8, doubling": (0.25, 0.5, 1.0, 2.0, 4.0, 8.0),
    "1, 2, 3": (1.0, 2.0, 3.0),
    "by itself": None,
}
METHODS: dict[str, dict[str, Any]] = {
    "cloud": {},
    "stripes": {"levels": (0.2, 0.3, 0.4, 0.6, 0.8)},
    "ida": {},
    "truncated ida": {"highest": 0.5},
}
BOOKCASE = Body.rectangle(0.32, 1.80)


def drawn(
    random: np.random.Generator,
    parts: tuple[float, float, float],
    level: NDArray[np.float64],
    recording: NDArray[np.intp],
    event: NDArray[np.intp],
) -> NDArray[np.int64]:
    """How many of two shakings of each motion overturn at each level, (motion, scale)."""
    shared = sum(parts)
    capacity = np.zeros((level.shape[0], 1, 2))
    groups = (event[recording], recording, np.arange(level.shape[0]))
    for part, group in zip(parts, groups, strict=True):
        each = random.normal(size=(int(group.max()) + 1, 1, 1))
        capacity = capacity + np.sqrt(part) * each[group]
    rest = random.normal(size=(*level.shape, 2)) * np.sqrt(1.0 - shared)
    beyond = np.log(level / MEDIAN)[..., None] >= BETA * (capacity + rest)
    return np.asarray(beyond.sum(axis=-1))


def coverage(repetitions: int) -> None:
    shaken = suite("fema-p695-far-field")
    recording, event = recordings_of(shaken), events_of(shaken)
    level = intensities(shaken, measure_named("PGV"), SCALES)
    of_point = np.repeat(recording, SCALES.size)
    for name, parts in SHARED.items():
        random = np.random.default_rng(1)
        inside = np.zeros(2)
        for k in range(repetitions):
            reached = drawn(random, parts, level, recording, event).ravel()
            points = Points(level.ravel(), reached, np.full(reached.size, 2), of_point)
            fits = fit_many(points, nested_resamples(event, DRAWS, k))
            for which, truth in enumerate((MEDIAN, BETA)):
                low, high = ends(reflected(fits[which]))
                inside[which] += low <= truth <= high
        shares = 100 * inside / repetitions
        print(f"95 % intervals, {name}: θ is covered in {shares[0]:.1f} %, β in {shares[1]:.1f} %")


def coverage_of_few(repetitions: int) -> None:
    """The same where only some of the earthquakes are at hand, others in each repetition."""
    shaken = suite("fema-p695-far-field")
    recording, event = recordings_of(shaken), events_of(shaken)
    level = intensities(shaken, measure_named("PGV"), SCALES)
    parts = SHARED["a quarter by events, a quarter by recordings"]
    logging.getLogger("shaketable").setLevel(logging.ERROR)  # it warns of so few in each repetition
    for count in FEW:
        random = np.random.default_rng(3)
        inside = np.zeros(2)
        for k in range(repetitions):
            reached = drawn(random, parts, level, recording, event)
            some = random.choice(int(event.max()) + 1, count, replace=False)
            here = np.isin(event[recording], some)
            _, mine = np.unique(recording[here], return_inverse=True)
            _, of_event = np.unique(event[np.unique(recording[here])], return_inverse=True)
            of_point = np.repeat(mine, SCALES.size)
            points = Points(
                level[here].ravel(), reached[here].ravel(), np.full(of_point.size, 2), of_point
            )
            fits = fit_many(points, nested_resamples(of_event, DRAWS, k))
            for which, truth in enumerate((MEDIAN, BETA)):
                low, high = ends(reflected(fits[which]))
                inside[which] += low <= truth <= high
        shares = 100 * inside / repetitions
        print(f"95 % intervals of {count} earthquakes: θ is covered in {shares[0]:.1f} %, "
              f"β in {shares[1]:.1f} %")  # fmt: skip


def chances(repetitions: int) -> None:
    """How often an effect is found where there is none, by both tests."""
    shaken = suite("fema-p695-far-field")
    recording, event = recordings_of(shaken), events_of(shaken)
    level = intensities(shaken, measure_named("PGV"), SCALES)
    of_point = np.repeat(recording, SCALES.size)
    x = np.log(level.ravel())
    beside = {
        name: np.repeat(one.standard, SCALES.size) for name, one in known_covariates(shaken).items()
    }
    beside["curvature"] = (x - x.mean()) ** 2
    family = sm.families.Binomial(sm.families.links.Probit())
    for name, parts in list(SHARED.items())[1:]:
        random = np.random.default_rng(2)
        found = np.zeros((2, len(beside)))
        for k in range(repetitions):
            reached = drawn(random, parts, level, recording, event).ravel()
            points = Points(level.ravel(), reached, np.full(reached.size, 2), of_point)
            counts = np.column_stack([reached, 2 - reached])
            for which, each in enumerate(beside.values()):
                robust = sm.GLM(
                    counts, sm.add_constant(np.column_stack([x, each])), family=family
                ).fit(cov_type="cluster", cov_kwds={"groups": event[of_point]})
                found[0, which] += score_p(points, each, event[of_point], k) < 0.05
                found[1, which] += robust.pvalues[2] < 0.05
        for test, row in zip(("signs of earthquakes", "robust errors"), found, strict=True):
            told = ", ".join(
                f"{key} {100 * share:.0f} %"
                for key, share in zip(beside, row / repetitions, strict=True)
            )
            print(f"p < 0.05 where there is no effect, {name}, by {test}: {told}")


def together() -> None:
    """What a bookcase's measures tell, and those of twelve bodies together."""
    shaken = suite("fema-p695-far-field")
    found = fragility(BOOKCASE, shaken, draws=0)
    print(f"p of lognormal: {goodness(found.curve).curvature_p:.2g}")
    print(efficiency(BOOKCASE, shaken).drop(columns="body").to_string(float_format="%.3f"))
    for some in (BODIES, BODIES[-2:]):
        pooled = vector_fragility(some, shaken)
        print(f"{len(some)} bodies together:")
        print(pooled.compared.to_string(float_format="%.2f", index=False))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=1000)
    given = parser.parse_args()
    shaken = suite("fema-p695-far-field")
    for name, scales in SETS.items():
        told = []
        for measure in ("PGA", "PGV"):
            found = fragility(BOOKCASE, shaken, measure=measure, scales=scales, draws=0)
            told.append(f"{measure} θ {found.median:.4g} {found.measure.unit}, β {found.beta:.3f}")
        print(f"scales {name}: {'; '.join(told)}")
    for method, more in METHODS.items():
        one = fragility(BOOKCASE, shaken, method=method, draws=0, **more)
        print(f"{method} {more or ''}: PGV θ {one.median:.3f} m/s, β {one.beta:.2f}")
    start = time.perf_counter()
    found = ida(BODIES, motions())
    seconds = time.perf_counter() - start
    share = 100 * float((found["survived"] > 0).mean())
    print(f"IDA of {len(BODIES)} bodies under {len(motions())} motions in both directions: "
          f"{seconds:.1f} s; in {share:.0f} % something stronger is survived")  # fmt: skip
    start = time.perf_counter()
    overturning_spectrum(
        BOOKCASE, frequencies=np.linspace(0.2, 10, 200), amplitudes=np.linspace(0.5, 12, 200)
    )
    print(f"spectrum of 200 × 200 pulses: {time.perf_counter() - start:.1f} s")
    together()
    coverage(given.repetitions)
    coverage_of_few(given.repetitions)
    chances(max(given.repetitions // 4, 1))


if __name__ == "__main__":
    main()
