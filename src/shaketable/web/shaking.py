"""The shakings that can be asked for: recordings, pulses and records that visitors upload."""

from __future__ import annotations

import functools
import math
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE, SUITES, read_motion, suite
from shaketable.resampling import recordings_of
from shaketable.signal import displacement, filtered, response_spectrum
from shaketable.units import STANDARD_GRAVITY
from shaketable.web.answers import GroundTrace, Listed, MotionSpectrum, UploadedRecord
from shaketable.web.limits import MOST_SAMPLES, MOST_SECONDS
from shaketable.web.questions import LookAtMotion, Pulse, Recording, Shaking
from shaketable.web.uploads import Upload

ALL = "fema-p695"
#: The earthquakes of FEMA P-695 (2009), tables A-4A and A-6A, by the names of their files.
EARTHQUAKES = {
    "CAPEMEND": "Cape Mendocino 1992",
    "CHICHI": "Chi-Chi 1999",
    "DENALI": "Denali 2002",
    "DUZCE": "Düzce 1999",
    "ERZIKAN": "Erzincan 1992",
    "FRIULI": "Friuli 1976",
    "GAZLI": "Gazli 1976",
    "HECTOR": "Hector Mine 1999",
    "IMPVALL": "Imperial Valley 1979",
    "ITALY": "Irpinia 1980",
    "KOBE": "Kobe 1995",
    "KOCAELI": "Kocaeli 1999",
    "LANDERS": "Landers 1992",
    "LOMAP": "Loma Prieta 1989",
    "MANJIL": "Manjil 1990",
    "NAHANNI": "Nahanni 1985",
    "NORTHR": "Northridge 1994",
    "SFERN": "San Fernando 1971",
    "SUPERST": "Superstition Hills 1987",
}
MOST_DRAWN = 2000  # samples of a trace that are drawn
SLOWEST = 0.1  # Hz: the ground is drawn without what is slower
PULSE_STEP = 0.005  # s
QUIET = 1.0  # s after a pulse


def look(asked: LookAtMotion) -> MotionSpectrum:
    """A motion and its spectrum."""
    motion = motion_of(asked.shaking).scaled(asked.scale)
    spectrum = response_spectrum(motion)
    return MotionSpectrum(
        ground=ground_of(motion),
        period_s=rounded(spectrum.periods),
        acceleration_g=rounded(spectrum.acceleration / STANDARD_GRAVITY),
    )


def motions() -> list[Listed]:
    """The recorded motions to choose from."""
    return [
        Listed(
            name=motion.name,
            suite=name,
            earthquake=EARTHQUAKES[motion.origin.event] if motion.origin else "",
            magnitude=motion.origin.magnitude if motion.origin else None,
            distance_km=motion.origin.distance if motion.origin else None,
            peak_g=motion.peak_ground_acceleration / STANDARD_GRAVITY,
            duration_s=motion.duration,
        )
        for name in SUITES
        if name not in (ALL, DEFAULT_SUITE)
        for motion in suite_of(name)
    ]


def read(
    name: str,
    data: bytes,
    units: str | None = None,
    time_step: float | None = None,
    component: str | None = None,
) -> UploadedRecord:
    """A record that a visitor has uploaded; it is parsed in a folder that is then gone."""
    with tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        upload = Upload.written(Path(folder), name, data)
        try:
            motion = read_motion(upload.path, component=component, units=units, time_step=time_step)
        except InputError as error:
            raise upload.refusal(error) from None
    if motion.horizontal.size > MOST_SAMPLES:
        raise InputError(
            f"{name}: has {motion.horizontal.size:,} samples; at most {MOST_SAMPLES:,} are taken"
        )
    _require_short(motion)
    return UploadedRecord(
        name=name, time_step_s=motion.time_step, acceleration=motion.horizontal.tolist()
    )


def motion_of(shaking: Shaking) -> Motion:
    """The motion that is asked for."""
    if isinstance(shaking, Recording):
        found = _by_name().get(shaking.name)
        if found is None:
            raise InputError(f"there is no recording {shaking.name!r}; see GET /api/motions")
        return found
    if isinstance(shaking, Pulse):
        size = max(math.ceil(shaking.period_s / PULSE_STEP), 10)
        step = shaking.period_s / size
        time = np.arange(size + 1) * step
        wave = shaking.peak_g * STANDARD_GRAVITY * np.sin(2.0 * np.pi * time / shaking.period_s)
        return Motion(np.r_[wave, np.zeros(math.ceil(QUIET / step))], step, name="pulse")
    motion = Motion(np.array(shaking.acceleration), shaking.time_step_s, name=shaking.name)
    _require_short(motion)
    return motion


def pair_of(shaking: Shaking) -> Motion:
    """A motion with the component across it, where that is known.

    Either component of a recording can be asked for: it is then along x, and the other along y as
    both were recorded.
    """
    motion = motion_of(shaking)
    pair = _pairs().get(_numbers()[motion.name]) if isinstance(shaking, Recording) else None
    if pair is None or pair.name == motion.name:
        return pair or motion
    return replace(pair.rotated(-math.pi / 2), name=motion.name)


@functools.cache
def pairs_of(name: str) -> list[Motion]:
    """The motions of a suite, both components of a recording as one, where both are known."""
    return [motion for motion in suite(name, pairs=True) if motion.transverse is not None]


def _require_short(motion: Motion) -> None:
    if motion.duration > MOST_SECONDS:
        raise InputError(
            f"{motion.name}: lasts {motion.duration:,.0f} s; at most {MOST_SECONDS:g} s are taken"
        )


@functools.cache
def suite_of(name: str) -> Sequence[Motion]:
    """The motions of a suite, each component by itself."""
    return suite(name)


@functools.cache
def _by_name() -> dict[str, Motion]:
    return {motion.name: motion for motion in suite_of(ALL)}


@functools.cache
def _numbers() -> dict[str, int]:
    """Of which recording each component is."""
    return dict(zip(_by_name(), recordings_of(suite_of(ALL)).tolist(), strict=True))


@functools.cache
def _pairs() -> dict[int, Motion]:
    return {_numbers()[pair.name]: pair for pair in pairs_of(ALL)}


def recordings(motions: Sequence[Motion]) -> int:
    """How many independent recordings motions come from."""
    return int(recordings_of(motions).max()) + 1


def median_pga(motions: Sequence[Motion]) -> float:
    """Median of the largest accelerations [g]."""
    peaks = [motion.peak_ground_acceleration for motion in motions]
    return float(np.median(peaks)) / STANDARD_GRAVITY


def moved_ground(motion: Motion, at: NDArray[np.float64], transverse: bool = False) -> list[float]:
    """Displacement of the ground at some times [m], without its drift."""
    still = filtered(motion, low=SLOWEST) if motion.duration > 2.0 / SLOWEST else motion
    acceleration = still.transverse if transverse else still.horizontal
    if acceleration is None:
        return rounded(np.zeros(np.size(at)))
    ground = displacement(acceleration, still.time_step)
    return rounded(np.interp(at, motion.time, ground, right=float(ground[-1])))


def ground_of(motion: Motion) -> GroundTrace:
    """A motion to draw: of a long one the least and the largest of every so many samples."""
    acceleration = motion.horizontal
    every = math.ceil(2 * acceleration.size / MOST_DRAWN)
    if every > 2:
        bins = np.pad(acceleration, (0, -acceleration.size % every), "edge").reshape(-1, every)
        first = bins.argmin(axis=1) < bins.argmax(axis=1)
        ends = np.column_stack([bins.min(axis=1), bins.max(axis=1)])
        acceleration = np.where(first[:, None], ends, ends[:, ::-1]).ravel()
    return GroundTrace(
        name=motion.name,
        peak_g=motion.peak_ground_acceleration / STANDARD_GRAVITY,
        time_step_s=motion.time_step * (every / 2 if every > 2 else 1),
        acceleration_g=rounded(acceleration / STANDARD_GRAVITY),
    )


def rounded(values: NDArray[np.float64]) -> list[float]:
    """As JSON takes them, to a millionth."""
    return [float(value) for value in np.round(values, 6)]
