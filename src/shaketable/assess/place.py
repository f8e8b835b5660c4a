"""What becomes of the items of one place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shaketable.assess.item_result import ItemResult
from shaketable.assess.plane import (
    Plane,
    beside,
    if_locked,
    levels_of,
    searches_of,
    severity,
    with_bases,
)
from shaketable.assess.profiles import profiles_of
from shaketable.assess.runs import Done, result_of, uncounted
from shaketable.assess.solids import ShakingInSpace
from shaketable.inventory import Item


def results_of(
    items: Sequence[Item], plane: Plane, space: ShakingInSpace | None, done: Done
) -> list[ItemResult]:
    """What becomes of each of some items of a place.

    What three dimensions decide is run in a plane as it stands, and no further.

    Args:
        items: some.
        plane: how they are shaken in a plane.
        space: how they are shaken in three dimensions; None where they are not.
        done: is told how many more simulations were made.
    """
    solids = space.results(items, plane.levels, done) if space else [None] * len(items)
    flat = [n for n, solid in enumerate(solids) if solid is None]
    decided = dict(zip(flat, _in_plane([items[n] for n in flat], plane, done), strict=True))
    known = {n: solid for n, solid in enumerate(solids) if solid is not None}
    beside_them = _as_it_stands([items[n] for n in known], plane, uncounted)
    others = dict(zip(known, beside_them, strict=True))
    return [
        replace(others[n], solid=known[n].result, levels=known[n].levels)
        if n in known
        else decided[n]
        for n in range(len(items))
    ]


def _as_it_stands(items: Sequence[Item], plane: Plane, done: Done) -> list[ItemResult]:
    """Items in the worse of their directions, as they stand, with what simple criteria say."""
    each = [profiles_of(item, plane.tilt) for item in items]
    profiles = [profile for some in each for profile in some]
    runs = iter(plane.runs(profiles, plane.trial.scale, done))
    made = []
    for some in each:
        own = [next(runs) for _ in some]
        found = [result_of(*pair, plane.draws) for pair in zip(some, own, strict=True)]
        lead = max(range(len(found)), key=lambda k: severity(found[k]))
        other = next((one for k, one in enumerate(found) if k != lead), None)
        made.append((found[lead], other, own[lead]))
    told = beside([lead.profile for lead, _, _ in made], [runs for _, _, runs in made], plane)
    return [
        ItemResult(**vars(lead), other=other, **more)
        for (lead, other, _), more in zip(made, told, strict=True)
    ]


def _in_plane(items: Sequence[Item], plane: Plane, done: Done) -> list[ItemResult]:
    """Items of which a plane decides: what becomes of them, and what would help."""
    if not items:
        return []
    found = with_bases(_as_it_stands(items, plane, done), plane, done)
    searched = searches_of([each.profile for each in found], plane, done)
    locked = if_locked(items, plane, done)
    levels = levels_of(items, plane, done)
    return [
        replace(one, locked=locked[k], levels=levels[k], **searched[k])
        for k, one in enumerate(found)
    ]
