"""Objects in three dimensions: solids that both horizontal components shake at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.assessment import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.results import (
    ROLLS_FAR,
    FrictionResult,
    LevelResult,
    Sides,
    SolidResult,
    StrapForce,
    StrapTrial,
    SurroundedResult,
)
from shaketable.assess.runs import Done, grouped
from shaketable.assess.shares import Share, agree, observed, observed_quartiles, share_of
from shaketable.assess.straps import STRAP_SHARE, TRIED, asks_for_trial, in_strap
from shaketable.engine.endings import not_settled
from shaketable.inventory import Castors, Item, in_space, solid_of
from shaketable.models import General, Model, Rocking, with_friction
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate import ShakingSet, kinds, result_fields
from shaketable.simulate.space import SolidBatch, require_stands, stands_of, tasks_of
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.tilting import TURNS
from shaketable.units import STANDARD_GRAVITY

NONE = np.empty(0)
ORIENTATION = 2  # among the numbers of a run that `stands_of` gives
Ways = NDArray[np.float64]  # turns [rad], (motion, polarity, turn)


class Stood(NamedTuple):
    """An object on what it stands on."""

    item: Item
    solid: Solid
    tilt: float  # rad, toward its front
    around: Surroundings | None = None  # as it faces the front of its support

    @property
    def symmetric(self) -> bool:
        """Whether nothing but its base tells one side of it from another."""
        return self.tilt == 0.0 and not self.around

    def turns(self, motions: Sequence[Motion]) -> NDArray[np.float64]:
        """Angles from each motion's horizontal component to its depth [rad], (motion, turn).

        One angle, if the azimuths of its front and of the motions are known; otherwise TURNS
        angles over half a turn, without those that would repeat another. Half a turn of an object
        and its support is the reversed motion, which is simulated as well. Alone on a level
        support a square looks the same after a quarter of a turn, and a circle always.
        """
        item = self.item
        azimuths = [motion.origin.azimuth if motion.origin else None for motion in motions]
        if item.facing is not None and None not in azimuths:
            # compass azimuths go clockwise; its x goes from the front to the back
            along = np.radians(np.array(azimuths, np.float64))
            return np.remainder(along - item.facing - math.pi, 2 * math.pi)[:, None]
        if self.symmetric and self.solid.round:
            return np.zeros((len(motions), 1))
        square = item.sideways == item.body and item.body.left == item.body.right
        turns = np.arange(TURNS) * (math.pi / 2 if self.symmetric and square else math.pi) / TURNS
        return np.tile(turns, (len(motions), 1))

    @property
    def polarities(self) -> tuple[float, ...]:
        """Of the motions: reversed, one does the same to a circle alone on a level support."""
        same = self.symmetric and self.solid.round
        return (1.0,) if same else (1.0, -1.0)

    def ways(self, motions: Sequence[Motion]) -> Ways:
        """All turns with which it meets each motion in each polarity."""
        turns = self.turns(motions)[:, None, :]
        return np.repeat(turns, len(self.polarities), axis=1)


def halves(ways: Ways) -> list[Ways]:
    """Every other turn, and the rest, if there is any."""
    return [ways] if ways.shape[2] % 2 else [ways[:, :, ::2], ways[:, :, 1::2]]


class SolidRuns(NamedTuple):
    """Simulations of one object, (simulation, turn): a row for each motion and polarity.

    Attributes:
        fell: whether it fell.
        toward: azimuth of the fall from its own x [rad], NaN where it stands.
        moved: distance of its foot from where it stood [m], at the end.
        yaw: by how much it is turned then [rad], either way.
        not_settled: whether it still moved when the run ended, and had not fallen.
        leans: whether it stands then, leaning on what surrounds it, or still moves in straps.
        force: the largest of its straps over its weight, 0 without straps.
        broke: whether one of them broke.
        off: whether it went over the edge of its support.
    """

    fell: NDArray[np.bool_]
    toward: NDArray[np.float64]
    moved: NDArray[np.float64]
    yaw: NDArray[np.float64]
    not_settled: NDArray[np.bool_]
    leans: NDArray[np.bool_]
    force: NDArray[np.float64]
    broke: NDArray[np.bool_]
    off: NDArray[np.bool_]

    def level(self, rolls: bool, recordings: int) -> LevelResult:
        """How often it falls; and how often it falls, leans or, on castors, goes far."""
        far = rolls & (self.moved > ROLLS_FAR)
        fall = share_of(self.fell, recordings)
        return LevelResult(fall, share_of(self.fell | self.leans | far, recordings))

    @property
    def strap_force(self) -> StrapForce:
        """What its straps bear."""
        return StrapForce(*(observed(self.force, each) for each in (0.5, STRAP_SHARE, 1.0)))

    def surrounded(self, around: Surroundings, recordings: int) -> SurroundedResult:
        """What its surroundings do."""
        straps, edge = bool(around.straps), around.edge is not None
        return SurroundedResult(
            leans=share_of(self.leans, recordings),
            falls_or_leans=share_of(self.fell | self.leans, recordings),
            force=self.strap_force if straps else None,
            broke=share_of(self.broke, recordings) if straps else None,
            off=share_of(self.off, recordings) if edge else None,
        )

    def and_of(self, others: SolidRuns) -> SolidRuns:
        """These and those in other turns."""
        pairs = zip(self, others, strict=True)
        return SolidRuns(*(np.concatenate(pair, axis=1) for pair in pairs))


class InSpace(NamedTuple):
    """What becomes of one object: at the scale of the assessment, and at each of its levels."""

    result: SolidResult
    levels: Sequence[LevelResult]
    straps: Sequence[StrapTrial]


class ShakingInSpace(NamedTuple):
    """How the objects of one place are shaken as solids.

    Attributes:
        trial: motions of which each has both horizontal components; the general model.
        tilt: of what they stand on [rad], toward their fronts.
        castors: frictions of what stands on them.
        on_ground: whether the motions are those of the ground, and the objects stand higher.
    """

    trial: ShakingSet
    tilt: float
    castors: CastorFriction
    on_ground: bool = False

    @property
    def recordings(self) -> int:
        """How many independent ones the motions come from."""
        return int(self.trial.recording.max()) + 1

    def results(
        self, items: Sequence[Item], scales: Sequence[float], done: Done
    ) -> list[InSpace | None]:
        """What becomes of each item; None of those whose base is not known.

        Args:
            items: some.
            scales: factors on the motions, of the levels.
            done: is told how many more simulations were made.
        """
        stood = [self._stood(item) for item in items]
        known = [each for each in stood if each is not None]
        now = self._runs(known, self.trial, done)
        others = self._other_frictions(known, now, done)
        levels = [self._runs(known, self.trial.changed(scale=scale), done) for scale in scales]
        trials = self._in_straps(known, done)
        found = iter(
            InSpace(
                _result(each, now[k], others[k], self.recordings)._replace(
                    on_ground=self.on_ground
                ),
                [level[k].level(each.item.rolls, self.recordings) for level in levels],
                trials.get(k, ()),
            )
            for k, each in enumerate(known)
        )
        return [None if each is None else next(found) for each in stood]

    def _stood(self, item: Item) -> Stood | None:
        solid = solid_of(item, self.castors.free)
        if solid is None:
            return None
        return Stood(item, solid, 0.0 if item.rolls else self.tilt, in_space(item.surroundings))

    def _friction_of(self, item: Item) -> float:
        """Of the feet of an item; castors that are free have their own."""
        model = self.trial.model
        assert isinstance(model, General)
        return self.castors.locked if item.castors is Castors.LOCKED else model.static_friction

    def _runs(self, stood: Sequence[Stood], trial: ShakingSet, done: Done) -> list[SolidRuns]:
        """With the friction that each has."""

        def run(alike: list[Stood]) -> list[SolidRuns]:
            locked = alike[0].item.castors is Castors.LOCKED
            model = with_friction(trial.model, self.castors.locked) if locked else None
            ways = [each.ways(trial.motions) for each in alike]
            return run_solids(alike, ways, trial.changed(model=model), done)

        return grouped(stood, lambda each: each.item.castors is Castors.LOCKED, run)

    def _in_straps(self, stood: Sequence[Stood], done: Done) -> dict[int, list[StrapTrial]]:
        """What becomes of those that do not roll in each strap of TRIED, by their numbers.

        In half of the turns.
        """
        chosen = [
            k
            for k, each in enumerate(stood)
            if not each.item.rolls and asks_for_trial(each.item.surroundings)
        ]
        found: dict[int, list[StrapTrial]] = {k: [] for k in chosen}
        for stiffness, slack in TRIED:
            strapped = []
            for k in chosen:
                solid, around = in_strap(stood[k].solid, stood[k].around, stiffness, slack)
                strapped.append(stood[k]._replace(solid=solid, around=around))
            ways = [halves(each.ways(self.trial.motions))[0] for each in strapped]
            for k, runs in zip(chosen, run_solids(strapped, ways, self.trial, done), strict=True):
                fall = share_of(runs.fell, self.recordings)
                leans = share_of(runs.leans, self.recordings)
                found[k].append(StrapTrial(stiffness, slack, fall, leans, runs.strap_force))
        return found

    def _other_frictions(
        self, stood: Sequence[Stood], now: Sequence[SolidRuns], done: Done
    ) -> list[list[FrictionResult]]:
        """With others, of what does not roll freely, where friction holds it on its tilt.

        Half of the turns are simulated at first, under all motions, and the rest where either share
        of falls lies outside the other's interval.
        """

        def share(runs: SolidRuns) -> Share:
            return share_of(runs.fell | runs.leans, self.recordings)

        found: list[list[FrictionResult]] = [[] for _ in stood]
        for friction in FRICTIONS:
            held = [
                k
                for k, each in enumerate(stood)
                if each.item.castors is not Castors.FREE
                and math.tan(each.tilt) < friction != self._friction_of(each.item)
            ]
            trial = self.trial.changed(model=with_friction(self.trial.model, friction))
            parts = [halves(stood[k].ways(trial.motions)) for k in held]
            firsts = run_solids([stood[k] for k in held], [part[0] for part in parts], trial, done)
            runs = dict(zip(held, firsts, strict=True))
            rest = {
                k: part[1]
                for k, part in zip(held, parts, strict=True)
                if len(part) > 1 and not agree(share(runs[k]), share(now[k]))
            }
            more = run_solids([stood[k] for k in rest], list(rest.values()), trial, done)
            for k, others in zip(rest, more, strict=True):
                runs[k] = runs[k].and_of(others)
            for k, each in runs.items():
                moved = observed_quartiles(each.moved[~each.fell]).median
                fall, worse = share_of(each.fell, self.recordings), share(each)
                worse_too = worse if stood[k].around else None
                found[k].append(FrictionResult(friction, fall, moved, worse_too))
        return found


def model_of_solids(model: Model) -> General | None:
    """The general model that does to solids what a model does in its plane, None if none does."""
    if isinstance(model, Rocking) and model.restitution is None:
        return General(restitution_factor=model.restitution_factor)
    return model if isinstance(model, General) else None


def run_solids(
    stood: Sequence[Stood], ways: Sequence[Ways], trial: ShakingSet, done: Done
) -> list[SolidRuns]:
    """Simulate objects under every motion, in some polarities and turns.

    Args:
        stood: some.
        ways: the turns of each.
        trial: motions, their scale, and the general model.
        done: is told how many more simulations were made.
    """
    if not stood:
        return []
    assert isinstance(trial.model, General)
    count = 0
    batches = []
    for body, (each, of_motions) in enumerate(zip(stood, ways, strict=True)):
        for k, (motion, some) in enumerate(zip(trial.motions, of_motions, strict=True)):
            stands = _stands(each, some, trial.scale)
            members = count + np.arange(len(stands))
            for own, around in _together(each, stands):
                batches.append(
                    SolidBatch(body, each.solid, k, motion, members[own], stands[own], around)
                )
            count += len(stands)
    require_stands(
        [batch.solid for batch in batches],
        [batch.stands for batch in batches],
        [batch.surroundings for batch in batches],
    )
    surroundings = list({batch.surroundings for batch in batches})
    found = result_fields.Results(result_fields.SOLID, count, surroundings)
    kinds.run(tasks_of(trial.model, batches), count, found.store, None, done)
    ends = np.cumsum([each.size for each in ways])
    parts = {name: np.split(values, ends[:-1]) for name, values in found.arrays.items()}
    return [
        _runs_of(each, of_motions, {name: values[k] for name, values in parts.items()})
        for k, (each, of_motions) in enumerate(zip(stood, ways, strict=True))
    ]


def _stands(stood: Stood, turns: NDArray[np.float64], scale: float) -> NDArray[np.float64]:
    """The runs of an object under one motion, from its turns, (polarity, turn)."""
    polarities = np.repeat(stood.polarities, turns.shape[1]).tolist()
    angles = turns.ravel().tolist()
    supports = [Support(tilt=stood.tilt, azimuth=math.pi + turn) for turn in angles]
    return stands_of(supports, angles, [scale] * len(angles), polarities)


def _together(
    stood: Stood, stands: NDArray[np.float64]
) -> list[tuple[NDArray[np.intp], Surroundings | None]]:
    """The numbers of the runs with the same surroundings, which turn with an object, and these."""
    if not stood.around:
        return [(np.arange(len(stands)), None)]
    turns, which = np.unique(stands[:, ORIENTATION], return_inverse=True)
    return [
        (np.flatnonzero(which == k), stood.around.turned(turn))
        for k, turn in enumerate(turns.tolist())
    ]


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
    moving = not_settled(columns["ending"])
    strapped = bool(stood.around and stood.around.straps)
    return SolidRuns(
        fell=columns["outcome"] != Outcome.STANDING,
        toward=np.remainder(columns["fall_azimuth"] - turns, 2 * math.pi),
        moved=np.hypot(columns["displacement_x"], columns["displacement_y"]),
        yaw=np.abs(columns["yaw"]),
        not_settled=moving,
        leans=columns.get("leaning", np.zeros(turns.shape, np.bool_)) | (moving & strapped),
        force=force / weight,
        broke=broke,
        off=columns.get("off_edge", np.zeros(turns.shape, np.bool_)),
    )


def _result(
    stood: Stood, runs: SolidRuns, others: Sequence[FrictionResult], recordings: int
) -> SolidResult:
    item, around, fell = stood.item, stood.around, runs.fell
    ways = [share_of(fell[:, k], recordings) for k in range(fell.shape[1])]
    return SolidResult(
        simulations=fell.size,
        recordings=recordings,
        falls=int(fell.sum()),
        level=runs.level(item.rolls, recordings),
        sides=_sides(runs.toward[fell] if fell.shape[1] > 1 or item.facing is not None else NONE),
        turned=ways,
        frictions=tuple(others),
        moved=observed_quartiles(runs.moved[~fell]),
        yaw=observed_quartiles(runs.yaw[~fell]),
        not_settled=int(runs.not_settled.sum()),
        surrounded=runs.surrounded(around, recordings) if around else None,
    )


def _sides(toward: NDArray[np.float64]) -> Sides:
    """Shares of falls by the side toward which they go, within 45°; NaN without falls."""
    if not toward.size:
        return Sides(*(math.nan,) * 4)
    # its x goes backward and its y to the left
    quarter = np.floor(toward / (math.pi / 2) + 0.5).astype(int) % 4
    backward, left, forward, right = np.bincount(quarter, minlength=4) / toward.size
    return Sides(float(forward), float(backward), float(left), float(right))
