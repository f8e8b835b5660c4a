"""Polygons of a plan: what stands, and the ground that it covers when it falls.

A body that falls over a side of its base, or over a corner, covers from there outward a rectangle
as long as it is high, and as wide as its base is across that direction. A wall stops it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from shaketable.inventory import BaseShape, Castors, Item
from shaketable.rooms.room import Door, Hinge, Place, Point, Room, Swing, Thing, plan_angle

ROUND = 32  # corners that stand for a circle
OVER_A_SIDE = 0.05  # rad: what falls nearer than this to a side's normal falls over that side
DOORSTEP = 0.6  # m: of the ground behind a door that counts as outside
SLIDES = 1.0  # m: hardly anything slides farther
NO_GAP = 1e-6  # m: what is drawn as near to a wall as this touches it
Points = NDArray[np.float64]


def base_of(item: Item) -> Points:
    """Corners of a base in its own frame: x from its front to its back, y to its left.

    The origin is the foot of its centre of gravity, as in `Solid`.
    """
    body, across = item.body, item.sideways or item.body
    if item.shape is BaseShape.CYLINDER:
        angles = 2 * math.pi * (np.arange(ROUND) + 0.5) / ROUND
        radius = body.base / 2 / math.cos(math.pi / ROUND)  # around the circle, not within it
        return radius * np.column_stack([np.cos(angles), np.sin(angles)])
    x, y = (-body.left, body.right), (-across.right, across.left)
    return np.array([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])])


def own_angle(thing: Thing, room: Room) -> float:
    """The angle of a thing's own x, from its front to its back, in the plan [rad]."""
    return plan_angle(thing.item.facing or 0.0, room.north) + math.pi


def turned(points: Points, angle: float) -> Points:
    """Points after a turn about the origin, from +x toward +y."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(points @ np.array([[cosine, sine], [-sine, cosine]]))


def foot_of(thing: Thing, room: Room) -> Points:
    """The foot of a thing's centre of gravity in the plan."""
    body, across = thing.item.body, thing.item.sideways or thing.item.body
    middle = [(body.right - body.left) / 2, (across.left - across.right) / 2]
    if thing.item.shape is BaseShape.CYLINDER:
        middle = [0.0, 0.0]
    return np.asarray(thing.at) - turned(np.array(middle), own_angle(thing, room))


def footprint(
    thing: Thing, room: Room, shift: Sequence[float] = (0.0, 0.0), yaw: float = 0.0
) -> Polygon:
    """What a thing stands on.

    Args:
        thing: of the room.
        room: where it is.
        shift: how far its foot came, in the plan [m].
        yaw: by which it has turned [rad].
    """
    corners = turned(base_of(thing.item), own_angle(thing, room) + yaw)
    return Polygon(corners + foot_of(thing, room) + np.asarray(shift))


def fallen(
    thing: Thing, room: Room, toward: float, shift: Sequence[float], yaw: float = 0.0
) -> Polygon:
    """The ground that a thing covers when it has fallen, as if there were no walls.

    Args:
        thing, room, yaw: as for `footprint`.
        toward: the direction in which it falls, from +x toward +y of the plan [rad].
        shift: how far its foot came when its axis was level [m]: it is right above the side, or
            the corner, over which the thing fell.
    """
    angle = own_angle(thing, room) + yaw
    way = toward - angle
    if thing.item.shape is not BaseShape.CYLINDER:
        side = round(way / (math.pi / 2)) * math.pi / 2
        way = side if abs(way - side) < OVER_A_SIDE else way
    across = turned(base_of(thing.item), -way)[:, 1]  # as it falls toward +x
    low, high, end = across.min(), across.max(), thing.item.height
    rectangle = np.array([(0.0, low), (end, low), (end, high), (0.0, high)])
    return Polygon(turned(rectangle, way + angle) + foot_of(thing, room) + np.asarray(shift))


def within_walls(ground: Polygon, outline: Polygon, foot: Points) -> BaseGeometry:
    """What walls leave of the ground that something covers: the part on its own side of them."""
    inside = ground.intersection(outline)
    parts = [each for each in shapely.get_parts(inside) if each.area > 0.0]
    if not parts:
        return Polygon()
    near: BaseGeometry = min(parts, key=lambda part: part.distance(shapely.Point(foot)))
    return near


def walls_near(room: Room, thing: Thing) -> list[tuple[float, Points]]:
    """Walls that a thing may reach as it falls, the nearest first: gap [m], direction toward it.

    A wall counts where part of it stands beside the thing, no farther away than the thing is high,
    or may slide; what rolls freely may come to every wall.
    """
    reach = math.inf if thing.item.castors is Castors.FREE else max(thing.item.height, SLIDES)
    points, found = np.array(footprint(thing, room).exterior.coords), []
    for number, (start, _, inward) in enumerate(_walls(room)):
        gap = float(((points - start) @ inward).min())
        if is_beside(room, thing, number) and -NO_GAP <= gap < reach:
            found.append((max(gap, 0.0), -inward))
    return sorted(found, key=lambda each: each[0])


def is_beside(room: Room, thing: Thing, number: int) -> bool:
    """Whether a part of a wall, of a number from 0, stands right beside a thing."""
    start, end, _ = _walls(room)[number]
    length = math.hypot(*(end - start))
    beside = (np.array(footprint(thing, room).exterior.coords) - start) @ (end - start) / length
    return bool(beside.max() > 0.0 and beside.min() < length)


def before_wall(room: Room, thing: Thing, number: int, gap: float) -> Thing:
    """A thing before a wall: its back to it where its facing is not known, at a distance.

    Args:
        room: where it is.
        thing: beside the place where it is to stand.
        number: of the wall, from 0: from that corner of the outline to the next one.
        gap: from the wall to the nearest point of its base [m].
    """
    start, _, inward = _walls(room)[number]
    if thing.item.facing is None:
        facing = plan_angle(math.atan2(inward[1], inward[0]), room.north)
        thing = replace(thing, item=replace(thing.item, facing=facing))
    near = float(((np.array(footprint(thing, room).exterior.coords) - start) @ inward).min())
    x, y = np.asarray(thing.at) + (gap - near) * inward
    return replace(thing, at=(float(x), float(y)))


def leaning(thing: Thing, room: Room, shift: Sequence[float], yaw: float) -> BaseGeometry:
    """The ground below a thing that one of the walls near it holds up; which one is not told."""
    base = footprint(thing, room, shift, yaw)
    ground: BaseGeometry = base
    for gap, out in walls_near(room, thing):
        at_wall = Polygon(np.array(base.exterior.coords) + gap * out)
        ground = ground.union(base.union(at_wall).convex_hull)
    return ground


def _walls(room: Room) -> list[tuple[Points, Points, Points]]:
    """Ends of each wall, and the direction into the room."""
    corners = np.array(room.outline)
    ends, ring = np.roll(corners, -1, axis=0), shapely.LinearRing(corners)
    sense = 1.0 if ring.is_ccw else -1.0
    return [
        (start, end, sense * np.array([start[1] - end[1], end[0] - start[0]])
         / math.hypot(*(end - start)))
        for start, end in zip(corners, ends, strict=True)
    ]  # fmt: skip


def outline_of(room: Room) -> Polygon:
    """The floor of a room."""
    return Polygon(room.outline)


def place_of(place: Place) -> Polygon:
    """The rectangle of a place."""
    x, y = np.array(place.size) / 2
    corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
    return Polygon(turned(corners, -place.turned) + np.asarray(place.at))


def inward_at(room: Room, at: Point) -> Points:
    """The direction into the room at a point of its outline, square to the wall there."""
    walls = _walls(room)
    lines = shapely.linestrings([(start, end) for start, end, _ in walls])
    return walls[int(shapely.distance(lines, shapely.Point(at)).argmin())][2]


def opening_of(door: Door, room: Room) -> Polygon:
    """The ground in a door and right behind it, which counts as outside."""
    inward = inward_at(room, door.at)
    along = np.array([inward[1], -inward[0]]) * door.width / 2
    at, out = np.asarray(door.at), -DOORSTEP * inward
    return Polygon([at - along, at + along, at + along + out, at - along + out])


def sweep_of(door: Door, room: Room) -> Polygon:
    """The ground that a door's leaf sweeps in the room; empty if it does not open inward."""
    if door.swing is not Swing.INWARD:
        return Polygon()
    inward = inward_at(room, door.at)
    right = np.array([-inward[1], inward[0]])  # of somebody in the room who looks at the door
    hinge = np.asarray(door.at) + right * door.width / 2 * (1 if door.hinge is Hinge.RIGHT else -1)
    across = np.asarray(door.at) * 2 - hinge - hinge
    angles = np.linspace(0.0, math.pi / 2, 13)[:, None]
    arc = hinge + np.cos(angles) * across + np.sin(angles) * door.width * inward
    return Polygon([hinge, *arc])
