"""What is simulated and how: planar bodies with either model, and solids with the general one.

`kind_of` returns the Kind of some bodies, which holds what only planar bodies, or only solids,
need. What all ensembles have in common is in `ensemble` and `each`.
"""

from __future__ import annotations

import logging
import math
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.engine.endings import SENTENCES, counts_of
from shaketable.errors import ADDS_UP, InputError, require_whole
from shaketable.language import translated
from shaketable.lazy_motions import heads_of
from shaketable.models import General, Model, Rocking, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.simulate import plane, result_fields, space
from shaketable.simulate.checks import numbers, require_stable, warn
from shaketable.simulate.result_fields import Part
from shaketable.simulate.standing import model_for_solids
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings

log = logging.getLogger(__name__)

CPU, CUDA = "cpu", "cuda"
DEVICES = (CPU, CUDA)
DOWNHILL = math.pi  # the azimuth of −x

Task = Callable[[], Part]


#: Each solid, with the setups of its runs as `space.stands_of` gives them, (run, 5), and what
#: holds it.
Stands = tuple[Sequence[Solid], Sequence[NDArray[np.float64]], Sequence[Surroundings | None]]


class Members(Protocol):
    """What is simulated: an `Ensemble`, or members side by side (`each`)."""

    @property
    def surroundings(self) -> Sequence[Surroundings | None]:
        """What surrounds every body, or each."""

    def extreme_tilts(self) -> Iterator[tuple[Sequence[Body], ArrayLike]]:
        """Planar bodies, with their least and greatest tilts [rad].

        A body that stands at both stands at all between.
        """

    def stands_of_solids(self) -> Stands:
        """Each solid, with the setups of its runs, and what holds it."""

    def rows(self, model: Model) -> plane.Rows:
        """Planar bodies on their supports."""

    def groups(self) -> Iterator[plane.Group]:
        """Which rows meet which motions."""

    def batches(self) -> Iterator[space.SolidBatch]:
        """The runs of each solid under each motion."""


class Kind(ABC):
    """What only one kind of body has.

    Attributes:
        body: its class.
        axes: of its Datasets of every body under every motion.
    """

    body: ClassVar[type[Body | Solid]]
    axes: ClassVar[tuple[str, ...]]

    @property
    @abstractmethod
    def sentences(self) -> Mapping[int, str]:
        """What to tell of the irregular endings, after "3 of 100 simulations"."""

    @abstractmethod
    def model_of(self, model: Model | str | None) -> Model:
        """The model that is asked for, or the default; InputError if it is for the other kind."""

    @abstractmethod
    def has(self, model: Model) -> str:
        """ROCKING, GENERAL or SOLID: which `result_fields.FIELDS` a model's runs have."""

    @abstractmethod
    def require_axes(self, azimuth: ArrayLike, orientations: ArrayLike) -> None:
        """InputError unless its bodies can be placed so [rad]."""

    @abstractmethod
    def require_surroundings(
        self,
        bodies: Sequence[Any],
        surroundings: Sequence[Surroundings | None],
        model: Model,
        tilts: NDArray[np.float64],
    ) -> None:
        """InputError unless its bodies can stand so.

        Args:
            bodies: at least one.
            surroundings: of all bodies, or of each.
            model: the contact model.
            tilts: of their supports [rad].
        """

    @abstractmethod
    def warn(self, model: Model, tilts: Sequence[float], motions: Sequence[Motion]) -> None:
        """Log what a user should know before anything is simulated."""

    @abstractmethod
    def coordinates(
        self, bodies: Sequence[Any], along: str, model: Model, placed: Mapping[str, Any]
    ) -> dict[str, Any]:
        """The coordinates that only its Datasets have, as xarray takes them.

        Args:
            bodies: along a dimension of that name.
            model: the contact model.
            placed: azimuth and orientation, each with its dimensions.
        """

    @abstractmethod
    def require_standing(self, asked: Members) -> None:
        """InputError naming each body that falls by itself on its support."""

    @abstractmethod
    def tasks(self, asked: Members, model: Model, device: str) -> Iterable[Task]:
        """What is to be done on a device for the simulations of an ensemble."""


class Plane(Kind):
    """Bodies in the vertical plane of the motions' horizontal components."""

    body = Body
    axes = ("body", "motion", "polarity", "tilt", "scale")

    @property
    def sentences(self) -> Mapping[int, str]:
        return {int(ending): sentence for ending, sentence in SENTENCES.items()}

    def model_of(self, model: Model | str | None) -> Model:
        return model_of(model)

    def has(self, model: Model) -> str:
        return result_fields.ROCKING if isinstance(model, Rocking) else result_fields.GENERAL

    def require_axes(self, azimuth: ArrayLike, orientations: ArrayLike) -> None:
        if np.any(numbers("azimuth", azimuth) != DOWNHILL):
            raise InputError(
                "azimuth= applies to Solids only; planar bodies fall toward -x, azimuth π, got "
                f"{azimuth!r}: give a negative tilt for +x"
            )
        if np.any(numbers("orientations", orientations)):
            raise InputError("orientations= applies to Solids only; a planar body cannot be turned")

    def require_surroundings(
        self,
        bodies: Sequence[Any],
        surroundings: Sequence[Surroundings | None],
        model: Model,
        tilts: NDArray[np.float64],
    ) -> None:
        if not any(surroundings):
            return
        each = list(surroundings) * len(bodies) if len(surroundings) == 1 else surroundings
        tilt = float(np.abs(tilts).max())
        for body, around in dict.fromkeys(zip(bodies, each, strict=True)):
            if around:
                model.require_surrounded(body, around, tilt)

    def warn(self, model: Model, tilts: Sequence[float], motions: Sequence[Motion]) -> None:
        warn(model, tilts, motions)

    def coordinates(
        self, bodies: Sequence[Any], along: str, model: Model, placed: Mapping[str, Any]
    ) -> dict[str, Any]:
        own = [body.restitution_factor for body in bodies]
        if all(factor is None for factor in own):
            return {}
        factors = [model.restitution_factor if factor is None else factor for factor in own]
        return {"restitution_factor": (along, np.array(factors, np.float64))}

    def require_standing(self, asked: Members) -> None:
        for bodies, tilts in asked.extreme_tilts():
            require_stable(bodies, tilts)

    def tasks(self, asked: Members, model: Model, device: str) -> Iterable[Task]:
        rows, groups = asked.rows(model), asked.groups()
        if device == CUDA:
            require_nothing_around(asked)
            from shaketable.simulate.plane_on_gpu import launches_of

            return launches_of(model, rows, groups)
        return plane.tasks_of(model, rows, groups)


class Space(Kind):
    """Solids under all components of the motions."""

    body = Solid
    axes = ("body", "motion", "polarity", "tilt", "scale", "orientation")

    @property
    def sentences(self) -> Mapping[int, str]:
        from shaketable.physics.space.ending import SENTENCES as OF_SOLIDS

        return OF_SOLIDS

    def model_of(self, model: Model | str | None) -> Model:
        return model_for_solids(model)

    def has(self, model: Model) -> str:
        return result_fields.SOLID

    def require_axes(self, azimuth: ArrayLike, orientations: ArrayLike) -> None:
        """Every azimuth and orientation will do."""

    def require_surroundings(
        self,
        bodies: Sequence[Any],
        surroundings: Sequence[Surroundings | None],
        model: Model,
        tilts: NDArray[np.float64],
    ) -> None:
        """Any will do; whether they can be is told by `require_standing`."""

    def warn(self, model: Model, tilts: Sequence[float], motions: Sequence[Motion]) -> None:
        alone = [not head.has_transverse for head in heads_of(motions)]
        if any(alone):
            log.warning(
                "%d of %d motions have one horizontal component alone", sum(alone), len(alone)
            )

    def coordinates(
        self, bodies: Sequence[Any], along: str, model: Model, placed: Mapping[str, Any]
    ) -> dict[str, Any]:
        return {name: (*placed[name], about) for name, about in PLACED.items()}

    def require_standing(self, asked: Members) -> None:
        space.require_stands(*asked.stands_of_solids())

    def tasks(self, asked: Members, model: Model, device: str) -> Iterable[Task]:
        del device  # the processor alone
        assert isinstance(model, General)
        return space.tasks_of(model, asked.batches())


PLACED = {
    "azimuth": {"units": "rad", "long_name": "azimuth of downhill, from x toward y"},
    "orientation": {"units": "rad", "long_name": "orientation of the solid on its support"},
}
TILT = {"units": "rad", "long_name": "tilt of the support"}
PLANE, SPACE = Plane(), Space()


def are_solids(bodies: object) -> bool:
    """Whether one of them is a Solid; then all of them have to be."""
    return isinstance(bodies, Sequence) and any(isinstance(body, Solid) for body in bodies)


def kind_of(bodies: object) -> Kind:
    """That of one body, or of some."""
    return SPACE if isinstance(bodies, Solid) or are_solids(bodies) else PLANE


def require_nothing_around(asked: Members) -> None:
    """InputError in surroundings, which were never tried on a GPU."""
    if any(asked.surroundings):
        raise InputError("surroundings= is not for a GPU; leave device='cuda'")


def require_device(device: str, kind: Kind) -> None:
    """InputError unless there are simulations of a kind on such a device."""
    if device not in DEVICES:
        raise InputError(f"unknown device {device!r}; accepted: {', '.join(DEVICES)}")
    if device == CUDA and kind is SPACE:
        raise InputError(
            "device='cuda': solids are simulated on the CPU, which is the faster for them; leave "
            "the device out"
        )


def run(
    tasks: Iterable[Task],
    count: int,
    store: Callable[[Part], None],
    threads: int | None,
    progress: Progress,
) -> Counter[int]:
    """Do all tasks, on all cores; returns how many runs ended in which way, for `warn_of`.

    Args:
        tasks: of a kind's.
        count: simulations of all of them.
        store: takes the results of some members at a time, in any order, in the caller's thread.
        threads, progress: as for `simulate_many`.
    """
    from shaketable.engine.pool import run_all

    if threads is not None:
        require_whole("threads", threads)
    endings: Counter[int] = Counter()
    with meter("simulations", count, progress) as done:

        def enter(part: Part) -> None:
            store(part)
            endings.update(counts_of(part.results["ending"]))
            done(part.members.size)

        run_all(tasks, threads, enter)
    return endings


def warn_of(kind: Kind, endings: Mapping[int, int]) -> None:
    """Log the runs that did not end regularly."""
    total = sum(endings.values())
    for ending, sentence in kind.sentences.items():
        if endings.get(ending):
            told = (endings[ending], total, translated(sentence))
            log.warning("%d of %d simulations %s", *told, extra={ADDS_UP: True})
