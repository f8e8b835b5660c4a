"""How far an item slides or rolls, and whether it walks off what it stands on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.profiles import Profile
from shaketable.assess.results import REACHED, ROLLS_FAR, Sliding
from shaketable.assess.shares import observed, observed_quartiles, share_of
from shaketable.tilting import SLIDES


def sliding_of(
    profile: Profile,
    stands: NDArray[np.bool_],
    slip_downhill: NDArray[np.float64],
    slip_uphill: NDArray[np.float64],
    recordings: int,
) -> Sliding:
    """Sliding of a profile in the simulations in which it stays upright.

    An item that falls also slips as it falls, and that does not count.

    Args:
        profile: the item in one direction.
        stands: whether it is upright at the end, (simulation,).
        slip_downhill, slip_uphill: farthest slip [m], both >= 0, (simulation,).
        recordings: how many independent ones the simulations come from.
    """
    farthest = np.maximum(slip_downhill, slip_uphill)
    left, right = room(profile)
    off = stands & ((slip_downhill > left) | (slip_uphill > right))
    return Sliding(
        share=float((stands & (farthest > SLIDES)).mean()),
        slip=observed_quartiles(farthest[stands]),
        reach=observed(farthest[stands], REACHED),
        far=share_of(stands & (farthest > ROLLS_FAR), recordings),
        falls_or_far=share_of(~stands | (farthest > ROLLS_FAR), recordings),
        walks_off=np.nan if np.isnan(left) else float(off.mean()),
        falls_or_off=share_of(~stands | off, recordings),  # nothing compares as off without length
    )


def room(profile: Profile) -> tuple[float, float]:
    """How far it may slide downhill and uphill [m] before its centre of gravity passes the edge.

    Its base starts in the middle of the support. NaN where the support's length is not known.
    """
    if profile.support_length is None:
        return np.nan, np.nan
    off_centre = profile.body.left - profile.body.width / 2
    return profile.support_length / 2 + off_centre, profile.support_length / 2 - off_centre
