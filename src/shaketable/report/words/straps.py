"""What straps have to hold: static forces, and those of the straps that an object has."""

from __future__ import annotations

import math

from shaketable.assess import STRAP_SHARE, ItemResult, SolidResult
from shaketable.inventory import Item
from shaketable.language import tell
from shaketable.report.words.numbers import in_hundred, likely, two_digits

LEAST_CODE_FORCE = 0.3  # of the weight: least F_p of ASCE 7-22, 13.3-3, with S_DS = 1 g and I_p = 1


def static_forces() -> str:
    """What must stand beside every static force."""
    return tell(
        "A static force is no design value: a simulated strap bears several times as much, as it "
        "stops what swings."
    )


def strap_forces(result: ItemResult) -> str:
    """The range of what the straps that were tried bear in STRAP_SHARE, over the weight."""
    forces = [each.force.high for each in result.straps if each.force]
    if not forces:
        return "–"
    low, high = two_digits(min(forces)), two_digits(max(forces))
    return high if low == high else f"{low}–{high}"


def code_force(result: ItemResult) -> float:
    """What a strap at its top bears over the weight, by the least force of ASCE 7-22.

    LEAST_CODE_FORCE of the weight acts at the centre of gravity; about the nearer edge the strap
    takes what the weight does not: (0.3 h − b) / H, the larger of both directions.
    """
    sides = [side.profile.body for side in (result, result.other) if side is not None]
    return max(
        max(0.0, LEAST_CODE_FORCE * body.cg_height - min(body.left, body.right))
        / result.item.height
        for body in sides
    )


def unbreakable(item: Item) -> str:
    """That a strap was, whose strength the list does not give."""
    straps = item.surroundings.straps if item.surroundings else ()
    if any(math.isinf(each.strength) for each in straps):
        return tell(", and so was the strap, whose strength the list does not give")
    return ""


def in_its_straps(item: Item, solid: SolidResult) -> str:
    """The force in the straps that it has, and how often they break."""
    held = solid.surrounded
    if held is None or held.force is None or held.broke is None:
        return ""
    if held.broke.value and item.mass is not None and item.surroundings:
        weakest = min(strap.strength for strap in item.surroundings.straps)
        return tell(
            "A strap breaks in {often} of 100 ({likely}), at {strength} N.",
            often=in_hundred(held.broke.value),
            likely=likely(held.broke),
            strength=two_digits(weakest),
        )
    return tell(
        "The force in its strap reaches {median} times its weight in half of the shakings, {high} "
        "times in {often} of 100 and {largest} times at most.",
        median=two_digits(held.force.median),
        high=two_digits(held.force.high),
        often=in_hundred(STRAP_SHARE),
        largest=two_digits(held.force.largest),
    )
