"""What a row says of the wall beside an object, of straps, pads, and the edge of its support."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from shaketable.errors import InputError
from shaketable.inventory.answers import YES_OR_NO
from shaketable.inventory.item import Item
from shaketable.inventory.shapes import solid_of
from shaketable.inventory.vocabulary import plain, words_of
from shaketable.language import tell
from shaketable.simulate.standing import require_surrounded
from shaketable.solid import ROLLING_RESISTANCE
from shaketable.spelled_surroundings import EXAMPLE, read_strap, surroundings_of

#: Azimuths in a solid's own frame [rad]: x from its front to its back, y to its left.
_SIDE = {"back": 0.0, "left": math.pi / 2, "front": math.pi, "right": -math.pi / 2}
SIDES = {word: _SIDE[meaning] for word, meaning in words_of("sides").items()}
FRONT = [word for word, azimuth in SIDES.items() if azimuth == math.pi]
RESTITUTION = 0.3  # of a wall: that of the study of walls, as no list knows it
COLUMNS = ("wall_gap", "strap", "strap_strength", "pad", "edge", "lip")


def with_surroundings(
    item: Item, numbers: Mapping[str, float], text: Mapping[str, str]
) -> tuple[Item, list[tuple[str, str]]]:
    """An item with what its row says of its surroundings, and what it cannot be: which, and why.

    Args:
        item: without surroundings.
        numbers: of the row, in SI.
        text: of its cells.
    """
    told = plain(text.get("strap", ""))
    spelled = [] if told == "none" or YES_OR_NO.get(told) is False else text["strap"].split(";")
    given = [name for name in COLUMNS if text.get(name) and (name != "strap" or spelled)]
    if faults := list(_contradictions(item, given, numbers, text)):
        return item, faults
    if not given:
        return item, []
    solid = solid_of(item, ROLLING_RESISTANCE)
    if solid is None:
        needed = tell(
            "is simulated in three dimensions: give depth_m and width_m of the object, or its "
            "diameter"
        )
        return item, [(given[0], needed)]
    try:
        around = surroundings_of(
            solid,
            side=SIDES[plain(text.get("wall_side", ""))],
            straps=[read_strap(each.strip()) for each in spelled if each.strip()],
            wall_gap=numbers.get("wall_gap"),
            wall_restitution=RESTITUTION if "wall_gap" in numbers else None,
            edge=numbers.get("edge"),
            lip=numbers.get("lip"),
            pull_off=numbers.get("pad"),
        )
        if around and (strength := numbers.get("strap_strength")):
            straps = tuple(replace(each, strength=strength) for each in around.straps)
            around = replace(around, straps=straps)
        high = [each for each in (around.straps if around else ()) if each.point[2] > item.height]
        if high:
            message = tell(
                "begins {z:g} m above the floor, and the object is {height:g} m high",
                z=high[0].point[2],
                height=item.height,
            )
            return item, [("strap", message)]
        require_surrounded(solid, around, 0.0)
    except InputError as error:
        which = "strap" if "strap" in given else given[0]
        return item, [(which, str(error))]
    return replace(item, surroundings=around), []


def _contradictions(
    item: Item, given: list[str], numbers: Mapping[str, float], text: Mapping[str, str]
) -> Iterator[tuple[str, str]]:
    """What the cells of surroundings cannot be together: which, and why."""
    if text.get("wall_side") and not {"wall_gap", "strap"} & {*given}:
        yield "wall_side", tell("is given without a wall: give wall_gap_mm as well")
    if plain(text.get("strap", "")) in YES_OR_NO and "strap" in given:
        yield (
            "strap",
            tell(
                "is written like {example}, of which 50 kN/m is a soft strap and 200 kN/m a stiff "
                "one; if nothing more is known, leave it empty: straps are tried on every object",
                example=EXAMPLE,
            ),
        )
    if "lip" in given and "edge" not in given:
        yield "lip", tell("is given without an edge: give edge_mm as well")
    if "strap_strength" in given and "strap" not in given:
        yield "strap_strength", tell("is given without a strap: give strap as well")
    if "strap_strength" in given and "strength" in text.get("strap", ""):
        yield "strap_strength", tell("is given in the strap as well: give the one or the other")
    if plain(text.get("wall_side", "")) in FRONT and {"wall_gap", "edge"} <= {*given}:
        yield "wall_side", tell("is that of the edge: there is a wall or an edge, not both")
    if (gap := numbers.get("wall_gap", 0.0)) > item.height:
        yield (
            "wall_gap",
            tell(
                "found {gap:g} m, farther than the object of {height:g} m reaches: leave it empty, "
                "or give the unit, as in wall_gap_mm",
                gap=gap,
                height=item.height,
            ),
        )
    if item.mass is None and (held := [name for name in ("strap", "pad") if name in given]):
        yield held[0], tell("needs the mass of the object: give mass_kg as well")
