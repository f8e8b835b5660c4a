"""Every body under every motion, polarity, tilt, scale and orientation."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_number
from shaketable.lazy_motions import heads_of
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate import kinds
from shaketable.simulate.around import Around, listed_surroundings, warn_of
from shaketable.simulate.checks import (
    listed,
    motions_of,
    numbers,
    require_polarities,
    unique_names,
)
from shaketable.simulate.kinds import CPU, CUDA, TILT, Kind, kind_of, require_device
from shaketable.simulate.plane import Group, Rows, downhill_of
from shaketable.simulate.result_fields import FIELDS, Part, Results
from shaketable.simulate.space import SolidBatch, stands_of
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    import xarray as xr


class EnsembleShape(NamedTuple):
    """How many there are of each; simulations are numbered in this order, the last the fastest."""

    body: int
    motion: int
    polarity: int
    tilt: int
    scale: int
    orientation: int


class Falls(NamedTuple):
    """Outcomes and peak rotations [rad] of members, with their indices along axes, (member,)."""

    motion: NDArray[np.intp]
    scale: NDArray[np.intp]
    body: NDArray[np.intp]
    tilt: NDArray[np.intp]
    outcome: NDArray[np.int8]
    peak: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Ensemble:
    """The simulations of a full product; `of` makes and checks one. A member is one simulation.

    Attributes:
        bodies, motions: at least one of each; all bodies planar, or all of them solids.
        tilts, scales, polarities, orientations: as for `simulate_many`, one axis each.
        azimuth: of downhill on all tilts [rad].
        model: the contact model.
        surroundings: what surrounds every body, or each; one entry, or one of each body.
    """

    bodies: Sequence[Any]
    motions: Sequence[Motion]
    tilts: NDArray[np.float64]
    scales: NDArray[np.float64]
    polarities: NDArray[np.float64]
    azimuth: float
    orientations: NDArray[np.float64]
    model: Model
    surroundings: Sequence[Surroundings | None] = (None,)

    @classmethod
    def of(
        cls,
        bodies: Sequence[Body] | Sequence[Solid],
        motions: Iterable[Motion],
        *,
        tilts: ArrayLike,
        scales: ArrayLike,
        polarities: ArrayLike,
        azimuth: float = kinds.DOWNHILL,
        orientations: ArrayLike = (0.0,),
        model: Model | str | None,
        surroundings: Around = None,
    ) -> Ensemble:
        """What a user asks for, as for `simulate_many`; whether bodies stand is not looked at.

        Raises:
            InputError: what `simulate_many` says, but for a body that falls by itself.
        """
        kind = kind_of(bodies)
        kind.require_axes(azimuth, orientations)
        around = listed_surroundings(surroundings)
        things, motions = listed("bodies", bodies, kind.body), motions_of(motions)
        if len(around) not in (1, len(things)):
            raise InputError(
                f"surroundings= must be one, or one of each of {len(things)} bodies; got "
                f"{len(around)}"
            )
        beta, factors = numbers("tilts", tilts), numbers("scales", scales)
        signs, turns = numbers("polarities", polarities), numbers("orientations", orientations)
        require_polarities(signs)
        model = kind.model_of(model)
        require_number("azimuth", azimuth)
        for tilt in {float(beta.min()), float(beta.max())}:
            Support(tilt=tilt, azimuth=azimuth)  # raises InputError for a tilt out of range
        kind.require_surroundings(things, around, model, beta)
        kind.warn(model, beta.tolist(), motions)
        warn_of(around, model)
        return cls(
            bodies=things,
            motions=motions,
            tilts=beta,
            scales=factors,
            polarities=signs,
            azimuth=float(azimuth),
            orientations=turns,
            model=model,
            surroundings=around,
        )

    @property
    def kind(self) -> Kind:
        return kind_of(self.bodies[0])

    @property
    def shape(self) -> EnsembleShape:
        return EnsembleShape(
            body=len(self.bodies),
            motion=len(self.motions),
            polarity=self.polarities.size,
            tilt=self.tilts.size,
            scale=self.scales.size,
            orientation=self.orientations.size,
        )

    @property
    def dimensions(self) -> dict[str, int]:
        """Those of its Dataset."""
        return {name: getattr(self.shape, name) for name in self.kind.axes}

    @property
    def repeats(self) -> int:
        """Simulations of one body under one motion with one scale on one tilt."""
        return self.polarities.size * self.orientations.size

    def some(self, bodies: Sequence[int], motions: Sequence[int]) -> Ensemble:
        """The simulations of some of the bodies under some of the motions."""
        return replace(
            self,
            bodies=[self.bodies[k] for k in bodies],
            motions=[self.motions[k] for k in motions],
            surroundings=[self.around(k) for k in bodies] if any(self.surroundings) else (None,),
        )

    @property
    def held_field(self) -> str:
        """The field that tells what its surroundings alone hold up; "" where it is not told."""
        field = FIELDS["held_up"]
        told = self.kind.has(self.model) in field.of and field.is_told(self.surroundings)
        return "held_up" if told else ""

    def around(self, body: int) -> Surroundings | None:
        """What surrounds a body."""
        return self.surroundings[body if len(self.surroundings) > 1 else 0]

    def require_standing(self) -> None:
        """InputError naming each body that falls by itself on one of the tilts."""
        self.kind.require_standing(self)

    def run(
        self,
        store: Callable[[Part], None],
        threads: int | None,
        progress: Progress,
        device: str = CPU,
    ) -> Counter[int]:
        """Simulate every member; `store` takes the results of some at a time, in any order.

        Returns how many runs ended in which way, for `warn_of`.
        """
        require_device(device, self.kind)
        count = int(np.prod(self.shape))
        tasks = self.kind.tasks(self, self.model, device)
        return kinds.run(tasks, count, store, 1 if device == CUDA else threads, progress)

    def warn_of(self, endings: Mapping[int, int]) -> None:
        """Log the runs that did not end regularly."""
        kinds.warn_of(self.kind, endings)

    def results(self) -> Results:
        """Room for the results of every simulation."""
        count = int(np.prod(self.shape))
        return Results(self.kind.has(self.model), count, self.surroundings)

    def dataset(self, results: Results) -> xr.Dataset:
        """The results of every simulation, without coordinates."""
        names, sizes = tuple(self.dimensions), tuple(self.dimensions.values())
        return results.dataset(names, sizes, {}, self.model)

    def coordinates(self) -> dict[str, Any]:
        """The coordinates of the Dataset, as xarray takes them."""
        placed = {"azimuth": ((), self.azimuth), "orientation": ("orientation", self.orientations)}
        return {
            "body": unique_names(self.bodies),
            "motion": unique_names(heads_of(self.motions)),
            "polarity": self.polarities.astype(np.int64),
            "tilt": ("tilt", self.tilts, TILT),
            "scale": self.scales,
            **self.kind.coordinates(self.bodies, "body", self.model, placed),
        }

    def falls_of(self, part: Part) -> Falls:
        """The indices of members along each axis, and their outcomes."""
        body, motion, _, tilt, scale, _ = np.unravel_index(part.members, self.shape)
        outcome = part.results["outcome"].astype(np.int8)
        return Falls(motion, scale, body, tilt, outcome, part.results["peak_rotation"])

    def extreme_tilts(self) -> Iterator[tuple[Sequence[Body], float]]:
        """Bodies with their least and greatest tilts [rad]: who stands at both stands at all."""
        for tilt in {float(self.tilts.min()), float(self.tilts.max())}:
            yield self.bodies, tilt

    def stands_of_solids(self) -> kinds.Stands:
        """Each solid, with the setups of its runs, (run, 5), and what holds it."""
        count = len(self.bodies)
        around = [self.around(k) for k in range(count)]
        return self.bodies, [self._stands()] * count, around

    def rows(self, model: Model) -> Rows:
        """Planar bodies on their supports."""
        shape = self.shape
        of_body, of_polarity, of_tilt = (
            index.ravel() for index in np.indices((shape.body, shape.polarity, shape.tilt))
        )
        pair_body, pair_tilt = (index.ravel() for index in np.indices((shape.body, shape.tilt)))
        of_pairs = [self.bodies[k] for k in pair_body.tolist()]
        around = [self.around(k) for k in pair_body.tolist()]
        table = model.tabulate(of_pairs, self.tilts[pair_tilt], around)
        first = np.zeros_like(of_body)
        return Rows(
            table.take(of_body * shape.tilt + of_tilt),
            self.polarities[of_polarity],
            downhill_of(self.tilts)[of_tilt],
            np.ravel_multi_index((of_body, first, of_polarity, of_tilt, first, first), shape),
        )

    def groups(self) -> Iterator[Group]:
        """All rows under each motion with each scale."""
        shape = self.shape
        every = np.arange(shape.body * shape.polarity * shape.tilt)
        for k, motion in enumerate(self.motions):
            for j, scale in enumerate(self.scales.tolist()):
                yield Group(motion, scale, every, k * shape.polarity * shape.tilt * shape.scale + j)

    def batches(self) -> Iterator[SolidBatch]:
        """The runs of each solid under each motion."""
        stands = self._stands()
        pairs = itertools.product(enumerate(self.bodies), enumerate(self.motions))
        for number, ((body, solid), (k, motion)) in enumerate(pairs):
            members = number * len(stands) + np.arange(len(stands))
            yield SolidBatch(body, solid, k, motion, members, stands, self.around(body))

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
