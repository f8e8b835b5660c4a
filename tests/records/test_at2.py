"""PEER AT2 in every header layout."""

from __future__ import annotations

import csv
import logging
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, read_motion
from tests.support.builders import G

VALUES = "  .1000000E-01 -.2000000E-01  .3000000E-01 -.4000000E-01  .5000000E-01\n  .6E-02\n"
TITLE = "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere, 1/2/1990, A Station, North, 021\n"
UNITS = "ACCELERATION TIME SERIES IN UNITS OF G\n"
NEW = "NPTS=   6, DT=   .0050 SEC,  -5 POLE @ .1 HZ\n"
OLD = "    6    0.0050    NPTS, DT\n"


def write(folder: Path, text: str, name: str = "record.AT2") -> Path:
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize(
    "text",
    [
        TITLE + UNITS + NEW + VALUES,
        TITLE + UNITS + OLD + VALUES,
        TITLE + UNITS.replace("SERIES", "HISTORY").replace("G\n", "G. FILTER\n") + NEW + VALUES,
        TITLE.replace("\n", "\n\n") + "\n" + UNITS + "\n" + NEW + "\n" + VALUES + "\n\n",
        (TITLE + UNITS + NEW + VALUES).replace("\n", "\r\n"),
        TITLE + UNITS + NEW.replace("NPTS=   6, ", "NPTS=6,") + VALUES.replace("E", "D"),
        TITLE + UNITS + NEW + VALUES + "*** End data ***\n",
        "El Centro\nThe units are (g)\n*** Begin data ***\n" + NEW + VALUES,
    ],
    ids=["new", "old", "history", "blank lines", "crlf", "fortran", "footer", "no title"],
)
def test_layouts(tmp_path: Path, text: str) -> None:
    motion = read_motion(write(tmp_path, text))
    assert motion.time_step == 0.005
    expected = np.array([0.01, -0.02, 0.03, -0.04, 0.05, 0.006]) * G
    assert motion.horizontal == pytest.approx(expected, rel=1e-15)
    assert motion.name == "record"


def test_title(tmp_path: Path) -> None:
    (component,) = read_components(write(tmp_path, TITLE + UNITS + NEW + VALUES))
    assert component.event == "Somewhere 1/2/1990"
    assert component.station == "A Station, North"
    assert (component.code, component.azimuth) == ("021", 21.0)


def test_a_missing_count_is_said(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    header = NEW.replace("NPTS=   6, ", "")
    with caplog.at_level(logging.WARNING):
        motion = read_motion(write(tmp_path, TITLE + UNITS + header + VALUES))
    assert motion.horizontal.size == 6
    assert "no NPTS; 6 values" in caplog.text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        ("\n \n", "empty"),
        (TITLE + UNITS + VALUES, r"no time step \(DT=\)"),
        (TITLE + "CM\n" + NEW + VALUES, "names no unit of acceleration"),
        (TITLE + UNITS.replace("OF G", "OF FURLONGS") + NEW + VALUES, "FURLONGS"),
        (TITLE + UNITS + NEW.replace(".0050", "0.0"), "line 4: the time step must be positive"),
        (TITLE + UNITS + NEW + "1.0 x2 3.0\n", "line 5: expected a number, found 'x2'"),
        (TITLE + UNITS + NEW + "1.0 NaN 3.0\n", "line 5: expected a finite number, found 'NaN'"),
        (TITLE + UNITS + NEW.replace("6", "6000", 1) + VALUES, "cut short"),
        (TITLE + UNITS + NEW + "1.0\n", "1 values"),
        (TITLE + "VELOCITY TIME SERIES IN UNITS OF CM/S\n" + NEW + VALUES, "velocity series"),
        (TITLE + "DISPLACEMENT TIME SERIES IN UNITS OF CM\n" + NEW, "displacement series"),
    ],
)
def test_faults(tmp_path: Path, text: str, message: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(InputError, match=message) as error:
        read_motion(path)
    assert str(path) in str(error.value)


@pytest.mark.parametrize("name", ["record.VT2", "record.dt2"])
def test_twins_are_refused_by_name(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="velocity or displacement"):
        read_motion(write(tmp_path, TITLE + UNITS + NEW + VALUES, name))


def test_given_time_step_must_agree(tmp_path: Path) -> None:
    path = write(tmp_path, TITLE + UNITS + NEW + VALUES)
    assert read_motion(path, time_step=0.005).time_step == 0.005
    with pytest.raises(InputError, match=r"time step of 0\.005 s; the one given is 0\.01 s"):
        read_motion(path, time_step=0.01)


def test_the_files_own_units_count(tmp_path: Path) -> None:
    path = write(tmp_path, TITLE + UNITS + NEW + VALUES)
    assert read_motion(path, units="g").horizontal[0] == pytest.approx(0.01 * G, rel=1e-15)
    # units are for files that do not say, so that a folder may hold both
    assert read_motion(path, units="gal").horizontal[0] == pytest.approx(0.01 * G, rel=1e-15)


def test_real_files(shared_records: Path) -> None:
    # npts, dt and peak by an independent parser, five decimals of g
    with (shared_records / "catalog.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["file"].startswith("peer_at2/")]
    assert len(rows) >= 19
    for row in rows:
        (component,) = read_components(shared_records / row["file"])
        assert component.acceleration.size == int(row["npts"])
        assert component.time_step == float(row["dt"])
        peak = np.abs(component.acceleration).max() / G
        assert peak == pytest.approx(float(row["pga_g"]), abs=6e-6)
        assert component.is_vertical == (row["component"] == "V")
    el_centro = read_motion(shared_records / "peer_at2" / "elCentro_no_npts.at2")
    assert (el_centro.horizontal.size, el_centro.time_step) == (1559, 0.02)
    for twin in ("RSN57_SFERN_ORR021.VT2", "RSN57_SFERN_ORR021.DT2"):
        with pytest.raises(InputError, match="series; an acceleration"):
            read_motion(shared_records / "peer_at2" / twin)


def test_real_triple(shared_records: Path) -> None:
    folder = shared_records / "peer_at2"
    motion = read_motion(
        folder / "RSN1633_MANJIL_ABBAR--L.AT2", vertical=folder / "RSN1633_MANJIL_ABBAR--V.AT2"
    )
    assert motion.vertical is not None
    assert motion.horizontal.size == motion.vertical.size == 2676  # 2671 and 5 zeros
    assert (motion.vertical[-5:] == 0).all()
