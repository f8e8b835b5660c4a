"""Members side by side, on all cores."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

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
from shaketable.support import Support

if TYPE_CHECKING:
    import xarray as xr


def simulate_each(
    bodies: Body | Sequence[Body],
    motions: Motion | Sequence[Motion],
    *,
    tilts: ArrayLike = 0.0,
    scales: ArrayLike = 1.0,
    polarities: ArrayLike = 1,
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
        bodies, motions: one, or one per member.
        tilts: β of the support [rad], one or one per member; on a negative tilt downhill is
            toward +x.
        scales: factors on both components of the motion, one or one per member.
        polarities: 1 or -1, one or one per member; -1 reverses the horizontal component.
        model, device, progress, threads: as for `simulate_many`.

    Returns:
        Dataset over member with the variables of `simulate_many`; coordinates body and motion
        (their names), tilt [rad], scale and polarity.

    Raises:
        InputError: arguments with different lengths other than one, and what `simulate_many`
            cannot simulate.
    """
    bodies = [bodies] if isinstance(bodies, Body) else listed("bodies", bodies, Body)
    motions = [motions] if isinstance(motions, Motion) else listed("motions", motions, Motion)
    model = model_of(model)
    require_device(device)
    given = {
        name: numbers(name, values)
        for name, values in {"tilts": tilts, "scales": scales, "polarities": polarities}.items()
    }
    lengths = {"bodies": len(bodies), "motions": len(motions)}
    lengths |= {name: values.size for name, values in given.items()}
    count = max(lengths.values())
    if any(length not in (1, count) for length in lengths.values()):
        told = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"arguments must have length 1 or the same length; got {told}")
    which_body, which_motion = (_spread(len(each), count) for each in (bodies, motions))
    tilt, scale, polarity = (np.broadcast_to(each, count) for each in given.values())
    require_polarities(polarity)
    members_of = [bodies[k] for k in which_body]
    for each in np.unique(tilt):
        Support(tilt=float(each))  # raises InputError for a tilt out of range
    require_stable(members_of, tilt)
    warn(model, tilt.tolist(), motions)

    rows = Rows(model.tabulate(members_of, tilt), np.array(polarity), downhill_of(tilt))
    members = Members.empty(count)
    groups = _groups([motions[k] for k in which_motion], scale)
    warn_of(run_groups_on(device, model, rows, groups, members.enter, threads, progress))
    coordinates = {
        "body": ("member", [body.name for body in members_of]),
        "motion": ("member", [motions[k].name for k in which_motion]),
        "tilt": ("member", tilt, {"units": "rad", "long_name": "tilt of the support"}),
        "scale": ("member", scale),
        "polarity": ("member", polarity.astype(np.int64)),
        **factors_of("member", members_of, model),
    }
    return dataset(members.reshaped((count,), (0,)), ("member",), coordinates, model)


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
