"""The risk that a body overturns on a floor, by direct integration.

One recorded floor motion is one sample of what the floor may do. Cimellaro G.P., Domaneschi M.,
Qu B. (2020), J. Vibration and Control 26(5-6):362-374, section 3.2.2: simulate the body under 100
motions that have the response spectrum of the recorded one, and take the share that overturns it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_whole
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import wilson_interval
from shaketable.signal.intensity import Record, significant_duration
from shaketable.simulate import fell, require_stable, simulate_many
from shaketable.synthesis import spectrum_compatible
from shaketable.synthesis.matching import BAND

MOTIONS = 100
#: Of the spectra. Compared with 0.1 it takes a third of the time, and departures are 0.03 in the
#: mean over periods instead of 0.024.
TOLERANCE = 0.15
STRONG = 0.6385  # of the trapezoid envelope's duration: time for 5 to 95 % of its Arias intensity


@dataclass(frozen=True, kw_only=True, eq=False)
class OverturningRisk:
    """Shares of simulations that overturn each body on each floor.

    Attributes:
        falls: how many, of `simulations` each, (body, floor).
        simulations: motions made for each floor.
        share, low, high: falls over simulations with Wilson's 95 % interval, (body, floor).
    """

    falls: NDArray[np.int64]
    simulations: int
    share: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


def overturning_risk(
    bodies: Body | Sequence[Body],
    floors: Motion | Sequence[Motion],
    *,
    n: int = MOTIONS,
    seed: int = 0,
    tolerance: float = TOLERANCE,
    model: Model | str | None = None,
    progress: Progress = False,
) -> OverturningRisk:
    """Return the share of `n` motions with each floor's spectrum that overturn each body.

    The motions of a floor are made once for all bodies. They last so long that 5 to 95 % of their
    Arias intensity takes the same time as that of the floor motion, and are used in one direction
    only, as their phases are random.

    Args:
        bodies, floors: one or more of each.
        n: motions for each floor.
        seed: seed of their phases; the k-th floor uses seed + k.
        tolerance: relative, of their spectra between 0.05 and 3 s.
        model: as for simulate_many.
        progress: whether to draw a bar.

    Raises:
        InputError: nothing to simulate, values out of range, or a floor motion without a spectrum
            to be compatible with.
    """
    bodies = [bodies] if isinstance(bodies, Body) else list(bodies)
    floors = [floors] if isinstance(floors, Motion) else list(floors)
    require_whole("n", n)
    model = model_of(model)
    if not bodies or not floors:
        raise InputError("overturning_risk needs at least one body and one floor motion")
    require_stable(bodies, 0.0)
    falls = np.zeros((len(bodies), len(floors)), np.int64)
    with meter("risk on floors", n * len(floors) * (1 + len(bodies)), progress) as done:
        for k, floor in enumerate(floors):
            runs = simulate_many(
                bodies,
                compatible_motions(floor, n, seed + k, tolerance, done),
                polarities=(1,),
                model=model,
                progress=done,
            )
            falls[:, k] = fell(runs).sum(runs.outcome.dims[1:])
    low, high = wilson_interval(falls / n, n)
    return OverturningRisk(falls=falls, simulations=n, share=falls / n, low=low, high=high)


def compatible_motions(
    floor: Motion, n: int, seed: int, tolerance: float, done: Callable[[int], None]
) -> list[Motion]:
    """Motions with a floor motion's spectrum and significant duration.

    Raises:
        InputError: a floor that does not move.
    """
    if floor.peak_ground_acceleration == 0.0:
        raise InputError(f"floor motion {floor.name!r} does not move: it has no spectrum")
    duration = significant_duration(Record(floor.horizontal, floor.time_step), 0.05, 0.95) / STRONG
    shortest, longest = 2.0 * BAND[1], max(2.0 * BAND[1], floor.duration)
    return spectrum_compatible(
        floor,
        n,
        duration=float(np.clip(duration, shortest, longest)),
        seed=seed,
        tolerance=tolerance,
        progress=done,
    )
