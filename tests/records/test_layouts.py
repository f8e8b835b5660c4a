"""Formats of which no real file is at hand, and what every machine can test: small files."""

from __future__ import annotations

import json
import logging
import zipfile
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, read_motion, suite
from shaketable.records import cached
from shaketable.records.component import azimuth_of, code_in_name, names_vertical
from tests.support.builders import G
from tests.support.record_files import examples


def smc(values: str, *, title: str, count: int, rate: float) -> str:
    """A USGS SMC file; integer 17 is the count, real 2 the sampling rate or none (1.7e38)."""
    integers = [-32768] * 48
    integers[16] = count
    reals = [1.7e38] * 50
    reals[1] = rate
    text = [title, "*", "SAF0A", "     1989  10  18    0004 Loma Prieta, CA", "*"]
    text += ["station = A Town, Main Street component=    270", "*", "*", "*", "*", "*"]
    text += ["".join(f"{n:10d}" for n in integers[k : k + 8]) for k in range(0, 48, 8)]
    text += ["".join(f"{x:15.7E}" for x in reals[k : k + 5]) for k in range(0, 50, 5)]
    return "\n".join([*text, "| a comment", values, ""])


def test_uncorrected_smc_holds_uneven_pairs(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    # a = 100 t cm/s² at uneven times: any even step lies on the same line
    times = np.array([0.0, 0.012, 0.019, 0.031, 0.04, 0.05, 0.061, 0.07])
    fields = [f"{x:10.4f}" for t in times for x in (t, 100 * t)]
    values = "\n".join("".join(fields[k : k + 8]) for k in range(0, 16, 8))
    path = tmp_path / "0210a.smc"
    path.write_text(smc(values, title="1 UNCORRECTED ACCELEROGRAM", count=8, rate=1.7e38))
    with caplog.at_level(logging.WARNING):
        (component,) = read_components(path)
    assert component.time_step == 0.01
    assert component.acceleration == pytest.approx(np.arange(8) * 0.01, abs=1e-12)
    assert component.uncorrected
    assert (component.azimuth, component.station) == (270.0, "A Town, Main Street")
    assert "8 uneven pairs resampled linearly to steps of 0.01 s" in caplog.text
    path.write_text(smc(values, title="1 UNCORRECTED ACCELEROGRAM", count=9, rate=1.7e38))
    with pytest.raises(InputError, match="cut short: the header says 9 pairs, found 8"):
        read_components(path)


@pytest.mark.parametrize("title", ["3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"])
def test_smc_of_something_else(tmp_path: Path, title: str) -> None:
    path = tmp_path / "a.smc"
    path.write_text(smc("0.1", title=title, count=1, rate=200.0))
    with pytest.raises(InputError, match="an acceleration is needed"):
        read_components(path)


def geonet_v1(values: np.ndarray) -> str:
    """A GeoNet V1A component: accelerations only, in mm/s²."""
    head = [
        "Uncorrected accelerogram 20160214_001343_NBLC_20 GNS Science",
        "Site NBLC      43 30 25S  172 43 53E     Cusp file:  20160214_001345_NBLC",
        "New Brighton Library",
        "Instrument Cusp_323",
        "Resolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700",
        "Accelerogram 20160214_001343_NBLC_20                 Processed 2016 February 22",
        "11 km east of CHRISTCHURCH",
        "2016 February 14         00:13:43 UT",
        "Epicentre  43 29 50S 172 45 18E  Bearing N61E  Dist    2km  Depth    8km M  5.70",
        f"Number of points  {values.size}    Duration {values.size * 0.005:.2f} s",
        "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s",
        "Data is unfiltered",
        "Component S14E",
        "Acceleration:  Peak  -2080.5 mm/s/s at  23.28 s     RMS   145.6 mm/s/s",
        "Velocity record unevaluated",
        "Displacement record unevaluated",
    ]
    integers = np.zeros((4, 10), int)
    integers[3, 3] = values.size
    head += ["".join(f"{n:8d}" for n in row) for row in integers]
    head += ["".join(f"{0:8.2f}" for _ in range(10))] * 6
    rows = [values[k : k + 10] for k in range(0, values.size, 10)]
    return "\n".join([*head, *("".join(f"{x:8.1f}" for x in row) for row in rows), ""])


def test_geonet_v1a(tmp_path: Path) -> None:
    values = np.linspace(-2080.5, 300.0, 23).round(1)
    path = tmp_path / "a.V1A"
    path.write_text(geonet_v1(values) + geonet_v1(values).replace("S14E", "N76E"))
    first, _ = read_components(path)
    assert first.acceleration == pytest.approx(values * 1e-3)
    assert (first.time_step, first.azimuth, first.uncorrected) == (0.005, 166.0, True)
    assert first.station == "NBLC New Brighton Library"
    path.write_text(geonet_v1(values)[:-60])
    with pytest.raises(InputError, match="expected 10 fields of 8"):
        read_components(path)


def test_early_volume_1_numbers_touch(tmp_path: Path) -> None:
    head = ["UNCORRECTED ACCELEROGRAM DATA", "AN EARTHQUAKE", "1 JAN 1971"]
    head += ["STATION NO.  123  34.0N 118.0W", "A TOWN", "CHAN  1: N65E (STA CHN: 1)"]
    head += ["NO. OF POINTS =  6  DURATION = 0.1 SEC", "UNITS ARE SEC AND G/10"]
    head += ["    0" * 16] * 6 + ["    0" * 4]
    head += ["     0.000" * 8] * 6 + ["     0.000" * 2]
    pairs = [
        (100.0, -1.25),
        (100.01, 2.5),
        (100.02, 0.0),
        (100.03, -9.99),
        (100.04, 1),
        (100.05, 0),
    ]
    fields = [f"{x:7.3f}" for pair in pairs for x in pair]
    rows = ["".join(fields[:10]), "".join(fields[10:])]
    path = tmp_path / "old.v1"
    path.write_text("\n".join([*head, *rows, "/& END OF DATA FOR CHANNEL 1", ""]))
    (component,) = read_components(path)
    assert component.acceleration == pytest.approx(np.array(pairs)[:, 1] * 0.1 * G)
    assert (component.time_step, component.start, component.azimuth) == (0.01, 100.0, 65.0)
    assert component.station == "123 A TOWN"


def test_zip_archives(tmp_path: Path) -> None:
    at2 = "UNITS OF G\nNPTS= 3, DT= .01 SEC\n .1 .2 .3\n"
    path = tmp_path / "records.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("notes.pdf", b"%PDF\0\0")
        archive.writestr("b/H2.at2", at2)
        archive.writestr("b/H1.at2", at2.replace(".1 ", ".4 "))
        archive.writestr("b/V.at2", at2)
        archive.writestr("b/H1.vt2", at2)
    components = read_components(path)
    assert [one.path.name for one in components] == ["H1.at2", "H2.at2", "V.at2"]
    assert components[0].acceleration[0] == pytest.approx(0.4 * G)
    motion = read_motion(path, component="H1", vertical="auto")
    assert motion.vertical == pytest.approx(np.array([0.1, 0.2, 0.3]) * G)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("cut.at2", at2.replace("NPTS= 3", "NPTS= 3000"))
    with pytest.raises(InputError, match=r"records.zip.cut.at2: cut short"):
        read_components(path)
    with zipfile.ZipFile(path, "w"):
        pass
    with pytest.raises(InputError, match="the archive is empty"):
        read_components(path)


@pytest.mark.parametrize(
    ("code", "azimuth"),
    [
        ("021", 21.0), ("360", 360.0), ("S05W", 185.0), ("N28W", 332.0), ("S62E", 118.0),
        ("N-S", 0.0), ("EW", 90.0), ("HNE", 90.0), ("W", 270.0), ("UP", None), ("HNZ", None),
        ("H1", None), ("DWN", None), ("999", None), ("", None),
    ],
)  # fmt: skip
def test_azimuths(code: str, azimuth: float | None) -> None:
    assert azimuth_of(code) == azimuth


def test_vertical_names() -> None:
    assert all(map(names_vertical, ["UP", "Up", "DWN", "U-D", "UD2", "V", "HNZ", "Z", "V2"]))
    assert not any(map(names_vertical, ["NS", "H1", "360", "", "HNE", "L1", "SN"]))
    names = {"TLM1_UD": "UD", "a-H1": "H1", "gm_ew_free_field": "ew", "chan_11": "", "set_021": ""}
    assert {name: code_in_name(Path(f"{name}.txt")) for name in names} == names
    assert [code_in_name(Path(f"A.{end}")) for end in ("UD1", "EW", "V2", "v1", "AT2", "acc")] == [
        "UD1",
        "EW",
        "",
        "",
        "",
        "",
    ]


def test_words_in_names_that_are_no_codes(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    # stations, and "run 1", have the form of a SEED channel; E05140 is Array #5, 140 degrees
    for name in ("CHZ", "WTZ12", "TEZ_01", "RUN1", "one", "RSN6_IMPVALL.I_I-ELC180"):
        assert code_in_name(Path(f"{name}.txt")) == ""
    assert azimuth_of("E05140") is None
    columns_in(tmp_path / "a", ["alpha.txt", "CHZ.txt"])
    assert len(suite(tmp_path / "a", units="g", time_step=0.01)) == 2
    # left out, but not silently
    columns_in(tmp_path / "b", ["alpha.txt", "beta_UD.txt", "gamma_EW.txt", "gamma_UD.txt"])
    assert len(suite(tmp_path / "b", units="g", time_step=0.01)) == 2
    assert "left out, by their names vertical components" in caplog.text
    assert "beta_UD.txt" in caplog.text
    assert "gamma_UD.txt" not in caplog.text


@pytest.mark.parametrize(
    ("name", "magnitude"),
    [("AOM003.EW", 6.2), ("nsmn.txt", 6.5), ("cwb.dat", 6.0), ("a.ASC", 4.6), ("a.smc", None)],
)
def test_magnitudes_of_headers(tmp_path: Path, name: str, magnitude: float | None) -> None:
    """As the header gives it; None where a format says nothing that is read."""
    (tmp_path / name).write_text(examples()[name].text)
    for component in read_components(tmp_path / name):
        assert component.origin.magnitude == magnitude


def columns_in(folder: Path, names: list[str]) -> None:
    folder.mkdir(exist_ok=True)
    for k, name in enumerate(names, 1):
        (folder / name).write_text("\n".join(str(k * x) for x in (0.1, -0.2, 0.3)))


@pytest.mark.parametrize(
    ("names", "pairs"),
    [
        # a borehole's three components beside a surface's
        (
            ["A.EW1", "A.NS1", "A.UD1", "A.EW2", "A.NS2", "A.UD2"],
            {"A.EW1": "A.UD1", "A.NS1": "A.UD1", "A.EW2": "A.UD2", "A.NS2": "A.UD2"},
        ),
        (
            ["r_EW_1.acc", "r_UD_1.acc", "r_EW_2.acc", "r_UD_2.acc"],
            {"r_EW_1.acc": "r_UD_1.acc", "r_EW_2.acc": "r_UD_2.acc"},
        ),
        (["r_EW_1.acc", "r_UD_2.acc"], {"r_EW_1.acc": None}),
        (["A.NS2", "A.UD1"], {"A.NS2": None}),
    ],
)
def test_verticals_of_other_records_are_not_taken(
    tmp_path: Path, cache: Path, names: list[str], pairs: dict[str, str | None]
) -> None:
    columns_in(tmp_path / "records", names)
    motions = suite(tmp_path / "records", vertical=True, units="m/s2", time_step=0.01)
    found = {
        Path(one.origin.file).name: one.vertical_origin and Path(one.vertical_origin.file).name
        for one in motions
    }
    assert found == pairs


def test_members_of_an_archive_pair_by_name(tmp_path: Path) -> None:
    path = tmp_path / "records.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("1979_CPE_H1.acc", "0.1\n0.2\n0.3")
        archive.writestr("1976_TLM1_UD.acc", "0.1\n0.2\n0.3")
    (motion,) = suite(path, vertical=True, units="g", time_step=0.01)
    assert motion.vertical is None


def test_damaged_archives_are_said(tmp_path: Path) -> None:
    path = tmp_path / "records.zip"
    rows = "\n".join(f" {0.001 * k:.4f} {-0.002 * k:.4f}" for k in range(60))
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.at2", f"PEER\nquake\nUNITS OF G\nNPTS= 120, DT= .01 SEC\n{rows}\n")
    (intact,) = read_components(path)
    raw = bytearray(path.read_bytes())
    places = range(0, len(raw), 3)
    refusals = []
    for at in places:
        spoilt = raw.copy()
        spoilt[at] ^= 0x5D
        path.write_bytes(spoilt)
        try:
            found = read_components(path)
        except InputError as error:
            refusals.append(str(error))
        else:  # a byte that says nothing of the values: a date, a version
            (component,) = found
            assert np.array_equal(component.acceleration, intact.acceleration)
    assert all("records.zip" in refusal for refusal in refusals)
    assert len(refusals) > 0.6 * len(places)


@pytest.mark.parametrize("count", [11, 13])
def test_fixed_rows_are_counted(tmp_path: Path, count: int) -> None:
    path = tmp_path / "a.V1A"
    path.write_text(geonet_v1(np.linspace(0.0, 100.0, 20)).replace("  20    D", f"  {count}    D"))
    with pytest.raises(InputError, match="found 20"):
        read_components(path)


def records_in(folder: Path, count: int = 3, samples: int = 50) -> Path:
    folder.mkdir()
    rng = np.random.default_rng(5)
    for number in range(count):
        for code in ("021", "-UP"):
            rows = "\n".join(f"{x: .7E}" for x in 0.1 * rng.normal(size=samples))
            text = f"UNITS OF G\nNPTS= {samples}, DT= .01 SEC\n{rows}\n"
            (folder / f"RSN{number}_{code}.AT2").write_text(text)
    (folder / "README.md").write_text("words only\nand more\n")
    return folder


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(cached, "user_cache_path", lambda _: tmp_path / "cache")
    return tmp_path / "cache" / "suites"


def test_a_suite_is_read_once(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    folder = records_in(tmp_path / "records")
    first = suite(folder, vertical=True)
    assert [motion.name for motion in first] == ["RSN0_021", "RSN1_021", "RSN2_021"]
    assert len(list(cache.iterdir())) == 1
    assert "left out, not records: README.md" in caplog.text
    caplog.clear()
    with monkeypatch.context() as patch:
        patch.setattr("shaketable.records.suites.each_of_folder", None)  # not to be called
        second = suite(folder, vertical=True)
    assert "left out, not records: README.md" in caplog.text  # said again
    for a, b in zip(first, second, strict=True):
        assert (a.name, a.time_step, a.origin) == (b.name, b.time_step, b.origin)
        assert a.vertical_origin == b.vertical_origin
        np.testing.assert_array_equal(a.horizontal, b.horizontal)
        np.testing.assert_array_equal(a.vertical, b.vertical)
    assert suite(folder)[0].vertical is None  # other options, another file
    assert len(list(cache.iterdir())) == 2


@pytest.mark.parametrize("spoil", ["cut", "zeros", "samples", "empty", "meaning"])
def test_a_spoilt_cache_is_built_anew(tmp_path: Path, cache: Path, spoil: str) -> None:
    folder = records_in(tmp_path / "records")
    first = suite(folder)
    (path,) = cache.iterdir()
    raw = bytearray(path.read_bytes())
    if spoil == "cut":
        path.write_bytes(raw[: len(raw) // 2])
    elif spoil == "zeros":
        raw[-2000:-1500] = bytes(500)
        path.write_bytes(raw)
    elif spoil == "samples":
        raw[8:16] = bytes(8)
        path.write_bytes(raw)
    elif spoil == "empty":
        path.write_bytes(b"")
    else:
        (length,) = cached.LENGTH.unpack(raw[-8:])
        about = json.loads(raw[-8 - length : -8])
        about["motions"][0]["samples"] = 10**6
        told = json.dumps(about).encode()
        path.write_bytes(raw[: -8 - length] + told + cached.LENGTH.pack(len(told)))
    again = suite(folder)
    np.testing.assert_array_equal(first[0].horizontal, again[0].horizontal)
    assert path.stat().st_size > 1000


def test_a_changed_record_is_read_again(tmp_path: Path, cache: Path) -> None:
    folder = records_in(tmp_path / "records")
    before = suite(folder)[0].horizontal[0]
    path = folder / "RSN0_021.AT2"
    path.write_text(path.read_text().replace("NPTS= 50", "NPTS= 49", 1).rsplit("\n", 2)[0] + "\n")
    assert suite(folder)[0].horizontal.size == 49
    assert suite(folder)[0].horizontal[0] == before


def test_no_cache_folder_is_no_harm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "cache").write_text("a file where the folder would be")
    monkeypatch.setattr(cached, "user_cache_path", lambda _: tmp_path / "cache")
    assert len(suite(records_in(tmp_path / "records"))) == 3


def test_suites_of_folders_refuse(tmp_path: Path, cache: Path) -> None:
    folder = records_in(tmp_path / "records")
    (folder / "RSN1_021.AT2").write_text("UNITS OF G\nNPTS= 50, DT= .01 SEC\n.1 x\n")
    (folder / "RSN2_021.AT2").write_text("UNITS OF G\nNPTS= 50, DT= .01 SEC\n.1 .2\n")
    with pytest.raises(InputError, match=r"(?s)RSN1_021.*found 'x'.*RSN2_021.*cut short"):
        suite(folder)
    (tmp_path / "none").mkdir()
    with pytest.raises(InputError) as told:
        suite(folder, vertical=True)  # though what is beside a broken record is read as well
    assert str(told.value).count("found 'x'") == 1
    with pytest.raises(InputError, match="no record with a horizontal component"):
        suite(tmp_path / "none")
    with pytest.raises(InputError, match="neither a file, a folder nor a suite"):
        suite(tmp_path / "nowhere")
    (alone,) = suite(folder / "RSN0_021.AT2", vertical=True)
    assert alone.vertical is not None
    assert suite(folder / "RSN0_-UP.AT2") == []
