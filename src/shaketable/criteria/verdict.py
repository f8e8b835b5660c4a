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
        beyond: what of the body lies outside that range, "" if nothing.
    """

    criterion: str
    overturns: bool
    margin: float
    sentence: str
    reference: str
    range: str
    beyond: str = ""


def margin_of(limit: float, demand: float) -> float:
    """`limit` over `demand`; infinite without a demand."""
    return limit / demand if demand > 0.0 else float("inf")


def outside(name: str, value: float, limits: tuple[float, float]) -> list[str]:
    """What is wrong with a value, if it lies outside its limits; a thousandth of it is forgiven."""
    low, high = limits
    if low * 0.999 <= value <= high * 1.001:
        return []
    return [f"{name} = {value:.3g} is outside {low:g} to {high:g}"]
