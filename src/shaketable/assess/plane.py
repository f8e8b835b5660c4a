"""Items in a plane, by one component at a time: as they stand, and what would help there.

Where three dimensions decide, the plane proposes: a base, a tilt.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.anchors import anchor_forces, extremes_of
from shaketable.assess.bases import safe_bases
from shaketable.assess.castors import CastorFriction
from shaketable.assess.criteria import criteria_of
from shaketable.assess.frictions import FRICTIONS, friction_while_rocking, frictions_of
from shaketable.assess.item_result import ItemResult, ProfileResult
from shaketable.assess.profiles import Profile, profiles_of
from shaketable.assess.results import ACCEPTED_FALLS, FrictionResult, LevelResult
from shaketable.assess.runs import Done, ProfileRuns, grouped, result_of, run_profiles
from shaketable.inventory import Castors, Item
from shaketable.models import General, Rocking, with_friction
from shaketable.simulate import ShakingSet
from shaketable.tilting import TILTS, TiltCurves, count_outcomes, curves_of


class Plane(NamedTuple):
    """How the items of one place are shaken in a plane.

    Attributes:
        trial: motions of one component, their scale, and the model.
        tilt: of what the items stand on now [rad], toward their fronts.
        control: wanted share of falls that go downhill.
        levels: factors on the motions, of levels of shaking.
        castors: frictions of what stands on them.
        draws: weights of what was observed and of draws, as by `resamples`.
        peaks: of the motions, as by `peaks_of`.
    """

    trial: ShakingSet
    tilt: float
    control: float
    levels: Sequence[float]
    castors: CastorFriction
    draws: NDArray[np.float64]
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]]

    @property
    def recordings(self) -> int:
        """How many independent ones the motions come from."""
        return int(self.trial.recording.max()) + 1

    def friction_of(self, item: Item) -> float:
        """The static friction with which an item is simulated; infinite where nothing slides."""
        own = {Castors.FREE: self.castors.free, Castors.LOCKED: self.castors.locked}
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


def severity(result: ProfileResult) -> tuple[float, ...]:
    """What makes one direction worse than the other."""
    slip = result.sliding.slip.upper if result.sliding else 0.0
    far = math.inf if math.isnan(slip) else slip
    far = far if result.profile.item.rolls else 0.0
    return (result.fall.value, result.governing_share.value, far, -result.profile.body.base)


def beside(
    profiles: Sequence[Profile], runs: Sequence[ProfileRuns], plane: Plane
) -> list[dict[str, Any]]:
    """What is told beside any result, by its name in ItemResult: static forces and criteria."""
    trial = plane.trial
    extremes = extremes_of(trial.motions, trial.scale)
    told: list[dict[str, Any]] = [
        {
            "friction": plane.friction_of(profile.item),
            "anchor_forces": anchor_forces(profiles_of(profile.item, plane.tilt), extremes),
        }
        for profile in profiles
    ]
    still = _not_rolling(profiles)
    if still and plane.tilt == 0.0:  # the criteria do not know tilts
        stands = np.array([runs[k].stands for k in still])
        said = criteria_of([profiles[k] for k in still], *plane.peaks, stands)
        for k, (criteria, ratios) in zip(still, said, strict=True):
            told[k] |= {"criteria": criteria, "floor_ratios": ratios}
    return told


def levels_of(items: Sequence[Item], plane: Plane, done: Done) -> list[list[LevelResult]]:
    """Each item at each level, in the worse of its directions."""
    each = [profiles_of(item, plane.tilt) for item in items]
    profiles = [profile for some in each for profile in some]
    found: list[list[LevelResult]] = [[] for _ in items]
    for scale in plane.levels:
        runs = iter(plane.runs(profiles, scale, done))
        for levels, some in zip(found, each, strict=True):
            own = [(next(runs), profile) for profile in some]
            levels.append(
                LevelResult(
                    max(run.fall for run, _ in own),
                    max(run.governing_share(profile) for run, profile in own),
                )
            )
    return found


def with_bases(results: Sequence[ItemResult], plane: Plane, done: Done) -> list[ItemResult]:
    """Results with a safe base in each direction, but of what rolls.

    In the other direction of an item one is sought where it falls too often.
    """
    sides: dict[tuple[int, bool], Profile] = {}
    for k, result in enumerate(results):
        if result.item.rolls:
            continue
        sides[k, True] = result.profile
        if result.other is not None and result.other.fall.value > ACCEPTED_FALLS:
            sides[k, False] = result.other.profile
    profiles = list(sides.values())
    found = grouped(
        profiles,
        lambda profile: profile.tilt,
        lambda some: safe_bases([p.body for p in some], some[0].tilt, plane.trial, done).tolist(),
    )
    width = dict(zip(sides, found, strict=True))
    return [
        replace(
            result,
            safe_base=width.get((k, True), math.nan),
            other=result.other and replace(result.other, safe_base=width.get((k, False), math.nan)),
        )
        for k, result in enumerate(results)
    ]


def curves_among(profiles: Sequence[Profile], plane: Plane, done: Done) -> list[TiltCurves]:
    """Shares over the tilts tried, of profiles that do not roll."""
    if not profiles:
        return []
    grid = count_outcomes([p.body for p in profiles], plane.trial, TILTS, progress=done)
    return [curves_of(grid.body(k), plane.draws, plane.control) for k in range(len(profiles))]


def searches_of(profiles: Sequence[Profile], plane: Plane, done: Done) -> list[dict[str, Any]]:
    """Tilts and frictions of profiles of which a plane decides, by their names in ItemResult."""
    told: list[dict[str, Any]] = [{} for _ in profiles]
    for k, frictions in _other_frictions(profiles, plane, done).items():
        told[k]["frictions"] = frictions
    still = _not_rolling(profiles)
    curves = curves_among([profiles[k] for k in still], plane, done)
    for k, found in zip(still, curves, strict=True):
        needed = friction_while_rocking(profiles[k], plane.trial)
        told[k] |= {"curves": found, "rocking_friction": needed}
    return told


def if_locked(items: Sequence[Item], plane: Plane, done: Done) -> list[ProfileResult | None]:
    """What rolls freely, in its worse direction and friction, if its castors were locked."""
    found: list[ProfileResult | None] = [None] * len(items)
    slippery = plane.castors.locked
    trial = plane.trial
    for k, item in enumerate(items):
        if item.castors is not Castors.FREE:
            continue
        profiles = profiles_of(replace(item, castors=Castors.LOCKED), 0.0)
        results = []
        for friction in (slippery, *(each for each in FRICTIONS if each > slippery)):
            rough = trial.changed(model=with_friction(trial.model, friction))
            runs = run_profiles(profiles, rough, done)
            results += [result_of(*pair, plane.draws) for pair in zip(profiles, runs, strict=True)]
        found[k] = max(results, key=severity)
    return found


def _not_rolling(profiles: Sequence[Profile]) -> list[int]:
    """The numbers of those that do not roll."""
    return [k for k, profile in enumerate(profiles) if not profile.item.rolls]


def _other_frictions(
    profiles: Sequence[Profile], plane: Plane, done: Done
) -> Mapping[int, tuple[FrictionResult, ...]]:
    """Results at FRICTIONS of profiles that do not roll freely, by their numbers."""
    if not isinstance(plane.trial.model, (Rocking, General)):
        return {}  # a model of one's own says what friction does itself
    found: dict[int, tuple[FrictionResult, ...]] = {}
    for friction in {plane.friction_of(profile.item) for profile in profiles}:
        which = [
            k
            for k, profile in enumerate(profiles)
            if profile.item.castors is not Castors.FREE
            and plane.friction_of(profile.item) == friction
        ]
        if which:
            chosen = [profiles[k] for k in which]
            tried = frictions_of(chosen, plane.trial, friction, done)
            found |= dict(zip(which, tried, strict=True))
    return found
