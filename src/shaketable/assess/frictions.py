"""Whether the answer hangs on friction: the general model with other frictions."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess.profiles import Profile
from shaketable.assess.results import FrictionResult
from shaketable.assess.runs import Done, ProfileRuns, run_profiles
from shaketable.models import with_friction
from shaketable.simulate import Trial

#: Static and kinetic: polished or dusty floors, most floors, rubber feet on a clean floor.
FRICTIONS = (0.3, 0.5, 0.7)


def frictions_of(
    profiles: Sequence[Profile], trial: Trial, present: float, done: Done
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


def _result(profile: Profile, friction: float, now: ProfileRuns) -> FrictionResult:
    sliding = now.sliding(profile)
    assert sliding is not None
    return FrictionResult(friction, now.fall, sliding.slip.median)
