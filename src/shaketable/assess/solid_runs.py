"""Simulations of objects as solids, shaken by both horizontal components at once."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.results import (
    ROLLS_FAR,
    LevelResult,
    StrapForce,
    SurroundedResult,
)
from shaketable.assess.runs import Done
from shaketable.assess.same_runs import simulated_once
from shaketable.assess.shares import observed, share_of
from shaketable.assess.stood import Stood, Ways
from shaketable.assess.straps import STRAP_SHARE
from shaketable.engine.endings import not_settled
from shaketable.models import General, with_friction
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate import ShakingSet, kinds, result_fields
from shaketable.simulate.space import SolidBatch, require_stands, stands_of, tasks_of
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.units import STANDARD_GRAVITY

TOUCHING = 0.005  # m: what is said to touch its wall stands so far from it at the most
ORIENTATION = 2  # among the numbers of a run that `stands_of` gives


class SolidRuns(NamedTuple):
    """Simulations of one object, (simulation, turn): a row for each motion and polarity.

    Attributes:
        fell: whether it fell.
        toward: azimuth of the fall from its own x [rad], NaN where it stands.
        along, across: how far its foot came along its own x and y [m], at the end or at a fall.
        farthest: its distance from where it stood, at any time [m].
        turned: by how much it is turned at the end, from its x toward its y [rad].
        not_settled: whether it still moved when the run ended, and had not fallen.
        held_up: whether it did not, and would without its walls and straps.
        force: the largest of its straps over its weight, 0 without straps.
        broke: whether one of them broke.
        off: whether it went over the edge of its support.
    """

    fell: NDArray[np.bool_]
    toward: NDArray[np.float64]
    along: NDArray[np.float64]
    across: NDArray[np.float64]
    farthest: NDArray[np.float64]
    turned: NDArray[np.float64]
    not_settled: NDArray[np.bool_]
    held_up: NDArray[np.bool_]
    force: NDArray[np.float64]
    broke: NDArray[np.bool_]
    off: NDArray[np.bool_]

    def beside(self, others: SolidRuns) -> SolidRuns:
        """These and others of the same object, turn by turn."""
        both = zip(self, others, strict=True)
        return SolidRuns(*(np.concatenate(each, axis=1) for each in both))

    @property
    def moved(self) -> NDArray[np.float64]:
        """Distance of its foot from where it stood [m], at the end."""
        return np.hypot(self.along, self.across)

    @property
    def yaw(self) -> NDArray[np.float64]:
        """By how much it is turned at the end [rad], either way."""
        return np.abs(self.turned)

    def level(self, rolls: bool, recordings: int) -> LevelResult:
        """How often it falls; and how often it is lost."""
        return LevelResult(*(share_of(each, recordings) for each in (self.fell, self.lost(rolls))))

    def lost(self, rolls: bool) -> NDArray[np.bool_]:
        """Whether it falls, is held up alone or, on castors, goes far."""
        return self.fell | self.held_up | (rolls & (self.farthest > ROLLS_FAR))

    @property
    def strap_force(self) -> StrapForce:
        """What its straps bear."""
        return StrapForce(*(observed(self.force, each) for each in (0.5, STRAP_SHARE, 1.0)))

    def surrounded(self, around: Surroundings, recordings: int) -> SurroundedResult:
        """What its surroundings do."""
        straps, edge = bool(around.straps), around.edge is not None
        return SurroundedResult(
            held_up=share_of(self.held_up, recordings),
            falls_or_held_up=share_of(self.fell | self.held_up, recordings),
            force=self.strap_force if straps else None,
            broke=share_of(self.broke, recordings) if straps else None,
            off=share_of(self.off, recordings) if edge else None,
        )


def run_solids(
    stood: Sequence[Stood], ways: Sequence[Ways], trial: ShakingSet, done: Done
) -> list[SolidRuns]:
    """Simulate objects under every motion, in some polarities and turns; those alike once.

    Args:
        stood: some.
        ways: the turns of each, in its first polarity or in all.
        trial: motions, their scale, and the general model of those without a friction of their own.
        done: is told how many more simulations were made.
    """
    if not stood:
        return []
    firsts, like = simulated_once(stood, ways)
    own = [ways[n] for n in firsts]
    runs = _run_each([stood[n] for n in firsts], own, trial, done)
    done(sum(each.size for each in ways) - sum(each.size for each in own))
    return [runs[k] for k in like]


def _run_each(
    stood: Sequence[Stood], ways: Sequence[Ways], trial: ShakingSet, done: Done
) -> list[SolidRuns]:
    """As `run_solids`, of objects that differ."""
    count = 0
    batches: list[SolidBatch] = []
    models: list[General] = []
    for body, (each, of_motions) in enumerate(zip(stood, ways, strict=True)):
        model = trial.model if each.friction is None else with_friction(trial.model, each.friction)
        assert isinstance(model, General)
        for k, (motion, some) in enumerate(zip(trial.motions, of_motions, strict=True)):
            stands = _stands(each, some, trial.scale)
            members = count + np.arange(len(stands))
            for own, around in _together(each, stands):
                batches.append(
                    SolidBatch(body, each.solid, k, motion, members[own], stands[own], around)
                )
                models.append(model)
            count += len(stands)
    require_stands(
        [batch.solid for batch in batches],
        [batch.stands for batch in batches],
        [batch.surroundings for batch in batches],
    )
    surroundings = list({batch.surroundings for batch in batches})
    found = result_fields.Results(result_fields.SOLID, count, surroundings)
    alike: dict[General, list[SolidBatch]] = {}
    for model, batch in zip(models, batches, strict=True):
        alike.setdefault(model, []).append(batch)
    tasks = [task for model, some in alike.items() for task in tasks_of(model, some)]
    # long and short ones mixed, so that the time left is told well
    random.Random(len(tasks)).shuffle(tasks)  # noqa: S311
    kinds.run(tasks, count, found.store, None, done)
    ends = np.cumsum([each.size for each in ways])
    parts = {name: np.split(values, ends[:-1]) for name, values in found.arrays.items()}
    return [
        _runs_of(each, of_motions, {name: values[k] for name, values in parts.items()})
        for k, (each, of_motions) in enumerate(zip(stood, ways, strict=True))
    ]


def require_possible(stood: Stood, motions: Sequence[Motion]) -> None:
    """InputError where an object falls by itself, or what surrounds it cannot be there."""
    stands = _stands(stood, stood.ways(motions[:1])[0], 1.0)
    for own, around in _together(stood, stands):
        require_stands([stood.solid], [stands[own]], [around])


def _stands(stood: Stood, turns: NDArray[np.float64], scale: float) -> NDArray[np.float64]:
    """The runs of an object under one motion, from its turns, (polarity, turn)."""
    polarities = np.repeat((1.0, -1.0)[: len(turns)], turns.shape[1]).tolist()
    angles = turns.ravel().tolist()
    downhill = math.atan2(stood.aside, -stood.tilt)  # its front is toward -x, its left toward +y
    tilt = math.hypot(stood.tilt, stood.aside)
    supports = [Support(tilt=tilt, azimuth=downhill + turn) for turn in angles]
    return stands_of(supports, angles, [scale] * len(angles), polarities)


def _together(
    stood: Stood, stands: NDArray[np.float64]
) -> list[tuple[NDArray[np.intp], Surroundings | None]]:
    """The numbers of the runs with the same surroundings, which turn with an object, and these.

    Nothing stands at no distance at all from its wall, where an impact of the whole back is
    singular: of an object that is said to touch it the gap is another one in each turn, spread
    evenly over TOUCHING.
    """
    if not stood.around:
        return [(np.arange(len(stands)), None)]
    turns, which = np.unique(stands[:, ORIENTATION], return_inverse=True)
    return [
        (np.flatnonzero(which == k), _apart(stood.around, (k + 0.5) / turns.size).turned(turn))
        for k, turn in enumerate(turns.tolist())
    ]


def _apart(around: Surroundings, part: float) -> Surroundings:
    """Surroundings whose walls are off by a part of TOUCHING where they are said to be touched."""
    walls = tuple(
        replace(wall, gap=part * TOUCHING) if wall.gap == 0.0 else wall for wall in around.walls
    )
    return replace(around, walls=walls)


def _runs_of(stood: Stood, ways: Ways, runs: Mapping[str, NDArray[Any]]) -> SolidRuns:
    """The runs of an object in some ways."""
    turns = ways.reshape(-1, ways.shape[2])
    columns = {
        name: values.reshape(*turns.shape, *values.shape[1:]) for name, values in runs.items()
    }
    none = np.zeros((*turns.shape, 0))
    force = np.nan_to_num(columns.get("strap_force", none)).max(axis=2, initial=0.0)
    broke = np.isfinite(columns.get("strap_broke_at", none + np.nan)).any(axis=2)
    weight = (stood.solid.mass or np.nan) * STANDARD_GRAVITY
    x, y = columns["displacement_x"], columns["displacement_y"]
    cosine, sine = np.cos(turns), np.sin(turns)
    return SolidRuns(
        fell=columns["outcome"] != Outcome.STANDING,
        toward=np.remainder(columns["fall_azimuth"] - turns, 2 * math.pi),
        along=x * cosine + y * sine,
        across=y * cosine - x * sine,
        farthest=columns["farthest_displacement"],
        turned=columns["yaw"],
        not_settled=not_settled(columns["ending"]),
        held_up=columns.get("held_up", np.zeros(turns.shape, np.bool_)),
        force=force / weight,
        broke=broke,
        off=columns.get("off_edge", np.zeros(turns.shape, np.bool_)),
    )
