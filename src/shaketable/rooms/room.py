"""A room: its outline, doors and places, and the things that stand in it.

Its plan has x to the right and y up [m]. Directions of things and places are azimuths, clockwise
from north, as in an inventory; `plan_angle` alone converts them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum

from shaketable.inventory import Castors, Item

Point = tuple[float, float]
WAY = 0.80  # m: how wide a way out has to be, if a room does not say


class Swing(StrEnum):
    """How a door opens."""

    INWARD = "inward"
    OUTWARD = "outward"
    SLIDING = "sliding"


class Hinge(StrEnum):
    """On which side of a door its hinges are, seen from inside the room."""

    LEFT = "left"
    RIGHT = "right"


class PlaceKind(StrEnum):
    """What a place is for."""

    BED = "bed"
    DESK = "desk"
    TURNING = "turning"  # where a wheelchair turns
    CORRIDOR = "corridor"

    @property
    def stands(self) -> bool:
        """Whether it is furniture, around which people walk."""
        return self in (PlaceKind.BED, PlaceKind.DESK)


@dataclass(frozen=True, kw_only=True)
class Door:
    """A door in a wall of a room, with its width, hinges and swing.

    Attributes:
        name: of it.
        at: the middle of its opening, on the outline.
        width: of the opening [m].
        swing: how it opens.
        hinge: on which side, seen from inside.
        exit: whether it is a way out.
    """

    name: str
    at: Point
    width: float
    swing: Swing = Swing.INWARD
    hinge: Hinge = Hinge.LEFT
    exit: bool = True


@dataclass(frozen=True, kw_only=True)
class Place:
    """A rectangle where people are, or pass.

    Attributes:
        name: of it.
        kind: what it is for.
        at: its middle.
        size: along x and along y, before it is turned [m].
        turned: clockwise, seen from above [rad].
        people: how many are there, on an average.
    """

    name: str
    kind: PlaceKind
    at: Point
    size: Point
    turned: float = 0.0
    people: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Thing:
    """An object and where it stands.

    Attributes:
        item: the object, with the azimuth to which its front looks, and what holds it.
        at: the middle of its base.
        on: the name of the thing on which it stands, "" for the floor.
    """

    item: Item
    at: Point
    on: str = ""

    @property
    def name(self) -> str:
        return self.item.name


def placed_item(item: Item) -> Item:
    """An item as it stands in a room: castors that may be locked are taken as locked."""
    if item.castors is not Castors.SOME:
        return item
    return replace(item, castors=Castors.LOCKED, lock_known=False)


@dataclass(frozen=True, kw_only=True)
class Room:
    """A room.

    Attributes:
        name: of it.
        outline: corners of its walls, in order.
        doors, places, things: in it.
        north: direction of north, clockwise from +y of the plan [rad]; None if it is not known.
        floor: label of the floor of a building on which it is, "" if none is given.
        way: how wide a way out has to be [m].
        scatter: how far the contents of what falls lie around it [m].
    """

    name: str
    outline: tuple[Point, ...]
    doors: tuple[Door, ...] = ()
    places: tuple[Place, ...] = ()
    things: tuple[Thing, ...] = ()
    north: float | None = None
    floor: str = ""
    way: float = WAY
    scatter: float = 0.0


def plan_angle(azimuth: float, north: float | None) -> float:
    """The angle from +x toward +y of a direction of the compass [rad].

    Args:
        azimuth: clockwise from north [rad].
        north: its direction, clockwise from +y [rad]; where it is not known, +y is called north.
    """
    return math.pi / 2 - azimuth - (north or 0.0)
