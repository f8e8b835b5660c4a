"""Which building an object stands in, and where that is."""

from __future__ import annotations

from pathlib import Path

import pytest

from shaketable import InputError
from shaketable.inventory import read_inventory

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
