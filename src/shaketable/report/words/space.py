"""What becomes of an object that both horizontal components shake at once, in words."""

from __future__ import annotations

import math
from collections.abc import Sequence

from shaketable.assess import (
    FEWEST_RECORDINGS,
    ROLLS_FAR,
    Assessment,
    ItemResult,
    Share,
    SolidResult,
)
from shaketable.errors import named
from shaketable.inventory import BaseShape, Item
from shaketable.language import listed, tell, translated
from shaketable.report.words import straps
from shaketable.report.words.findings import unsettled, walks_off
from shaketable.report.words.numbers import (
    counted,
    distance,
    in_hundred,
    likely,
    limits_in_hundred,
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
        _how_often(solid, result.item),
        _held_up(solid),
        _which_way(solid),
        _spread(result, solid),
        _goes_far(result.item, solid),
        _moves(result.item, solid),
        walks_off(result.along_support),
        straps.in_its_straps(result.item, solid),
    )
    return " ".join(part for part in parts if part)


def _beside(item: Item) -> str:
    """What surrounds an object, as its list says."""
    around = item.surroundings
    if around is None:
        return ""
    straps = tell("in its strap") if len(around.straps) == 1 else tell("in its straps")
    parts = {
        tell("beside its wall"): around.walls,
        straps: around.straps,
        tell("on its pads"): around.pad,
        tell("near the edge of its support"): around.edge,
    }
    told = [part for part, there in parts.items() if there]
    return tell(", {where}", where=listed(told)) if told else ""


def _held_up(solid: SolidResult) -> str:
    held = solid.surrounded
    if held is None or not held.held_up.value:
        return ""
    return tell(
        "In {often} of 100 ({likely}) only its wall or strap holds it up in the end: that counts "
        "as a fall, and is no place to stand under.",
        often=in_hundred(held.held_up.value),
        likely=likely(held.held_up),
    )


def _how_often(solid: SolidResult, item: Item) -> str:
    shaken = tell("Shaken in both horizontal directions at once{where}", where=_beside(item))
    moving = unsettled(solid.not_settled, solid.simulations)
    if solid.recordings < FEWEST_RECORDINGS:
        return tell(
            "{shaken}, it fell in {falls} of {simulations} shakings; they come from {recordings} "
            "and decide nothing.{moving}",
            shaken=shaken,
            falls=solid.falls,
            simulations=solid.simulations,
            recordings=counted(solid.recordings, "independent recording"),
            moving=moving,
        )
    if not solid.falls:
        return tell(
            "{shaken}, it fell in none of {simulations} shakings from {recordings} recordings; up "
            "to {limit} in 100 cannot be excluded.{moving}",
            shaken=shaken,
            simulations=solid.simulations,
            recordings=solid.recordings,
            limit=limits_in_hundred(solid.fall)[1],
            moving=moving,
        )
    return tell(
        "{shaken}, it falls in {often} of 100 ({likely}).{moving}",
        shaken=shaken,
        often=in_hundred(solid.fall.value),
        likely=likely(solid.fall),
        moving=moving,
    )


def _which_way(solid: SolidResult) -> str:
    """Toward which sides; by symmetry two of them are often alike."""
    if solid.falls < FEWEST_FALLS:
        return ""
    if math.isnan(solid.sides.forward):
        return tell("As it is round, it may fall to any side.")
    shares = dict(zip(TOWARD, solid.sides, strict=True))
    if len({round(100 * share) for share in shares.values()}) == 1:
        return tell("It falls as often to each of its four sides.")
    (side, first), *others = [
        (translated(side), round(share * solid.falls)) for side, share in shares.items() if share
    ]
    told = [
        tell("{count:,} go {side}", count=first, side=side),
        *(tell("{count:,} {side}", count=count, side=side) for side, count in others),
    ]
    return tell("Of its {falls:,} falls {told}.", falls=solid.falls, told=listed(told))


def _spread(result: ItemResult, solid: SolidResult) -> str:
    """How much it matters how it is turned to the motion, and on what it stands."""
    said = []
    if len(solid.turned) > 1 and solid.falls:
        ways = _range(solid.turned)
        said.append(tell("Depending on which way it faces, it falls in {range}.", range=ways))
    frictions = [each.fall for each in solid.frictions]
    if frictions and max(frictions).value:
        here = tell("That is where it cannot slide")
        if math.isfinite(result.friction):
            here = tell("That is with a friction of {friction:g}", friction=result.friction)
        said.append(
            tell(
                "{here}; with a friction of {low:g} to {high:g} it is {range}.",
                here=here,
                low=solid.frictions[0].friction,
                high=solid.frictions[-1].friction,
                range=_range(frictions),
            )
        )
    return " ".join(said)


def _goes_far(item: Item, solid: SolidResult) -> str:
    """How often what stands on castors falls or goes far, which is of concern there."""
    if not item.rolls or solid.level.governing_share.value == solid.fall.value:
        return ""
    return tell(
        "In {often} of 100 ({likely}) it falls or goes farther than {far:g} m.",
        often=in_hundred(solid.level.governing_share.value),
        likely=likely(solid.level.governing_share),
        far=ROLLS_FAR,
    )


def _range(shares: Sequence[Share]) -> str:
    low, high = in_hundred(min(shares).value), in_hundred(max(shares).value)
    if low == high:
        return tell("{often} of 100", often=low)
    return tell("{low} to {high} of 100", low=low, high=high)


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
            tell(
                "it ends {median} or more from its place in half of the shakings and {upper} or "
                "more in a quarter",
                median=distance(solid.moved.median),
                upper=distance(solid.moved.upper),
            )
        )
    if far and far[most] > max(SLIDES, solid.moved.median):
        said.append(
            tell(
                "with a friction of {friction:g} it ends {far} or more from its place in half of "
                "them",
                friction=most,
                far=distance(far[most]),
            )
        )
    if item.shape is not BaseShape.CYLINDER and solid.yaw.upper > NOTICED:
        turn = degrees(solid.yaw.upper)
        said.append(tell("it is turned by {turn:.0f}° or more in a quarter of them", turn=turn))
    if not said:
        return ""
    told = "; ".join(said)
    if solid.falls:
        return tell("Where it stays upright, {told}.", told=told)
    return f"{told[0].upper()}{told[1:]}."


def limits(assessment: Assessment) -> list[str]:
    """What three dimensions do not know of the objects, and which were simulated in a plane."""
    sentences = []
    round_ones = [each.item for each in assessment.solids if each.item.shape is BaseShape.CYLINDER]
    if round_ones:
        sentences.append(
            tell(
                "What is round falls more easily than in a plane: once tipped it rolls around on "
                "its rim, without the impacts that slow down a box."
            )
        )
        sentences.append(
            tell(
                "Rims are taken as flat. A real one stands on a few high points, and tips more "
                "easily over the side between two of them: on points 0.1 to 1 mm high cylinders "
                "overturned 1.4 times as often at half of the recorded strength. Such objects may "
                "fall more often than is told here."
            )
        )
    if any(item.rolling_friction == item.contour_friction == 0.0 for item in round_ones):
        sentences.append(
            tell(
                "What a rim loses as it rolls is not known, and taken as nothing where the list "
                "does not give it: for that reason such objects may fall less often."
            )
        )
    return [*sentences, *_in_a_plane(assessment)]


def _in_a_plane(assessment: Assessment) -> list[str]:
    """What has no three dimensions, and why."""
    flat = [floor.floor for floor in assessment.floors if not floor.pairs]
    known = [floor for floor in assessment.floors if floor.pairs]
    left_out = [each.item.name for floor in known for each in floor.results if each.solid is None]
    said = []
    if known and flat:
        said.append(
            tell(
                "On these floors everything was simulated in a plane alone, as the second "
                "component of their motions is not known: {floors}.",
                floors=named(flat, MOST_NAMED),
            )
        )
    if not known:
        return [
            tell(
                "Everything was simulated in a plane, by one horizontal component at a time: an "
                "earthquake shakes in both directions at once, and what is round, nearly square or "
                "on feet then falls far more often."
            )
        ]
    if left_out:
        said.append(
            tell(
                "In a plane alone, as the width or depth is not known or the centre of gravity of "
                "a round base is off its centre: {names}.",
                names=named(list(dict.fromkeys(left_out)), MOST_NAMED),
            )
        )
    return said


def how_sure(assessment: Assessment) -> list[str]:
    """How the simulations in three dimensions were made; nothing where there are none."""
    found = [each.solid for each in assessment.solids if each.solid is not None]
    if not found:
        return []
    moving = sum(each.not_settled for each in found)
    total = sum(each.simulations for each in found)
    ways = max(len(each.turned) for each in found)
    turned = ""
    if ways > 1:
        turned = tell(
            ", each object facing {ways} ways to them, as the list does not say which it faces",
            ways=ways,
        )
    said = [
        tell(
            "Objects are shaken in three dimensions by both horizontal components of {pairs} at "
            "once{turned}; this was not checked against tests on shake tables in three dimensions.",
            pairs=counted(assessment.pairs, "recording"),
            turned=turned,
        )
    ]
    if moving:
        said.append(
            tell(
                "In {moving:,} of all {total:,} simulations the object still wobbled or rolled ten "
                "seconds after the motion, or swung on in straps three seconds after it, without "
                "the energy to fall: it had neither fallen nor come to rest, and its card says how "
                "often that was.",
                moving=moving,
                total=total,
            )
        )
    return [" ".join(said)]
