"""Columns that say what an object stands beside, and what holds it."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from shaketable import Edge, InputError, Pad, Strap, Surroundings, Wall
from shaketable.inventory import Item, read_inventory

SIZES = "name,depth_m,width_m,height_m,mass_kg"


def read(tmp_path: Path, columns: str, cells: str, mass: str = "110") -> Item:
    path = tmp_path / "list.csv"
    path.write_text(f"{SIZES},{columns}\nshelf,0.3,0.9,1.8,{mass},{cells}\n", encoding="utf-8")
    (item,) = read_inventory(path)
    return item


def test_a_list_without_these_columns_stands_alone(tmp_path: Path) -> None:
    assert read(tmp_path, "note", "old").surroundings is None
    assert read(tmp_path, "wall_gap_mm,strap,edge_mm", ",,").surroundings is None
    for word in ("no", "none", "-"):
        assert read(tmp_path, "strap", word).surroundings is None


@pytest.mark.parametrize(
    ("side", "azimuth", "x", "y"),
    [
        ("", 0.0, 0.15, 0.0),
        ("back", 0.0, 0.15, 0.0),
        ("left", math.pi / 2, 0.0, 0.45),
        ("front", math.pi, -0.15, 0.0),
        ("derecha", -math.pi / 2, 0.0, -0.45),
    ],
)
def test_a_wall_and_a_strap_to_it(
    tmp_path: Path, side: str, azimuth: float, x: float, y: float
) -> None:
    """The strap goes from the middle of that side straight to the wall, 12 mm away."""
    columns = "wall_gap_mm,wall_side,strap,strap_strength_n"
    item = read(tmp_path, columns, f'12,{side},"1.5m:stiffness=50kN/m,slack=5mm",900')
    assert item.surroundings is not None
    (wall,), (strap,) = item.surroundings.walls, item.surroundings.straps
    assert wall == Wall(azimuth=wall.azimuth, gap=0.012, restitution=0.3)
    assert wall.azimuth == pytest.approx(azimuth)
    assert strap.point == pytest.approx((x, y, 1.5), abs=1e-15)
    away = (x + 0.012 * math.cos(azimuth), y + 0.012 * math.sin(azimuth), 1.5)
    assert strap.anchor == pytest.approx(away, abs=1e-15)
    assert (strap.stiffness, strap.slack, strap.strength) == (5e4, 0.005, 900.0)


def test_an_edge_is_in_front(tmp_path: Path) -> None:
    """Its distance is from the front; this one's front is 0.15 m from its middle."""
    around = read(tmp_path, "edge_mm,lip_mm,pad_n", "30,5,40").surroundings
    assert around == Surroundings(
        edge=Edge(at=0.18, azimuth=math.pi, lip=0.005), pad=Pad(pull_off=40.0)
    )


def test_units_zeros_and_several_straps(tmp_path: Path) -> None:
    around = read(tmp_path, "Distance to wall (cm),pad_kN", "0,0.04").surroundings
    assert around is not None
    assert (around.walls[0].gap, around.pad) == (0.0, Pad(pull_off=40.0))
    two = '"top:stiffness=50kN/m; 0.9m:stiffness=20kN/m,strength=800N"'
    around = read(tmp_path, "strap", two).surroundings
    assert around is not None
    assert [(each.point[2], each.stiffness, each.strength) for each in around.straps] == [
        (1.8, 5e4, math.inf),
        (0.9, 2e4, 800.0),
    ]
    # no wall: it ends 50 mm behind its point
    assert around.straps[0] == Strap(
        point=(0.15, 0.0, 1.8), anchor=(0.15 + 0.05, 0.0, 1.8), stiffness=5e4
    )


@pytest.mark.parametrize(
    ("columns", "cells", "mass", "says"),
    [
        ("wall_gap_mm", "-1", "1", "wall_gap_mm: expected 0 or more, found '-1'"),
        ("wall_gap", "3", "110", "wall_gap: found 3 m, farther than the object of 1.8 m reaches"),
        ("edge_m", "12", "110", "edge_m: 12 m is not to be expected"),
        ("wall_side", "left", "110", "wall_side: is given without a wall"),
        ("wall_gap_mm,wall_side", "5,under", "110", "expected back, front, left or right"),
        ("strap", '"top:stiffness=5kN/m"', "", "strap: needs the mass of the object"),
        ("pad_n", "40", "", "pad_n: needs the mass of the object"),
        ("strap", "yes", "110", "if nothing more is known, leave it empty"),
        ("strap", "top:stiffness=5", "110", "stiffness is a number with one of the units"),
        ("strap", "2.5m:stiffness=5kN/m", "110", "2.5 m above the floor, and the object is 1.8"),
        ("strap_strength_n", "900", "110", "is given without a strap"),
        (
            "strap,strap_strength_n", '"top:stiffness=5kN/m,strength=1kN",900', "110",
            "strap_strength_n: is given in the strap as well",
        ),
        (
            "wall_side,wall_gap_mm,edge_mm", "front,100,50", "110",
            "wall_side: is that of the edge: there is a wall or an edge, not both",
        ),
        ("lip_mm", "5", "110", "lip_mm: is given without an edge"),
    ],
)  # fmt: skip
def test_what_cannot_be(tmp_path: Path, columns: str, cells: str, mass: str, says: str) -> None:
    with pytest.raises(InputError, match="line 2, ") as found:
        read(tmp_path, columns, cells, mass)
    assert says in str(found.value)


def test_it_needs_both_sizes_of_the_base(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text("name,depth_m,height_m,wall_gap_mm\nshelf,0.3,1.8,10\n", encoding="utf-8")
    with pytest.raises(InputError, match="give depth_m and width_m of the object"):
        read_inventory(path)
