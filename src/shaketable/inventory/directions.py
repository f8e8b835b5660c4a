"""Objects as the bodies that are shaken: front to back, and side to side where that differs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from shaketable.body import Body
from shaketable.inventory.item import Item

FRONT, SIDE = "front to back", "side to side"


class Directed(NamedTuple):
    """An object in one direction.

    Attributes:
        number: its place in the inventory, from 1.
        item: the object.
        direction: FRONT or SIDE.
        body: named by the place, and by the direction where there are two.
    """

    number: int
    item: Item
    direction: str
    body: Body


def directed(items: Iterable[tuple[int, Item]]) -> list[Directed]:
    """Objects in each direction that differs.

    Args:
        items: each with its place, from 1.
    """
    found = []
    for number, item in items:
        both = item.sideways is not None and item.sideways != item.body
        for direction, body in ((FRONT, item.body), (SIDE, item.sideways if both else None)):
            if body is not None:
                way = f", {direction}" if both else ""
                named = replace(body, name=f"{number}: {item.name}{way}")
                found.append(Directed(number, item, direction, named))
    return found


def both_directions(items: Iterable[tuple[int, Item]]) -> list[Body]:
    """The bodies of objects in each direction; arguments as for `directed`."""
    return [one.body for one in directed(items)]
