"""How bodies are shaken, as one thing that is handed on."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from shaketable.body import Body
from shaketable.errors import require_positive
from shaketable.models import Model, model_of
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
    scale: float
    model: Model

    @classmethod
    def of(
        cls, motions: Sequence[Motion], scale: float = 1.0, model: Model | str | None = None
    ) -> Trial:
        """With the model that a short word means."""
        return cls(motions, scale, model_of(model))

    def __post_init__(self) -> None:
        object.__setattr__(self, "motions", tuple(listed("motions", self.motions, Motion)))
        require_positive("scale", self.scale)

    def run(
        self, bodies: Sequence[Body], tilts: Iterable[float] = (0.0,), progress: Progress = True
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
