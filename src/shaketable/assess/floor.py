"""How the objects of one floor are shaken, and what becomes of them there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from shaketable.assess.alike import as_simulated, result_for
from shaketable.assess.assessment import FloorAssessment, Level
from shaketable.assess.bases import BASE_GRID, FINER_BASES
from shaketable.assess.castors import CastorFriction
from shaketable.assess.classes import CLASSES
from shaketable.assess.criteria import peaks_of
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.item_result import ItemResult
from shaketable.assess.place import results_of
from shaketable.assess.plane import Plane
from shaketable.assess.results import UncertainResult
from shaketable.assess.shaking import Shaking
from shaketable.assess.shares import Share
from shaketable.assess.solids import ShakingInSpace, model_of_solids
from shaketable.assess.uncertainty import MEMBERS, uncertain_in_space, uncertain_results
from shaketable.errors import InputError
from shaketable.inventory import Castors, Item
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Done
from shaketable.resampling import recordings_of, resamples
from shaketable.simulate import ShakingSet
from shaketable.tilting import TILTS, pieces


class Floor(NamedTuple):
    """How the objects of a floor are shaken."""

    motions: Shaking
    plane: Plane
    space: ShakingInSpace | None

    @property
    def recordings(self) -> int:
        return self.plane.recordings

    def planned(self, items: Sequence[Item], uncertainty: bool) -> int:
        """About how many simulations tell what becomes of items; of those that are alike one."""
        plane = 2 * len(self.plane.trial.motions)
        levels = 1 + len(self.plane.levels)
        flat = plane * (2 * levels + len(FRICTIONS) + TILTS.size + BASE_GRID.size + FINER_BASES)
        flat += plane * MEMBERS if uncertainty else 0
        total = 0
        every = [each for item in items for each in lock_states(item)]
        for item in {as_simulated(item): item for item in every}.values():
            stood = self.space and self.space.stood(item)
            if not (self.space and stood):
                total += int(flat)
                continue
            ways = stood.ways(self.space.trial.motions)
            total += ways.size * levels
            if item.castors is not Castors.FREE:  # in one way each, and in all where more fall
                total += len(FRICTIONS) * (len(ways) + ways.size)
            total += plane // 2 * MEMBERS if uncertainty else 0
        return total

    def assessed(self, items: Sequence[Item], uncertainty: bool, done: Done) -> list[ItemResult]:
        """What becomes of items, some at a time, so that simulations of all need not be kept.

        What moves alike is simulated once. Of castors that may be locked or free both are, and
        the worse is the result.
        """
        ways = [lock_states(item) for item in items]
        found = iter(self._assessed([each for some in ways for each in some], uncertainty, done))
        return [max((next(found) for _ in some), key=_how_bad) for some in ways]

    def _assessed(self, items: Sequence[Item], uncertainty: bool, done: Done) -> list[ItemResult]:
        kinds: dict[Item, Item] = {}
        for item in items:
            kinds.setdefault(as_simulated(item), item)
        some_of_each, results = list(kinds.values()), []
        for some in pieces(len(kinds), 2 * len(self.plane.trial.motions) * TILTS.size):
            found = results_of(some_of_each[some], self.plane, self.space, done)
            results += self._with_uncertainty(found, done) if uncertainty else found
        known = dict(zip(kinds, results, strict=True))
        return [result_for(item, known[as_simulated(item)], self.plane.tilt) for item in items]

    def _with_uncertainty(self, results: Sequence[ItemResult], done: Done) -> list[ItemResult]:
        """The results with what becomes of objects like each; not of what rolls or is held."""
        chosen = [
            k for k, each in enumerate(results) if not (each.item.rolls or each.item.surroundings)
        ]
        flat = [k for k in chosen if results[k].solid is None]
        profiles = [results[k].profile for k in flat]
        known: dict[int, UncertainResult] = {}
        if flat:
            known |= zip(flat, uncertain_results(profiles, self.plane.trial, done), strict=True)
        if self.space is not None:
            solids = [k for k in chosen if results[k].solid is not None]
            items = [results[k].item for k in solids]
            found = uncertain_in_space(items, self.space, done)
            known |= zip(solids, found, strict=True)
        return [replace(result, uncertain=known.get(k)) for k, result in enumerate(results)]

    def as_found(self, label: str, results: Sequence[ItemResult]) -> FloorAssessment:
        """What was found on it."""
        motions = self.plane.trial.motions
        pga = self.plane.peaks[0]
        return FloorAssessment(
            floor=label,
            results=results,
            motions=tuple(motion.name for motion in self.motions.pairs or motions),
            recordings=self.recordings,
            pairs=len(self.motions.pairs),
            smallest_pga=float(pga.min()),
            largest_pga=float(pga.max()),
            artificial=all(_is_artificial(motion) for motion in motions),
        )


def _how_bad(result: ItemResult) -> tuple[int, Share, Share]:
    """Its class, then how often it falls, then how often it falls or goes far."""
    risk = CLASSES.index(result.risk) if result.risk in CLASSES else -1
    return risk, result.overturns, result.governing_share


def lock_states(item: Item) -> list[Item]:
    """An item, or where it is not known whether its castors are locked, both that it may be."""
    if item.castors is not Castors.SOME:
        return [item]
    states = (Castors.FREE, Castors.LOCKED)
    return [replace(item, castors=each, lock_known=False) for each in states]


def _is_artificial(motion: Motion) -> bool:
    """Whether a motion was made, as its origin says first of all."""
    steps = motion.origin.processing if motion.origin else ()
    return bool(steps) and steps[0].startswith("artificial")


def floor_of(
    motions: Sequence[Motion],
    planar: bool,
    scale: float,
    tilt: float,
    control: float,
    levels: Sequence[Level],
    model: Model,
    castors: CastorFriction,
) -> Floor:
    """How the objects of a floor are shaken; arguments as for `assess`."""
    shaking = Shaking.of(motions, planar)
    trial = ShakingSet(shaking.components, scale, model)
    if shaking.pairs:  # both components are of the recording of their pair
        trial.__dict__["recording"] = np.repeat(recordings_of(shaking.pairs), 2)
    plane = Plane(
        trial=trial,
        tilt=tilt,
        control=control,
        levels=[level.scale for level in levels],
        castors=castors,
        draws=resamples(int(trial.recording.max()) + 1),
        peaks=peaks_of(trial),
    )
    space = None
    if shaking.pairs:
        pairs = ShakingSet(shaking.pairs, scale, model_in_space(model))
        space = ShakingInSpace(pairs, tilt, castors)
    return Floor(shaking, plane, space)


def model_in_space(model: Model) -> Model:
    """The model of solids that goes with a planar one; InputError where there is none."""
    general = model_of_solids(model)
    if general is None:
        raise InputError(
            f"{model!r} is for planar=True: solids know General(...) and Rocking() without "
            "restitution="
        )
    return general
