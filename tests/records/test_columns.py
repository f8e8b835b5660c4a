"""Plain columns, pairing, and what no file says."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, read_motion
from tests.support.builders import G


def write(folder: Path, text: str, name: str = "record.txt") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("units", "factor"),
    [("g", G), ("m/s2", 1.0), ("m/s²", 1.0), ("cm/s²", 0.01), ("gal", 0.01), ("GAL", 0.01)],
)
def test_one_value_a_line(tmp_path: Path, units: str, factor: float) -> None:
    path = write(tmp_path, "# a comment\n\n1.0\n-2.5\n3e-1\n\n")
    motion = read_motion(path, units=units, time_step=0.02)
    assert motion.horizontal == pytest.approx(np.array([1.0, -2.5, 0.3]) * factor, rel=1e-15)
    assert motion.time_step == 0.02


@pytest.mark.parametrize("separator", [" ", "\t", ",", ";", ", "])
def test_two_columns(tmp_path: Path, separator: str) -> None:
    rows = [f"{0.01 * n:.2f}{separator}{n}" for n in range(5)]
    motion = read_motion(write(tmp_path, "\n".join(rows)), units="m/s2")
    assert motion.time_step == 0.01
    assert motion.horizontal == pytest.approx(range(5))


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        ("time_s,acceleration_g", G),
        ("Time (s),East (cm/s²)", 0.01),
        ("t [s];a [gal]", 0.01),
        ("time,acc_m_s2", 1.0),
    ],
)
def test_header_names_the_unit(tmp_path: Path, header: str, factor: float) -> None:
    separator = ";" if ";" in header else ","
    rows = [f"{0.005 * n:.3f}{separator}{n}" for n in range(4)]
    motion = read_motion(write(tmp_path, "\n".join([header, *rows])))
    assert motion.time_step == 0.005
    assert motion.horizontal == pytest.approx(np.arange(4) * factor)


def test_several_columns_are_components(tmp_path: Path) -> None:
    path = write(tmp_path, "time,NS (gal),EW (gal)\n0,1,2\n0.01,3,4\n0.02,5,6\n")
    components = read_components(path)
    assert [c.code for c in components] == ["NS", "EW"]
    assert components[1].acceleration == pytest.approx([0.02, 0.04, 0.06])
    with pytest.raises(InputError, match=r"2 horizontal components \(NS, 0°; EW, 90°\)"):
        read_motion(path)


@pytest.mark.parametrize(
    ("text", "given", "message"),
    [
        ("1\n2\n", {"units": "g"}, r"give --time-step-s .*time_step=\)$"),
        ("1\n2\n", {}, "give --time-step-s .*, and --units"),
        ("1\n2\n", {"time_step": 0.01}, "names no unit"),
        ("0 1\n1 2\n", {}, "names no unit"),
        ("1\n2\n", {"units": "furlongs", "time_step": 0.01}, "unknown unit"),
        ("1\n2\n", {"units": "g", "time_step": 0.0}, "time_step"),
        ("t,a (lb)\n0,1\n1,2\n", {}, "unknown unit of acceleration 'lb'"),
        ("0 1\n0.01 2\n0.15 3\n0.16 4\n", {"units": "g"}, "line 3: a gap of 0.14 s"),
        ("0 1\n0.01 2\n0.03 3\n0.02 4\n", {"units": "g"}, "line 4: the time falls"),
        (
            "\n".join(f"{0.01 * n:.2f} 1" for n in range(100) if n not in (20, 40, 60, 80)),
            {"units": "g"},
            "line 21: mixed time steps: 0.02 s here, 0.01 s elsewhere",
        ),
        ("1_0\n2\n", {"units": "g", "time_step": 0.01}, "unknown record format|expected a number"),
        ("0 1\n0 2\n0 3\n", {"units": "g"}, "does not rise"),
        ("0 1\n0.01\n0.02 2\n", {"units": "g"}, "line 2: expected 2 values, found 1"),
        ("0 1 2\n1 2 3\n", {"units": "g"}, "3 columns and no header"),
        ("t,a_g\n0,1\n1,oops\n", {}, "line 3: expected a number, found 'oops'"),
        ("t,a_g\n0,1\n1,inf\n", {}, "line 3: expected a finite number, found 'inf'"),
        ("t,a_g\n0,1\n", {}, "1 rows"),
        ("0 1\n0.01 2\n", {"units": "g", "time_step": 0.02}, "time step given is"),
        ("Time (ms),acc (g)\n0,1\n10,2\n", {}, r"has no column .*'time \(s\)'"),
        (
            "Time (ms),acc (g)\n0,1\n10,2\n",
            {"time_step": 0.01},
            "unknown unit of acceleration 'ms'",
        ),
        ("Transverse (g),Up (g)\n0,1\n10,2\n", {}, r"time_step=\)$"),
        ("some words\nthat are\nno record\n", {}, "unknown record format"),
        ("", {}, "empty"),
        ("3\n.1\n.2\n.3\n", {"units": "g", "time_step": 0.01}, "begins with 3, the number of"),
        (".1\n# .2\n.3\n", {"units": "g", "time_step": 0.01}, "line 2: a comment among"),
        (".1\n\n.3\n.4\n", {"units": "g", "time_step": 0.01}, "line 2: a blank line among"),
        ("t (s),a (g)\n0,1\n.1,2\n\n.2,4\n", {}, "line 4: a blank line among"),
        (".1E-01\n.2E-01\n.3E-0", {"units": "g", "time_step": 0.01}, "cut short within a number"),
        ("1\n2000\n3\n", {"units": "g", "time_step": 0.01}, "sample 2 of component 1 is 2e"),
    ],
)
def test_faults(tmp_path: Path, text: str, given: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_motion(write(tmp_path, text), **given)


def test_uneven_pairs_are_resampled(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    # linear between the pairs: on a straight line every step gives it back
    time = [0, 0.011, 0.023, 0.024, 0.037, 0.05, 0.06]
    path = write(tmp_path, "".join(f"{t} {3 * t}\n" for t in time))
    with caplog.at_level(logging.WARNING):
        motion = read_motion(path, units="m/s2")
    assert motion.time_step == 0.01  # of the median 0.0115
    assert motion.horizontal == pytest.approx(3 * motion.time, abs=1e-15)
    assert motion.duration == pytest.approx(0.06)
    assert "7 uneven pairs resampled linearly to steps of 0.01 s" in caplog.text
    assert motion.origin is not None
    assert "resampled" in motion.origin.processing[0]
    assert read_motion(path, units="m/s2", time_step=0.005).horizontal.size == 13


def test_missing_folder_and_binary(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_motion(tmp_path / "none.txt")
    with pytest.raises(InputError, match="is a folder"):
        read_motion(tmp_path)
    path = tmp_path / "image.png"
    path.write_bytes(b"\x89PNG\0\0\0")
    with pytest.raises(InputError, match="not a text file"):
        read_motion(path)


def test_rounded_times_are_even(tmp_path: Path) -> None:
    # 1/128 s printed with three decimals
    rows = [f"{n / 128:.3f} {n}" for n in range(129)]
    motion = read_motion(write(tmp_path, "\n".join(rows)), units="gal")
    assert motion.time_step == pytest.approx(1 / 128, rel=1e-6)


def test_vertical_with_another_step_and_length(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    across = write(tmp_path, "0 0\n0.02 2\n0.04 0\n", "across.txt")
    up = write(tmp_path, "0 1\n0.01 2\n0.02 3\n", "up.txt")
    with caplog.at_level(logging.WARNING):
        motion = read_motion(across, vertical=up, units="m/s2")
    assert motion.time_step == 0.01
    assert motion.horizontal == pytest.approx([0, 1, 2, 1, 0])
    assert motion.vertical == pytest.approx([1, 2, 3, 0, 0])
    assert "interpolated linearly from a time step of 0.02 s to 0.01 s" in caplog.text
    assert "2 zeros added" in caplog.text


def test_components_that_begin_apart_are_refused(tmp_path: Path) -> None:
    across = write(tmp_path, "0 0\n0.02 2\n0.04 0\n", "across.txt")
    late = write(tmp_path, "5.00 1\n5.02 2\n5.04 3\n", "late.txt")
    with pytest.raises(InputError, match=r"begins at 0 s and .* at 5 s"):
        read_motion(across, vertical=late, units="g")


def test_a_vertical_component_is_no_horizontal_motion(tmp_path: Path) -> None:
    path = write(tmp_path, "time,UP (g)\n0,1\n0.01,2\n", "up.csv")
    assert read_components(path)[0].is_vertical
    with pytest.raises(InputError, match=r"vertical component \(UP\)"):
        read_motion(path)


def test_real_file(shared_records: Path) -> None:
    name = "19760506_2000_TLM1_NS.acc"
    motion = read_motion(shared_records / "kallioras_2025" / name, units="m/s2", time_step=0.005)
    assert motion.horizontal.size == 7278  # catalog.csv
    assert motion.peak_ground_acceleration / G == pytest.approx(0.34573, abs=6e-6)


def test_a_spreadsheet_is_refused_in_one_line(tmp_path: Path) -> None:
    from openpyxl import Workbook

    path = tmp_path / "record.xlsx"
    Workbook().save(path)
    with pytest.raises(InputError) as raised:
        read_motion(path)
    (line,) = str(raised.value).splitlines()
    assert "a spreadsheet or document, no record; save its table as CSV" in line
