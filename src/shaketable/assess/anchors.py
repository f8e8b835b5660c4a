"""The force that an anchor or a strap needs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.profiles import Profile
from shaketable.assess.results import AnchorForce
from shaketable.body import Body
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY

HEIGHTS = (1.0, 2.0 / 3.0)  # of the object's height
ANCHOR_SHARE = 0.9  # of the motions need no larger force


class AnchorExtremes(NamedTuple):
    """The samples of motions at which a force can be largest, those of each motion together."""

    a_x: NDArray[np.float64]  # a_x [m/s²], (n,)
    g_effective: NDArray[np.float64]  # g + a_y [m/s²], (n,)
    first: NDArray[np.intp]  # index of each motion's first sample, (motion,)


def extremes_of(motions: Sequence[Motion], scale: float) -> AnchorExtremes:
    """Corners of the convex hull of the accelerations of each motion, times a factor.

    What is linear in both accelerations is largest at one of them.
    """
    hulls = [_hull(motion, scale) for motion in motions]
    points = np.concatenate(hulls)
    return AnchorExtremes(points[:, 0], points[:, 1], np.cumsum([0, *map(len, hulls[:-1])]))


def _hull(motion: Motion, scale: float) -> NDArray[np.float64]:
    a_x = scale * motion.horizontal
    if motion.vertical is None:
        return np.array([[peak, STANDARD_GRAVITY] for peak in (a_x.min(), a_x.max())])
    from scipy.spatial import ConvexHull, QhullError

    points = np.column_stack([a_x, STANDARD_GRAVITY + scale * motion.vertical])
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:  # all on one line
        return points


def anchor_forces(profiles: Sequence[Profile], extremes: AnchorExtremes) -> tuple[AnchorForce, ...]:
    """The least force along the support that keeps a corner from lifting, at each of HEIGHTS.

    A body that stands still and does not slide meets, per mass, the apparent forces f_t along and
    f_n normal to its support (theory, section 1). A force F at the height z holds it down where
    F z >= m (|f_t| h + f_n b), with b the distance of the centre of gravity from the corner to
    which f_t points: on a level support F/m = max[(|a_x| h - (g + a_y) b) / z, 0]. It is the
    largest over the motion, as recorded and reversed, and of the item's directions the larger.

    Args:
        profiles: the directions of one item, at least one.
        extremes: of the motions, as they are scaled.
    """
    needed = np.max([lifting_moments(each.body, each.tilt, extremes) for each in profiles], axis=0)
    middle, high = np.quantile(needed, [0.5, ANCHOR_SHARE], method="inverted_cdf")
    every = middle, high, needed.max()
    heights = [share * profiles[0].item.height for share in HEIGHTS]
    return tuple(AnchorForce(z, *(float(moment / z) for moment in every)) for z in heights)


def lifting_moments(body: Body, tilt: float, extremes: AnchorExtremes) -> NDArray[np.float64]:
    """The largest moment per mass that would lift a corner [m²/s²], or 0, (motion,).

    Of each motion as recorded and reversed, on a support tilted by so much [rad].
    """
    sine, cosine = math.sin(tilt), math.cos(tilt)
    largest = np.zeros(extremes.a_x.size)
    for polarity in (1.0, -1.0):
        a_x = polarity * extremes.a_x
        along = -a_x * cosine - extremes.g_effective * sine
        normal = a_x * sine - extremes.g_effective * cosine
        for side, arm in ((1.0, body.right), (-1.0, body.left)):
            np.maximum(largest, side * along * body.cg_height + normal * arm, out=largest)
    return np.maximum.reduceat(largest, extremes.first)
