"""Reading, measuring and making motions: `python -m benchmarks.shaking`."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import eqsig
import numpy as np
from tests.signal.test_processing import shifted

from benchmarks.cases import motions
from shaketable import Motion, suite
from shaketable.signal import (
    PERIODS,
    Spectrum,
    baseline_corrected,
    displacement,
    intensity_measures,
    permanent_displacement,
    response_spectrum,
    velocity,
)
from shaketable.signal.spectra import spectral_acceleration
from shaketable.synthesis import eurocode_8, match_spectrum, spectrum_compatible
from shaketable.synthesis.compatible import trapezoid, waves
from shaketable.synthesis.matching import goal_of
from shaketable.units import STANDARD_GRAVITY

RECORDS, SECONDS, STEP = 300, 40.0, 0.005
MADE = 50


def timed(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def of_forty_seconds() -> list[Motion]:
    """300 motions of 40 s at 0.005 s: recorded ones, resampled, cut or repeated."""
    shaking = motions()
    count = round(SECONDS / STEP)
    made = []
    for k in range(RECORDS):
        one = shaking[k % len(shaking)]
        even = np.interp(np.arange(0.0, one.duration, STEP), one.time, one.horizontal)
        made.append(Motion(np.resize(np.roll(even, k), count), STEP, name=f"{one.name} {k}"))
    return made


def folder_of(records: list[Motion], folder: Path) -> None:
    """The motions as PEER AT2 files."""
    for k, motion in enumerate(records):
        rows = (motion.horizontal / STANDARD_GRAVITY).reshape(-1, 5)
        text = "\n".join("".join(f"{value:15.7E}" for value in row) for row in rows)
        head = f"UNITS OF G\nNPTS= {motion.horizontal.size}, DT= {motion.time_step} SEC\n"
        (folder / f"RSN{k}.AT2").write_text(f"{head}{text}\n")


def main() -> None:
    target = eurocode_8(0.3 * STANDARD_GRAVITY, "B")
    recorded = motions()[0]
    intensity_measures(recorded)  # compiles
    spectrum_compatible(target, 1)
    records = of_forty_seconds()
    print(f"{RECORDS} records of {SECONDS:g} s at {STEP:g} s, one core:\n")
    print("| work | s |\n|---|---:|")
    both = timed(
        lambda: [(intensity_measures(one), response_spectrum(one, PERIODS)) for one in records]
    )
    print(f"| all intensity measures and spectra of {PERIODS.size} periods | {both:.2f} |")
    spectra = timed(lambda: [response_spectrum(one, PERIODS) for one in records])
    print(f"| the spectra alone | {spectra:.2f} |")
    with tempfile.TemporaryDirectory() as name:
        folder_of(records, Path(name))
        first, second = (timed(lambda: suite(name)) for _ in range(2))
    print(f"| a folder of {RECORDS} AT2 files as a suite, first time | {first:.2f} |")
    print(f"| again | {second:.2f} |")

    few = records[:5]

    def peer() -> None:
        for one in few:
            signal = eqsig.AccSignal(one.horizontal, one.time_step)
            signal.generate_response_spectrum(response_times=PERIODS)

    ours = timed(lambda: [response_spectrum(one, PERIODS) for one in few])
    print(f"\nspectra: eqsig takes {timed(peer) / ours:.0f} times as long, peaks at samples\n")

    periods = np.geomspace(0.05, 3.0, 300)
    print(f"{MADE} motions each, one core; departures at 300 periods from 0.05 to 3 s:\n")
    print("| target | s each | largest | largest of the mean |\n|---|---:|---:|---:|")
    for label, goal, length in (
        (target.name, target, 25.0),
        (f"spectrum of {recorded.name}", recorded, None),
    ):
        start = time.perf_counter()
        made = spectrum_compatible(goal, MADE, duration=length, seed=1)
        each = (time.perf_counter() - start) / MADE
        wanted = (
            response_spectrum(goal, periods).acceleration
            if isinstance(goal, Motion)
            else goal.at(periods)
        )
        found = np.array([response_spectrum(one, periods).acceleration for one in made]) / wanted
        largest, mean = np.abs(found - 1).max(), np.abs(found.mean(axis=0) - 1).max()
        print(f"| {label} | {each:.3f} | {largest:.1%} | {mean:.1%} |")
    scaled = [waves_only(seed, target) for seed in range(MADE)]
    off = [
        np.abs(spectral_acceleration(one, 0.01, periods) / target.at(periods) - 1).max()
        for one in scaled
    ]
    print(
        f"\nscaling by the ratio of spectra alone (SIMQKE's way), 20 times: largest departure "
        f"{np.median(off):.0%} in the median motion, {np.min(off):.0%} in the best"
    )
    seeds = [one for one in motions()[:44] if 4.0 * one.time_step <= 0.05]
    each = timed(lambda: [match_spectrum(one, target) for one in seeds]) / len(seeds)
    print(f"matching a recorded seed to {target.name}: {each:.3f} s in the mean of {len(seeds)}")
    offsets()


def offsets() -> None:
    """How well permanent displacements that are known are found again."""
    rng = np.random.default_rng(1)
    off, raw, peaks = [], [], []
    for _ in range(60):
        record, offset, peak = shifted(rng, motions()[rng.integers(44)])
        corrected = baseline_corrected(record)
        off.append(abs(permanent_displacement(corrected) - offset))
        raw.append(abs(displacement(record.horizontal, record.time_step)[-1] - offset))
        found = np.abs(velocity(corrected.horizontal, record.time_step)).max()
        peaks.append(abs(found / peak - 1))
    print(
        f"baselines of 60 shifted records: offsets off by {np.median(off):.2f} m in the median, "
        f"{np.quantile(off, 0.9):.2f} m in nine of ten (raw: {np.median(raw):.0f} m); peak "
        f"velocities by {np.median(peaks):.0%} and {np.quantile(peaks, 0.9):.0%}"
    )


def waves_only(seed: int, target: Spectrum) -> np.ndarray:
    height = trapezoid(np.linspace(0.0, 1.0, 2501))
    goal = goal_of(target, (0.05, 3.0), 0.1, 0.01)
    return waves(np.random.default_rng(seed), height, 0.01, goal, scalings=20)


if __name__ == "__main__":
    main()
