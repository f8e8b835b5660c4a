"""Detrending, filters, and a baseline that keeps a permanent displacement."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion, read_motion
from shaketable.origin import Origin
from shaketable.signal import (
    baseline_corrected,
    detrended,
    displacement,
    filtered,
    permanent_displacement,
    velocity,
)


def waves(*frequencies: float, duration: float = 40.0, h: float = 0.01) -> Motion:
    t = np.arange(round(duration / h) + 1) * h
    taper = np.sin(math.pi * t / duration) ** 2
    series = sum(np.sin(2 * math.pi * f * t) for f in frequencies) * taper
    return Motion(series, h, vertical=2 * series, origin=Origin(), vertical_origin=Origin())


def test_detrended() -> None:
    motion = waves(2.0)
    slope = 0.3 + 0.02 * motion.time
    bent = Motion(motion.horizontal + slope, motion.time_step, origin=Origin())
    found = detrended(bent, order=1)
    # sin² leaves a mean and a slope of its own, of 1e-3
    assert found.horizontal == pytest.approx(motion.horizontal, abs=5e-3)
    assert found.origin.processing == ("polynomial of order 1 subtracted",)
    before = Motion(np.concatenate([np.full(200, 0.1), motion.horizontal + 0.1]), 0.01)
    assert detrended(before, until=1.9).horizontal[200:] == pytest.approx(motion.horizontal)
    with pytest.raises(InputError, match="cannot be fitted"):
        detrended(motion, order=3, until=0.01)


def test_filter_passes_its_band() -> None:
    inside, mixed = waves(2.0), waves(2.0, 0.05, 20.0)
    found = filtered(mixed, low=0.3, high=8.0)
    assert found.horizontal == pytest.approx(inside.horizontal, abs=0.02)
    assert found.vertical == pytest.approx(inside.vertical, abs=0.04)
    assert found.origin.processing[0].startswith("bandpass 0.3-8 Hz, Butterworth of order 4")
    # forwards and backwards: half the amplitude at a corner
    corner = filtered(waves(2.0), high=2.0).horizontal[1500:2500]
    assert np.abs(corner).max() == pytest.approx(0.5, abs=0.02)
    for bad in ({}, {"low": 0.0}, {"high": 50.0}, {"low": 5.0, "high": 2.0}):
        with pytest.raises(InputError, match="Hz"):
            filtered(mixed, **bad)


def shifted(rng: np.random.Generator, motion: Motion) -> tuple[Motion, float, float]:
    """A record with a step of the ground in it, on an instrument whose zero shifts; the ground's
    offset [m] and peak velocity [m/s]."""
    h = motion.time_step
    quiet = [np.zeros(round(5.0 / h)), motion.horizontal, np.zeros(round(20.0 / h))]
    a = np.concatenate(quiet)
    t = np.arange(a.size) * h
    share = np.cumsum(a * a) / (a * a).sum()
    begins, ends = t[np.searchsorted(share, 0.05)], t[np.searchsorted(share, 0.95)]
    strongest = t[np.argmax(np.abs(a))]
    step, lasts = rng.uniform(-1.5, 1.5), rng.uniform(2.0, 5.0)
    x = np.clip((t - strongest) / lasts + 0.5, 0.0, 1.0)
    clean = a + step * 2 * math.pi / lasts**2 * np.sin(2 * math.pi * x)
    t1 = rng.uniform(begins, strongest)
    t2 = rng.uniform(max(strongest, t1 + 0.5), ends)
    zero = np.where((t > t1) & (t < t2), rng.uniform(-0.05, 0.05), 0.0)
    zero = np.where(t >= t2, rng.uniform(-0.01, 0.01), zero)
    offset, peak = displacement(clean, h)[t > ends].mean(), np.abs(velocity(clean, h)).max()
    return Motion(clean + zero, h), float(offset), float(peak)


def test_permanent_displacements_are_found_again(p695: list[Motion]) -> None:
    rng = np.random.default_rng(1)
    errors, raw, peaks = [], [], []
    for _ in range(60):
        record, offset, peak = shifted(rng, p695[rng.integers(44)])
        corrected = baseline_corrected(record)
        found = np.abs(velocity(corrected.horizontal, corrected.time_step)).max()
        peaks.append(abs(found / peak - 1.0))
        errors.append(abs(permanent_displacement(corrected) - offset))
        raw.append(abs(displacement(record.horizontal, record.time_step)[-1] - offset))
        end = velocity(corrected.horizontal, corrected.time_step)[-100:]
        assert np.abs(end).max() < 0.05  # m/s: the ground stands still
    # what Boore (2001) and Wang et al. (2011) find: decimetres, where raw integrals run to 10 m
    assert np.median(errors) < 0.15
    assert np.quantile(errors, 0.9) < 0.45
    assert np.quantile(peaks, 0.9) < 0.15  # some cm/s of the shift are in the peak
    assert np.median(raw) > 5.0


def test_known_times_give_the_offset() -> None:
    # zero shifts by 0.04 m/s² from 12 to 18 s and by 0.003 m/s² after, none else: with t1 and t2
    # known the ground's step of 0.8 m comes back
    h, t = 0.01, np.arange(6001) * 0.01
    x = np.clip((t - 13.0) / 4.0, 0.0, 1.0)
    clean = 0.8 * 2 * math.pi / 16.0 * np.sin(2 * math.pi * x)
    zero = np.where((t > 12.0) & (t <= 18.0), 0.04, 0.0) + np.where(t > 18.0, 0.003, 0.0)
    corrected = baseline_corrected(Motion(clean + zero, h), t1=12.0, t2=18.0, t3=25.0)
    found = displacement(corrected.horizontal, h)
    # the shifts fall within a sample: 0.04 m/s² · 0.01 s · 40 s
    assert found[-1] == pytest.approx(0.8, abs=0.02)


def test_a_good_record_stays_about_as_it_is(p695: list[Motion]) -> None:
    for motion in p695[:8]:
        corrected = baseline_corrected(motion)
        taken_off = velocity(motion.horizontal - corrected.horizontal, motion.time_step)
        peak = np.abs(velocity(motion.horizontal, motion.time_step)).max()
        # what the tails of filtered records swing: 1 or 2 cm/s
        assert np.abs(taken_off).max() < 0.05 * peak


def test_quadratic_takes_off_a_parabola() -> None:
    # an acceleration b + 2ct from t1 on and nothing else is a parabola of velocity through zero
    t = np.arange(4001) * 0.01
    bent = np.where(t >= 10.0, 0.02 - 0.001 * (t - 10.0), 0.0)
    found = baseline_corrected(Motion(bent, 0.01), scheme="quadratic", t1=10.0, t3=20.0)
    # the jump at t1 falls within a sample
    assert np.abs(found.horizontal[1002:]).max() < 1e-4


@pytest.mark.parametrize(
    ("name", "left"),
    [
        ("AOM0031801241951.EW", 0.02),
        ("AOM0031801241951.NS", 0.02),
        ("AICH040010061330.NS2", 0.2),  # 143 s, of which most is the instrument's noise
    ],
)
def test_far_records_end_where_they_began(shared_records: Path, name: str, left: float) -> None:
    # as published, 150 km and more from their earthquakes: no permanent displacement
    motion = read_motion(shared_records / "knet_kiknet" / name)
    corrected = baseline_corrected(motion)
    assert abs(permanent_displacement(corrected)) < left
    raw = np.abs(displacement(motion.horizontal, motion.time_step)).max()
    assert np.abs(displacement(corrected.horizontal, motion.time_step)).max() < 0.5 * raw


def test_baselines_refuse() -> None:
    motion = waves(1.0)
    for bad in (
        {"scheme": "cubic"},
        {"scheme": "quadratic", "t2": 3.0},
        {"t1": 5.0, "t2": 4.0},
        {"t3": 39.9},
        {"t1": -1.0},
    ):
        with pytest.raises(InputError):
            baseline_corrected(motion, **bad)
