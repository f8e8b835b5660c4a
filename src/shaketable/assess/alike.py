"""Which objects are alike: of one name, size and support, wherever they stand."""

from __future__ import annotations

from dataclasses import replace

from shaketable.inventory import Item


def alike(item: Item) -> Item:
    """What is the same of an item and of others like it: all but where and how many they are."""
    return replace(item, quantity=1, building="", site=None, floor="", location="", row=0)
