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
from shaketable.assess.frictions import frictions_of
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
from shaketable.inventory import Castors, Item
from shaketable.models import Rocking, with_friction
from shaketable.simulate import Trial
from shaketable.tilting import TILTS, TiltCurves, count_outcomes, curves_of


class Settings(NamedTuple):
    """What holds for all floors."""

    tilt: float  # rad, of what the items stand on now
    control: float
    levels: Sequence[float]  # factors on the motions
    castors: CastorFriction


class Place(NamedTuple):
    """What the items of one place have in common."""

    trial: Trial
    settings: Settings
    draws: NDArray[np.float64]  # weights of what was observed and of draws, as by `resamples`
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]]  # of the motions

    def runs(self, profiles: Sequence[Profile], scale: float, done: Done) -> list[ProfileRuns]:
        """Simulations of profiles with a factor on the motions, what rolls in the general model."""
        rocking = self.trial.changed(scale=scale)
        castors = self.settings.castors
        rolling = {Castors.FREE: castors.free, Castors.LOCKED: castors.locked}

        def run(alike: list[Profile]) -> list[ProfileRuns]:
            friction = rolling.get(alike[0].item.castors)
            model = None if friction is None else with_friction(rocking.model, friction)
            return run_profiles(alike, rocking.changed(model=model), done)

        return grouped(profiles, lambda profile: rolling.get(profile.item.castors), run)


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
    return [
        ItemResult(
            **vars(found[lead]),
            other=next((found[k] for k in span if k != lead), None),
            locked=if_locked,
            levels=[
                LevelResult(
                    max(level[k].fall for k in span),
                    max(level[k].concern(profiles[k]) for k in span),
                )
                for level in levels
            ],
            **measure._asdict(),
        )
        for span, lead, measure, if_locked in zip(spans, leading, measures, locked, strict=True)
    ]


def _with_bases(
    found: list[ProfileResult], leading: set[int], trial: Trial, done: Done
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
    """What rolls freely, in its worse direction, if its castors were locked."""
    found: list[ProfileResult | None] = [None] * len(items)
    free = [k for k, item in enumerate(items) if item.castors is Castors.FREE]
    for k in free:
        profiles = profiles_of(replace(items[k], castors=Castors.LOCKED), 0.0)
        runs = place.runs(profiles, place.trial.scale, done)
        results = [result_of(*pair, place.draws) for pair in zip(profiles, runs, strict=True)]
        found[k] = max(results, key=_severity)
    return found


def _severity(result: ProfileResult) -> tuple[float, ...]:
    """What makes one direction worse than the other."""
    slip = result.sliding.slip.upper if result.sliding else 0.0
    rotation = result.peak_rotation.upper
    far = math.inf if math.isnan(slip) else slip
    second = (far, rotation) if result.profile.item.rolls else (rotation, far)
    return (result.concern.value, *second, -result.profile.body.width)


class _Measures(NamedTuple):
    """What would help a profile, and what is shown beside it; names as in ItemResult."""

    curves: TiltCurves | None = None
    holds: Sequence[AnchorForce] = ()
    frictions: Sequence[FrictionResult] = ()
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None


def _measures_of(
    profiles: Sequence[Profile], runs: Sequence[ProfileRuns], place: Place, done: Done
) -> list[_Measures]:
    """What would help each profile: tilts and forces; criteria and frictions beside that."""
    trial, settings = place.trial, place.settings
    extremes = extremes_of(trial.motions, trial.scale)
    measures = [
        _Measures()
        if profile.item.castors is Castors.FREE
        else _Measures(holds=anchor_forces(profiles_of(profile.item, settings.tilt), extremes))
        for profile in profiles
    ]
    still = [k for k, profile in enumerate(profiles) if not profile.item.rolls]
    if not still:
        return measures
    chosen = [profiles[k] for k in still]
    grid = count_outcomes([p.body for p in chosen], trial, TILTS, progress=done)
    rocks = isinstance(trial.model, Rocking)  # any other model says what friction does itself
    frictions = frictions_of(chosen, trial, done) if rocks else [()] * len(still)
    for n, k in enumerate(still):
        curves = curves_of(grid.body(n), place.draws, settings.control)
        measures[k] = measures[k]._replace(curves=curves, frictions=frictions[n])
    if settings.tilt == 0.0:  # the criteria do not know tilts
        stands = np.array([runs[k].stands for k in still])
        said = criteria_of(chosen, *place.peaks, stands)
        for k, (criteria, ratios) in zip(still, said, strict=True):
            measures[k] = measures[k]._replace(criteria=criteria, floor_ratios=ratios)
    return measures
