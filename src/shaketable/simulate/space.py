"""Solids of an ensemble: runs of one solid under one motion, some at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, joined
from shaketable.models import General
from shaketable.models.held import held_of
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate.around import with_held
from shaketable.simulate.result_fields import Part
from shaketable.simulate.standing import require_surrounded, standing_limit, upright
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.units import degrees

if TYPE_CHECKING:
    from shaketable.physics.space.found import FoundRecords
    from shaketable.physics.space.workspace import SolidRecords, Workspaces

RUNS_PER_TASK = 4  # some take a thousand times as long as others


class SolidBatch(NamedTuple):
    """Runs of one solid under one motion.

    Attributes:
        solid_number, motion_number: theirs, among those of the ensemble.
        members: numbers of the runs in the ensemble, (run,).
        stands: the numbers of a `physics.space.ground.RunSetup` for each, (run, 5).
        surroundings: what holds it.
    """

    solid_number: int
    solid: Solid
    motion_number: int
    motion: Motion
    members: NDArray[np.intp]
    stands: NDArray[np.float64]
    surroundings: Surroundings | None


def tasks_of(model: General, batches: Iterable[SolidBatch]) -> Iterator[Callable[[], Part]]:
    """What is to be done on a processor, the longest motions first.

    Args:
        model: the contact model.
        batches: at least one.
    """
    ordered = sorted(batches, key=lambda batch: -batch.motion.duration)
    known: dict[tuple[int, Surroundings | None], tuple[SolidRecords, Workspaces]] = {}
    for batch in ordered:  # a solid meets many motions
        key = id(batch.solid), batch.surroundings
        if key not in known:
            known[key] = shapes_of(batch.solid, model, batch.surroundings)
    return (
        task
        for batch in ordered
        for task in _tasks(batch, *known[id(batch.solid), batch.surroundings])
    )


def _tasks(
    batch: SolidBatch, shapes: SolidRecords, workspaces: Workspaces
) -> Iterator[Callable[[], Part]]:
    """The runs of a batch, some in each task."""
    from shaketable.physics.space.drive import move_solid
    from shaketable.physics.space.found import make_found, make_trace

    around = batch.surroundings
    ground = ground_of(batch.motion)
    nothing = make_trace(0)

    def run(first: int) -> Part:
        some = slice(first, first + RUNS_PER_TASK)
        members, stands = batch.members[some], batch.stands[some]
        found = make_found(members.size)
        move_solid(shapes, workspaces.copy(), ground, stands, False, nothing, found)
        part = part_of(members, stands, found)
        return with_held(part, held_of(found, around, batch.solid.mass)) if around else part

    return (partial(run, first) for first in range(0, batch.members.size, RUNS_PER_TASK))


def part_of(members: NDArray[np.intp], stands: NDArray[np.float64], found: FoundRecords) -> Part:
    """The results of members by their names; a fall is downhill within 90° of it.

    Args:
        members: their numbers.
        stands: as in Batch.
        found: what is told of each, (member,).
    """
    toward = np.cos(found["fall_azimuth"] - stands[:, 1])
    outcome = np.where(toward >= 0.0, Outcome.DOWNHILL, Outcome.UPHILL)
    outcome[np.isnan(toward)] = Outcome.STANDING
    return Part(
        members,
        {
            "outcome": outcome,
            "overturning_time": found["time"],
            "peak_rotation": found["peak"],
            "impacts": found["impacts"],
            "ending": found["ending"],
            "fall_azimuth": found["fall_azimuth"],
            "displacement_x": found["displacement_x"],
            "displacement_y": found["displacement_y"],
            "yaw": found["yaw"],
            "max_lift": found["lift"],
            "displacement_x_at_motion_end": found["shaken_x"],
            "displacement_y_at_motion_end": found["shaken_y"],
            "yaw_at_motion_end": found["shaken_yaw"],
            "farthest_displacement": found["farthest"],
        },
    )


def stands_of(
    supports: Iterable[Support],
    orientations: Iterable[float],
    scales: Iterable[float],
    polarities: Iterable[float],
) -> NDArray[np.float64]:
    """The numbers of a `physics.space.ground.RunSetup` for runs side by side, (run, 5)."""
    rows = [
        (*upright(support), orientation, scale, polarity)
        for support, orientation, scale, polarity in zip(
            supports, orientations, scales, polarities, strict=True
        )
    ]
    return np.array(rows, np.float64).reshape(-1, 5)


def require_stands(
    solids: Iterable[Solid],
    stands: Iterable[NDArray[np.float64]],
    surroundings: Iterable[Surroundings | None],
) -> None:
    """InputError naming each solid that falls by itself, or cannot be held, in one of its stands.

    Args:
        solids: each solid once.
        stands: of each solid, as `stands_of` gives them.
        surroundings: of each solid.
    """
    faults = []
    for index, (solid, each, around) in enumerate(zip(solids, stands, surroundings, strict=True)):
        for tilt, azimuth, orientation in np.unique(each[:, :3], axis=0).tolist():
            require_surrounded(solid, around, orientation)
            limit = standing_limit(solid, azimuth - orientation)
            if tilt >= limit:
                faults.append(
                    f"body {solid.name or index}: falls by itself on a support tilted by "
                    f"{degrees(tilt):.4g}° toward {degrees(azimuth):.4g}°, turned by "
                    f"{degrees(orientation):.4g}°; it stands below {degrees(limit):.4g}°"
                )
    if faults:
        raise InputError(joined(faults))
