"""Whether the answer hangs on friction: the general model with other frictions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from shaketable.assess.profiles import Profile
from shaketable.assess.results import REACHED, FrictionResult
from shaketable.assess.runs import Done, ProfileRuns, run_profiles
from shaketable.demand import largest_demand
from shaketable.models import Rocking, with_friction
from shaketable.simulate import ShakingSet, simulate
from shaketable.support import Support

#: Static and kinetic: polished or dusty floors, most floors, rubber feet on a clean floor.
FRICTIONS = (0.3, 0.5, 0.7)


def frictions_of(
    profiles: Sequence[Profile], trial: ShakingSet, present: float, done: Done
) -> list[tuple[FrictionResult, ...]]:
    """What other frictions make of each profile on its tilt, where friction holds it there.

    Args:
        profiles: some.
        trial: motions, their scale, and the model.
        present: the friction with which they were simulated; infinite where nothing slides.
        done: is told how many more simulations were made.
    """
    found: list[list[FrictionResult]] = [[] for _ in profiles]
    for friction in FRICTIONS:
        if friction == present:
            continue
        rough = trial.changed(model=with_friction(trial.model, friction))
        held = [k for k, profile in enumerate(profiles) if math.tan(profile.tilt) < friction]
        runs = run_profiles([profiles[k] for k in held], rough, done)
        for k, now in zip(held, runs, strict=True):
            found[k].append(_result(profiles[k], friction, now))
    return [tuple(each) for each in found]


def friction_while_rocking(profile: Profile, trial: ShakingSet) -> float:
    """The friction with which REACHED of the motions that rock it do so without sliding.

    By the rocking model, one direction of each motion; NaN where none rocks it. Boroschek and Romo
    (2004), eq. 20.
    """
    model = Rocking(restitution_factor=trial.model.restitution_factor)
    support = Support(tilt=profile.tilt)
    demands = []
    for motion in trial.motions:
        run = simulate(profile.body, motion.scaled(trial.scale), support, model=model)
        if run.peak_rotation > 0.0:
            demands.append(largest_demand(run))
    return float(np.quantile(demands, REACHED, method="higher")) if demands else math.nan


def _result(profile: Profile, friction: float, now: ProfileRuns) -> FrictionResult:
    sliding = now.sliding(profile)
    assert sliding is not None
    return FrictionResult(friction, now.fall, sliding.slip.median)
