"""What the simple criteria say of each item, beside what the simulations show."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.sliding import Kept
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.criteria.together import HOUSNER, ISHIYAMA, KNOWN, RULE, UNKNOWN, scores
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.signal import peaks

#: Begin of the names of a criterion's columns.
COLUMNS = {
    HOUSNER: "housner",
    ISHIYAMA: "ishiyama",
    KNOWN: "known_eccentricity",
    UNKNOWN: "unknown_eccentricity",
    RULE: "shaketable",
}


def criteria_columns(
    items: Sequence[Item], motions: Sequence[Motion], scale: float, kept: Kept
) -> dict[str, NDArray[np.float64] | NDArray[np.int64]]:
    """Columns of the table: of each criterion the share of the motions under which it says that
    the item may overturn, and how many simulated falls it misses; of those that give a ratio its
    mean.

    Args:
        items, motions, scale: of the assessment, on a level support.
        kept: its single simulations, both directions of a motion side by side.
    """
    found = [peaks(motion) for motion in motions]
    bodies = [item.body for item in items]
    sizes = [(b.width, b.left / b.width, b.cg_height, b.gyration_radius) for b in bodies]
    pga = scale * np.array([peak.acceleration for peak in found])
    pgv = scale * np.array([peak.velocity for peak in found])
    width, nu, h, i = np.array(sizes).T[:, :, None]
    falls = (~kept.stands[:, 0]).reshape(len(items), len(motions), 2).sum(axis=2)
    columns: dict[str, NDArray[np.float64] | NDArray[np.int64]] = {}
    for name, score in scores(width, nu, h, i, pga, pgv).items():
        warned = score > 1.0
        columns[f"{COLUMNS[name]}_share"] = warned.mean(axis=1)
        columns[f"{COLUMNS[name]}_missed"] = np.where(warned, 0, falls).sum(axis=1)
    height = np.array([item.height for item in items])[:, None]
    ratios = kaneko_hayashi_2004.overturning_ratio(width, height, pga, pgv)
    risks = cimellaro_2020.overturning_risk(width / height, pga)
    return {
        **columns,
        "kaneko_hayashi_ratio": np.asarray(ratios.mean(axis=1)),
        "cimellaro_ratio": np.asarray(risks.mean(axis=1)),
        "cimellaro_out_of_range_share": np.array(
            [
                np.mean([bool(cimellaro_2020.out_of_range(ratio, float(a))) for a in pga])
                for ratio in (width / height)[:, 0]
            ]
        ),
    }
