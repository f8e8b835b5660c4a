"""What is wrong with the plan of a room: all of it at once, each with where, and a remedy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely
from shapely import Polygon

from shaketable.language import tell
from shaketable.rooms.room import Point, Room
from shaketable.rooms.shapes import (
    footprint,
    inward_at,
    outline_of,
    place_of,
    sweep_of,
    walls_near,
)

OVERLAP = 1e-4  # m²: less is how plans are drawn
ON_WALL = 0.02  # m: a door whose middle is as near to the outline is on it
SHORTEST = 1e-3  # m: of a wall
SMALL, LARGE = 1.0, 10_000.0  # m²: rooms beyond that are in another unit


class PlanFault(NamedTuple):
    """A fault of a plan.

    Attributes:
        where: the names of what it is about.
        text: what is wrong, and what to do.
        at: where to draw it.
        on_page: the same for somebody who draws the plan and sees no file; `text` if empty.
    """

    where: str
    text: str
    at: Point
    on_page: str = ""


def faults_of(room: Room) -> list[PlanFault]:
    """All faults of a room's plan."""
    outline = outline_of(room)
    corners = np.array(room.outline)
    again = (np.hypot(*(np.roll(corners, -1, axis=0) - corners).T) < SHORTEST).any()
    if again or not outline.is_valid:
        middle = tuple(np.mean(room.outline, axis=0).tolist())
        text = tell("its walls cross each other: give the corners in order, each once")
        return [PlanFault("outline_m", text, middle)]
    return [*_of_size(room, outline), *_of_doors(room, outline), *_of_places(room, outline),
            *_of_things(room, outline)]  # fmt: skip


def _of_size(room: Room, outline: Polygon) -> Iterator[PlanFault]:
    if not SMALL <= outline.area <= LARGE:
        text = tell("encloses {area:.3g} m²; are its corners in metres?", area=outline.area)
        yield PlanFault("outline_m", text, _middle(outline))


def _of_doors(room: Room, outline: Polygon) -> Iterator[PlanFault]:
    for door in room.doors:
        far = outline.exterior.distance(shapely.Point(door.at))
        if far > ON_WALL:
            text = tell(
                "is {far:.2f} m away from the walls: at_m is the middle of its opening, on the "
                "outline",
                far=far,
            )
            page = tell("is {far:.2f} m away from the walls: drag it onto one", far=far)
            yield PlanFault(door.name, text, door.at, page)
            continue
        ends = _ends(door.at, door.width, room)
        if max(outline.exterior.distance(shapely.Point(end)) for end in ends) > ON_WALL:
            text = tell(
                "reaches past the end of its wall: it is {width:g} m wide", width=door.width
            )
            yield PlanFault(door.name, text, door.at)
    if not any(door.exit for door in room.doors):
        text = tell("has no exit: give a [[door]] with exit = true")
        page = tell("has no way out: add a door and tick 'It is a way out'")
        yield PlanFault(room.name, text, _middle(outline), page)


def _of_places(room: Room, outline: Polygon) -> Iterator[PlanFault]:
    for place in room.places:
        outside = place_of(place).difference(outline).area
        if outside > OVERLAP:
            text = tell(
                "lies with {area:.2f} m² outside the walls: move it, or turn it", area=outside
            )
            yield PlanFault(place.name, text, place.at)


def _of_things(room: Room, outline: Polygon) -> Iterator[PlanFault]:
    bases = [footprint(thing, room) for thing in room.things]
    for k, (thing, base) in enumerate(zip(room.things, bases, strict=True)):
        if base.difference(outline).area > OVERLAP:
            inside = walls_near(room, thing) or base.intersects(outline)
            much = (
                tell("stands in a wall: move it into the room, or see which way it faces")
                if inside
                else tell("stands outside the walls: is at_m in metres?")
            )
            page = tell("stands outside the walls: drag it into the room")
            yield PlanFault(thing.name, much, thing.at, "" if inside else page)
        if thing.on:
            continue
        for other, its in list(zip(room.things, bases, strict=True))[:k]:
            if not other.on and base.intersection(its).area > OVERLAP:
                text = tell(
                    "stands in {other}: move one of them, or say on = {quoted!r} if it stands on "
                    "it",
                    other=other.name,
                    quoted=other.name,
                )
                page = tell(
                    "stands in {other}: move one of them, or choose it under 'Stands on' if it "
                    "stands on it",
                    other=other.name,
                )
                yield PlanFault(thing.name, text, thing.at, page)
        for place in room.places:
            if place.kind.stands and base.intersection(place_of(place)).area > OVERLAP:
                text = tell("stands in {other}: move one of them", other=place.name)
                yield PlanFault(thing.name, text, thing.at)
        for door in room.doors:
            if base.intersection(sweep_of(door, room)).area > OVERLAP:
                text = tell(
                    "stands where {door} swings: move it, or say how the door opens (swing, hinge)",
                    door=door.name,
                )
                page = tell(
                    "stands where {door} swings: move it, or choose how the door opens",
                    door=door.name,
                )
                yield PlanFault(thing.name, text, thing.at, page)


def _ends(at: Point, width: float, room: Room) -> list[Point]:
    """Both sides of a door's opening."""
    inward = inward_at(room, at)
    along = np.array([inward[1], -inward[0]]) * width / 2
    return [tuple((np.asarray(at) + sign * along).tolist()) for sign in (1, -1)]


def _middle(ground: Polygon) -> Point:
    return (ground.representative_point().x, ground.representative_point().y)
