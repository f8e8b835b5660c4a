"""Objects as the bodies that are shaken: front to back, and side to side where that differs."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from shaketable.body import Body
from shaketable.inventory.item import Item
from shaketable.surroundings import Edge, Pad, Strap, Surroundings, Wall

FRONT, SIDE = "front to back", "side to side"
#: Toward which azimuth of a solid's own frame +x of its planar body is [rad].
TOWARD = {FRONT: 0.0, SIDE: -math.pi / 2}
PARALLEL = 1e-9  # of a cosine, and m
FEET = 2  # of a solid, that are one foot of its planar body


class Directed(NamedTuple):
    """An object in one direction.

    Attributes:
        number: its place in the inventory, from 1.
        item: the object.
        direction: FRONT or SIDE.
        body: named by the place, and by the direction where there are two.
        surroundings: what of the object's acts in that direction; None where nothing does. The
            body then has its mass and its height.
    """

    number: int
    item: Item
    direction: str
    body: Body
    surroundings: Surroundings | None = None


def directed(items: Iterable[tuple[int, Item]]) -> list[Directed]:
    """Objects in each direction that differs.

    Args:
        items: each with its place, from 1.
    """
    found = []
    for number, item in items:
        # what surrounds an object tells its directions apart, alike as its bodies may be
        both = item.sideways is not None and (
            item.sideways != item.body or item.surroundings is not None
        )
        for direction, body in ((FRONT, item.body), (SIDE, item.sideways if both else None)):
            if body is not None:
                way = f", {direction}" if both else ""
                named = replace(body, name=f"{number}: {item.name}{way}")
                around = item.surroundings and in_plane(item.surroundings, TOWARD[direction])
                if around:
                    named = replace(named, mass=item.mass, height=item.height)
                found.append(Directed(number, item, direction, named, around or None))
    return found


def both_directions(items: Iterable[tuple[int, Item]]) -> list[Body]:
    """The bodies of objects in each direction; arguments as for `directed`."""
    return [one.body for one in directed(items)]


def in_plane(around: Surroundings, toward: float) -> Surroundings:
    """What of a solid's surroundings acts on its planar body, whose +x is toward an azimuth [rad].

    Walls and edges that lie across, and straps that go along; of four pads two are a foot.
    """
    along = math.cos(toward), math.sin(toward)

    def on(place: tuple[float, ...], x: float, y: float) -> float:
        return place[0] * x + place[1] * y

    def turned(thing: Wall | Edge) -> float | None:
        cosine = math.cos(thing.azimuth - toward)
        if abs(cosine) < 1.0 - PARALLEL:
            return None
        return 0.0 if cosine > 0.0 else math.pi

    def flat(strap: Strap) -> Strap:
        point, anchor = ((on(each, *along), each[2]) for each in (strap.point, strap.anchor))
        return replace(strap, point=point, anchor=anchor)

    def aside(strap: Strap) -> float:
        return on(strap.anchor, -along[1], along[0]) - on(strap.point, -along[1], along[0])

    edge = around.edge
    ends = None if edge is None else turned(edge)
    return Surroundings(
        walls=tuple(
            replace(wall, azimuth=azimuth)
            for wall in around.walls
            if (azimuth := turned(wall)) is not None
        ),
        straps=tuple(flat(strap) for strap in around.straps if abs(aside(strap)) < PARALLEL),
        edge=None if edge is None or ends is None else replace(edge, azimuth=ends),
        pad=around.pad and Pad(pull_off=FEET * around.pad.pull_off),
    )
