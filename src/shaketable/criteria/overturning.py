"""The criteria for overturning on a level support, all at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.criteria import boroschek_romo_2004, housner_1963, ishiyama_1982, shaketable_2026
from shaketable.criteria.verdict import Verdict

HOUSNER, ISHIYAMA = "Housner", "Ishiyama"
KNOWN, UNKNOWN, RULE = "known eccentricity", "unknown eccentricity", "shaketable"


def scores(
    base: ArrayLike,
    eccentricity: ArrayLike,
    cg_height: ArrayLike,
    gyration_radius: ArrayLike,
    pga: ArrayLike,
    pgv: ArrayLike,
) -> dict[str, NDArray[np.float64]]:
    """The ratio of the demand to the limit of each criterion; above 1 the body may overturn.

    Where two conditions must be met, it is the smaller of their ratios. Housner's limit is that at
    which half of the bodies overturn; that of this project's rule is a chance of
    shaketable_2026.SAFE.

    Args:
        base: B [m]; all shapes broadcast together.
        eccentricity: ν or 1 - ν [-].
        cg_height, gyration_radius: [m].
        pga: [m/s²].
        pgv: [m/s].
    """
    b, nu = np.asarray(base, np.float64), np.asarray(eccentricity, np.float64)
    h, i = np.asarray(cg_height, np.float64), np.asarray(gyration_radius, np.float64)
    a, v = np.asarray(pga, np.float64), np.asarray(pgv, np.float64)
    nearer = np.minimum(nu, 1.0 - nu) * b
    factor = boroschek_romo_2004.UNKNOWN_FACTOR
    chance = shaketable_2026.overturning_chance(shaketable_2026.measures(b, nu, h, i, a, v))
    return {
        HOUSNER: v / housner_1963.overturning_velocity(nearer, h, i),
        ISHIYAMA: _of_both(b / 2, h, i, a, v),
        KNOWN: _of_both(nearer, h, i, a, v),
        UNKNOWN: v / ishiyama_1982.overturning_velocity(b / 2, h, i, factor),
        RULE: chance / shaketable_2026.SAFE,
    }


def _of_both(
    arm: NDArray[np.float64],
    h: NDArray[np.float64],
    i: NDArray[np.float64],
    pga: NDArray[np.float64],
    pgv: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The smaller ratio of Ishiyama's two conditions with that arm."""
    return np.minimum(
        pga / ishiyama_1982.overturning_acceleration(arm, h),
        pgv / ishiyama_1982.overturning_velocity(arm, h, i),
    )


def verdicts(body: Body, pga: float, pgv: float) -> list[Verdict]:
    """Return the verdict of each criterion for a body, a PGA [m/s²] and a PGV [m/s]."""
    return [
        housner_1963.verdict(body, pga, pgv),
        ishiyama_1982.verdict(body, pga, pgv),
        boroschek_romo_2004.known_verdict(body, pga, pgv),
        boroschek_romo_2004.unknown_verdict(body, pga, pgv),
        shaketable_2026.verdict(body, pga, pgv),
    ]
