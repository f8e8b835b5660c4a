"""Many solids under many motions, on all cores."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, joined, require_number, require_whole
from shaketable.models import General, Model
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.progress import Progress, meter
from shaketable.simulate.checks import listed, numbers, require_polarities
from shaketable.simulate.devices import CPU
from shaketable.simulate.members import flags, names
from shaketable.simulate.solid_input import (
    ground_of,
    model_for_solids,
    shape_of,
    standing_limit,
    upright,
)
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.units import degrees

if TYPE_CHECKING:
    import xarray as xr

log = logging.getLogger(__name__)

DIMENSIONS = ("body", "motion", "polarity", "tilt", "scale", "orientation")
MEMBERS_PER_TASK = 16


class Variable(NamedTuple):
    """A variable of the Dataset, by the field of `solids.run.Found` that it shows."""

    field: str
    long_name: str
    units: str


VARIABLES = {
    "overturning_time": Variable("time", "time of overturning", "s"),
    "fall_azimuth": Variable("fall_azimuth", "azimuth of the axis as it fell", "rad"),
    "peak_rotation": Variable("peak", "peak nutation", "rad"),
    "displacement_x": Variable("displacement_x", "displacement of the foot along x", "m"),
    "displacement_y": Variable("displacement_y", "displacement of the foot along y", "m"),
    "yaw": Variable("yaw", "turn about the support's normal", "rad"),
    "max_lift": Variable("lift", "largest clearance under the base", "m"),
}


def simulate_solids(
    solids: Sequence[Solid],
    motions: Sequence[Motion],
    *,
    tilts: ArrayLike,
    azimuth: float,
    scales: ArrayLike,
    polarities: ArrayLike,
    orientations: ArrayLike,
    model: Model | str | None,
    device: str,
    progress: Progress,
    threads: int | None,
) -> xr.Dataset:
    """What `simulate_many` gives for solids."""
    import xarray as xr

    from shaketable.solids.run import STANDING, Found

    solids, motions = listed("bodies", solids, Solid), listed("motions", motions, Motion)
    general = model_for_solids(model)
    axes = {
        "polarity": numbers("polarities", polarities),
        "tilt": numbers("tilts", tilts),
        "scale": numbers("scales", scales),
        "orientation": numbers("orientations", orientations),
    }
    require_polarities(axes["polarity"])
    require_number("azimuth", azimuth)
    if device != CPU:
        raise InputError(f'solids are simulated with device="{CPU}" alone, got {device!r}')
    if threads is not None:
        require_whole("threads", threads)
    supports = [Support(tilt=tilt, azimuth=azimuth) for tilt in axes["tilt"].tolist()]
    _require_standing(solids, supports, axes["orientation"])
    alone = sum(motion.transverse is None for motion in motions)
    if alone:
        log.warning("%d of %d motions have one horizontal component alone", alone, len(motions))
    stands = _stands(supports, axes)
    shape = (len(solids), len(motions), *(axis.size for axis in axes.values()))
    found = np.empty((len(solids), len(motions), len(stands), len(Found._fields)))

    def enter(task: Task) -> None:
        found[task.solid, task.motion, task.members] = task.found
        done(len(task.members))

    from shaketable.engine.pool import run_all

    with meter("simulations", math.prod(shape), progress) as done:
        run_all(_tasks(solids, motions, general, stands), threads, enter)
    columns = {
        name: found[..., Found._fields.index(variable.field)].reshape(shape)
        for name, variable in VARIABLES.items()
    }
    ending = found[..., Found._fields.index("ending")].reshape(shape).astype(np.int8)
    _tell(ending)
    downhill = np.array([upright(support)[1] for support in supports])
    toward = np.cos(columns["fall_azimuth"] - downhill[:, None, None])
    outcome = np.where(toward >= 0.0, Outcome.DOWNHILL, Outcome.UPHILL)
    outcome = np.where(np.isnan(toward), Outcome.STANDING, outcome).astype(np.int8)
    impacts = found[..., Found._fields.index("impacts")].reshape(shape).astype(np.int32)
    variables: dict[str, Any] = {
        "outcome": (DIMENSIONS, outcome, {"long_name": "outcome", **flags(Outcome)}),
        "impacts": (DIMENSIONS, impacts, {"long_name": "number of impacts"}),
        "irregular": (
            DIMENSIONS,
            ending > STANDING + 1,
            {"long_name": "the run was given up while the solid moved"},
        ),
    }
    for name, (_, long_name, units) in VARIABLES.items():
        variables[name] = (DIMENSIONS, columns[name], {"long_name": long_name, "units": units})
    tilt_about = {"units": "rad", "long_name": "tilt of the support"}
    orientation_about = {"units": "rad", "long_name": "orientation of the solid on its support"}
    coordinates = {
        "body": names(solids),
        "motion": names(motions),
        "polarity": axes["polarity"].astype(np.int64),
        "tilt": ("tilt", axes["tilt"], tilt_about),
        "scale": axes["scale"],
        "orientation": ("orientation", axes["orientation"], orientation_about),
        "azimuth": ((), azimuth, {"units": "rad", "long_name": "downhill, from x toward y"}),
    }
    return xr.Dataset(variables, coords=coordinates, attrs={"model": repr(general)})


class Task(NamedTuple):
    """Some members of one solid under one motion, and what they found."""

    solid: int
    motion: int
    members: NDArray[np.intp]
    found: NDArray[np.float64]


def _stands(supports: list[Support], axes: dict[str, NDArray[np.float64]]) -> NDArray[np.float64]:
    """The numbers of a `solids.run.Stand` for each member of one solid under one motion."""
    rows = [
        (*upright(support), orientation, scale, polarity)
        for polarity in axes["polarity"].tolist()
        for support in supports
        for scale in axes["scale"].tolist()
        for orientation in axes["orientation"].tolist()
    ]
    return np.array(rows, np.float64)


def _tasks(
    solids: Sequence[Solid],
    motions: Sequence[Motion],
    model: General,
    stands: NDArray[np.float64],
) -> Iterator[partial[Task]]:
    """The longest motions first, a few members at a time."""
    order = sorted(range(len(motions)), key=lambda k: -motions[k].duration)
    for motion in order:
        for solid in range(len(solids)):
            for first in range(0, len(stands), MEMBERS_PER_TASK):
                members = np.arange(first, min(first + MEMBERS_PER_TASK, len(stands)))
                yield partial(
                    _run, solids[solid], motions[motion], model, stands[members],
                    Task(solid, motion, members, np.empty(0)),
                )  # fmt: skip


def _run(
    solid: Solid, motion: Motion, model: General, stands: NDArray[np.float64], task: Task
) -> Task:
    from shaketable.solids.drive import move_solid
    from shaketable.solids.room import STATE
    from shaketable.solids.run import Found, Trace

    shape, rooms = shape_of(solid, model)
    found = np.empty((len(stands), len(Found._fields)))
    nothing = Trace(np.empty((0, STATE)), *np.empty((2, 0), np.int8))
    move_solid(shape, rooms, ground_of(motion), stands, False, nothing, found)
    return task._replace(found=found)


def _require_standing(
    solids: Sequence[Solid], supports: list[Support], orientations: NDArray[np.float64]
) -> None:
    """InputError naming each solid that falls by itself on one of the supports."""
    faults = []
    for index, solid in enumerate(solids):
        for tilt, azimuth in map(upright, supports):
            for orientation in orientations.tolist():
                limit = standing_limit(solid, azimuth - orientation)
                if tilt >= limit:
                    faults.append(
                        f"body {solid.name or index}: falls by itself on a support tilted by "
                        f"{degrees(tilt):.4g}°, turned by {degrees(orientation):.4g}°; it stands "
                        f"below {degrees(limit):.4g}°"
                    )
    if faults:
        raise InputError(joined(faults))


def _tell(ending: NDArray[np.int8]) -> None:
    """Log the runs that did not end regularly."""
    from shaketable.solids.run import SENTENCES

    for code, sentence in SENTENCES.items():
        count = int((ending == code).sum())
        if count:
            log.warning("%d of %d simulations %s", count, ending.size, sentence)
