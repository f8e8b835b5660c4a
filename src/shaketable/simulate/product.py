"""Every body under every motion, polarity, tilt and scale."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.lazy_motions import heads_of
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import (
    listed,
    motions_of,
    numbers,
    require_polarities,
    require_stable,
    warn,
)
from shaketable.simulate.devices import CPU, require_device, run_groups_on
from shaketable.simulate.ensemble import Group, Part, Rows, downhill_of, warn_of
from shaketable.simulate.members import Members, dataset, factors_of, names
from shaketable.support import Support

if TYPE_CHECKING:
    import xarray as xr


DOWNHILL = math.pi  # the azimuth of −x


class Shape(NamedTuple):
    """How many there are of each; members are numbered in this order, tilts the fastest."""

    motion: int
    scale: int
    body: int
    polarity: int
    tilt: int


class Falls(NamedTuple):
    """How some members ended, and which motion, scale, body and tilt they are of, (member,)."""

    motion: NDArray[np.intp]
    scale: NDArray[np.intp]
    body: NDArray[np.intp]
    tilt: NDArray[np.intp]
    outcome: NDArray[np.int8]
    peak: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Product:
    """The simulations of a full product; `of` makes and checks one. A member is one simulation.

    Attributes:
        bodies, motions: at least one of each.
        tilts, scales, polarities: as for `simulate_many`, one axis each.
        model: the contact model.
    """

    dimensions: ClassVar[tuple[str, ...]] = ("body", "motion", "polarity", "tilt", "scale")

    bodies: Sequence[Body]
    motions: Sequence[Motion]
    tilts: NDArray[np.float64]
    scales: NDArray[np.float64]
    polarities: NDArray[np.float64]
    model: Model

    @classmethod
    def of(
        cls,
        bodies: Sequence[Body],
        motions: Iterable[Motion],
        tilts: ArrayLike,
        scales: ArrayLike,
        polarities: ArrayLike,
        model: Model | str | None,
    ) -> Product:
        """What a user asks for, as for `simulate_many`; whether bodies stand is not looked at.

        Raises:
            InputError: what `simulate_many` says, but for a body that falls by itself.
        """
        bodies, motions = listed("bodies", bodies, Body), motions_of(motions)
        beta, factors = numbers("tilts", tilts), numbers("scales", scales)
        signs = numbers("polarities", polarities)
        require_polarities(signs)
        model = model_of(model)
        for tilt in {float(beta.min()), float(beta.max())}:
            Support(tilt=tilt)  # raises InputError for a tilt out of range
        warn(model, beta.tolist(), motions)
        return cls(
            bodies=bodies,
            motions=motions,
            tilts=beta,
            scales=factors,
            polarities=signs,
            model=model,
        )

    def require_device(self, device: str) -> None:
        """InputError unless these can be simulated there."""
        require_device(device)

    def require_standing(self) -> None:
        """InputError naming each body that falls by itself on one of the tilts."""
        for tilt in {float(self.tilts.min()), float(self.tilts.max())}:
            require_stable(self.bodies, tilt)

    @property
    def shape(self) -> Shape:
        return Shape(
            motion=len(self.motions),
            scale=self.scales.size,
            body=len(self.bodies),
            polarity=self.polarities.size,
            tilt=self.tilts.size,
        )

    @property
    def repeats(self) -> int:
        """Simulations of one body under one motion with one scale on one tilt."""
        return self.polarities.size

    def some(self, bodies: Sequence[int], motions: Sequence[int]) -> Product:
        """The simulations of some of the bodies under some of the motions."""
        return replace(
            self,
            bodies=[self.bodies[k] for k in bodies],
            motions=[self.motions[k] for k in motions],
        )

    def run(
        self,
        keep: Callable[[Part], None],
        threads: int | None,
        progress: Progress,
        device: str = CPU,
    ) -> Counter[float]:
        """Simulate every member; `keep` takes the results of some at a time, in any order.

        Returns how many runs ended in which way, for `warn_of`.
        """
        of_body, of_polarity, of_tilt = (index.ravel() for index in np.indices(self.shape[2:]))
        pair_body, pair_tilt = (
            index.ravel() for index in np.indices((len(self.bodies), self.tilts.size))
        )
        of_pairs = [self.bodies[k] for k in pair_body.tolist()]
        table = self.model.tabulate(of_pairs, self.tilts[pair_tilt])
        rows = Rows(
            table.take(of_body * self.tilts.size + of_tilt),
            self.polarities[of_polarity],
            downhill_of(self.tilts)[of_tilt],
        )
        every = np.arange(of_body.size)
        shakings = itertools.product(self.motions, self.scales.tolist())
        groups = (
            Group(motion, scale, every, k * every.size)
            for k, (motion, scale) in enumerate(shakings)
        )
        return run_groups_on(device, self.model, rows, groups, keep, threads, progress)

    def warn_of(self, endings: Counter[float]) -> None:
        """Log the runs that did not end regularly."""
        warn_of(endings)

    def members(self) -> Members:
        """Room for the results of every simulation."""
        return Members.empty(int(np.prod(self.shape)))

    def dataset(self, members: Members) -> xr.Dataset:
        """The results of every simulation, without coordinates."""
        axes = tuple(Shape._fields.index(name) for name in self.dimensions)
        return dataset(members.reshaped(self.shape, axes), self.dimensions, {}, self.model)

    def coordinates(self) -> dict[str, Any]:
        """The coordinates of the Dataset, as xarray takes them."""
        return {
            "body": names(self.bodies),
            "motion": names(heads_of(self.motions)),
            "polarity": self.polarities.astype(np.int64),
            "tilt": ("tilt", self.tilts, {"units": "rad", "long_name": "tilt of the support"}),
            "scale": self.scales,
            **factors_of("body", self.bodies, self.model),
        }

    def falls_of(self, part: Part) -> Falls:
        """Where some members stand in the product, and how they ended."""
        motion, scale, body, _, tilt = np.unravel_index(part.members, self.shape)
        outcome = (part.runs.direction * part.downhill).astype(np.int8)
        return Falls(motion, scale, body, tilt, outcome, part.runs.peak)
