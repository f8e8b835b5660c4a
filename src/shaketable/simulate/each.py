"""Members side by side, on all cores."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate import kinds
from shaketable.simulate.around import Around, listed_surroundings, warn_of
from shaketable.simulate.checks import listed, numbers, require_polarities
from shaketable.simulate.kinds import CPU, CUDA, TILT, kind_of, require_device
from shaketable.simulate.plane import Group, Rows, downhill_of
from shaketable.simulate.result_fields import Results
from shaketable.simulate.space import SolidBatch, stands_of
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    import xarray as xr


def simulate_each(
    bodies: Body | Solid | Sequence[Body] | Sequence[Solid],
    motions: Motion | Sequence[Motion],
    *,
    tilts: ArrayLike = 0.0,
    scales: ArrayLike = 1.0,
    polarities: ArrayLike = 1,
    azimuths: ArrayLike = math.pi,
    orientations: ArrayLike = 0.0,
    model: Model | str | None = None,
    surroundings: Around = None,
    device: str = CPU,
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Simulate members side by side: body k under motion k on tilt k, on all cores.

    An ensemble of uncertain bodies or a fit needs this, where `simulate_many` would run every body
    under every motion. Members that share a motion (the same object) and its scale run together,
    as fast as with `simulate_many`.

    Args:
        bodies, motions: one, or one per member; all bodies planar, or all of them Solids.
        tilts: β of the support [rad], one or one per member; on a negative tilt downhill is
            toward +x.
        scales: factors on all components of the motion, one or one per member.
        polarities: 1 or -1, one or one per member; -1 reverses the horizontal components.
        azimuths: of downhill, from +x toward +y [rad], one or one per member; π for planar bodies.
        orientations: of Solids on their supports, from x toward y [rad], one or one per member.
        surroundings: as for `simulate_many`, one or one per member.
        model, device, progress, threads: as for `simulate_many`.

    Returns:
        Dataset over member with the variables of `simulate_many`; coordinates body and motion
        (their names), tilt [rad], scale and polarity, and of Solids azimuth and orientation.

    Raises:
        InputError: arguments with different lengths other than one, and what `simulate_many`
            cannot simulate.
    """
    kind = kind_of(bodies)
    things = [bodies] if isinstance(bodies, (Body, Solid)) else listed("bodies", bodies, kind.body)
    motions = [motions] if isinstance(motions, Motion) else listed("motions", motions, Motion)
    given = {
        "tilts": numbers("tilts", tilts),
        "scales": numbers("scales", scales),
        "polarities": numbers("polarities", polarities),
        "azimuths": numbers("azimuths", azimuths),
        "orientations": numbers("orientations", orientations),
    }
    require_polarities(given["polarities"])
    around = listed_surroundings(surroundings)
    lengths = {"bodies": len(things), "motions": len(motions)}
    lengths |= {name: values.size for name, values in given.items()}
    lengths["surroundings"] = len(around)
    count = max(lengths.values())
    if any(length not in (1, count) for length in lengths.values()):
        told = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"arguments must have length 1 or the same length; got {told}")
    kind.require_axes(given["azimuths"], given["orientations"])
    asked = SideBySide(
        [things[k] for k in _spread(len(things), count)],
        [motions[k] for k in _spread(len(motions), count)],
        [around[k] for k in _spread(len(around), count)],
        *(np.broadcast_to(each, count) for each in given.values()),
    )
    model = kind.model_of(model)
    require_device(device, kind)
    for tilt, azimuth in np.unique(np.column_stack([asked.tilts, asked.azimuths]), axis=0).tolist():
        Support(tilt=tilt, azimuth=azimuth)  # raises InputError for a tilt out of range
    kind.require_standing(asked)
    kind.require_surroundings(asked.bodies, asked.surroundings, model, asked.tilts)
    kind.warn(model, asked.tilts.tolist(), list(dict.fromkeys(asked.motions)))
    warn_of(around, model)
    found = Results(kind.has(model), count, around)
    tasks = kind.tasks(asked, model, device)
    endings = kinds.run(tasks, count, found.store, 1 if device == CUDA else threads, progress)
    kinds.warn_of(kind, endings)
    placed = {
        "azimuth": ("member", asked.azimuths),
        "orientation": ("member", asked.orientations),
    }
    coordinates = {
        "body": ("member", [body.name for body in asked.bodies]),
        "motion": ("member", [motion.name for motion in asked.motions]),
        "tilt": ("member", asked.tilts, TILT),
        "scale": ("member", asked.scales),
        "polarity": ("member", asked.polarities.astype(np.int64)),
        **kind.coordinates(asked.bodies, "member", model, placed),
    }
    return found.dataset(("member",), (count,), coordinates, model)


class SideBySide(NamedTuple):
    """What is simulated, an entry of each for each member; `Ensemble` has the same methods."""

    bodies: Sequence[Any]
    motions: Sequence[Motion]
    surroundings: Sequence[Surroundings | None]
    tilts: NDArray[np.float64]
    scales: NDArray[np.float64]
    polarities: NDArray[np.float64]
    azimuths: NDArray[np.float64]
    orientations: NDArray[np.float64]

    def extreme_tilts(self) -> Iterator[tuple[Sequence[Body], NDArray[np.float64]]]:
        """Bodies, and the tilt [rad] of each."""
        yield self.bodies, self.tilts

    def stands_of_solids(self) -> kinds.Stands:
        """Each solid under each motion, how it stands in its runs, and what holds it."""
        batches = list(self.batches())
        return (
            [batch.solid for batch in batches],
            [batch.stands for batch in batches],
            [batch.surroundings for batch in batches],
        )

    def rows(self, model: Model) -> Rows:
        """Planar bodies on their supports."""
        table = model.tabulate(self.bodies, self.tilts, self.surroundings)
        every = np.arange(len(self.bodies))
        return Rows(table, np.array(self.polarities), downhill_of(self.tilts), every)

    def groups(self) -> Iterator[Group]:
        """Members that share a motion and its scale."""
        shakings = zip(self.motions, self.scales.tolist(), strict=True)
        for (motion, scale), members in _alike(shakings):
            yield Group(motion, scale, members, 0)

    def batches(self) -> Iterator[SolidBatch]:
        """The runs of each solid under each motion."""
        places = zip(self.tilts.tolist(), self.azimuths.tolist(), strict=True)
        supports = [Support(tilt=tilt, azimuth=azimuth) for tilt, azimuth in places]
        stands = stands_of(supports, self.orientations, self.scales, self.polarities)
        numbers_of = [
            {each: k for k, each in enumerate(dict.fromkeys(some))}
            for some in (self.bodies, self.motions)
        ]
        alike = zip(self.bodies, self.motions, self.surroundings, strict=True)
        for (solid, motion, around), members in _alike(alike):
            yield SolidBatch(
                numbers_of[0][solid], solid, numbers_of[1][motion], motion, members,
                stands[members], around,
            )  # fmt: skip


def _spread(length: int, count: int) -> NDArray[np.intp]:
    """Index into a list that holds one entry, or one per member."""
    return np.zeros(count, np.intp) if length == 1 else np.arange(count)


def _alike(things: Iterable[Hashable]) -> Iterator[tuple[Any, NDArray[np.intp]]]:
    """Each that is there once, and the places at which it is."""
    found: dict[Hashable, list[int]] = {}
    for k, thing in enumerate(things):
        found.setdefault(thing, []).append(k)
    for thing, places in found.items():
        yield thing, np.array(places, np.intp)
