"""What straps have to hold: those that an object has, and those that were tried on it."""

from __future__ import annotations

import math

from shaketable.assess import (
    SLACKS,
    STIFFNESSES,
    STRAP_SHARE,
    Assessment,
    ItemResult,
    SolidResult,
)
from shaketable.inventory import BaseShape, Item
from shaketable.language import tell
from shaketable.report.words.numbers import in_hundred, likely, two_digits, with_interval
from shaketable.units import STANDARD_GRAVITY

HUNDRED = 100.0  # kg: for which the stiffness of a strap is told
LEAST_CODE_FORCE = 0.3  # of the weight: least F_p of ASCE 7-22, 13.3-3, with S_DS = 1 g and I_p = 1


def what_a_strap_bears(assessment: Assessment) -> str:
    """How strong a strap must be, to stand once beside all advice to strap."""
    if not any(each.straps for each in assessment.results):
        return tell(
            "How strong must a strap be? That was not simulated here. A static force, and the "
            "least one of a code, are far below what a strap has to bear, as it stops what swings."
        )
    return tell(
        "How strong must a strap be? The cards tell what simulated straps bear in {often:g} of 100 "
        "of these shakings. A static force, and the least one of a code, are far below that, as a "
        "strap stops what swings.",
        often=100 * STRAP_SHARE,
    )


def static_forces() -> str:
    """What must stand beside every static force."""
    return tell(
        "A static force is no design value: a simulated strap bears several times as much, as it "
        "stops what swings."
    )


def strap_forces(result: ItemResult) -> str:
    """The range of what the straps that were tried bear in STRAP_SHARE, over the weight."""
    if not result.straps:
        return "–"
    forces = [each.force.high for each in result.straps]
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


def in_a_strap(result: ItemResult) -> str:
    """What the force in a strap is and how many fall in it, by the worst of those tried."""
    around = result.item.surroundings
    if not result.straps and around and around.straps:
        return tell(" Whether the strap that it has does was not simulated here.")
    if not result.straps:
        return tell(" What a strap must bear was not simulated.")
    fall = max(each.fall for each in result.straps)
    if fall.value >= result.overturns.value > 0.0:
        return tell(
            " A strap from its top to a wall does not do here: in it it falls in {falls} of 100.",
            falls=with_interval(fall),
        )
    most = max(each.force.high for each in result.straps)
    largest = max(each.force.largest for each in result.straps)
    if not most:
        return tell(
            " In {often:g} of 100 of these shakings no strap from its top is pulled at all.",
            often=100 * STRAP_SHARE,
        )
    force = tell(
        " The force in a strap from the middle of its top to a wall reaches {most} times its "
        "weight{newtons} in {often:g} of 100 shakings, and {largest} times at most: {range}, by "
        "its stiffness ({soft:g} or {stiff:g} kN/m for each {mass:g} kg) and its slack ({short:g} "
        "or {long:g} mm).",
        most=two_digits(most),
        newtons=in_newtons(result.item, most),
        often=100 * STRAP_SHARE,
        largest=two_digits(largest),
        range=strap_forces(result),
        soft=STIFFNESSES[0] * HUNDRED / 1e3,
        stiff=STIFFNESSES[-1] * HUNDRED / 1e3,
        mass=HUNDRED,
        short=1e3 * SLACKS[0],
        long=1e3 * SLACKS[-1],
    )
    if not (around and around.walls) and result.item.shape is BaseShape.CYLINDER:
        force += tell(" That is without a wall beside it.")
    elif not (around and around.walls):
        force += tell(
            " That is without a wall that stops it: one close behind it, given by the column "
            "wall_gap_mm, lowers it."
        )
    if result.solid is not None and result.solid.on_ground:
        force += tell(" That is on the ground: on its floor it is more.")
    falls = with_interval(fall)
    leans = max(each.leans.value for each in result.straps)
    if not leans:
        return force + tell(" In such a strap it falls in {falls} of 100.", falls=falls)
    return force + tell(
        " In such a strap it falls in {falls} of 100, and in up to {leans} it ends leaning in it "
        "or still swings.",
        falls=falls,
        leans=in_hundred(leans),
    )


def in_newtons(item: Item, force: float) -> str:
    """A force over the weight in newtons, where the mass is known."""
    if item.mass is None:
        return ""
    newtons = force * item.mass * STANDARD_GRAVITY
    if newtons >= 1e3:
        return f" ({two_digits(newtons / 1e3)} kN)"
    return f" ({two_digits(newtons)} N)"


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
