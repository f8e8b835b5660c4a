"""What becomes of the items of one place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.assessment import CastorFriction
from shaketable.assess.bases import safe_bases
from shaketable.assess.criteria import criteria_of
from shaketable.assess.frictions import frictions_of
from shaketable.assess.holds import holds_of
from shaketable.assess.present import Done, Present, grouped, present_runs, result_of
from shaketable.assess.profiles import Profile, profiles_of
from shaketable.assess.results import ItemResult, LevelResult, ProfileResult
from shaketable.inventory import Castors, Item
from shaketable.models import General
from shaketable.simulate import Trial
from shaketable.tilting import TILTS, count_outcomes, curves_of


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
    weights: NDArray[np.float64]  # of what was observed and of draws, as `resamples` gives them
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]]  # of the motions

    def runs(self, profiles: Sequence[Profile], scale: float, done: Done) -> list[Present]:
        """Simulations of profiles with a factor on the motions, what rolls in the general model."""
        rocking = self.trial.changed(scale=scale)
        castors = self.settings.castors
        rolling = {Castors.FREE: castors.free, Castors.LOCKED: castors.locked}

        def run(alike: list[Profile]) -> list[Present]:
            friction = rolling.get(alike[0].item.castors)
            model = None if friction is None else General(static_friction=friction)
            return present_runs(alike, rocking.changed(model=model), done)

        return grouped(profiles, lambda profile: rolling.get(profile.item.castors), run)


def results_of(items: Sequence[Item], place: Place, done: Done) -> list[ItemResult]:
    """What becomes of each of some items of a place; `done` is told how many were simulated."""
    each = [profiles_of(item, place.settings.tilt) for item in items]
    profiles = [profile for some in each for profile in some]
    ends = np.cumsum([len(some) for some in each]).tolist()
    spans = [range(end - len(some), end) for some, end in zip(each, ends, strict=True)]
    runs = place.runs(profiles, place.trial.scale, done)
    found = [result_of(*pair, place.weights) for pair in zip(profiles, runs, strict=True)]
    levels = [place.runs(profiles, scale, done) for scale in place.settings.levels]
    leading = [max(span, key=lambda k: _severity(found[k])) for span in spans]
    measures = measures_of([profiles[k] for k in leading], [runs[k] for k in leading], place, done)
    return [
        ItemResult(
            **vars(found[lead]),
            other=next((found[k] for k in span if k != lead), None),
            levels=[
                LevelResult(
                    max(level[k].fall for k in span),
                    max(level[k].concern(profiles[k]) for k in span),
                )
                for level in levels
            ],
            **measure,
        )
        for span, lead, measure in zip(spans, leading, measures, strict=True)
    ]


def _severity(result: ProfileResult) -> tuple[float, ...]:
    """What makes one direction worse than the other."""
    slip = result.sliding.slip.upper if result.sliding else 0.0
    rotation = result.peak_rotation.upper
    far = math.inf if math.isnan(slip) else slip
    second = (far, rotation) if result.profile.item.rolls else (rotation, far)
    return (result.concern.value, *second)


def measures_of(
    profiles: Sequence[Profile], runs: Sequence[Present], place: Place, done: Done
) -> list[dict[str, Any]]:
    """What would help each profile: tilts, bases, forces; criteria and frictions beside that."""
    measures: list[dict[str, Any]] = [{} for _ in profiles]
    still = [k for k, profile in enumerate(profiles) if not profile.item.rolls]
    if not still:
        return measures
    trial, (tilt, control, _, _) = place.trial, place.settings
    chosen = [profiles[k] for k in still]
    bodies = [profile.body for profile in chosen]
    grid = count_outcomes(bodies, trial, TILTS, progress=done)
    bases = grouped(
        chosen,
        lambda profile: profile.tilt,
        lambda some: safe_bases([p.body for p in some], some[0].tilt, trial, done).tolist(),
    )
    for n, (k, profile) in enumerate(zip(still, chosen, strict=True)):
        measures[k] = {
            "curves": curves_of(grid.body(n), place.weights, control),
            "safe_width": bases[n],
            "holds": holds_of(profile, trial.motions, trial.scale),
        }
    if not trial.model.slides:
        for k, frictions in zip(still, frictions_of(chosen, trial, done), strict=True):
            measures[k]["frictions"] = frictions
    if tilt == 0.0:  # the criteria do not know tilts
        stands = np.array([runs[k].stands for k in still])
        for k, (criteria, ratios) in zip(
            still, criteria_of(chosen, *place.peaks, stands), strict=True
        ):
            measures[k] |= {"criteria": criteria, "floor_ratios": ratios}
    return measures
