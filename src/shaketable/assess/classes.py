"""Classes of what is seen of an object: Kaneko and Hayashi's, and what few recordings allow."""

from __future__ import annotations

from shaketable.assess.shares import Share
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES, risk_class
from shaketable.resampling import FEWEST

FEWEST_RECORDINGS = FEWEST  # with fewer nothing is classed
#: Zero falls in so many exclude a share above RISK_CLASSES["low"], by Wilson's upper limit.
ENOUGH_RECORDINGS = 125
NOT_CLASSED = "not classed"
#: Hardly any falls, of too few recordings to call that a low risk.
FEW_FALLS = "few or no falls seen"
LOW = next(iter(RISK_CLASSES))
#: What can be said of an object or a place, from the best to the worst; NOT_CLASSED stands apart.
CLASSES = (LOW, FEW_FALLS, *list(RISK_CLASSES)[1:])


def class_of(share: Share, recordings: int) -> str:
    """One of CLASSES, for a share that comes from so many independent recordings.

    Of ENOUGH_RECORDINGS or more the class is that of the upper end of the interval, as so many can
    exclude falls. Of fewer it is that of the share, and none is low.
    """
    if recordings >= ENOUGH_RECORDINGS:
        return risk_class(share.high)
    found = risk_class(share.value)
    return FEW_FALLS if found == LOW else found
