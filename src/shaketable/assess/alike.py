"""Which objects are alike, wherever they stand: in all, or in what decides how they move."""

from __future__ import annotations

from dataclasses import replace

from shaketable.assess.item_result import ItemResult, ProfileResult
from shaketable.assess.profiles import Profile, profiles_of
from shaketable.assess.uncertainty import kind_of
from shaketable.inventory import Castors, Item


def alike(item: Item) -> Item:
    """What is the same of an item and of others like it: all but where and how many they are."""
    return replace(
        item,
        quantity=1,
        building="",
        site=None,
        floor="",
        location="",
        position=None,
        wall="",
        row=0,
    )


def as_simulated(item: Item) -> Item:
    """What decides how an item moves: the same for all whose simulations are the same.

    Of its name only the kind of furniture, which says how far others like it differ from it.
    """
    return replace(
        alike(item),
        body=replace(item.body, name=kind_of(item).name),
        sideways=item.sideways and replace(item.sideways, name=""),
        note="",
        critical=0,
        blocks_exit=False,
        people_nearby=False,
        must_not_fall=False,
        stands_on="",
        may_be_round=False,
        unread=(),
        assumed=(),
        assumed_as="",
    )


def result_for(item: Item, found: ItemResult, tilt: float) -> ItemResult:
    """What was found of an item, as the result of one that moves alike.

    Args:
        item: the other one.
        found: of the first.
        tilt: of their support [rad].
    """
    profiles = {each.direction: each for each in profiles_of(item, tilt)}

    def its(one: ProfileResult) -> Profile:
        return profiles[one.profile.direction]

    other, locked = found.other, found.locked
    if locked is not None:
        own = replace(locked.profile, item=replace(item, castors=Castors.LOCKED))
        locked = replace(locked, profile=replace(own, body=its(locked).body))
    return replace(
        found,
        profile=its(found),
        other=other and replace(other, profile=its(other)),
        locked=locked,
    )
