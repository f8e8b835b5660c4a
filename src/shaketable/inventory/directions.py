"""Objects as the bodies that are shaken: front to back, and side to side where that differs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from shaketable.body import Body
from shaketable.inventory.item import Item


def both_directions(items: Iterable[tuple[int, Item]]) -> list[Body]:
    """The bodies of objects, named by the object's place in its inventory and the direction.

    Args:
        items: each with its place, from 1.
    """
    bodies = []
    for number, item in items:
        both = item.sideways is not None and item.sideways != item.body
        way = ", front to back" if both else ""
        bodies.append(replace(item.body, name=f"{number}: {item.name}{way}"))
        if both and item.sideways is not None:
            bodies.append(replace(item.sideways, name=f"{number}: {item.name}, side to side"))
    return bodies
