"""What a criterion says of a body under a motion's peaks."""

from __future__ import annotations

from typing import NamedTuple


class Verdict(NamedTuple):
    """A criterion's answer for one body and one motion.

    Attributes:
        criterion: its name.
        overturns: whether it says that the body may overturn.
        margin: the limit over the demand, or the larger such ratio where two conditions must be
            met; above 1 it says that the body stands. Infinite without any motion.
        sentence: the answer in words, with numbers and units.
        reference: the paper and its equation.
        range: what it is defined and calibrated for.
        beyond: in what the body lies outside that range, "" if in nothing.
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
    """A remark if a value lies outside its limits by more than a thousandth; empty if not."""
    low, high = limits
    if low * 0.999 <= value <= high * 1.001:
        return []
    return [f"{name} = {value:.3g} is outside {low:g} to {high:g}"]
