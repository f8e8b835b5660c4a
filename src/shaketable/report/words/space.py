"""What three dimensions change, where both horizontal components shake an object at once."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess import (
    FEWEST_RECORDINGS,
    Assessment,
    ItemResult,
    Share,
    SolidResult,
    apart,
)
from shaketable.errors import named
from shaketable.inventory import Item, Shape
from shaketable.report.words.numbers import (
    counted,
    distance,
    expected_count,
    in_hundred,
    likely,
    limit_in_hundred,
)
from shaketable.tilting import FEWEST_FALLS, SLIDES
from shaketable.units import degrees

MOST_NAMED = 10
NOTICED = math.radians(5.0)  # a smaller turn is not told
TOWARD = ("forward", "backward", "to the left", "to the right")


def what_happens(result: ItemResult) -> str:
    """How often an object falls in three dimensions, over which side, and how far it moves."""
    solid = result.solid
    if solid is None:
        return ""
    parts = (
        _how_often(solid),
        _which_way(solid),
        _spread(result, solid),
        _moves(result.item, solid),
    )
    return " ".join(part for part in parts if part)


def _how_often(solid: SolidResult) -> str:
    said = "Shaken in both horizontal directions at once, it"
    if solid.recordings < FEWEST_RECORDINGS:
        return (
            f"{said} fell in {solid.falls} of {solid.simulations} shakings; they come from "
            f"{counted(solid.recordings, 'independent recording')} and decide nothing."
        )
    if not solid.falls:
        return (
            f"{said} fell in none of {solid.simulations} shakings from {solid.recordings} "
            f"recordings; up to {limit_in_hundred(solid.fall.high)} in 100 cannot be excluded."
        )
    often = f"{said} falls in {in_hundred(solid.fall.value)} of 100 ({likely(solid.fall)})."
    upright = solid.simulations - solid.falls
    if not solid.given_up:
        return often
    return (
        f"{often} Of {solid.simulations} simulations {solid.falls} overturned it; of the "
        f"{upright} that did not, {solid.given_up} left it wobbling or rolling, which counts as "
        "standing."
    )


def _which_way(solid: SolidResult) -> str:
    """Toward which sides; by symmetry two of them are often alike."""
    if solid.falls < FEWEST_FALLS:
        return ""
    if math.isnan(solid.sides.forward):
        return "As it is round, it may fall to any side."
    shares = dict(zip(TOWARD, solid.sides, strict=True))
    if len({round(100 * share) for share in shares.values()}) == 1:
        return "It falls as often to each of its four sides."
    (side, first), *others = [(side, share) for side, share in shares.items() if share]

    def count(share: float) -> str:
        return f"{round(share * solid.falls):,}"

    told = [f"{count(first)} go {side}", *(f"{count(other)} {side}" for side, other in others)]
    return f"Of its {solid.falls:,} falls {_and(told)}."


def _spread(result: ItemResult, solid: SolidResult) -> str:
    """How much it matters how it is turned to the motion, and on what it stands."""
    said = []
    if len(solid.turned) > 1 and solid.falls:
        said.append(f"Depending on which way it faces, it falls in {_range(solid.turned)}.")
    frictions = [each.fall for each in solid.frictions]
    if frictions and max(frictions).value:
        low, high = solid.frictions[0].friction, solid.frictions[-1].friction
        here = (
            "That is where its feet cannot slide"
            if math.isinf(result.friction)
            else f"That is with a friction of {result.friction:g}"
        )
        said.append(f"{here}; with a friction of {low:g} to {high:g} it is {_range(frictions)}.")
    return " ".join(said)


def _range(shares: Sequence[Share]) -> str:
    low, high = in_hundred(min(shares).value), in_hundred(max(shares).value)
    return f"{low} of 100" if low == high else f"{low} to {high} of 100"


def _moves(item: Item, solid: SolidResult) -> str:
    """How far from its place it ends, with the friction with which that is farthest."""
    if solid.simulations - solid.falls < FEWEST_FALLS:
        return ""  # half of so few tells nothing
    far = {
        each.friction: each.slip
        for each in solid.frictions
        if (1.0 - each.fall.value) * solid.simulations >= FEWEST_FALLS
    }
    most = max(far, key=far.__getitem__, default=math.nan)
    said = []
    if solid.moved.upper > SLIDES:
        said.append(
            f"it ends {distance(solid.moved.median)} or more from its place in half of the "
            f"shakings and {distance(solid.moved.upper)} or more in a quarter"
        )
    if far and far[most] > max(SLIDES, solid.moved.median):
        said.append(
            f"with a friction of {most:g} it ends {distance(far[most])} or more from its place in "
            "half of them"
        )
    if item.shape is not Shape.CYLINDER and solid.yaw.upper > NOTICED:
        said.append(f"it is turned by {degrees(solid.yaw.upper):.0f}° or more in a quarter of them")
    if not said:
        return ""
    told = "; ".join(said)
    return f"Where it stays upright, {told}." if solid.falls else f"{told[0].upper()}{told[1:]}."


def over_turns(solid: SolidResult) -> str:
    """The range of the shares [%] over the ways in which it was turned, a dash for one way."""
    shares = [f"{100 * share.value:.0f}" for share in sorted(solid.turned)]
    if len(shares) < 2:
        return "–"
    return shares[0] if shares[0] == shares[-1] else f"{shares[0]}–{shares[-1]}"


def what_changes(assessment: Assessment) -> list[str]:
    """What the third dimension makes of the falls; nothing where none was simulated."""
    found = assessment.solids
    if not found:
        return []
    pieces = sum(each.item.quantity for each in found)
    plane = sum(each.item.quantity * each.fall.value for each in found)
    space = sum(each.item.quantity * each.solid.fall.value for each in found if each.solid)
    sentences = [
        f"An earthquake shakes in both horizontal directions at once. Of {counted(pieces, 'piece')}"
        f" that were simulated both ways, {expected_count(plane)} fall on average where they are "
        f"shaken in one direction at a time (in a plane), and {expected_count(space)} where they "
        "are shaken in both at once (in three dimensions)."
    ]
    more = [each.item.name for each in found if each.solid and apart(each.fall, each.solid.fall)]
    if more:
        sentences.append(
            f"Three dimensions change the answer for {named(more, MOST_NAMED)}, by more than "
            "chance explains: each of the two shares lies outside the interval of the other."
        )
    round_ones = [each for each in found if each.item.shape is Shape.CYLINDER]
    if round_ones:
        sentences.append(
            "What is round falls more easily than in a plane: once tipped it rolls around on its "
            "rim, without the impacts that slow down a box."
        )
    left_out = [each.item.name for each in assessment.results if each.solid is None]
    if left_out:
        sentences.append(
            "In a plane alone, as the width or depth is not known or the centre of gravity of a "
            f"round base is off its centre: {named(left_out, MOST_NAMED)}."
        )
    return sentences


def how_sure(assessment: Assessment) -> list[str]:
    """What the simulations in three dimensions stand on; nothing where there are none."""
    found = [each.solid for each in assessment.solids if each.solid is not None]
    if not found:
        return []
    given_up = sum(each.given_up for each in found)
    total = sum(each.simulations for each in found)
    still = (
        f" In {given_up:,} of all {total:,} simulations in three dimensions the object still "
        "wobbled or rolled ten seconds after the motion; it counts as standing, and its card says "
        "how often that was."
        if given_up
        else ""
    )
    ways = max(len(each.turned) for each in found)
    turned = (
        f", each object facing up to {ways} ways, as the inventory does not say which it faces"
        if ways > 1
        else ""
    )
    counts = "So few decide nothing: totals, class and order are of the plane."
    if any(each.decisive for each in assessment.solids):
        counts = (
            "How many fall in all is told of three dimensions where they were simulated; class and "
            "order are by the worse of both."
        )
    return [
        f"Also in three dimensions: {counted(len(found), 'kind of object')}, under "
        f"{counted(assessment.pairs, 'pair')} of horizontal components whose compass directions "
        "are known, "
        f"from {counted(found[0].recordings, 'independent recording')}{turned}. "
        f"{counts} What these simulations say was not held against tests on shake tables in three "
        f"dimensions.{still}"
    ]


def _and(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"
