"""The force that an anchor or a strap needs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shaketable.assess.profiles import Profile
from shaketable.assess.results import AnchorForce
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY

HEIGHTS = (1.0, 2.0 / 3.0)  # of the object's height
ANCHOR_SHARE = 0.9  # of the motions need no larger force


def anchor_forces(
    profiles: Sequence[Profile], motions: Sequence[Motion], scale: float
) -> tuple[AnchorForce, ...]:
    """The least force along the support that keeps a corner from lifting, at each of HEIGHTS.

    A body that stands still and does not slide meets, per mass, the apparent forces f_t along and
    f_n normal to its support (theory, section 1). A force F at the height z holds it down where
    F z >= m (|f_t| h + f_n b), with b the distance of the centre of gravity from the corner to
    which f_t points: on a level support F/m = max[(|a_x| h - (g + a_y) b) / z, 0]. It is the
    largest over the motion, as recorded and reversed, and of the item's directions the larger.

    Args:
        profiles: the directions of one item, at least one.
        motions: at least one.
        scale: factor on the motions.
    """
    needed = np.array(
        [max(_moment(profile, motion, scale) for profile in profiles) for motion in motions]
    )
    middle, high = np.quantile(needed, [0.5, ANCHOR_SHARE], method="inverted_cdf")
    every = middle, high, needed.max()
    heights = [share * profiles[0].item.height for share in HEIGHTS]
    return tuple(AnchorForce(z, *(float(moment / z) for moment in every)) for z in heights)


def _moment(profile: Profile, motion: Motion, scale: float) -> float:
    """The largest moment per mass that would lift a corner [m²/s²], or 0."""
    body, sine, cosine = profile.body, np.sin(profile.tilt), np.cos(profile.tilt)
    vertical = 0.0 if motion.vertical is None else scale * motion.vertical
    weight = STANDARD_GRAVITY + vertical
    largest = 0.0
    for push in (scale * motion.horizontal, -scale * motion.horizontal):
        along, normal = -push * cosine - weight * sine, push * sine - weight * cosine
        toward_right = along * body.cg_height + normal * body.right
        toward_left = -along * body.cg_height + normal * body.left
        largest = max(largest, float(toward_right.max()), float(toward_left.max()))
    return largest
