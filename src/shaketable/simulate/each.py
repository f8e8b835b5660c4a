"""Members side by side, on all cores."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import listed, numbers, require_polarities, require_stable, warn
from shaketable.simulate.devices import CPU, require_device, run_groups_on
from shaketable.simulate.ensemble import Group, Rows, downhill_of, warn_of
from shaketable.simulate.members import Members, dataset, factors_of
from shaketable.simulate.products import are_solids, require_plane
from shaketable.simulate.solid_batches import Batch, stands_of
from shaketable.simulate.solid_input import model_for_solids
from shaketable.simulate.solid_members import SolidMembers
from shaketable.simulate.solid_product import AZIMUTH, ORIENTATION, TILT
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
    device: str = CPU,
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Shake members side by side: body k under motion k on tilt k, and so on, on all cores.

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
        model, device, progress, threads: as for `simulate_many`.

    Returns:
        Dataset over member with the variables of `simulate_many`; coordinates body and motion
        (their names), tilt [rad], scale and polarity, and of Solids azimuth and orientation.

    Raises:
        InputError: arguments with different lengths other than one, and what `simulate_many`
            cannot simulate.
    """
    solid = isinstance(bodies, Solid) or are_solids(bodies)
    kind: type[Body | Solid] = Solid if solid else Body
    things = [bodies] if isinstance(bodies, (Body, Solid)) else listed("bodies", bodies, kind)
    motions = [motions] if isinstance(motions, Motion) else listed("motions", motions, Motion)
    given = {
        "tilts": numbers("tilts", tilts),
        "scales": numbers("scales", scales),
        "polarities": numbers("polarities", polarities),
        "azimuths": numbers("azimuths", azimuths),
        "orientations": numbers("orientations", orientations),
    }
    require_polarities(given["polarities"])
    lengths = {"bodies": len(things), "motions": len(motions)}
    lengths |= {name: values.size for name, values in given.items()}
    count = max(lengths.values())
    if any(length not in (1, count) for length in lengths.values()):
        told = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"arguments must have length 1 or the same length; got {told}")
    side_by_side = SideBySide(
        [things[k] for k in _spread(len(things), count)],
        [motions[k] for k in _spread(len(motions), count)],
        *(np.broadcast_to(each, count) for each in given.values()),
    )
    if solid:
        return _solids(side_by_side, model, device, progress, threads)
    require_plane(given["azimuths"], given["orientations"])
    return _planar(side_by_side, model, device, progress, threads)


class SideBySide(NamedTuple):
    """What is simulated, an entry of each for each member."""

    bodies: Sequence[Any]
    motions: Sequence[Motion]
    tilts: NDArray[np.float64]
    scales: NDArray[np.float64]
    polarities: NDArray[np.float64]
    azimuths: NDArray[np.float64]
    orientations: NDArray[np.float64]

    def coordinates(self) -> dict[str, Any]:
        """Those that members of both kinds have, as xarray takes them."""
        return {
            "body": ("member", [body.name for body in self.bodies]),
            "motion": ("member", [motion.name for motion in self.motions]),
            "tilt": ("member", self.tilts, TILT),
            "scale": ("member", self.scales),
            "polarity": ("member", self.polarities.astype(np.int64)),
        }


def _planar(
    asked: SideBySide,
    model: Model | str | None,
    device: str,
    progress: Progress,
    threads: int | None,
) -> xr.Dataset:
    model = model_of(model)
    require_device(device)
    for each in np.unique(asked.tilts):
        Support(tilt=float(each))  # raises InputError for a tilt out of range
    require_stable(asked.bodies, asked.tilts)
    warn(model, asked.tilts.tolist(), list({id(each): each for each in asked.motions}.values()))
    table = model.tabulate(asked.bodies, asked.tilts)
    rows = Rows(table, np.array(asked.polarities), downhill_of(asked.tilts))
    count = len(asked.bodies)
    members = Members.empty(count)
    groups = _groups(asked.motions, asked.scales)
    warn_of(run_groups_on(device, model, rows, groups, members.enter, threads, progress))
    coordinates = {**asked.coordinates(), **factors_of("member", asked.bodies, model)}
    return dataset(members.reshaped((count,), (0,)), ("member",), coordinates, model)


def _solids(
    asked: SideBySide,
    model: Model | str | None,
    device: str,
    progress: Progress,
    threads: int | None,
) -> xr.Dataset:
    general = model_for_solids(model)
    require_device(device)
    places = zip(asked.tilts.tolist(), asked.azimuths.tolist(), strict=True)
    supports = [Support(tilt=tilt, azimuth=azimuth) for tilt, azimuth in places]
    stands = stands_of(supports, asked.orientations, asked.scales, asked.polarities)
    together: dict[tuple[int, int], list[int]] = {}
    for k, pair in enumerate(zip(asked.bodies, asked.motions, strict=True)):
        together.setdefault((id(pair[0]), id(pair[1])), []).append(k)
    batches = [
        Batch(asked.bodies[which[0]], asked.motions[which[0]], np.array(which), stands[which])
        for which in together.values()
    ]
    require_stands([batch.solid for batch in batches], [batch.stands for batch in batches])
    warn_of_components([batch.motion for batch in batches])
    members = SolidMembers(len(stands))
    warn_of_solids(run_batches(batches, general, members.enter, threads, progress, device))
    coordinates = {
        **asked.coordinates(),
        "azimuth": ("member", asked.azimuths, AZIMUTH),
        "orientation": ("member", asked.orientations, ORIENTATION),
    }
    return members.dataset(("member",), (len(stands),), coordinates, general)


def _spread(length: int, count: int) -> NDArray[np.intp]:
    """Index into a list that holds one entry, or one per member."""
    return np.zeros(count, np.intp) if length == 1 else np.arange(count)


def _groups(motions: Sequence[Motion], scale: NDArray[np.float64]) -> Iterable[Group]:
    """Members that share a motion and its scale."""
    found: dict[tuple[int, float], list[int]] = {}
    for k, motion in enumerate(motions):
        found.setdefault((id(motion), float(scale[k])), []).append(k)
    for (_, factor), members in found.items():
        yield Group(motions[members[0]], factor, np.array(members, np.intp), 0)
