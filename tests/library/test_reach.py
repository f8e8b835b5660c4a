"""How far things reach from the wall behind them: beside the polygons of rooms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Solid
from shaketable.body import Body
from shaketable.inventory import Item
from shaketable.inventory.item import BaseShape
from shaketable.library.reach import reach_from_wall

pytest.importorskip("shapely")

GAP = 0.1


@pytest.mark.parametrize("shape", [BaseShape.BOX, BaseShape.CYLINDER])
def test_it_is_that_of_the_polygons_of_a_room(shape: BaseShape) -> None:
    """The room's polygon is drawn with the same sizes; both are exact but for a circle's corners.

    Rooms let what falls within 0.05 rad of a side's normal fall over that side: falls are drawn
    beside that.
    """
    from shaketable.rooms.room import Room, Thing
    from shaketable.rooms.shapes import fallen, footprint

    depth, width, height = 0.4, 0.9, 1.8
    if shape is BaseShape.CYLINDER:
        width = depth
        solid = Solid.cylinder(depth, height)
    else:
        solid = Solid.box(depth, width, height)
    item = Item(
        body=Body.rectangle(depth, height, name="thing"),
        sideways=Body.rectangle(width, height, name="thing"),
        height=height,
        shape=shape,
    )
    room = Room(name="room", outline=((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)))
    thing = Thing(item=item, at=(4.0, 4.0))  # its x, front to back, is toward the plan's -y or so
    random = np.random.default_rng(1)
    from shaketable.rooms.shapes import own_angle

    angle = own_angle(thing, room)
    back = np.array([math.cos(angle), math.sin(angle)])
    for _ in range(40):
        shift, yaw = random.uniform(-0.5, 0.5, 2), random.uniform(-1.0, 1.0)
        toward = angle + yaw + random.integers(4) * math.pi / 2 + random.uniform(0.1, 1.4)
        for fell in (False, True):
            ground = (
                fallen(thing, room, toward, shift, yaw)
                if fell
                else footprint(thing, room, shift, yaw)
            )
            corners = np.array(ground.exterior.coords)
            wall = (np.array(thing.at) + (depth / 2 + GAP) * back) @ back
            there = float((wall - corners @ back).max())
            here = reach_from_wall(
                solid, angle, GAP, np.array([fell]), shift[None], np.array([yaw]),
                np.array([toward]),
            )[0]  # fmt: skip
            # 32 corners around a circle are 0.5 % of its radius farther out than within it
            assert here == pytest.approx(there, abs=0.003 if shape is BaseShape.CYLINDER else 1e-9)


def test_it_begins_with_the_depth_and_the_gap() -> None:
    none = np.zeros(1)
    reach = reach_from_wall(
        Solid.box(0.4, 0.9, 1.8), 0.7, GAP, np.array([False]), np.zeros((1, 2)), none, none
    )
    assert reach == pytest.approx(0.4 + GAP)
    away = reach_from_wall(
        Solid.box(0.4, 0.9, 1.8), 0.0, GAP, np.array([True]), np.array([[-0.2, 0.0]]), none,
        np.array([math.pi]),
    )  # fmt: skip
    # its foot lies over the front edge, and it lies from there as far as it is high
    assert away == pytest.approx(0.2 + GAP + 0.2 + 1.8)
