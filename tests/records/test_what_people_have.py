"""Records as phones, spreadsheets, old films and archives hold them: read right, or refused."""

from __future__ import annotations

import io
import logging
import zipfile
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components
from shaketable.records.component import Component, direction_in
from tests.records.test_layouts import smc
from tests.support import record_files
from tests.support.builders import G

SINE = np.sin(np.arange(400) / 9.0)  # its mean is 0.001


def write(folder: Path, text: str, name: str = "a.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def table(header: str, *columns: np.ndarray, separator: str = ",") -> str:
    time = 0.01 * np.arange(columns[0].size)
    rows = np.column_stack([time, *columns])
    return "\n".join([header, *(separator.join(f"{x:.6f}" for x in row) for row in rows), ""])


# directions ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "direction", "vertical", "azimuth"),
    [
        ("acc_z", "z", True, None),
        ("Acc Z", "Z", True, None),
        ("az", "z", True, None),
        ("ZACC", "Z", True, None),
        ("accel_up", "up", True, None),
        ("Acceleration z", "z", True, None),
        ("Vertical acceleration", "Vertical", True, None),
        ("linearAccelerationZ", "Z", True, None),
        ("gFz", "z", True, None),
        ("Acc. z-axis", "z", True, None),
        ("acc_x", "x", False, None),
        ("gFx", "x", False, None),
        ("acc_ns", "ns", False, 0.0),
        ("acceleration EW", "EW", False, 90.0),
        ("accel_e", "e", False, 90.0),
        # the number of a sensor is no azimuth, and codes of networks stay what they are
        ("acc_1", "1", False, None),
        ("N28W", "N28W", False, 332.0),
        ("HNZ", "HNZ", True, None),
        ("LONG", "LONG", False, None),
    ],
)
def test_the_direction_stands_at_the_end_of_a_name(
    name: str, direction: str, vertical: bool, azimuth: float | None
) -> None:
    component = Component(acceleration=SINE, time_step=0.01, code=name)
    assert direction_in(name) == direction
    assert (component.is_vertical, component.azimuth) == (vertical, azimuth)


def test_a_downward_column_is_turned(tmp_path: Path) -> None:
    (up,) = read_components(write(tmp_path, table("time_s,acc_dn_g", SINE)))
    assert (up.is_vertical, up.upward) == (True, -1.0)


@pytest.mark.parametrize("name", ["Absolute acceleration", "total_acc", "Resultant", "Magnitude"])
def test_the_length_of_a_vector_is_no_component(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, name: str
) -> None:
    length = np.hypot(SINE, 0.3)
    path = write(tmp_path, table(f"time_s,x_g,{name} (g)", SINE, length))
    assert [one.code for one in read_components(path)] == ["x"]
    assert "left out, no accelerations" in caplog.text
    # what has both signs is no length: the total acceleration of a floor, ground's included
    path = write(tmp_path, table(f"time_s,x_g,{name} (g)", SINE, SINE[::-1]))
    assert len(read_components(path)) == 2


@pytest.mark.parametrize(("offset", "read"), [(1.0, True), (-0.95, True), (0.5, False)])
def test_gravity_is_no_motion(tmp_path: Path, offset: float, read: bool) -> None:
    """A mean near 1 g is gravity and taken away; any other mean is left, as files have offsets."""
    path = write(tmp_path, table("time_s,acc_z_g", 0.05 * SINE + offset))
    (component,) = read_components(path)
    shift = 0.0 if read else offset
    # the sine's own mean goes, too, and six decimals are printed
    assert component.acceleration / G == pytest.approx(0.05 * SINE + shift, abs=1e-3)
    assert (component.processing != ()) == read


def test_gravity_in_a_horizontal_column_is_asked(tmp_path: Path) -> None:
    path = write(tmp_path, table("time_s,acc_y_g", 0.05 * SINE + 1.0))
    with pytest.raises(InputError, match="column 'acc_y' has a mean of 1 g: this is gravity"):
        read_components(path)


# plain columns ------------------------------------------------------------------------------

ROWS = table("time (s);acc (g)", 0.3 * SINE, separator=";")


@pytest.mark.parametrize(
    "text",
    [
        ROWS.replace(".", ","),
        ROWS.replace(".", ",").replace(";", "\t"),
        ROWS.replace(".", ",").replace(";", "  ").replace("time  ", "time "),
        "\n".join(["A Station", "", "of 1985", ROWS]),
        table("time_s,acc_g", 0.3 * SINE).replace("\n", "D+00\n").replace("gD+00", "g"),
    ],
    ids=["semicolons", "tabs", "blanks", "titles", "Fortran"],
)
def test_numbers_as_spreadsheets_and_programs_write_them(tmp_path: Path, text: str) -> None:
    (component,) = read_components(write(tmp_path, text))
    assert component.time_step == 0.01
    assert component.acceleration / G == pytest.approx(0.3 * SINE, abs=5.1e-7)  # as printed


def test_a_column_of_decimal_commas(tmp_path: Path) -> None:
    text = "\n".join(f"{x:.4f}".replace(".", ",") for x in 0.01 * SINE)
    (component,) = read_components(write(tmp_path, text), units="g", time_step=0.01)
    assert component.acceleration / G == pytest.approx(0.01 * SINE, abs=5.1e-5)


def test_commas_between_whole_numbers_separate(tmp_path: Path) -> None:
    (component,) = read_components(write(tmp_path, "0,1\n1,2\n2,4\n"), units="m/s2")
    assert component.acceleration.tolist() == [1.0, 2.0, 4.0]


@pytest.mark.parametrize("unit", ["counts", "raw counts", "Count"])
def test_raw_counts_are_called_so(tmp_path: Path, unit: str) -> None:
    path = write(tmp_path, table(f"time_s,NS ({unit})", SINE))
    with pytest.raises(InputError, match="holds the raw counts of a digitizer"):
        read_components(path)


# formats ------------------------------------------------------------------------------------


def test_a_title_of_digits_is_no_header_of_integers(tmp_path: Path) -> None:
    text = record_files.renadic(channels=1)
    lines = text.splitlines()
    lines[1] = "3001011"
    (component,) = read_components(write(tmp_path, "\n".join([*lines, ""]), "a.v1"))
    (before,) = read_components(write(tmp_path, text, "b.v1"))
    assert component.acceleration == pytest.approx(before.acceleration, rel=1e-15)


@pytest.mark.parametrize("fill", [0, 2, 8])
def test_smc_may_count_numbers_and_fill_its_last_line(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, fill: int
) -> None:
    times = np.array([0.0, 0.012, 0.019, 0.031, 0.04, 0.05, 0.061, 0.07])
    numbers = [x for t in times for x in (t, 100 * t)]
    fields = [f"{x:10.4f}" for x in [*numbers, *numbers[:fill]]]
    values = "\n".join("".join(fields[k : k + 8]) for k in range(0, len(fields), 8))
    path = tmp_path / "a.smc"
    path.write_text(smc(values, title="1 UNCORRECTED ACCELEROGRAM", count=16, rate=1.7e38))
    (component,) = read_components(path)
    assert component.acceleration == pytest.approx(np.arange(8) * 0.01, abs=1e-12)
    assert "count of 16 is taken as one of numbers: 8 pairs" in caplog.text


def film(steps: np.ndarray) -> str:
    """A film's pairs at some steps [ms], with the length and count that its header states."""
    time = np.append(0.0, np.cumsum(steps)) * 1e-3
    values = record_files.shaking(time.size, 31, 300.0) * 0.01
    pairs = [f"{x:7.3f}" for pair in zip(time, values, strict=True) for x in pair]
    lines = record_files.renadic(time.size, 1).splitlines()
    lines[7] = f"NO. OF POINTS = {time.size}  RECORD LENGTH = {time[-1]:.3f} SEC."
    lines[8] = lines[8].partition("MAX")[0]
    begin = next(n for n, line in enumerate(lines) if line.startswith("  0.000"))
    return "\n".join([*lines[:begin], *record_files.rows(pairs, 10), lines[-1], ""])


def test_a_splice_of_a_film_is_read(tmp_path: Path) -> None:
    steps = np.full(199, 5)
    steps[80] = 1
    (component,) = read_components(write(tmp_path, film(steps), "a.v1"))
    assert component.acceleration.size == 199  # (198 · 5 + 1) ms hold 199 steps of 5 ms
    assert "200 uneven pairs resampled" in component.processing[0]
    steps[81] = 9  # one time is wrong: a short step and a long one
    with pytest.raises(InputError, match="mixed time steps"):
        read_components(write(tmp_path, film(steps), "a.v1"))


@pytest.mark.parametrize(("gap", "read"), [(40, True), (60, False)])
def test_films_have_gaps_where_the_trace_is_straight(tmp_path: Path, gap: int, read: bool) -> None:
    """Points on film are some 2.5 ms apart, and up to 40 ms where nothing bends."""
    steps = np.random.default_rng(5).integers(1, 4, 199)
    steps[50] = gap
    path = write(tmp_path, film(steps), "a.v1")
    if read:
        assert read_components(path)[0].acceleration.size > 100
        return
    with pytest.raises(InputError, match=r"a gap of 0\.06 s"):
        read_components(path)


def test_a_volume_in_an_unknown_layout_is_called_one(tmp_path: Path) -> None:
    text = record_files.csmip_rated(channels=1).replace("pts/sec", "samples per sec")
    with pytest.raises(InputError, match=r"line 24.*: a volume of CSMIP.*layout.*not known"):
        read_components(write(tmp_path, text, "a.V1"))


def test_one_channel_of_many_is_a_way_to_keep_records(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    one = record_files.csmip().partition(
        "CORRECTED ACCELEROGRAM   36456-S4384-83123.01       CHAN  2"
    )
    read_components(write(tmp_path, one[0], "a.V2"))
    assert "was it cut?" not in caplog.text
    two = record_files.csmip().rpartition("CORRECTED ACCELEROGRAM   36456")[0]
    read_components(write(tmp_path, two, "a.V2"))
    assert "holds 2 of the 3 components" in caplog.text


def test_unam_names_its_channels(tmp_path: Path) -> None:
    found = read_components(write(tmp_path, record_files.unam(), "a.txt"))
    assert [(one.code, one.azimuth) for one in found] == [
        ("S60E", 120.0), ("V", None), ("N30E", 30.0),
    ]  # fmt: skip
    assert found[0].station == "LUGA UN LUGAR"
    assert np.abs(found[1].acceleration).max() == pytest.approx(0.31)  # its channel's 31 gal


# archives -----------------------------------------------------------------------------------


def zipped(members: dict[str, bytes]) -> bytes:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return held.getvalue()


def test_an_archive_in_an_archive(tmp_path: Path) -> None:
    record = record_files.csmip(channels=1).encode()
    inner = zipped({"a.V2": record, "readme.txt": b"where from"})
    path = tmp_path / "all.zip"
    path.write_bytes(zipped({"station.zip": inner, "notes.txt": b"nothing"}))
    (component,) = read_components(path)
    assert component.path == path / "station.zip" / "a.V2"
    path.write_bytes(zipped({"all.zip": zipped({"station.zip": inner})}))
    with pytest.raises(InputError, match="too many levels deep; unpack it first"):
        read_components(path)


def test_archives_in_an_archive_share_its_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shaketable.records.archives.MOST_MEMBERS", 4)
    inner = zipped({f"{k}.txt": b"nothing" for k in range(3)})
    path = tmp_path / "all.zip"
    path.write_bytes(zipped({"a.zip": inner, "b.zip": inner}))
    with pytest.raises(InputError, match=r"holds 5 files; at most 4"):
        read_components(path)


def test_sac(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    obspy = pytest.importorskip("obspy", reason="SAC needs ObsPy")
    caplog.set_level(logging.WARNING)
    head = {
        "network": "XX", "station": "ABC", "channel": "HNE", "sampling_rate": 100.0,
        "sac": {"cmpaz": 92.0, "cmpinc": 90.0},
    }  # fmt: skip
    obspy.Trace(SINE.astype(np.float32), head).write(str(tmp_path / "a.sac"), format="SAC")
    with pytest.raises(InputError, match="give their units"):
        read_components(tmp_path / "a.sac")
    (component,) = read_components(tmp_path / "a.sac", units="gal")
    assert component.acceleration == pytest.approx(0.01 * SINE, rel=1e-6)  # single precision
    assert (component.azimuth, component.time_step) == (92.0, 0.01)
    assert component.format == "SAC"
