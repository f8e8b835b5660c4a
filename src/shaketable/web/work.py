"""What a worker does: each question answered with the package, in a process of its own."""

from __future__ import annotations

import functools
import logging
import math
import os
import re
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models import General, Model, Rocking
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.records import SUITES, read_motion, suite
from shaketable.resampling import recordings_of, wilson_interval
from shaketable.signal import displacement, filtered, response_spectrum
from shaketable.simulate import fell, simulate, simulate_many
from shaketable.support import Support
from shaketable.units import STANDARD_GRAVITY, degrees, radians
from shaketable.web.answers import (
    Frames,
    Ground,
    Listed,
    Point,
    Read,
    Shaken,
    Shares,
    Spectrum,
)
from shaketable.web.limits import MOST_SAMPLES, MOST_SECONDS, WORKER_MEMORY
from shaketable.web.questions import Many, Pulse, Recording, Shake, Shaking, Thing, Trace

RATE = 60.0  # pictures a second
MOST_DRAWN = 2000  # samples of a trace that are drawn
SLOWEST = 0.1  # Hz: the ground is drawn without what is slower
PULSE_STEP = 0.005  # s
MOST_AFTER = 60.0  # s: the film shows no more of what still moves after the motion
QUIET = 1.0  # s after a pulse
CURVE = np.geomspace(0.25, 4.0, 9)  # scales of the fragility curve
ALL = "fema-p695"
SIDES: dict[Outcome, Literal["standing", "left", "right"]] = {
    Outcome.STANDING: "standing",
    Outcome.DOWNHILL: "left",
    Outcome.UPHILL: "right",
}


def warm(scratch: str) -> None:
    """Prepare a worker: its limits, its folder, the suites and the compiled kernels."""
    own = Path(scratch) / str(os.getpid())
    own.mkdir(mode=0o700, exist_ok=True)
    tempfile.tempdir = str(own)
    told = logging.getLogger("shaketable")  # has the names of visitors' files: for reports alone
    told.addHandler(logging.NullHandler())
    told.propagate = False
    _limit_memory()
    thing = Thing(width_m=0.3, height_m=1.8, friction=0.5)
    for each in (thing, thing.model_copy(update={"friction": None})):
        shake(Shake(thing=each, shaking=Pulse(period_s=0.5, peak_g=0.3)))
        many(Many(thing=each))


def _limit_memory() -> None:
    """Let a worker take so much memory beside what it has mapped; on Linux."""
    mapped = Path("/proc/self/statm")
    if not mapped.exists():
        return
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = int(mapped.read_text().split()[0]) * resource.getpagesize() + WORKER_MEMORY
    if most == resource.RLIM_INFINITY or wanted < most:
        resource.setrlimit(resource.RLIMIT_AS, (wanted, most))


def shake(asked: Shake) -> Shaken:
    """One thing under one motion, with its film."""
    motion = _motion(asked.shaking).scaled(asked.scale)
    if asked.reverse:
        motion = motion.reversed()
    body = _body(asked.thing)
    found = simulate(
        body, motion, Support(tilt=radians(asked.thing.tilt_deg)), model=_model(asked.thing)
    )
    standing = found.outcome is Outcome.STANDING
    moved = found.slip[np.isfinite(found.slip)]
    tilt, farthest = asked.thing.tilt_deg, found.rotation[np.argmax(np.abs(found.rotation))]
    left, right = degrees(body.slenderness_left) - tilt, degrees(body.slenderness_right) + tilt
    return Shaken(
        outcome=SIDES[found.outcome],
        time_s=None if standing else found.overturning_time,
        peak_deg=degrees(found.peak_rotation),
        tips_at_deg=right if farthest > 0.0 else left,
        slip_m=float(np.abs(moved).max(initial=0.0)),
        lift_m=found.max_lift,
        impacts=found.impacts,
        ground=_ground(motion),
        frames=_frames(found.time, found.rotation, found.position, motion),
    )


def many(asked: Many) -> Shares:
    """One thing under a suite, and how its falls grow with the strength of the motions."""
    motions = _suite(asked.suite)
    scales = np.r_[asked.scale, CURVE]
    runs = simulate_many(
        [_body(asked.thing)],
        motions,
        tilts=[radians(asked.thing.tilt_deg)],
        scales=scales,
        polarities=(1, -1),
        model=_model(asked.thing),
        progress=False,
        threads=1,
    )
    recordings = _recordings(asked.suite)
    fallen = fell(runs).isel(body=0, tilt=0)
    shares = fallen.mean(("motion", "polarity")).values
    points = [
        Point(scale=scale, share=share, low=float(low), high=float(high))
        for scale, share in zip(scales.tolist(), shares.tolist(), strict=True)
        for low, high in [wilson_interval(share, recordings)]
    ]
    now = runs.outcome.isel(body=0, tilt=0, scale=0)
    return Shares(
        simulations=2 * len(motions),
        recordings=recordings,
        falls=int(fallen.isel(scale=0).sum()),
        left=int((now == Outcome.DOWNHILL).sum()),
        share=points[0].share,
        low=points[0].low,
        high=points[0].high,
        median_pga_g=asked.scale * _median_pga(asked.suite),
        curve=points[1:],
    )


def look(asked: Trace) -> Spectrum:
    """A motion and its spectrum."""
    motion = _motion(asked.shaking).scaled(asked.scale)
    spectrum = response_spectrum(motion)
    return Spectrum(
        ground=_ground(motion),
        period_s=_rounded(spectrum.periods),
        acceleration_g=_rounded(spectrum.acceleration / STANDARD_GRAVITY),
    )


def motions() -> list[Listed]:
    """The recorded motions to choose from."""
    return [
        Listed(
            name=motion.name,
            suite=name,
            peak_g=motion.peak_ground_acceleration / STANDARD_GRAVITY,
            duration_s=motion.duration,
        )
        for name in SUITES
        if name != ALL
        for motion in _suite(name)
    ]


def read(name: str, data: bytes) -> Read:
    """A record that a visitor has uploaded; it is parsed in a folder that is then gone."""
    with tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        path = Path(folder) / safe_name(name)  # the name chooses the format
        path.write_bytes(data)
        try:
            motion = read_motion(path)
        except InputError as error:
            raise InputError(str(error).replace(str(path), name)) from None
    if motion.horizontal.size > MOST_SAMPLES:
        raise InputError(
            f"{name}: has {motion.horizontal.size:,} samples; at most {MOST_SAMPLES:,} are taken"
        )
    _require_short(motion)
    return Read(name=name, time_step_s=motion.time_step, acceleration=motion.horizontal.tolist())


def safe_name(name: str) -> str:
    """A visitor's name of a file, of letters that any folder takes, and never hidden."""
    return "file_" + re.sub(r"[^A-Za-z0-9._-]", "_", name)[-60:]


def _body(thing: Thing) -> Body:
    """The thing, with the radius of gyration of a homogeneous rectangle."""
    return Body(
        width=thing.width_m,
        cg_height=thing.cg_share * thing.height_m,
        left=thing.eccentricity * thing.width_m,
        gyration_radius=math.hypot(thing.width_m, thing.height_m) / math.sqrt(12.0),
    )


def _model(thing: Thing) -> Model:
    return Rocking() if thing.friction is None else General(static_friction=thing.friction)


def _motion(shaking: Shaking) -> Motion:
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


def _require_short(motion: Motion) -> None:
    if motion.duration > MOST_SECONDS:
        raise InputError(
            f"{motion.name}: lasts {motion.duration:,.0f} s; at most {MOST_SECONDS:g} s are taken"
        )


@functools.cache
def _suite(name: str) -> Sequence[Motion]:
    return suite(name)


@functools.cache
def _by_name() -> dict[str, Motion]:
    return {motion.name: motion for motion in _suite(ALL)}


@functools.cache
def _recordings(name: str) -> int:
    return int(recordings_of(_suite(name)).max()) + 1


@functools.cache
def _median_pga(name: str) -> float:
    peaks = [motion.peak_ground_acceleration for motion in _suite(name)]
    return float(np.median(peaks)) / STANDARD_GRAVITY


def _ground(motion: Motion) -> Ground:
    every = math.ceil(motion.horizontal.size / MOST_DRAWN)
    return Ground(
        name=motion.name,
        peak_g=motion.peak_ground_acceleration / STANDARD_GRAVITY,
        time_step_s=motion.time_step * every,
        acceleration_g=_rounded(motion.horizontal[::every] / STANDARD_GRAVITY),
    )


def _frames(
    time: NDArray[np.float64],
    rotation: NDArray[np.float64],
    position: NDArray[np.float64],
    motion: Motion,
) -> Frames:
    """The histories, at the times of the pictures."""
    end = min(float(time[-1]), motion.duration + MOST_AFTER)
    at = np.arange(math.floor(end * RATE) + 1) / RATE
    still = filtered(motion, low=SLOWEST) if motion.duration > 2.0 / SLOWEST else motion
    ground = displacement(still.horizontal, still.time_step)
    return Frames(
        rotation_deg=_rounded(np.degrees(np.interp(at, time, rotation))),
        x_m=_rounded(np.interp(at, time, position[:, 0])),
        y_m=_rounded(np.interp(at, time, position[:, 1])),
        ground_m=_rounded(np.interp(at, motion.time, ground, right=float(ground[-1]))),
    )


def _rounded(values: NDArray[np.float64]) -> list[float]:
    return [float(value) for value in np.round(values, 6)]
