"""Sizes that a list leaves out, taken from the catalogue of common things."""

from __future__ import annotations

from collections.abc import Mapping, Set
from typing import NamedTuple

from shaketable.inventory.catalogue import CommonThing, common_thing
from shaketable.inventory.item import Assumed, BaseShape

SIDES = ("depth", "width")


class TakenSizes(NamedTuple):
    """What the catalogue gives for what a row leaves out.

    Attributes:
        thing: of the catalogue.
        numbers: by their meanings, those that were given included.
        shape: of its base.
        assumed: what was not given, as `Item.assumed`.
    """

    thing: CommonThing
    numbers: dict[str, float]
    shape: BaseShape
    assumed: tuple[Assumed, ...]


def taken_sizes(
    name: str, numbers: Mapping[str, float], shape: BaseShape | None, filled: Set[str]
) -> TakenSizes | None:
    """The sizes of a thing by its name; None where none is left out, or the catalogue has no such.

    Of a range the smaller base and the larger height, height of the centre of gravity and mass:
    of what is usual, the one that tips most easily.

    Args:
        name: of the object.
        numbers: that its row gives, by their meanings.
        shape: of its base, if its row says it.
        filled: meanings of cells with text, also where that could not be read.
    """
    thing = common_thing(name)
    if thing is None:
        return None
    is_round = "diameter" in filled or (shape or thing.shape) is BaseShape.CYLINDER
    across = filled & {"diameter", *SIDES}
    base = SIDES if not is_round else () if across else ("diameter",)
    missing = [each for each in (*base, "height") if each not in filled]
    if not missing:
        return None
    found = dict(numbers)
    assumed = []
    sizes = {"diameter": thing.depth, "depth": thing.depth, "width": thing.width}
    for each in missing:
        usual = sizes.get(each, thing.height)
        found[each] = usual.most if each == "height" else usual.least
        assumed.append(Assumed(each, found[each], usual.least, usual.most))
    if "cg_height" not in filled and "height" in found:
        found["cg_height"] = thing.cg.most * found["height"]
        shares = (each * found["height"] for each in (thing.cg.least, thing.cg.most))
        assumed.append(Assumed("cg_height", found["cg_height"], *shares))
    if "mass" not in filled:
        found["mass"] = thing.mass.most
        assumed.append(Assumed("mass", thing.mass.most, thing.mass.least, thing.mass.most))
    across_is_given = BaseShape.CYLINDER if "diameter" in filled else thing.shape
    return TakenSizes(thing, found, shape or across_is_given, tuple(assumed))
