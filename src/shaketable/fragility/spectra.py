"""Overturning and rocking spectra: all blocks under one pulse or one motion, in one picture."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_positive
from shaketable.fragility.pulse_borders import size_of, without_impact
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate import simulate_each, simulate_many
from shaketable.simulate.checks import numbers
from shaketable.synthesis import (
    half_sine,
    mavroeidis_papageorgiou,
    one_cosine,
    one_sine,
    rectangular,
    ricker,
)
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: Pulses of a circular frequency ω_p [rad/s], with so many samples.
PULSES: dict[str, Callable[[float, int], Motion]] = {
    "sine": lambda w, n: one_sine(1.0, 2.0 * math.pi / w, samples=n),
    "cosine": lambda w, n: one_cosine(1.0, 2.0 * math.pi / w, samples=n),
    "half sine": lambda w, n: half_sine(1.0, math.pi / w, samples=n),
    "rectangular": lambda w, n: rectangular(1.0, math.pi / w, samples=n),
    "ricker": lambda w, n: ricker(1.0, 2.0 * math.pi / w, samples=n),
    "mavroeidis-papageorgiou": lambda w, n: mavroeidis_papageorgiou(
        1.0, 2.0 * math.pi / w, cycles=2.0, samples=n
    ),
}
SAMPLES = 1000  # of a pulse, or a period of it: borders are 1e-5 off
PRECISION = 1e-6  # relative, of borders


class Fate(IntEnum):
    """What a pulse does to a block."""

    RESTS = 0
    ROCKS = 1
    OVERTURNS_AFTER_IMPACTS = 2
    OVERTURNS_WITHOUT_IMPACT = 3


def overturning_spectrum(
    body: Body,
    *,
    pulse: str = "sine",
    frequencies: ArrayLike,
    amplitudes: ArrayLike,
    model: Model | str | None = None,
    samples: int = SAMPLES,
    progress: Progress = False,
    threads: int | None = None,
) -> xr.Dataset:
    """Simulate a body on a level support under pulses of many frequencies and amplitudes.

    Zhang J., Makris N. (2001) Rocking response of free-standing blocks under cycloidal pulses, J.
    Eng. Mech. 127(5):473-483. The pulse begins toward +x.

    Args:
        body: p and α are those of its more slender side.
        pulse: "sine", "cosine", "half sine", "rectangular", "ricker" or
            "mavroeidis-papageorgiou" (two cycles); the last four of the frequency that a whole
            wave, or two half ones, would have.
        frequencies: ω_p/p.
        amplitudes: peak acceleration over g tan α.
        model, progress, threads: as for `simulate_many`.
        samples: of a pulse or a period of it.

    Returns:
        Dataset over (frequency, amplitude): `fate` (int8, see Fate), `impacts` and
        `peak_rotation` [rad]; `closed_form` over frequency, the border of overturning without
        impact of a slender block, where it is known. Its attributes hold p [rad/s] and α [rad].

    Raises:
        InputError: an unknown pulse, or values that are not above 0.
    """
    import xarray as xr

    w, a = _axes(frequencies, amplitudes)
    shapes = _pulses(body, pulse, w, samples)
    p, slenderness = size_of(body)
    unit = STANDARD_GRAVITY * math.tan(slenderness)
    runs = simulate_many(
        [body], shapes, scales=a * unit, polarities=[1], model=model, progress=progress,
        threads=threads,
    ).isel(body=0, polarity=0, tilt=0)  # fmt: skip
    both = {
        name: runs[name].transpose("motion", "scale").values
        for name in ("outcome", "impacts", "peak_rotation")
    }
    closed = without_impact(pulse, w)
    told = {"long_name": "border of overturning without impact, slender block", "units": "1"}
    plane = ("frequency", "amplitude")
    border = np.full(w.size, np.nan)
    if closed is not None:
        border = closed * slenderness / math.tan(slenderness)
    return xr.Dataset(
        {
            "fate": (plane, _fate(**both), {"flags": {one.name.lower(): int(one) for one in Fate}}),
            "impacts": (plane, both["impacts"]),
            "peak_rotation": (plane, both["peak_rotation"], {"units": "rad"}),
            "closed_form": ("frequency", border, told),
        },
        coords={
            "frequency": ("frequency", w, {"long_name": "ω_p/p", "units": "1"}),
            "amplitude": ("amplitude", a, {"long_name": "a_p/(g tan α)", "units": "1"}),
        },
        attrs={"pulse": pulse, "p": p, "slenderness": slenderness, "model": repr(model_of(model))},
    )


def borders(
    body: Body,
    spectrum: xr.Dataset,
    *,
    model: Model | str | None = None,
    samples: int = SAMPLES,
    precision: float = PRECISION,
    threads: int | None = None,
) -> pd.DataFrame:
    """Where the fate of a body changes along the amplitudes of a spectrum, by bisection.

    Args:
        body, model, samples, threads: as for `overturning_spectrum`.
        spectrum: what it gave. A change between two of its amplitudes is taken for a single one.
        precision: relative.

    Returns:
        A row for each border: frequency, amplitude, and the fates `below` and `above` it.
    """
    import pandas as pd

    w, a = spectrum["frequency"].values, spectrum["amplitude"].values
    fate = spectrum["fate"].values
    at, step = np.nonzero(np.diff(fate, axis=1) != 0)
    below, above = fate[at, step], fate[at, step + 1]
    low, high = a[step], a[step + 1]
    shapes = _pulses(body, spectrum.attrs["pulse"], w, samples)
    unit = STANDARD_GRAVITY * math.tan(spectrum.attrs["slenderness"])
    while at.size and (high / low - 1.0 > precision).any():
        middle = 0.5 * (low + high)
        runs = simulate_each(
            body, [shapes[k] for k in at], scales=middle * unit, model=model, progress=False,
            threads=threads,
        )  # fmt: skip
        found = _fate(*(runs[name].values for name in ("outcome", "impacts", "peak_rotation")))
        stays = found == below
        low, high = np.where(stays, middle, low), np.where(stays, high, middle)
    return pd.DataFrame(
        {
            "frequency": w[at],
            "amplitude": 0.5 * (low + high),
            "below": [Fate(int(one)).name.lower() for one in below],
            "above": [Fate(int(one)).name.lower() for one in above],
        }
    )


def rocking_spectrum(
    motion: Motion,
    slenderness: ArrayLike,
    periods: ArrayLike,
    *,
    model: Model | str | None = None,
    progress: Progress = False,
    threads: int | None = None,
) -> xr.Dataset:
    """Return the largest rotation of blocks of all sizes under one motion.

    Makris N., Konstantinidis D. (2003) The rocking spectrum and the limitations of practical design
    methodologies, Earthquake Engng Struct. Dyn. 32(2):265-289. Blocks are rectangles with the
    frequency parameter p = √(3g/4r).

    Args:
        motion: in both directions, of which the worse counts.
        slenderness: α [rad], between 0 and π/2.
        periods: 2π/p [s], above 0.
        model, progress, threads: as for `simulate_many`.

    Returns:
        Dataset over (slenderness, period): `peak_rotation` [rad], π/2 where the block overturns,
        `share`, the same over α, and `overturns`.

    Raises:
        InputError: values out of range.
    """
    import xarray as xr

    alpha, period = numbers("slenderness", slenderness), numbers("periods", periods)
    if not ((alpha > 0.0) & (alpha < math.pi / 2)).all():
        raise InputError("slenderness= must lie between 0 and π/2 rad")
    if not (period > 0.0).all():
        raise InputError("periods= must be above 0 s")
    bodies = [block_of(2.0 * math.pi / t, one) for one in alpha.tolist() for t in period.tolist()]
    runs = simulate_many(bodies, [motion], model=model, progress=progress, threads=threads)
    worst = runs.isel(motion=0, tilt=0, scale=0)
    shape = (alpha.size, period.size)
    peak = worst["peak_rotation"].max("polarity").values.reshape(shape)
    fallen = (worst["outcome"] != 0).any("polarity").values.reshape(shape)
    plane = ("slenderness", "period")
    return xr.Dataset(
        {
            "peak_rotation": (plane, peak, {"units": "rad"}),
            "share": (plane, peak / alpha[:, None], {"long_name": "largest rotation over α"}),
            "overturns": (plane, fallen),
        },
        coords={
            "slenderness": ("slenderness", alpha, {"units": "rad", "long_name": "α"}),
            "period": ("period", period, {"units": "s", "long_name": "2π/p"}),
        },
        attrs={"motion": motion.name, "model": repr(model_of(model))},
    )


def block_of(p: float, slenderness: float) -> Body:
    """The homogeneous rectangle of a frequency parameter p [rad/s] and a slenderness α [rad].

    Raises:
        InputError: p is not above 0, or the block has no size that a body can have.
    """
    require_positive("p [rad/s]", p)
    half_diagonal = 3.0 * STANDARD_GRAVITY / (4.0 * p * p)
    return Body.rectangle(
        2.0 * half_diagonal * math.sin(slenderness), 2.0 * half_diagonal * math.cos(slenderness)
    )


def _axes(frequencies: ArrayLike, amplitudes: ArrayLike) -> Sequence[NDArray[np.float64]]:
    axes = numbers("frequencies", frequencies), np.sort(numbers("amplitudes", amplitudes))
    for name, axis in zip(("frequencies", "amplitudes"), axes, strict=True):
        if not (axis > 0.0).all():
            raise InputError(f"{name}= must be above 0, got {axis.min():g}")
    return axes


def _pulses(body: Body, pulse: str, frequencies: NDArray[np.float64], samples: int) -> list[Motion]:
    """Pulses of a peak acceleration of 1 m/s²."""
    if pulse not in PULSES:
        raise InputError(f"unknown pulse {pulse!r}; accepted: {', '.join(PULSES)}")
    p, _ = size_of(body)
    found = [PULSES[pulse](p * w, samples) for w in frequencies.tolist()]
    return [motion.scaled(1.0 / motion.peak_ground_acceleration) for motion in found]


def _fate(
    outcome: NDArray[np.int8], impacts: NDArray[np.int64], peak_rotation: NDArray[np.float64]
) -> NDArray[np.int8]:
    fallen = np.where(impacts > 0, Fate.OVERTURNS_AFTER_IMPACTS, Fate.OVERTURNS_WITHOUT_IMPACT)
    stands = np.where(peak_rotation > 0.0, Fate.ROCKS, Fate.RESTS)
    return np.where(outcome != 0, fallen, stands).astype(np.int8)
