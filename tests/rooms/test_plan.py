"""Rooms by geometry: frames, what a fall covers, cells, ways out, and faults of a plan."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage
from shapely import Polygon

from shaketable import Body
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.rooms import Door, Hinge, Place, PlaceKind, Room, Swing, Thing, faults_of
from shaketable.rooms.grid import Grid
from shaketable.rooms.grounds import Ground
from shaketable.rooms.judged import Judge
from shaketable.rooms.room import plan_angle
from shaketable.rooms.shaken import at_walls
from shaketable.rooms.shapes import (
    fallen,
    foot_of,
    footprint,
    outline_of,
    own_angle,
    place_of,
    sweep_of,
    within_walls,
)
from shaketable.rooms.ways import REACH, Ways

DEEP, WIDE, HIGH = 0.4, 1.0, 2.0


def cabinet(at: tuple[float, float], facing_deg: float = 0.0, name: str = "cabinet") -> Thing:
    front, side = Body.rectangle(DEEP, HIGH, name=name), Body.rectangle(WIDE, HIGH, name=name)
    facing = math.radians(facing_deg)
    return Thing(item=Item(body=front, sideways=side, height=HIGH, facing=facing), at=at)


def room(*things: Thing, **given: object) -> Room:
    """4 by 3 m, a door of 0.9 m in the middle of the lower wall, a bed in the upper left corner."""
    asked = {
        "name": "room",
        "outline": ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)),
        "doors": (Door(name="door", at=(2.0, 0.0), width=0.9, swing=Swing.OUTWARD),),
        "places": (Place(name="bed", kind=PlaceKind.BED, at=(0.5, 2.0), size=(1.0, 2.0)),),
        **given,
    }
    return Room(things=things, **asked)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("azimuth", "north", "toward"),
    [
        (0, 0, (0, 1)),  # north is up
        (90, 0, (1, 0)),  # east is to the right
        (0, 90, (1, 0)),  # north is to the right
        (90, 90, (0, -1)),
    ],
)
def test_azimuths_go_clockwise(azimuth: float, north: float, toward: tuple[float, float]) -> None:
    angle = plan_angle(math.radians(azimuth), math.radians(north))
    assert (math.cos(angle), math.sin(angle)) == pytest.approx(toward, abs=1e-12)


@pytest.mark.parametrize(("facing", "size"), [(0, (WIDE, DEEP)), (90, (DEEP, WIDE))])
def test_what_faces_east_is_deep_along_x(facing: float, size: tuple[float, float]) -> None:
    thing = cabinet((2.0, 1.5), facing)
    left, low, right, high = footprint(thing, room(thing)).bounds
    assert (right - left, high - low) == pytest.approx(size)
    assert ((left + right) / 2, (low + high) / 2) == pytest.approx(thing.at)


def test_its_own_x_goes_from_its_front_to_its_back() -> None:
    """And at_m is the middle of the base, wherever the centre of gravity is above it."""
    thing = cabinet((2.0, 1.5), 180.0)  # its front looks down
    angle = own_angle(thing, room(thing))
    assert (math.cos(angle), math.sin(angle)) == pytest.approx((0.0, 1.0), abs=1e-12)
    front = Body.rectangle(DEEP, HIGH, eccentricity=0.25)  # nearer to its front
    heavy = replace(thing, item=replace(thing.item, body=front))
    assert foot_of(heavy, room(heavy)) == pytest.approx([2.0, 1.5 - DEEP / 4])
    assert footprint(heavy, room(heavy)).equals_exact(footprint(thing, room(thing)), 1e-12)


def test_a_fall_covers_its_height_by_its_width() -> None:
    """By hand: over its front, from there on; its old footprint is free again."""
    thing = cabinet((2.0, 0.5), 0.0)  # its front looks up
    # when its axis is level its foot is above its front side
    ground = fallen(thing, room(thing), math.pi / 2, (0.0, DEEP / 2))
    assert ground.bounds == pytest.approx((1.5, 0.7, 2.5, 2.7))
    aside = fallen(thing, room(thing), 0.01, (WIDE / 2, 0.0))  # all but over its right side
    assert aside.bounds == pytest.approx((2.5, 0.3, 4.5, 0.7))


def test_a_fall_over_a_corner_is_as_wide_as_its_base_across_it() -> None:
    thing = cabinet((2.0, 0.5), 0.0)
    ground = fallen(thing, room(thing), math.pi / 4, (WIDE / 2, DEEP / 2))
    across = (WIDE + DEEP) / math.sqrt(2)
    assert ground.area == pytest.approx(HIGH * across)


def test_a_turned_thing_falls_over_its_turned_side() -> None:
    thing, turn = cabinet((2.0, 0.5), 0.0), math.radians(20.0)
    shift = DEEP / 2 * np.array([-math.sin(turn), math.cos(turn)])
    ground = fallen(thing, room(thing), math.pi / 2 + turn, shift, turn)
    straight = fallen(thing, room(thing), math.pi / 2, (0.0, DEEP / 2))
    assert ground.area == pytest.approx(straight.area)
    assert ground.centroid.x == pytest.approx(2.0 - (DEEP + HIGH) / 2 * math.sin(turn))


def test_a_cylinder_falls_any_way() -> None:
    body = Body.rectangle(0.23, 1.46)
    drum = Thing(
        item=Item(body=body, sideways=body, height=1.46, shape=BaseShape.CYLINDER), at=(2.0, 1.5)
    )
    for toward in np.linspace(0.0, 6.0, 7):
        shift = 0.115 * np.array([math.cos(toward), math.sin(toward)])
        ground = fallen(drum, room(drum), float(toward), shift)
        # the polygon that stands for its base is around it: up to 0.5 % wider
        assert ground.area == pytest.approx(0.23 * 1.46, rel=5e-3)


def test_a_wall_stops_a_fall() -> None:
    thing = cabinet((2.0, 2.0), 0.0)  # 0.8 m from its front to the upper wall
    shift = np.array([0.0, DEEP / 2])
    ground = fallen(thing, room(thing), math.pi / 2, shift)
    within = within_walls(ground, outline_of(room()), foot_of(thing, room(thing)) + shift)
    assert within.bounds == pytest.approx((1.5, 2.2, 2.5, 3.0))
    # behind a wall that juts out nothing is covered
    outline = Polygon([(0, 0), (4, 0), (4, 3), (2.6, 3), (2.6, 2.4), (1.4, 2.4), (1.4, 3), (0, 3)])
    assert within_walls(ground, outline, np.array([2.0, 2.2])).bounds[3] == pytest.approx(2.4)


def test_cells_are_counted_by_their_middles() -> None:
    grid = Grid.of(room())
    assert grid.floor.sum() * grid.area == pytest.approx(12.0)
    thing = cabinet((2.0, 1.5), 0.0)
    assert grid.covered(footprint(thing, room())).size * grid.area == pytest.approx(WIDE * DEEP)
    some = grid.covered(footprint(thing, room()))
    assert np.flatnonzero(grid.cells(some)).tolist() == sorted(some.tolist())


@pytest.mark.parametrize(
    ("hinge", "swept"), [(Hinge.RIGHT, (1.55, 0.0)), (Hinge.LEFT, (2.45, 0.0))]
)
def test_where_a_door_swings(hinge: Hinge, swept: tuple[float, float]) -> None:
    """Who is in the room and looks at a door in its lower wall has x to the left."""
    door = Door(name="door", at=(2.0, 0.0), width=0.9, swing=Swing.INWARD, hinge=hinge)
    ground = sweep_of(door, room())
    # a quarter of a circle, by a polygon of 12 sides
    assert ground.area == pytest.approx(math.pi * 0.9**2 / 4, rel=3e-3)
    corner = min(ground.exterior.coords, key=lambda at: math.dist(at, swept))
    assert corner == pytest.approx(swept)
    assert ground.bounds == pytest.approx((1.55, 0.0, 2.45, 0.9))


def still(grid: Grid, thing: Thing, where: Room) -> Ground:
    """A thing that stands where it is in one run."""
    rest = grid.covered(footprint(thing, where))
    return Ground(rest, (rest,), np.zeros(1, bool))


@pytest.mark.parametrize(("gap", "passes"), [(0.78, False), (0.79, False), (0.81, True), (1, True)])
def test_a_way_is_as_wide_as_it_has_to_be(gap: float, passes: bool) -> None:
    """From a bed down to the door, past a row of cabinets and the right wall.

    Of cells of 5 mm a gap is a multiple.
    """
    row = [cabinet((x, 1.2), 0.0, f"{x:.1f}") for x in np.arange(4.0 - gap - 0.5, 0.0, -0.9)]
    bed = Place(name="bed", kind=PlaceKind.BED, at=(0.6, 2.5), size=(1.0, 0.9))
    where = room(*row, places=(bed,))
    grid = Grid.of(where, 0.005)
    judged = Judge(where, grid).judged([still(grid, thing, where) for thing in row])
    assert judged.closed.all() != passes


def test_what_lies_before_a_door_closes_it() -> None:
    """One cabinet beside one door: it falls across it, by hand."""
    thing = cabinet((0.3, 0.55), 90.0)  # at the left wall, its front looks to the right
    where = room(thing, places=(
        Place(name="bed", kind=PlaceKind.BED, at=(3.0, 2.3), size=(2.0, 1.0), people=0.5),
    ))  # fmt: skip
    grid = Grid.of(where)
    stands = still(grid, thing, where)
    lies = grid.covered(fallen(thing, where, 0.0, (DEEP / 2, 0.0)))
    # from x = 0.5 to 2.5, from y = 0.05 to 1.05; the door from x = 1.55 to 2.45
    both = Ground(stands.rest, (stands.rest, lies), np.array([False, True]))
    judged = Judge(where, grid).judged([both])
    assert judged.closed[0, 0].tolist() == [False, True]
    assert judged.by[0, 0, 0].tolist() == [False, True]
    assert not judged.hit.any()


def test_what_lies_in_its_swing_closes_a_door() -> None:
    """A door that opens inward: what lies there is in its way, though people could climb past."""
    inward = Door(name="door", at=(2.0, 0.0), width=0.9, hinge=Hinge.LEFT)
    box = Item(body=Body.rectangle(0.1, 0.3), sideways=Body.rectangle(0.1, 0.3), height=0.3)
    thing = Thing(item=box, at=(1.62, 0.06))
    for swing, closed in ((Swing.INWARD, True), (Swing.OUTWARD, False)):
        where = room(thing, doors=(replace(inward, swing=swing, width=1.2),))
        grid = Grid.of(where)
        judged = Judge(where, grid).judged([still(grid, thing, where)])
        assert judged.closed.all() == closed


def test_what_keeps_people_away_is_the_sum_of_what_each_thing_does() -> None:
    """Against the distance of every cell from all that stands or lies, at once, without a window.

    Patches lie anywhere: in walls, before doors, and at the rim of the cells.
    """
    rng = np.random.default_rng(43)
    door = Door(name="gate", at=(4.0, 1.5), width=1.2, swing=Swing.OUTWARD)
    bed = Place(name="bed", kind=PlaceKind.BED, at=(0.8, 2.4), size=(1.0, 1.0))
    where = room(doors=(*room().doors, door), places=(bed,))
    grid = Grid.of(where)
    ways = Ways(where, grid)
    rows, columns = grid.shape
    outcomes = set()
    for _ in range(60):
        occupied, away = (np.zeros(grid.shape, np.bool_) for _ in range(2))
        for _ in range(rng.integers(1, 6)):
            y, x = rng.integers(0, rows), rng.integers(0, columns)
            patch = np.zeros(grid.shape, np.bool_)
            patch[y : y + rng.integers(1, 20), x : x + rng.integers(1, 20)] = True
            occupied |= patch
            away.flat[ways.kept_away(np.flatnonzero(patch))] = True
        clear = grid.floor & ~occupied
        for doorway in grid.doorways:
            clear |= doorway
        passes = grid.cell * ndimage.distance_transform_edt(clear) >= where.way / 2 - grid.cell / 2
        regions, _ = ndimage.label(passes, structure=np.ones((3, 3)))
        far = grid.cell * ndimage.distance_transform_edt(~grid.cells(grid.covered(place_of(bed))))
        near = set(regions[far <= where.way / 2 + REACH].tolist()) - {0}
        expected = [bool(near & (set(regions[grid.doorways[k]].tolist()) - {0})) for k in (0, 1)]
        found = ways.open(occupied, away)[0].tolist()
        assert found == expected
        outcomes.add(tuple(found))
    assert len(outcomes) > 2  # it tells something


def test_walls_that_a_thing_may_reach() -> None:
    """Those behind and beside it; not those that are farther than it is high, or than a metre."""
    thing = cabinet((0.21, 1.0), 90.0)  # its back is 10 mm from the left wall
    walls = at_walls(room(thing), thing).surroundings.walls  # type: ignore[union-attr]
    assert [round(math.degrees(wall.azimuth)) for wall in walls] == [0, 90, -90]
    assert [wall.gap for wall in walls] == pytest.approx([0.01, 0.5, 1.5])
    far = cabinet((0.21, 1.0), 90.0)
    low = replace(far, item=replace(far.item, height=0.4))
    walls = at_walls(room(low), low).surroundings.walls  # type: ignore[union-attr]
    assert [wall.gap for wall in walls] == pytest.approx([0.01, 0.5])
    cart = replace(low, item=replace(low.item, castors=Castors.FREE))
    walls = at_walls(room(cart), cart).surroundings.walls  # type: ignore[union-attr]
    assert [wall.gap for wall in walls] == pytest.approx([0.01, 0.5, 1.5, 3.59])


def test_all_faults_at_once() -> None:
    twice = room(outline=((0, 0), (0, 0), (4, 0), (4, 3), (0, 3)))
    assert "each once" in faults_of(twice)[0].text
    crossing = room(outline=((0, 0), (4, 3), (4, 0), (0, 3)))
    assert "cross each other" in faults_of(crossing)[0].text
    inward = Door(name="door", at=(2.0, 0.0), width=0.9)
    wrong = room(
        cabinet((2.0, 0.3), 0.0, "in the swing"),
        cabinet((4.0, 2.0), 0.0, "in a wall"),
        cabinet((9.0, 2.0), 0.0, "outside"),
        cabinet((2.6, 0.3), 0.0, "in another"),
        cabinet((0.5, 2.0), 0.0, "in the bed"),
        doors=(inward, Door(name="hatch", at=(2.0, 1.0), width=0.9),
               Door(name="gate", at=(0.0, 0.2), width=0.9)),
    )  # fmt: skip
    told = {(each.where, each.text.split(":")[0].split(" (")[0]) for each in faults_of(wrong)}
    assert told == {
        ("hatch", "is 1.00 m away from the walls"),
        ("gate", "reaches past the end of its wall"),
        ("in the swing", "stands where door swings"),
        ("in another", "stands where door swings"),
        ("in another", "stands in in the swing"),
        ("in a wall", "stands in a wall"),
        ("outside", "stands outside the walls"),
        ("in the bed", "stands in bed"),
    }
    assert [each.where for each in faults_of(room(doors=()))] == ["room"]
    assert not faults_of(room(cabinet((3.0, 2.0))))


@pytest.mark.parametrize(("wide", "open_"), [(0.85, True), (0.80, True), (0.70, False)])
def test_a_gap_as_wide_as_the_way_is_open_and_a_narrower_one_closed(
    wide: float, open_: bool
) -> None:
    """A way of 0.80 m between a wall and a row of cabinets, on cells of 0.05 m.

    Cells stand for their middles: 0.75 m cannot be told from 0.80 m, and counts as open.
    """
    bed = Place(name="bed", kind=PlaceKind.BED, at=(0.6, 2.4), size=(1.0, 1.0))
    where = room(places=(bed,), way=0.8)
    grid = Grid.of(where)
    assert grid.cell == pytest.approx(0.05)
    ways = Ways(where, grid)
    y, x = np.indices(grid.shape)
    outline = np.argwhere(grid.floor)
    (low_y, low_x), (high_y, high_x) = outline.min(axis=0), outline.max(axis=0)
    row = low_y + (high_y - low_y) // 2  # across the room, but for a gap at its left wall
    bar = (np.abs(y - row) <= 2) & (x >= low_x + round(wide / grid.cell)) & (x <= high_x)
    occupied = bar & grid.floor
    away = np.zeros(grid.shape, np.bool_)
    away.flat[ways.kept_away(np.flatnonzero(occupied))] = True
    assert bool(ways.open(occupied, away).any()) is open_


def test_what_keeps_a_disc_away_is_nearer_than_its_radius_less_half_a_cell() -> None:
    """0.40 m less 0.025: a cell 7 and 3 cells off (0.381 m)
    does not, one 7 and 2 off (0.364 m) does.

    The middle of a cell stands for all of it, whose border is half a cell nearer.
    """
    where = room(way=0.8)
    grid = Grid.of(where)
    ways = Ways(where, grid)
    y, x = (int(each) for each in np.argwhere(grid.floor)[grid.floor.sum() // 2])
    away = np.zeros(grid.shape, np.bool_)
    away.flat[ways.kept_away(np.array([y * grid.shape[1] + x]))] = True
    assert not away[y + 7, x + 3]
    assert away[y + 7, x + 2]
