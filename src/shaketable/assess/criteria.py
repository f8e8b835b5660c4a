"""What the simple criteria say about each item, beside what the simulations show."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.profiles import Profile
from shaketable.assess.results import CriterionResult, FloorRatios
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.criteria.overturning import scores
from shaketable.signal import peaks
from shaketable.simulate import ShakingSet


def peaks_of(trial: ShakingSet) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Peak ground acceleration [m/s²] and velocity [m/s] of each scaled motion, (motion,) each."""
    found = [peaks(motion) for motion in trial.motions]
    pga = trial.scale * np.array([peak.acceleration for peak in found])
    pgv = trial.scale * np.array([peak.velocity for peak in found])
    return pga, pgv


def criteria_of(
    profiles: Sequence[Profile],
    pga: NDArray[np.float64],
    pgv: NDArray[np.float64],
    stands: NDArray[np.bool_],
) -> list[tuple[dict[str, CriterionResult], FloorRatios]]:
    """What each criterion and each formula for floors says about each profile on a level support.

    Args:
        profiles: some of the inventory.
        pga, pgv: of the motions as they are scaled [m/s², m/s], as `peaks_of` gives them.
        stands: whether each is upright at the end, (profile, simulation).
    """
    sizes = [
        (body.base, body.left / body.base, body.cg_height, body.gyration_radius)
        for body in (profile.body for profile in profiles)
    ]
    base, nu, h, i = np.array(sizes).T[:, :, None]
    falls = (~stands).reshape(len(profiles), pga.size, 2).sum(axis=2)
    warned = {name: score > 1.0 for name, score in scores(base, nu, h, i, pga, pgv).items()}
    height = np.array([profile.item.height for profile in profiles])[:, None]
    ratios = kaneko_hayashi_2004.overturning_ratio(base, height, pga, pgv).mean(axis=1)
    formula = cimellaro_2020.overturning_ratio(base / height, pga).mean(axis=1)
    beyond = [
        np.mean([bool(cimellaro_2020.out_of_range(ratio, float(a))) for a in pga])
        for ratio in (base / height)[:, 0]
    ]
    return [
        (
            {
                name: CriterionResult(
                    float(each[k].mean()), int(np.where(each[k], 0, falls[k]).sum())
                )
                for name, each in warned.items()
            },
            FloorRatios(float(ratios[k]), float(formula[k]), float(beyond[k])),
        )
        for k in range(len(profiles))
    ]
