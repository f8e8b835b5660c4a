"""The share of similar bodies that overturn on a floor, from its peaks: this project's fit.

    P = 1/(1 + e^-x) ,   x = c_0 + c_1 min( ln(PFA/A50), ln(PFV/V50) )

with the medians A50 and V50 of Kaneko and Hayashi (2004): the smaller of their two demands holds
all that the two peaks can tell. P was fitted by logistic regression to the bodies that rock among
rectangles 0.5 to 3 m high with B/H 0.10 to 0.45, under the 100 motions of FEMA P-695 at 0.3, 0.6,
1 and 1.5 times their size, in both directions. `shaketable study cimellaro-2020` repeats the fit
and tests it on recordings that it was not fitted to. Below PFA = (B/H) g nothing moves and P is 0.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.criteria.kaneko_hayashi_2004 import demands
from shaketable.criteria.verdict import outside
from shaketable.units import STANDARD_GRAVITY

CONSTANT, SLOPE = -0.799, 5.795
FITTED_TO = {"height [m]": (0.5, 3.0), "B/H": (0.10, 0.45)}


def overturning_ratio(
    base: ArrayLike, height: ArrayLike, pfa: ArrayLike, pfv: ArrayLike
) -> NDArray[np.float64]:
    """P in [0, 1].

    Args:
        base, height: full sizes [m]; all shapes broadcast together.
        pfa: peak floor acceleration [m/s²].
        pfv: peak floor velocity [m/s].

    Raises:
        InputError: sizes that are not positive, peaks that are negative or missing (NaN).
    """
    smaller = np.minimum(*demands(base, height, pfa, pfv))
    ratio = np.asarray(base, np.float64) / np.asarray(height, np.float64)
    with np.errstate(over="ignore"):
        chance = 1.0 / (1.0 + np.exp(-(CONSTANT + SLOPE * smaller)))
    return np.where(np.asarray(pfa) > STANDARD_GRAVITY * ratio, chance, 0.0)


def out_of_range(base: float, height: float) -> list[str]:
    """Which measures of a rectangle of full sizes [m] lie outside those that P was fitted to."""
    sizes = {"height [m]": height, "B/H": base / height}
    return [
        reason
        for name, limits in FITTED_TO.items()
        for reason in outside(name, sizes[name], limits)
    ]
