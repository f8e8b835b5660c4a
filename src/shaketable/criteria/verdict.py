"""What a criterion says of a body under a motion's peaks."""

from __future__ import annotations

from typing import NamedTuple


class Verdict(NamedTuple):
    """A criterion's answer for one body and one motion.

    Attributes:
        criterion: its name.
        overturns: whether it says that the body may overturn.
        margin: what it takes over what there is, the larger of its conditions' where all must be
            met; above 1 it says that the body stands. Infinite without any motion.
        sentence: the answer in words, with numbers and units.
        reference: the paper and its equation.
        range: what it is defined for and was calibrated for.
    """

    criterion: str
    overturns: bool
    margin: float
    sentence: str
    reference: str
    range: str


def margin_of(limit: float, demand: float) -> float:
    """`limit` over `demand`; infinite without a demand."""
    return limit / demand if demand > 0.0 else float("inf")
