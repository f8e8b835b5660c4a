"""Thousands of damaged records: nothing but InputError, and no change that nobody is told of."""

from __future__ import annotations

import logging
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from shaketable import InputError, read_components
from shaketable.records.component import Component
from tests.support.mutations import MUTATIONS
from tests.support.record_files import Example, examples

LONGEST = 10.0  # s a file, on a machine that others use too
MOST_MEMORY = 1_000_000_000  # bytes
PEAKS = 0.025  # readers hold a scale within 2 % of the stated maximum, beside its rounding
STEPS = 2e-3  # durations and times of peaks are printed with two or three decimals
PER_LINE = 20  # more samples than any format has on a line


def peak(values: NDArray[np.float64]) -> float:
    return float(np.abs(values).max())


def peak_from_mean(values: NDArray[np.float64]) -> float:
    return peak(values - values.mean())


def changed(example: Example, before: list[Component], after: list[Component], lines: int) -> str:
    """What a count, a maximum or a header that the file states could have told, "" if nothing.

    Args:
        before, after: components of the whole and of the damaged file.
        lines: how many lines were damaged: what stands on them cannot be told.
    """
    if len(before) != len(after):
        return f"{len(before)} components became {len(after)}"
    for one, other in zip(before, after, strict=True):
        sizes = one.acceleration.size, other.acceleration.size
        # a damaged time of uneven pairs may move an end by less than a header's length can tell
        spare = 0 if example.even else lines
        if example.counted and abs(sizes[0] - sizes[1]) > spare:
            return f"{sizes[0]} samples became {sizes[1]}"
        if example.timed and not np.isclose(one.time_step, other.time_step, rtol=STEPS):
            return f"a time step of {one.time_step} s became {other.time_step} s"
        if example.peaked and not any(
            np.isclose(of(one.acceleration), of(other.acceleration), rtol=PEAKS)
            for of in (peak, peak_from_mean)
        ):
            return f"a peak of {peak(one.acceleration)} became {peak(other.acceleration)}"
        if example.even and sizes[0] == sizes[1]:
            differ = ~np.isclose(one.acceleration, other.acceleration, rtol=PEAKS, atol=1e-9)
            if np.count_nonzero(differ) > PER_LINE * max(lines, 1):
                return f"{np.count_nonzero(differ)} of {sizes[0]} samples changed"
    return ""


def damage(
    folder: Path, caplog: pytest.LogCaptureFixture, each: int, seed: int
) -> tuple[list[str], int, float]:
    """Read `each` damaged versions of every example; faults, how many were read, longest time."""
    faults, read, longest = [], 0, 0.0
    rng = np.random.default_rng(seed)
    for name, example in examples().items():
        path = folder / name
        raw = example.text.encode()
        path.write_bytes(raw)
        caplog.clear()
        intact = read_components(path, **example.given)
        usual = set(caplog.messages)
        for number in range(each):
            mutation = MUTATIONS[int(rng.integers(len(MUTATIONS)))]
            spoilt, lines = mutation(raw, rng)
            path.write_bytes(spoilt)
            caplog.clear()
            begun = time.monotonic()
            what = f"{name}, {number}, {mutation.__name__}"
            try:
                found = read_components(path, **example.given)
            except InputError as error:
                if len(str(error)) > 2000 or not str(error).isprintable():
                    faults.append(f"{what}: message {str(error)[:80]!r}")
            except Exception as error:
                faults.append(f"{what}: {type(error).__name__}: {error}"[:200])
            else:
                read += 1
                told = changed(example, intact, found, lines)
                if mutation.__name__ == "cut" and len(found) == 1 < len(intact):
                    told = ""  # at the end of a channel: many collections hold one a file
                if told and not set(caplog.messages) - usual:
                    faults.append(f"{what}: {told}")
            longest = max(longest, time.monotonic() - begun)
    return faults, read, longest


@pytest.mark.parametrize("each", [20, pytest.param(600, marks=pytest.mark.slow)])
def test_damaged_records(tmp_path: Path, caplog: pytest.LogCaptureFixture, each: int) -> None:
    tracemalloc.start()
    with caplog.at_level(logging.WARNING):
        faults, read, longest = damage(tmp_path, caplog, each, seed=each)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert faults == []
    assert longest < LONGEST
    assert most < MOST_MEMORY
    assert 0.1 < read / (each * len(examples())) < 0.6  # neither all nor none was refused
