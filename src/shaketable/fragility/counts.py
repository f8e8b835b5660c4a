"""How often simulations reached limit states, at each level of each motion."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.limit_states import LimitState
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.signal import Measure
from shaketable.simulate import fell, fell_downhill, simulate_many

if TYPE_CHECKING:
    import xarray as xr

log = logging.getLogger(__name__)

STRANGE = 10.0  # a motion scaled by more is hardly an earthquake


class Counts(NamedTuple):
    """How often states were reached.

    Attributes:
        reached: (body, state, motion, level).
        trials: simulations of each body at each motion and level.
        downhill, uphill: falls, (body, level).
    """

    reached: NDArray[np.int64]
    trials: int
    downhill: NDArray[np.int64]
    uphill: NDArray[np.int64]

    def at(self, levels: NDArray[np.intp]) -> Counts:
        """Those at some of the levels."""
        return Counts(
            self.reached[..., levels], self.trials, self.downhill[:, levels], self.uphill[:, levels]
        )


def counted(runs: xr.Dataset, bodies: Sequence[Body], states: Sequence[LimitState]) -> Counts:
    """Counts of what `simulate_many` gave, on one tilt."""
    each = [
        state.reached(runs, bodies)
        .isel(tilt=0)
        .sum("polarity")
        .transpose("body", "motion", "scale")
        .values
        for state in states
    ]
    down, every = (
        one(runs).isel(tilt=0).sum(["polarity", "motion"]).transpose("body", "scale").values
        for one in (fell_downhill, fell)
    )
    return Counts(np.stack(each, axis=1), runs.sizes["polarity"], down, every - down)


def count_stripes(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    states: Sequence[LimitState],
    measure: Measure,
    once: NDArray[np.float64],
    levels: NDArray[np.float64],
    tilt: float,
    progress: Progress,
    given: dict[str, Any],
) -> Counts:
    """Counts where every motion is scaled to each level of the measure.

    Args:
        once: the measure of each motion as it is, (motion,).
    """
    if measure.power is None or measure.power < 1:
        raise InputError(f"measure {measure.name!r}: does not grow with the motion; no stripes")
    if not (levels[0] > 0.0 and once.all()):
        raise InputError(f"levels= and the {measure.name} of every motion must be above 0")
    found, strongest = [], 0.0
    with meter("motions", len(motions), progress) as done:
        for motion, at_one in zip(motions, once.tolist(), strict=True):
            scales = (levels / at_one) ** (1.0 / measure.power)
            strongest = max(strongest, float(scales[-1]))
            runs = simulate_many(
                bodies, [motion], tilts=[tilt], scales=scales, progress=False, **given
            )
            found.append(counted(runs, bodies, states))
            done(1)
    warn_of_scales(np.array([strongest]))
    return Counts(
        np.concatenate([one.reached for one in found], axis=2),
        found[0].trials,
        np.sum([one.downhill for one in found], axis=0),
        np.sum([one.uphill for one in found], axis=0),
    )


def warn_of_scales(scales: NDArray[np.float64]) -> None:
    strange = scales[scales > STRANGE]
    if strange.size:
        log.warning(
            "motions are scaled by up to %.3g: beyond %g what shakes is hardly an earthquake",
            strange.max(),
            STRANGE,
        )
