"""How bodies are shaken, as one object that can be passed on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_positive
from shaketable.models import Model, Rocking, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import recordings_of
from shaketable.simulate.checks import listed
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.fall_counts import OutcomeCounts, OutcomeTally
from shaketable.simulate.many import simulate_many
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    import xarray as xr


MOST_SCALE = 1e9  # a larger factor on a motion is a mistake, and may give infinite accelerations


def require_scale(scale: float) -> None:
    """InputError unless a factor on motions is positive, and at most MOST_SCALE."""
    require_positive("scale", scale)
    if scale > MOST_SCALE:
        raise InputError(f"scale must be at most {MOST_SCALE:g}, got {scale!r}")


@dataclass(frozen=True, eq=False)
class ShakingSet:
    """Motions, the factor on them, the contact model and what surrounds each body.

    Every motion counts as recorded and reversed.

    Raises:
        InputError: no motions, a scale that is not positive or above MOST_SCALE, an unknown
            model.
    """

    motions: Sequence[Motion]
    scale: float = 1.0
    model: Model = field(default_factory=Rocking)
    surroundings: Surroundings | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "motions", tuple(listed("motions", self.motions, Motion)))
        object.__setattr__(self, "model", model_of(self.model))
        require_scale(self.scale)

    @cached_property
    def recording(self) -> NDArray[np.intp]:
        """The number of each motion's recording, as `recordings_of` gives it, (motion,)."""
        return recordings_of(self.motions)

    def changed(self, *, scale: float | None = None, model: Model | None = None) -> ShakingSet:
        """The same motions with another scale or model."""
        other = ShakingSet(
            self.motions,
            self.scale if scale is None else scale,
            self.model if model is None else model,
            self.surroundings,
        )
        # counted once: it logs a warning, and depends on the motions alone
        other.__dict__["recording"] = self.recording
        return other

    def run(
        self, bodies: Sequence[Body], tilts: ArrayLike = (0.0,), progress: Progress = True
    ) -> xr.Dataset:
        """What `simulate_many` gives for bodies on tilts [rad]."""
        return simulate_many(
            bodies,
            self.motions,
            tilts=tilts,
            scales=(self.scale,),
            model=self.model,
            surroundings=self.surroundings,
            progress=progress,
        )

    def count(
        self, bodies: Sequence[Body], tilts: ArrayLike = (0.0,), progress: Progress = True
    ) -> OutcomeCounts:
        """How bodies end on tilts [rad], by recording, without keeping every simulation."""
        ensemble = Ensemble.of(
            bodies,
            self.motions,
            tilts=tilts,
            scales=(self.scale,),
            polarities=(1, -1),
            model=self.model,
            surroundings=self.surroundings,
        )
        ensemble.require_standing()
        tally = OutcomeTally(ensemble, self.recording)
        ensemble.warn_of(ensemble.run(tally.store, None, progress))
        return tally.counts
