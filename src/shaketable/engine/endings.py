"""How a run ended."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Ending(IntEnum):
    """How a run ended; the first two are the regular endings."""

    STANDING = 0
    OVERTURNED = 1
    STILL_ROCKING = 2
    STILL_SLIDING = 3
    UNRESOLVED = 4


#: What to tell the user about the others, after "the body" or "3 of 100 simulations".
SENTENCES = {
    Ending.STILL_ROCKING: "still rocked or flew an hour, or a million steps or impacts, after the "
    "motion's end (among walls, straps and edges ten seconds if straps hold it or its energy is "
    "too little to overturn, three if both is so and it hardly loses any, ten minutes, or 100,000 "
    "steps) and counts as "
    "standing: balanced on an edge, thrown up, swinging in a strap, or losing hardly any energy at "
    "an impact",
    Ending.STILL_SLIDING: "still slid when the motion had ended, with nothing to stop it, or an "
    "hour or a million steps later: there is no kinetic friction, or too little for the tilt; slip "
    "counts until then. Give more kinetic friction or less tilt to see it stop",
    Ending.UNRESOLVED: "met a million contacts and losses of contact within one sample, or among "
    "surroundings took 200,000 steps and ten a sample during the motion, and was given up there: "
    "please report body, motion, support and surroundings",
}
STANDING, OVERTURNED, STILL_ROCKING, STILL_SLIDING, UNRESOLVED = (int(e) for e in Ending)


def not_settled(endings: NDArray[Any]) -> NDArray[np.bool_]:
    """Whether each run was given up while its body moved."""
    return ~np.isin(endings, (STANDING, OVERTURNED))


def counts_of(endings: NDArray[Any]) -> dict[int, int]:
    """How often each of them is there."""
    found, counts = np.unique(endings, return_counts=True)
    return dict(zip(found.astype(int).tolist(), counts.tolist(), strict=True))
