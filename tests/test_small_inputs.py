"""Small inputs that once failed or were misread, each for its kind, with their right values."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import InputError, read_components
from shaketable.hazard import read_shakemap
from shaketable.inventory.read import read_with_columns
from shaketable.rooms import read_room
from shaketable.rooms.grid import Grid
from tests.conftest import SHARED
from tests.support.builders import G

CASES = SHARED / "cases"
pytestmark = pytest.mark.skipif(not CASES.is_dir(), reason=f"no small inputs at {CASES}")

#: Code, number of samples, time step [s], peak [m/s²] and its time [s] of the first component.
RECORDS = {
    "01-z-and-absolute-as-horizontal.csv": ("Acceleration x", 2000, 0.01, -0.050937 * G, 6.96),
    "03-csmip-v1-points-at.V1": ("360", 800, 0.005, -0.049022 * G, 1.92),
    "04-renadic-title-of-digits.v1": ("NS", 500, 0.01, 0.030 * G, 2.00),
    "06-film-splice-one-short-step.RAW": ("90", 999, 0.005, 0.0769 * G, None),
    "07-zip-in-zip.zip": ("NS", 500, 0.01, 0.030 * G, 2.00),
    "12-comma-decimals.csv": ("acc", 2000, 0.01, -0.050937 * G, 6.96),
    "13-fortran-D-columns.csv": ("acc", 2000, 0.01, -0.050937 * G, 6.96),
    "14-title-above-columns.txt": ("Acceleration", 2000, 0.01, -0.050937 * G, 6.96),
    "15-unam-asa.txt": ("V", 2000, 0.01, -0.19949, None),
    "16-csmnc.dat": ("EW", 2000, 0.01, -0.49952, 6.96),
    "17-usc-volume-2.s0a": ("N90E", 573, 0.02, -0.59204, 3.84),
}
#: Name, depth, width and height [m], quantity and mass [kg] of the first object.
LISTS = {
    "02-unit-column.csv": ("Bookcase", 0.3048, 0.79248, 1.49352, 1, None),
    "02b-same-in-header.csv": ("Bookcase", 0.3048, 0.79248, 1.49352, 1, None),
    "09-sizes-in-one-column.csv": ("Freezer", 1.02, 0.90, 1.98, 1, 310.0),
    "10-index-column-of-pandas.csv": ("Bookcase", 0.28, 0.80, 2.02, 1, None),
    "11-question-marks-in-sizes.csv": ("drying rack", 0.4445, 0.508, 1.651, 1, None),
    "18-objectid-taken-for-name.csv": ("Chair", 0.508, 0.457, 0.813, 1, None),
    "19-unrelated-yes-no-column.csv": ("Bookcase", 0.28, 0.80, 2.02, 1, None),
    "20-title-as-name.csv": ("Amphora", 0.31, 0.31, 0.48, 1, 6.0),
    "31-cost-es.csv": ("Tomógrafo", 0.80, 1.50, 1.90, 1, None),
    "33-shift-jis.csv": ("ガスボンベ", 0.23, 0.23, 1.40, 1, None),
    "40-names-above-letters.xlsx": ("Bookcase", 0.32, 0.90, 1.80, 4, 50.0),
    "41-size-in-one-cell.xlsx": ("Bookcase", 0.32, 0.90, 1.80, 4, 50.0),
    "42-h-b-t-cm.xlsx": ("Bookcase", 0.32, 0.90, 1.80, 4, None),
    "44-school-de.csv": ("Schülerspinde, 3er-Block", 0.50, 0.90, 1.80, 20, 75.0),
    "45-office-ja.csv": ("書庫（両開き）", 0.45, 0.90, 1.85, 8, 60.0),
}


@pytest.mark.parametrize("name", RECORDS)
def test_records(name: str) -> None:
    code, count, step, peak, at = RECORDS[name]
    first = read_components(CASES / name)[0]
    largest = int(np.argmax(np.abs(first.acceleration)))
    assert (first.code, first.acceleration.size, first.time_step) == (code, count, step)
    assert first.acceleration[largest] == pytest.approx(peak, rel=1e-4)  # as the files print it
    if at is not None:
        assert largest * step == pytest.approx(at)


def test_directions_and_channels_of_records() -> None:
    x, y, z = read_components(CASES / "01-z-and-absolute-as-horizontal.csv")
    assert [one.is_vertical for one in (x, y, z)] == [False, False, True]
    assert abs(z.acceleration.mean()) < 1e-12
    peaks = [one.acceleration for one in read_components(CASES / "15-unam-asa.txt")]
    largest = [one[np.argmax(np.abs(one))] for one in peaks]
    assert largest == pytest.approx([-0.1995, -0.4995, 0.3991], abs=1e-4)
    (film,) = read_components(CASES / "05-smc-uneven-count-of-numbers.smc")
    assert "400 uneven pairs" in film.processing[1]


@pytest.mark.parametrize("name", LISTS)
def test_lists(name: str) -> None:
    found = read_with_columns(CASES / name).items[0]
    across = found.sideways.base if found.sideways else None
    right = LISTS[name]
    assert (found.name, found.quantity, found.mass) == (right[0], right[4], right[5])
    assert (found.body.base, across, found.height) == pytest.approx(right[1:4])


def test_what_else_is_right_in_lists() -> None:
    def items(name: str) -> dict[str, object]:
        return {item.name: item for item in read_with_columns(CASES / name).items}

    assert read_with_columns(CASES / "11-question-marks-in-sizes.csv").not_assessed == [
        "easel", "carpet",
    ]  # fmt: skip
    assert all(item.unread == () for item in items("19-unrelated-yes-no-column.csv").values())
    assert [item.cost for item in items("31-cost-es.csv").values()] == [125_000.0, 85_000.0]
    school = items("44-school-de.csv")
    assert len(school) == 20
    assert (school["Chemikalienschrank"].mass, school["Aktenschrank"].mass) == (250.0, 100.0)
    assert school["Beamer"].hangs
    assert school["Globus"].stands_on
    office = items("45-office-ja.csv")
    assert len(office) == 6
    assert office["サーバーラック"].anchored
    assert not office["冷蔵庫"].anchored


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("32-units-again.csv", "the header comes again with other units"),
        ("36-merged-unit-heading.xlsx", "height: names no unit, and 'depth' names cm"),
    ],
)
def test_lists_that_are_asked_about(name: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read_with_columns(CASES / name)


def test_a_map_and_a_room() -> None:
    found = read_shakemap(CASES / "08-shakemap35-zero-and-stdpga.xml")
    assert {"PGA", "PGV"} <= set(found.ln_median)
    assert "SA(3.0)" not in found.ln_median
    assert found.sigma == {}
    with pytest.raises(InputError, match=r"cells of 0\.05 m; at most"):
        Grid.of(read_room(CASES / "35-room-diagonal.toml", check=False))
