"""What becomes of objects in three dimensions, shaken by both horizontal components at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.castors import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.results import FrictionResult, LevelResult, Sides, SolidResult
from shaketable.assess.runs import Done
from shaketable.assess.shares import Share, is_worse, observed_quartiles, share_of
from shaketable.assess.solid_runs import SolidRuns, run_solids
from shaketable.assess.stood import Stood, one_of_each
from shaketable.inventory import Castors, Item, solid_of
from shaketable.models import General, Model, Rocking
from shaketable.simulate import ShakingSet

NONE = np.empty(0)


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
    """

    trial: ShakingSet
    tilt: float
    castors: CastorFriction

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
        stood = [self.stood(item) for item in items]
        known = [each for each in stood if each is not None]
        now = self.runs(known, self.trial, done)
        others = self._other_frictions(known, now, done)
        levels = [self.runs(known, self.trial.changed(scale=scale), done) for scale in scales]
        found = iter(
            InSpace(
                _result(each, now[k], others[k], self.recordings),
                [level[k].level(each.item.rolls, self.recordings) for level in levels],
            )
            for k, each in enumerate(known)
        )
        return [None if each is None else next(found) for each in stood]

    def stood(self, item: Item) -> Stood | None:
        """An item as it stands; None where its base is not known."""
        solid = solid_of(item, self.castors.free)
        if solid is None:
            return None
        return Stood(
            item,
            solid,
            tilt=0.0 if item.rolls else self.tilt,
            around=item.surroundings,
            friction=self.castors.locked if item.castors is Castors.LOCKED else None,
        )

    def runs(self, stood: Sequence[Stood], trial: ShakingSet, done: Done) -> list[SolidRuns]:
        """All runs of objects: in all turns and polarities."""
        return run_solids(stood, [each.ways(trial.motions) for each in stood], trial, done)

    def _friction_of(self, stood: Stood) -> float:
        """Of the feet of an object; castors that are free have their own."""
        model = self.trial.model
        assert isinstance(model, General)
        return model.static_friction if stood.friction is None else stood.friction

    def _other_frictions(
        self, stood: Sequence[Stood], now: Sequence[SolidRuns], done: Done
    ) -> list[list[FrictionResult]]:
        """With others, of what does not roll freely, where friction holds it on its tilt.

        Each motion is met in one of the ways at first, and in all where more fall, so that either
        share lies outside the other's interval: the worst of all frictions decides the class, and
        is to be known as well as the object's own.
        """

        def share(runs: SolidRuns) -> Share:
            return share_of(runs.fell | runs.held_up, self.recordings)

        found: list[list[FrictionResult]] = [[] for _ in stood]
        for friction in FRICTIONS:
            held = [
                k
                for k, each in enumerate(stood)
                if each.item.castors is not Castors.FREE
                and math.tan(each.tilt) < friction != self._friction_of(each)
            ]
            trial = self.trial
            rough = [each._replace(friction=friction) for each in stood]
            tried = [rough[k] for k in held]
            once = [one_of_each(each.ways(trial.motions)) for each in tried]
            runs = dict(zip(held, run_solids(tried, once, trial, done), strict=True))
            worse = [k for k in held if is_worse(share(runs[k]), share(now[k]))]
            runs |= zip(worse, self.runs([rough[k] for k in worse], trial, done), strict=True)
            done(_not_needed(stood, held, worse, trial))
            for k, each in runs.items():
                moved = observed_quartiles(each.moved[~each.fell]).median
                fall = share_of(each.fell, self.recordings)
                falls_or_held_up = share(each) if stood[k].around else None
                found[k].append(FrictionResult(friction, fall, moved, falls_or_held_up))
        return found


def _not_needed(
    stood: Sequence[Stood], held: Sequence[int], worse: Sequence[int], trial: ShakingSet
) -> int:
    """How many of the simulations with another friction that were planned are not made."""
    count = 0
    for k, each in enumerate(stood):
        if each.item.castors is not Castors.FREE and k not in worse:
            ways = each.ways(trial.motions)
            count += ways.size + (0 if k in held else len(ways))
    return count


def model_of_solids(model: Model) -> General | None:
    """The general model that does to solids what a model does in its plane, None if none does."""
    if isinstance(model, Rocking) and model.restitution is None:
        return General(restitution_factor=model.restitution_factor)
    return model if isinstance(model, General) else None


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
        sides=sides_of(runs.toward[fell] if fell.shape[1] > 1 or item.facing is not None else NONE),
        turned=ways,
        frictions=tuple(others),
        moved=observed_quartiles(runs.moved[~fell]),
        yaw=observed_quartiles(runs.yaw[~fell]),
        not_settled=int(runs.not_settled.sum()),
        surrounded=runs.surrounded(around, recordings) if around else None,
    )


def sides_of(toward: NDArray[np.float64]) -> Sides:
    """Shares of falls by the side toward which they go, within 45°; NaN without falls."""
    if not toward.size:
        return Sides(*(math.nan,) * 4)
    # its x goes backward and its y to the left
    quarter = np.floor(toward / (math.pi / 2) + 0.5).astype(int) % 4
    backward, left, forward, right = np.bincount(quarter, minlength=4) / toward.size
    return Sides(float(forward), float(backward), float(left), float(right))
