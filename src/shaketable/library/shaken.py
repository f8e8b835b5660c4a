"""The simulations of a case: every draw of its thing under its motion, at all scales that tell."""

from __future__ import annotations

import io
import random
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import not_settled
from shaketable.fragility.cloud import SATURATED_SHARE, TRIED
from shaketable.library.case import Case
from shaketable.library.draws import Draw, draws_of
from shaketable.library.reach import reach_from_wall, wall_behind
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.progress import Progress
from shaketable.simulate import kinds
from shaketable.simulate.result_fields import SOLID, Results
from shaketable.simulate.space import SolidBatch, require_stands, stands_of, tasks_of
from shaketable.support import Support
from shaketable.synthesis import floor_motions
from shaketable.units import STANDARD_GRAVITY

PILOT = 4  # every fourth motion tells which scales matter
MOST_SCALES = 8
SLIDES = 0.05  # m: what slides so far is not quiet


@dataclass(frozen=True, kw_only=True, eq=False)
class CaseRuns:
    """What the simulations of a case gave, (run,) each.

    Attributes:
        draw: number of the draw; its motion is that number modulo the number of motions.
        scale: factor on the motion.
        fell: whether it fell.
        held_up: whether it did not, and would without its wall and strap.
        off: whether it went over the edge of its table.
        rotation: largest of its axis from the support's normal [rad].
        farthest: displacement of its foot at any time [m].
        reach: from the wall to the farthest point of what it covers at the end [m].
        force: largest of its strap, in weights; 0 without one.
        broke: whether its strap broke.
        moving: whether it still moved when the run was given up, and counts as standing.
    """

    draw: NDArray[np.int32]
    scale: NDArray[np.float64]
    fell: NDArray[np.bool_]
    held_up: NDArray[np.bool_]
    off: NDArray[np.bool_]
    rotation: NDArray[np.float32]
    farthest: NDArray[np.float32]
    reach: NDArray[np.float32]
    force: NDArray[np.float32]
    broke: NDArray[np.bool_]
    moving: NDArray[np.bool_]

    def as_bytes(self) -> bytes:
        """All of it as a file of NumPy's."""
        file = io.BytesIO()
        np.savez_compressed(file, **{each.name: getattr(self, each.name) for each in fields(self)})
        return file.getvalue()

    @classmethod
    def from_bytes(cls, content: bytes) -> CaseRuns:
        """What `as_bytes` wrote.

        Raises:
            KeyError, ValueError: something of it is missing.
        """
        with np.load(io.BytesIO(content)) as told:
            return cls(**{each.name: told[each.name] for each in fields(cls)})


def motions_under(case: Case, ground: Sequence[Motion]) -> list[Motion]:
    """The motions of the floor on which the thing of a case stands."""
    stand = case.stand
    if stand.building is None:
        return list(ground)
    return [floor_motions(stand.building, motion)[stand.floor - 1] for motion in ground]


def simulated(
    case: Case,
    motions: Sequence[Motion],
    *,
    seed: int = 0,
    scales: Sequence[float] | None = None,
    progress: Progress = False,
    threads: int | None = None,
) -> CaseRuns:
    """Simulate a case.

    Args:
        case: which.
        motions: of its floor, each with both horizontal components.
        seed: of the draws.
        scales: factors on the motions; by default at most MOST_SCALES between those at which
            nothing lifts off or slides and those at which all things fall, as every fourth motion
            says.
        progress, threads: as for `simulate_each`.
    """
    draws = draws_of(case, case.held.draws * len(motions), seed).each
    if scales is None:
        some = list(range(0, len(motions), PILOT))
        scales = _telling(_run(case, [draws[k] for k in some], [motions[k] for k in some],
                               TRIED, threads))  # fmt: skip
    each = [motions[k % len(motions)] for k in range(len(draws))]
    return _run(case, draws, each, scales, threads, progress)


def _telling(pilot: CaseRuns) -> list[float]:
    """Scales from where hardly anything lifts off or slides to where nearly all fall."""
    by_scale = {scale: pilot.scale == scale for scale in np.unique(pilot.scale).tolist()}
    tried = list(by_scale)
    moved = (pilot.rotation > 0.0) | (pilot.farthest > SLIDES)
    lifted = [moved[which].mean() for which in by_scale.values()]
    down = pilot.fell | pilot.held_up
    fallen = [down[which].mean() for which in by_scale.values()]
    quiet = [k for k, share in enumerate(lifted) if share <= SATURATED_SHARE]
    sure = [k for k, share in enumerate(fallen) if share >= 1.0 - SATURATED_SHARE]
    low, high = (max(quiet) if quiet else 0), (min(sure) if sure else len(tried) - 1)
    high = max(high, min(low + 2, len(tried) - 1))
    count = min(MOST_SCALES, high - low + 1)
    return [float(each) for each in np.geomspace(tried[low], tried[high], count)]


def _run(
    case: Case,
    draws: Sequence[Draw],
    motions: Sequence[Motion],
    scales: Sequence[float] | NDArray[np.float64],
    threads: int | None,
    progress: Progress = False,
) -> CaseRuns:
    """Each draw under its motion at all scales, (draw, scale) in a row."""
    factors = np.asarray(scales, np.float64)
    alike: dict[General, list[SolidBatch]] = defaultdict(list)
    for number, (draw, motion) in enumerate(zip(draws, motions, strict=True)):
        support = Support(tilt=case.tilt, azimuth=draw.orientation)
        count = factors.size
        stands = stands_of(
            [support] * count, [draw.orientation] * count, factors.tolist(), [1.0] * count
        )
        members = number * count + np.arange(count)
        alike[draw.model].append(
            SolidBatch(number, draw.solid, number, motion, members, stands, draw.around)
        )
    batches = [batch for some in alike.values() for batch in some]
    around = [batch.surroundings for batch in batches]
    require_stands([each.solid for each in batches], [each.stands for each in batches], around)
    count = len(draws) * factors.size
    found = Results(SOLID, count, list(set(around)))
    tasks = [task for model, some in alike.items() for task in tasks_of(model, some)]
    # long and short ones mixed, so that the time left is told well
    random.Random(len(tasks)).shuffle(tasks)  # noqa: S311
    kinds.run(tasks, count, found.store, threads, progress)
    numbers = np.repeat(np.arange(len(draws), dtype=np.int32), factors.size)
    return _kept(case, draws, numbers, np.tile(factors, len(draws)), found.arrays)


def _kept(
    case: Case,
    draws: Sequence[Draw],
    number: NDArray[np.int32],
    scale: NDArray[np.float64],
    runs: Mapping[str, NDArray[Any]],
) -> CaseRuns:
    """What is kept of the simulations."""
    down = runs["outcome"] != Outcome.STANDING
    moving, nowhere = not_settled(runs["ending"]), np.zeros(number.size, np.bool_)
    shift = np.column_stack([runs["displacement_x"], runs["displacement_y"]])
    yaw, toward = runs["yaw"], np.nan_to_num(runs["fall_azimuth"])
    reach = np.empty(number.size)
    for k, draw in enumerate(draws):
        which = number == k
        reach[which] = reach_from_wall(
            draw.solid, draw.orientation, wall_behind(case), down[which], shift[which], yaw[which],
            toward[which],
        )  # fmt: skip
    none = np.zeros((number.size, 0))
    force = np.nan_to_num(runs.get("strap_force", none)).max(axis=1, initial=0.0)
    return CaseRuns(
        draw=number,
        scale=scale,
        fell=down,
        held_up=runs.get("held_up", nowhere),
        off=runs.get("off_edge", nowhere),
        rotation=runs["peak_rotation"].astype(np.float32),
        farthest=runs["farthest_displacement"].astype(np.float32),
        reach=reach.astype(np.float32),
        force=(force / STANDARD_GRAVITY).astype(np.float32),
        broke=np.isfinite(runs.get("strap_broke_at", none)).any(axis=1),
        moving=moving,
    )
