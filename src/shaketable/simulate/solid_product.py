"""Every solid under every motion, polarity, tilt, scale and orientation."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import require_number
from shaketable.lazy_motions import heads_of
from shaketable.models import General, Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import listed, motions_of, numbers, require_polarities
from shaketable.simulate.devices import CPU, require_device
from shaketable.simulate.members import names
from shaketable.simulate.product import Falls
from shaketable.simulate.solid_batches import Batch, SolidPart, stands_of
from shaketable.simulate.solid_input import model_for_solids
from shaketable.simulate.solid_members import SolidMembers
from shaketable.simulate.solid_runs import (
    require_stands,
    run_batches,
    warn_of_components,
    warn_of_solids,
)
from shaketable.solid import Solid
from shaketable.support import Support

if TYPE_CHECKING:
    import xarray as xr

TILT = {"units": "rad", "long_name": "tilt of the support"}
ORIENTATION = {"units": "rad", "long_name": "orientation of the solid on its support"}
AZIMUTH = {"units": "rad", "long_name": "azimuth of downhill, from x toward y"}


class SolidShape(NamedTuple):
    """How many there are of each; members are numbered in this order, orientations the fastest."""

    body: int
    motion: int
    polarity: int
    tilt: int
    scale: int
    orientation: int


@dataclass(frozen=True, kw_only=True, eq=False)
class SolidProduct:
    """The simulations of a full product; `of` makes and checks one. A member is one simulation.

    Attributes:
        bodies, motions: at least one of each.
        tilts, scales, polarities, orientations: as for `simulate_many`, one axis each.
        azimuth: of downhill on all tilts [rad].
        model: the contact model.
    """

    dimensions: ClassVar[tuple[str, ...]] = SolidShape._fields

    bodies: Sequence[Solid]
    motions: Sequence[Motion]
    tilts: NDArray[np.float64]
    azimuth: float
    scales: NDArray[np.float64]
    polarities: NDArray[np.float64]
    orientations: NDArray[np.float64]
    model: General

    @classmethod
    def of(
        cls,
        bodies: Sequence[Solid],
        motions: Iterable[Motion],
        *,
        tilts: ArrayLike,
        azimuth: float,
        scales: ArrayLike,
        polarities: ArrayLike,
        orientations: ArrayLike,
        model: Model | str | None,
    ) -> SolidProduct:
        """What a user asks for, as for `simulate_many`; whether solids stand is not looked at.

        Raises:
            InputError: what `simulate_many` says, but for a solid that falls by itself.
        """
        bodies, motions = listed("bodies", bodies, Solid), motions_of(motions)
        general = model_for_solids(model)
        signs = numbers("polarities", polarities)
        require_polarities(signs)
        require_number("azimuth", azimuth)
        beta = numbers("tilts", tilts)
        for tilt in {float(beta.min()), float(beta.max())}:
            Support(tilt=tilt, azimuth=azimuth)  # raises InputError for a tilt out of range
        warn_of_components(motions)
        return cls(
            bodies=bodies,
            motions=motions,
            tilts=beta,
            azimuth=float(azimuth),
            scales=numbers("scales", scales),
            polarities=signs,
            orientations=numbers("orientations", orientations),
            model=general,
        )

    @property
    def shape(self) -> SolidShape:
        return SolidShape(
            body=len(self.bodies),
            motion=len(self.motions),
            polarity=self.polarities.size,
            tilt=self.tilts.size,
            scale=self.scales.size,
            orientation=self.orientations.size,
        )

    @property
    def repeats(self) -> int:
        """Simulations of one body under one motion with one scale on one tilt."""
        return self.polarities.size * self.orientations.size

    def some(self, bodies: Sequence[int], motions: Sequence[int]) -> SolidProduct:
        """The simulations of some of the bodies under some of the motions."""
        return replace(
            self,
            bodies=[self.bodies[k] for k in bodies],
            motions=[self.motions[k] for k in motions],
        )

    def require_device(self, device: str) -> None:
        """InputError unless these can be simulated there."""
        require_device(device)

    def require_standing(self) -> None:
        """InputError naming each solid that falls by itself on one of the tilts."""
        require_stands(self.bodies, itertools.repeat(self._stands(), len(self.bodies)))

    def run(
        self,
        keep: Callable[[SolidPart], None],
        threads: int | None,
        progress: Progress,
        device: str = CPU,
    ) -> Counter[float]:
        """Simulate every member; `keep` takes the results of some at a time, in any order.

        Returns how many runs ended in which way, for `warn_of`.
        """
        return run_batches(self._batches(), self.model, keep, threads, progress, device)

    def warn_of(self, endings: Counter[float]) -> None:
        """Log the runs that did not end regularly."""
        warn_of_solids(endings)

    def members(self) -> SolidMembers:
        """Room for the results of every simulation."""
        return SolidMembers(int(np.prod(self.shape)))

    def dataset(self, members: SolidMembers) -> xr.Dataset:
        """The results of every simulation, without coordinates."""
        return members.dataset(self.dimensions, self.shape, {}, self.model)

    def coordinates(self) -> dict[str, Any]:
        """The coordinates of the Dataset, as xarray takes them."""
        return {
            "body": names(self.bodies),
            "motion": names(heads_of(self.motions)),
            "polarity": self.polarities.astype(np.int64),
            "tilt": ("tilt", self.tilts, TILT),
            "scale": self.scales,
            "orientation": ("orientation", self.orientations, ORIENTATION),
            "azimuth": ((), self.azimuth, AZIMUTH),
        }

    def falls_of(self, part: SolidPart) -> Falls:
        """Where some members stand in the product, and how they ended."""
        body, motion, _, tilt, scale, _ = np.unravel_index(part.members, self.shape)
        return Falls(motion, scale, body, tilt, part.outcome, part.column("peak"))

    def _stands(self) -> NDArray[np.float64]:
        """Those of one solid under one motion."""
        rows = itertools.product(
            self.polarities.tolist(),
            [Support(tilt=tilt, azimuth=self.azimuth) for tilt in self.tilts.tolist()],
            self.scales.tolist(),
            self.orientations.tolist(),
        )
        polarities, supports, scales, orientations = zip(*rows, strict=True)
        return stands_of(supports, orientations, scales, polarities)

    def _batches(self) -> Iterator[Batch]:
        stands = self._stands()
        pairs = itertools.product(self.bodies, self.motions)
        for number, (solid, motion) in enumerate(pairs):
            yield Batch(solid, motion, number * len(stands) + np.arange(len(stands)), stands)
