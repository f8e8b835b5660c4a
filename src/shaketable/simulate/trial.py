"""How bodies are shaken, as one object that can be passed on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from shaketable.body import Body
from shaketable.errors import require_positive
from shaketable.models import Model, Rocking, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import listed
from shaketable.simulate.many import simulate_many

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, eq=False)
class Trial:
    """Motions, the factor on them and the contact model; every motion counts in both directions.

    Raises:
        InputError: no motions, a scale that is not positive, or an unknown model.
    """

    motions: Sequence[Motion]
    scale: float = 1.0
    model: Model = field(default_factory=Rocking)

    def __post_init__(self) -> None:
        object.__setattr__(self, "motions", tuple(listed("motions", self.motions, Motion)))
        object.__setattr__(self, "model", model_of(self.model))
        require_positive("scale", self.scale)

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
            progress=progress,
        )
