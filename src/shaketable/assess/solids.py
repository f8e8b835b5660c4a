"""Objects in three dimensions: solids that both horizontal components shake at once."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.assessment import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.results import ROLLS_FAR, FrictionResult, LevelResult, Sides, SolidResult
from shaketable.assess.runs import Done, grouped
from shaketable.assess.shares import Share, agree, observed_quartiles, share_of
from shaketable.engine.endings import not_settled
from shaketable.inventory import Castors, Item, solid_of
from shaketable.models import General, Model, Rocking, with_friction
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate import ShakingSet, kinds, result_fields
from shaketable.simulate.space import SolidBatch, require_stands, stands_of, tasks_of
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.tilting import TURNS

NONE = np.empty(0)
Ways = NDArray[np.float64]  # turns [rad], (motion, polarity, turn)


class Stood(NamedTuple):
    """An object on what it stands on."""

    item: Item
    solid: Solid
    tilt: float  # rad, toward its front

    def turns(self, motions: Sequence[Motion]) -> NDArray[np.float64]:
        """Angles from each motion's horizontal component to its depth [rad], (motion, turn).

        One angle, if the azimuths of its front and of the motions are known; otherwise TURNS
        angles over half a turn, without those that would repeat another. Half a turn of an object
        and its support is the reversed motion, which is simulated as well. On a level support a
        square looks the same after a quarter of a turn, and a circle always.
        """
        item, level = self.item, self.tilt == 0.0
        azimuths = [motion.origin.azimuth if motion.origin else None for motion in motions]
        if item.facing is not None and None not in azimuths:
            # compass azimuths go clockwise; its x goes from the front to the back
            along = np.radians(np.array(azimuths, np.float64))
            return np.remainder(along - item.facing - math.pi, 2 * math.pi)[:, None]
        if level and self.solid.round:
            return np.zeros((len(motions), 1))
        square = item.sideways == item.body and item.body.left == item.body.right
        turns = np.arange(TURNS) * (math.pi / 2 if level and square else math.pi) / TURNS
        return np.tile(turns, (len(motions), 1))

    @property
    def polarities(self) -> tuple[float, ...]:
        """Of the motions: reversed, one does the same to a circle on a level support."""
        same = self.tilt == 0.0 and self.solid.round
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
    """

    fell: NDArray[np.bool_]
    toward: NDArray[np.float64]
    moved: NDArray[np.float64]
    yaw: NDArray[np.float64]
    not_settled: NDArray[np.bool_]

    def level(self, rolls: bool, recordings: int) -> LevelResult:
        """How often it falls, and how often that, or on castors going far, is of concern."""
        fall = share_of(self.fell, recordings)
        far = share_of(self.fell | (self.moved > ROLLS_FAR), recordings)
        return LevelResult(fall, far if rolls else fall)

    def and_of(self, others: SolidRuns) -> SolidRuns:
        """These and those in other turns."""
        pairs = zip(self, others, strict=True)
        return SolidRuns(*(np.concatenate(pair, axis=1) for pair in pairs))


class InSpace(NamedTuple):
    """What becomes of one object: at the scale of the assessment, and at each of its levels."""

    result: SolidResult
    levels: Sequence[LevelResult]


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
        found = iter(
            InSpace(
                _result(each.item, now[k], others[k], self.recordings)._replace(
                    on_ground=self.on_ground
                ),
                [level[k].level(each.item.rolls, self.recordings) for level in levels],
            )
            for k, each in enumerate(known)
        )
        return [None if each is None else next(found) for each in stood]

    def _stood(self, item: Item) -> Stood | None:
        solid = solid_of(item, self.castors.free)
        if solid is None:
            return None
        return Stood(item, solid, 0.0 if item.rolls else self.tilt)

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

    def _other_frictions(
        self, stood: Sequence[Stood], now: Sequence[SolidRuns], done: Done
    ) -> list[list[FrictionResult]]:
        """With others, of what does not roll freely, where friction holds it on its tilt.

        Half of the turns are simulated at first, under all motions, and the rest where either share
        of falls lies outside the other's interval.
        """

        def share(runs: SolidRuns) -> Share:
            return share_of(runs.fell, self.recordings)

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
                found[k].append(FrictionResult(friction, share(each), moved))
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
            batches.append(SolidBatch(body, each.solid, k, motion, members, stands, None))
            count += len(stands)
    require_stands(
        [batch.solid for batch in batches],
        [batch.stands for batch in batches],
        [batch.surroundings for batch in batches],
    )
    found = result_fields.Results(result_fields.SOLID, count)
    kinds.run(tasks_of(trial.model, batches), count, found.store, None, done)
    ends = np.cumsum([each.size for each in ways])
    parts = {name: np.split(values, ends[:-1]) for name, values in found.arrays.items()}
    return [
        _runs_of(of_motions, {name: values[k] for name, values in parts.items()})
        for k, of_motions in enumerate(ways)
    ]


def _stands(stood: Stood, turns: NDArray[np.float64], scale: float) -> NDArray[np.float64]:
    """The runs of an object under one motion, from its turns, (polarity, turn)."""
    polarities = np.repeat(stood.polarities, turns.shape[1]).tolist()
    angles = turns.ravel().tolist()
    supports = [Support(tilt=stood.tilt, azimuth=math.pi + turn) for turn in angles]
    return stands_of(supports, angles, [scale] * len(angles), polarities)


def _runs_of(ways: Ways, runs: Mapping[str, NDArray[Any]]) -> SolidRuns:
    """The runs of an object in some ways."""
    turns = ways.reshape(-1, ways.shape[2])
    columns = {name: values.reshape(turns.shape) for name, values in runs.items()}
    return SolidRuns(
        fell=columns["outcome"] != Outcome.STANDING,
        toward=np.remainder(columns["fall_azimuth"] - turns, 2 * math.pi),
        moved=np.hypot(columns["displacement_x"], columns["displacement_y"]),
        yaw=np.abs(columns["yaw"]),
        not_settled=not_settled(columns["ending"]),
    )


def _result(
    item: Item, runs: SolidRuns, others: Sequence[FrictionResult], recordings: int
) -> SolidResult:
    fell = runs.fell
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
    )


def _sides(toward: NDArray[np.float64]) -> Sides:
    """Shares of falls by the side toward which they go, within 45°; NaN without falls."""
    if not toward.size:
        return Sides(*(math.nan,) * 4)
    # its x goes backward and its y to the left
    quarter = np.floor(toward / (math.pi / 2) + 0.5).astype(int) % 4
    backward, left, forward, right = np.bincount(quarter, minlength=4) / toward.size
    return Sides(float(forward), float(backward), float(left), float(right))
