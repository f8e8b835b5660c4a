"""What surrounds an object, on its planar bodies."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from shaketable import Body, Edge, Pad, Strap, Surroundings, Wall
from shaketable.inventory import Item
from shaketable.inventory.directions import FRONT, SIDE, TOWARD, directed, in_plane

BACK, LEFT = Wall(gap=0.01), Wall(gap=0.02, azimuth=math.pi / 2)
TO_BACK = Strap(point=(0.15, 0.1, 1.8), anchor=(0.2, 0.1, 1.9), stiffness=1e4, slack=0.01)
TO_LEFT = Strap(point=(0.0, 0.45, 1.8), anchor=(0.0, 0.5, 1.8), stiffness=1e4)
ACROSS = Strap(point=(0.15, 0.1, 1.8), anchor=(0.2, 0.2, 1.8), stiffness=1e4)
AROUND = Surroundings(
    walls=(BACK, LEFT),
    straps=(TO_BACK, TO_LEFT, ACROSS),
    edge=Edge(at=0.2, azimuth=math.pi, lip=0.01),
    pad=Pad(pull_off=30.0),
)


def test_front_to_back() -> None:
    """Its -x is the front: what is behind is toward +x, and an edge in front toward -x."""
    found = in_plane(AROUND, TOWARD[FRONT])
    assert found.walls == (BACK,)
    assert found.straps == (replace(TO_BACK, point=(0.15, 1.8), anchor=(0.2, 1.9)),)
    assert found.edge == AROUND.edge
    assert found.pad == Pad(pull_off=60.0)  # two of four feet


def test_side_to_side() -> None:
    """Its -x is to the left: a wall there stands toward -x."""
    found = in_plane(AROUND, TOWARD[SIDE])
    assert found.walls == (replace(LEFT, azimuth=math.pi),)
    (strap,) = found.straps
    assert strap.point == pytest.approx((-0.45, 1.8))
    assert strap.anchor == pytest.approx((-0.5, 1.8))
    assert found.edge is None


def test_bodies_have_what_acts_on_them() -> None:
    front, side = (Body.rectangle(b, 1.8, name="shelf") for b in (0.3, 0.9))
    item = Item(body=front, sideways=side, height=1.8, mass=80.0)
    walled = replace(item, surroundings=Surroundings(walls=(BACK,)))
    ways = directed([(1, walled), (2, item)])
    assert [bool(way.surroundings) for way in ways] == [True, False, False, False]
    assert [way.body.mass for way in ways] == [80.0, None, None, None]
    assert ways[0].body.whole_height == 1.8


def test_alike_bodies_are_two_where_something_stands_beside_one() -> None:
    """A square object is held front to back alone; side to side it stands alone."""
    body = Body.rectangle(0.4, 1.6, name="square")
    item = Item(body=body, sideways=body, height=1.6)
    assert len(directed([(1, item)])) == 1
    walled = replace(item, surroundings=Surroundings(walls=(BACK,)))
    front, side = directed([(1, walled)])
    assert front.surroundings is not None
    assert side.surroundings is None
    left = replace(item, surroundings=Surroundings(walls=(LEFT,)))
    front, side = directed([(1, left)])
    assert front.surroundings is None
    assert side.surroundings is not None
