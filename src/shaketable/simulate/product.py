"""Every body under every motion, polarity, tilt and scale."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import listed, numbers, require_polarities, require_stable, warn
from shaketable.simulate.devices import CPU, run_groups_on
from shaketable.simulate.ensemble import Group, Part, Rows, downhill_of
from shaketable.support import Support


class Shape(NamedTuple):
    """How many there are of each; members are numbered in this order, tilts the fastest."""

    motion: int
    scale: int
    body: int
    polarity: int
    tilt: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Product:
    """The simulations of a full product; `of` makes and checks one. A member is one simulation.

    Attributes:
        bodies, motions: at least one of each.
        tilts, scales, polarities: as for `simulate_many`, one axis each.
        model: the contact model.
    """

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
        motions: Sequence[Motion],
        tilts: ArrayLike,
        scales: ArrayLike,
        polarities: ArrayLike,
        model: Model | str | None,
    ) -> Product:
        """What a user asks for, as for `simulate_many`; whether bodies stand is not looked at.

        Raises:
            InputError: what `simulate_many` says, but for a body that falls by itself.
        """
        bodies, motions = listed("bodies", bodies, Body), listed("motions", motions, Motion)
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
