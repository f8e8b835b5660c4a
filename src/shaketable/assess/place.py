"""What becomes of the items of one place."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.anchors import anchor_forces, extremes_of
from shaketable.assess.assessment import CastorFriction
from shaketable.assess.bases import safe_bases
from shaketable.assess.criteria import criteria_of
from shaketable.assess.frictions import FRICTIONS, friction_while_rocking, frictions_of
from shaketable.assess.profiles import Profile, profiles_of
from shaketable.assess.results import (
    ACCEPTED_FALLS,
    AnchorForce,
    CriterionResult,
    FloorRatios,
    FrictionResult,
    ItemResult,
    LevelResult,
    ProfileResult,
)
from shaketable.assess.runs import Done, ProfileRuns, grouped, result_of, run_profiles
from shaketable.assess.solids import ShakingInSpace
from shaketable.inventory import Castors, Item
from shaketable.models import General, Rocking, with_friction
from shaketable.simulate import ShakingSet
from shaketable.tilting import TILTS, TiltCurves, count_outcomes, curves_of


class Settings(NamedTuple):
    """What holds for all floors."""

    tilt: float  # rad, of what the items stand on now
    control: float
    levels: Sequence[float]  # factors on the motions
    castors: CastorFriction


class Place(NamedTuple):
    """What the items of one place have in common."""

    trial: ShakingSet
    settings: Settings
    draws: NDArray[np.float64]  # weights of what was observed and of draws, as by `resamples`
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]]  # of the motions
    space: ShakingInSpace | None  # None where nothing is simulated in three dimensions

    def friction_of(self, item: Item) -> float:
        """The static friction with which an item is simulated; infinite where nothing slides."""
        castors = self.settings.castors
        own = {Castors.FREE: castors.free, Castors.LOCKED: castors.locked}
        model = self.trial.model
        usual = model.static_friction if isinstance(model, General) else math.inf
        return own.get(item.castors, usual)

    def runs(self, profiles: Sequence[Profile], scale: float, done: Done) -> list[ProfileRuns]:
        """Simulations of profiles with a factor on the motions, what rolls in the general model."""
        rocking = self.trial.changed(scale=scale)

        def run(alike: list[Profile]) -> list[ProfileRuns]:
            item = alike[0].item
            model = with_friction(rocking.model, self.friction_of(item)) if item.rolls else None
            return run_profiles(alike, rocking.changed(model=model), done)

        return grouped(profiles, lambda profile: profile.item.castors, run)


def results_of(items: Sequence[Item], place: Place, done: Done) -> list[ItemResult]:
    """What becomes of each of some items of a place; `done` is told how many were simulated."""
    each = [profiles_of(item, place.settings.tilt) for item in items]
    profiles = [profile for some in each for profile in some]
    ends = np.cumsum([len(some) for some in each]).tolist()
    spans = [range(end - len(some), end) for some, end in zip(each, ends, strict=True)]
    runs = place.runs(profiles, place.trial.scale, done)
    found = [result_of(*pair, place.draws) for pair in zip(profiles, runs, strict=True)]
    levels = [place.runs(profiles, scale, done) for scale in place.settings.levels]
    leading = [max(span, key=lambda k: _severity(found[k])) for span in spans]
    found = _with_bases(found, set(leading), place.trial, done)
    measures = _measures_of([profiles[k] for k in leading], [runs[k] for k in leading], place, done)
    locked = _if_locked(items, place, done)
    space, scales = place.space, place.settings.levels
    solids = space.results(items, scales, done) if space else [None] * len(items)
    made = [
        ItemResult(
            **vars(found[lead]),
            other=next((found[k] for k in span if k != lead), None),
            locked=if_locked,
            levels=[
                LevelResult(
                    max(level[k].fall for k in span),
                    max(level[k].governing_share(profiles[k]) for k in span),
                )
                for level in levels
            ],
            solid=solid and solid.result,
            straps=solid.straps if solid else (),
            **measure._asdict(),
        )
        for span, lead, measure, if_locked, solid in zip(
            spans, leading, measures, locked, solids, strict=True
        )
    ]
    return [
        replace(
            one,
            levels=[_in_space(*pair, one) for pair in zip(one.levels, solid.levels, strict=True)],
        )
        if solid and one.governing_3d
        else one
        for one, solid in zip(made, solids, strict=True)
    ]


def _in_space(plane: LevelResult, solid: LevelResult, item: ItemResult) -> LevelResult:
    """The item at one level, from its planar result and its result in three dimensions."""
    if item.as_it_stands:
        return solid
    on_ground = item.solid is not None and item.solid.on_ground
    fall = max(plane.fall, solid.fall) if on_ground else solid.fall
    return LevelResult(fall, max(plane.governing_share, solid.governing_share))


def _with_bases(
    found: list[ProfileResult], leading: set[int], trial: ShakingSet, done: Done
) -> list[ProfileResult]:
    """The results with a safe base, where they lead or fall too often, and do not roll."""
    chosen = [
        k
        for k, result in enumerate(found)
        if not result.profile.item.rolls and (k in leading or result.fall.value > ACCEPTED_FALLS)
    ]
    profiles = [found[k].profile for k in chosen]
    bases = grouped(
        profiles,
        lambda profile: profile.tilt,
        lambda some: safe_bases([p.body for p in some], some[0].tilt, trial, done).tolist(),
    )
    known = dict(zip(chosen, bases, strict=True))
    return [
        replace(result, safe_width=known[k]) if k in known else result
        for k, result in enumerate(found)
    ]


def _if_locked(items: Sequence[Item], place: Place, done: Done) -> list[ProfileResult | None]:
    """What rolls freely, in its worse direction and friction, if its castors were locked."""
    found: list[ProfileResult | None] = [None] * len(items)
    slippery = place.settings.castors.locked
    trial = place.trial
    for k, item in enumerate(items):
        if item.castors is not Castors.FREE:
            continue
        profiles = profiles_of(replace(item, castors=Castors.LOCKED), 0.0)
        results = []
        for friction in (slippery, *(each for each in FRICTIONS if each > slippery)):
            rough = trial.changed(model=with_friction(trial.model, friction))
            runs = run_profiles(profiles, rough, done)
            results += [result_of(*pair, place.draws) for pair in zip(profiles, runs, strict=True)]
        found[k] = max(results, key=_severity)
    return found


def _severity(result: ProfileResult) -> tuple[float, ...]:
    """What makes one direction worse than the other."""
    slip = result.sliding.slip.upper if result.sliding else 0.0
    far = math.inf if math.isnan(slip) else slip
    far = far if result.profile.item.rolls else 0.0
    return (result.fall.value, result.governing_share.value, far, -result.profile.body.width)


class _Measures(NamedTuple):
    """What would help a profile, and what is shown beside it; names as in ItemResult."""

    friction: float = math.inf
    curves: TiltCurves | None = None
    anchor_forces: Sequence[AnchorForce] = ()
    frictions: Sequence[FrictionResult] = ()
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None
    rocking_friction: float = math.nan


def _measures_of(
    profiles: Sequence[Profile], runs: Sequence[ProfileRuns], place: Place, done: Done
) -> list[_Measures]:
    """What would help each profile: tilts and forces; criteria and frictions beside that."""
    trial, settings = place.trial, place.settings
    extremes = extremes_of(trial.motions, trial.scale)
    measures = [
        _Measures(
            friction=place.friction_of(profile.item),
            anchor_forces=anchor_forces(profiles_of(profile.item, settings.tilt), extremes),
        )
        for profile in profiles
    ]
    for k, frictions in _other_frictions(profiles, place, done).items():
        measures[k] = measures[k]._replace(frictions=frictions)
    still = [k for k, profile in enumerate(profiles) if not profile.item.rolls]
    if not still:
        return measures
    chosen = [profiles[k] for k in still]
    for k in still:
        needed = friction_while_rocking(profiles[k], trial)
        measures[k] = measures[k]._replace(rocking_friction=needed)
    grid = count_outcomes([p.body for p in chosen], trial, TILTS, progress=done)
    for n, k in enumerate(still):
        curves = curves_of(grid.body(n), place.draws, settings.control)
        measures[k] = measures[k]._replace(curves=curves)
    if settings.tilt == 0.0:  # the criteria do not know tilts
        stands = np.array([runs[k].stands for k in still])
        said = criteria_of(chosen, *place.peaks, stands)
        for k, (criteria, ratios) in zip(still, said, strict=True):
            measures[k] = measures[k]._replace(criteria=criteria, floor_ratios=ratios)
    return measures


def _other_frictions(
    profiles: Sequence[Profile], place: Place, done: Done
) -> dict[int, tuple[FrictionResult, ...]]:
    """Results at FRICTIONS of profiles that do not roll freely, by their numbers."""
    if not isinstance(place.trial.model, (Rocking, General)):
        return {}  # a model of one's own says what friction does itself
    found: dict[int, tuple[FrictionResult, ...]] = {}
    for friction in {place.friction_of(profile.item) for profile in profiles}:
        which = [
            k
            for k, profile in enumerate(profiles)
            if profile.item.castors is not Castors.FREE
            and place.friction_of(profile.item) == friction
        ]
        if which:
            chosen = [profiles[k] for k in which]
            tried = frictions_of(chosen, place.trial, friction, done)
            found |= dict(zip(which, tried, strict=True))
    return found
