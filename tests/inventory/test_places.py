"""Which building an object stands in, and where that is."""

from __future__ import annotations

from pathlib import Path

import pytest

from shaketable import InputError
from shaketable.inventory import read_inventory

SIZES = "depth_m,width_m,height_m"
HEADER = "name,width_m,height_m,building,latitude,longitude,floor"


def test_buildings_and_sites(tmp_path: Path) -> None:
    path = tmp_path / "city.csv"
    path.write_text(
        f"{HEADER}\nshelf,0.32,1.8,Surgery,-33.45,-70.66,2\nshelf,0.32,1.8,Wards,0,10,2\n"
        "shelf,0.32,1.8,,,,\n"
    )
    first, second, third = read_inventory(path)
    assert (first.building, first.site, first.floor) == ("Surgery", (-70.66, -33.45), "2")
    assert second.site == (10.0, 0.0)
    assert (third.building, third.site) == ("", None)


@pytest.mark.parametrize(
    ("cells", "says"),
    [
        ("A,91,10,1", "line 2, latitude: expected decimal degrees from -90 to 90, found '91'"),
        ("A,1,-181,1", "longitude: expected decimal degrees from -180 to 180"),
        ("A,45°30',9,1", "latitude: expected decimal degrees"),
        ("A,,9,1", "longitude: is given without a latitude"),
    ],
)
def test_sites_that_are_none(tmp_path: Path, cells: str, says: str) -> None:
    path = tmp_path / "city.csv"
    path.write_text(f"{HEADER}\nshelf,0.32,1.8,{cells}\n")
    with pytest.raises(InputError) as caught:
        read_inventory(path)
    assert says in str(caught.value)


def test_places_that_are_written_once_hold_below(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """Each is filled in to the next of it, or of a larger one; and told."""
    path = tmp_path / "hospital.csv"
    path.write_text(
        f"Building,Floor,Room,Name,{SIZES}\n"
        "North,1,Ward,shelf,0.30,0.90,1.80\n,,,cart,0.50,0.70,1.10\n,,Kitchen,rack,0.6,0.7,1.9\n"
        ",2,,case,0.4,1.0,1.7\n# to be measured: the store\nSouth,1,,desk,0.7,1.4,0.75\n"
        ",,Hall,locker,0.4,0.5,1.85\n"
    )
    assert [(item.building, item.floor, item.location) for item in read_inventory(path)] == [
        ("North", "1", "Ward"),
        ("North", "1", "Ward"),
        ("North", "1", "Kitchen"),
        ("North", "2", ""),  # the kitchen is on the floor below
        ("South", "1", ""),
        ("South", "1", "Hall"),
    ]
    assert "line 3–5, 8, Building: empty, and taken to be the same as above" in caplog.text
    assert "line 3–4, 8, Floor: empty" in caplog.text
    assert "line 3, Room: empty" in caplog.text
    assert "left out, as comments: line 6" in caplog.text


@pytest.mark.parametrize(
    "rooms",
    [
        ("Ward", "Ward", "", "", "Hall"),  # written in each row, where it is known
        ("", "Ward", "", "", "Hall"),  # the first stands nowhere
        ("Ward", "Hall", "", "Store", "Attic"),  # one was forgotten
        ("Ward", "", "", "", ""),  # there are no others
        ("Ward", "-", "", "", "?"),  # which are no places
    ],
)
def test_places_that_are_not_known_stay_empty(tmp_path: Path, rooms: tuple[str, ...]) -> None:
    path = tmp_path / "list.csv"
    rows = [f"{room},shelf {k},0.3,0.9,1.{k}" for k, room in enumerate(rooms)]
    path.write_text("\n".join([f"Room,Name,{SIZES}", *rows]))
    assert tuple(item.location for item in read_inventory(path)) == rooms


def test_what_ends_a_place(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A heading that is left out, or a row without one above; two alike in a place are two."""
    path = tmp_path / "list.csv"
    path.write_text(
        f"Building,Room,Name,{SIZES}\nNorth,Ward,chair,0.5,0.5,0.9\n,,chair,0.5,0.5,0.9\n"
        ",Kitchen,rack,0.6,0.7,1.9\nTotal,,,,,\n,,desk,0.7,1.4,0.75\nSouth,,box,0.5,0.5,0.6\n"
        ",,crate,0.4,0.4,0.5\n,Hall,bench,0.4,1.2,0.5\n"
    )
    items = read_inventory(path)
    assert [(item.name, item.building, item.location) for item in items] == [
        ("chair", "North", "Ward"),
        ("chair", "North", "Ward"),
        ("rack", "North", "Kitchen"),
        ("desk", "", ""),
        ("box", "South", ""),
        ("crate", "South", ""),
        ("bench", "South", "Hall"),
    ]
    assert "line 3, Room: empty, and taken to be the same as above" in caplog.text
