"""Every file of the shared records against their catalogue, and what the headers themselves say."""

from __future__ import annotations

import csv
import re
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, read_motion, suite
from shaketable.records.read import FORMATS
from shaketable.signal import velocity
from tests.conftest import SHARED
from tests.support.builders import G

CATALOG = SHARED / "records" / "catalog.csv"
#: What the files do not say.
GIVEN = {"kallioras_2025": {"units": "m/s2", "time_step": 0.005}, "buildings": {"units": "g"}}


def rows_by_file() -> dict[str, list[dict[str, str]]]:
    found = defaultdict(list)
    if CATALOG.is_file():
        with CATALOG.open(encoding="utf-8") as file:
            for row in csv.DictReader(file):
                found[row["file"]].append(row)
    return found


def read(path: Path):
    return read_components(path, **GIVEN.get(path.relative_to(CATALOG.parent).parts[0], {}))


ROWS = rows_by_file()


@pytest.mark.skipif(not ROWS, reason=f"no recorded accelerograms at {CATALOG.parent}")
@pytest.mark.parametrize("name", ROWS or ["none"])
def test_the_catalogue(name: str) -> None:
    components = read(CATALOG.parent / name)
    assert len(components) == len(ROWS[name])
    for component, row in zip(components, ROWS[name], strict=True):
        assert component.acceleration.size == int(row["npts"])
        # the catalogue's RENADIC steps are duration/(n - 1) of a duration of n steps
        assert component.time_step == pytest.approx(float(row["dt"]), abs=1.1e-6)
        peak = np.abs(component.acceleration).max() / G
        # its RENADIC peaks were converted with g = 9.80 m/s²; the headers' own are tested below
        g = 9.80665 / 9.80 if "renadic" in name else 1.0
        assert peak == pytest.approx(g * float(row["pga_g"]), abs=5.1e-6)
        assert component.is_vertical == (row["component"] == "V")
        assert len(component.sha256) == 64


@pytest.mark.parametrize(
    "name", ["curico1002271parte1.v1", "llolleo1002271.v1", "stgomaipu1002271parte1.v1"]
)
def test_renadic_peaks_are_those_of_the_headers(shared_records: Path, name: str) -> None:
    path = shared_records / "renadic" / name
    stated = [float(peak) for peak in re.findall(r"MAX\s*=\s*(\S+) G", path.read_text("latin-1"))]
    for component in read_components(path):
        peak = component.acceleration[np.argmax(np.abs(component.acceleration))] / G
        assert peak == pytest.approx(stated[component.channel - 1], abs=5.1e-4)  # three decimals


def test_knet_motions_have_the_stated_peak(shared_records: Path) -> None:
    # NIED's "Max. Acc. (gal)" is without the offset that its counts carry
    paths = [path for path in (shared_records / "knet_kiknet").iterdir() if "UD" not in path.suffix]
    assert paths
    for path in paths:
        stated = re.search(r"Max\. Acc\. \(gal\) +(\S+)", path.read_text("latin-1"))
        motion = read_motion(path)
        assert motion.peak_ground_acceleration * 100 == pytest.approx(
            float(stated.group(1)), abs=2e-2
        )
        assert "published uncorrected" in motion.origin.processing[-1]


def test_geonet_and_csmip_velocities_are_those_of_the_headers(shared_records: Path) -> None:
    path = shared_records / "geonet" / "20161113_110259_WTMC_20.V2A"
    lines = path.read_text().splitlines()
    stated = [-1.01655, 0.68643]  # m/s, in the headers; the vertical, of 1.8 g, loses 5 % below
    for number, (component, peak) in enumerate(zip(read_components(path), stated, strict=False)):
        begins = float(lines[number * 2486 + 26 + 820][:8]) * 1e-3  # its velocities' first
        found = velocity(component.acceleration, component.time_step, start=begins)
        # theirs was integrated at 0.005 s, before it was thinned out to 0.02 s
        assert found[np.argmax(np.abs(found))] == pytest.approx(peak, abs=0.012)
    csmip = read_components(shared_records / "cosmos_csmip" / "ce14196p.zip")
    assert [one.code for one in csmip] == ["90", "UP", "0"]
    assert csmip[0].path.name == "INGLEWOO.V2"
    found = velocity(csmip[0].acceleration, 0.02, start=-0.053e-2)  # both in the header
    assert np.abs(found).max() == pytest.approx(0.16380, abs=6e-4)  # thinned out, too


PAIRS = [
    ("knet_kiknet/AOM0031801241951.EW", "AOM0031801241951.UD"),
    ("knet_kiknet/AICH040010061330.NS2", "AICH040010061330.UD2"),
    ("peer_at2/RSN1616_DUZCE_362-E.AT2", "RSN1616_DUZCE_362-V.AT2"),
    ("peer_at2/RSN164_IMPVALL.H_H-CPE147.AT2", "RSN164_IMPVALL.H_H-CPEDWN.AT2"),
    ("peer_at2/RSN4013_SANSIMEO_36258021.AT2", "RSN4013_SANSIMEO_36258-UP.AT2"),
    ("peer_at2/Rinaldi228.AT2", "RinaldiUP.AT2"),
    ("esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", "HI.ARS1..HNZ.D.20190728.160908.C.ACC.ASC"),
    ("esm/legacy_16840/16840_H1.cor.acc", "16840_V.cor.acc"),
    ("smc/0111a.smc", "0111b.smc"),
    ("other/017m30lw.e0c", "017m30lw.e0b"),
    ("kallioras_2025/19760506_2000_TLM1_NS.acc", "19760506_2000_TLM1_UD.acc"),
]


@pytest.mark.parametrize(("across", "up"), PAIRS)
def test_verticals_beside(shared_records: Path, across: str, up: str) -> None:
    given = GIVEN.get(across.split("/")[0], {})
    motion = read_motion(shared_records / across, vertical="auto", **given)
    assert Path(motion.vertical_origin.file).name == up
    assert motion.vertical.size == motion.horizontal.size
    (alone,) = read_components(shared_records / across.rsplit("/", 1)[0] / up, **given)
    sign = -1.0 if "DWN" in up else 1.0  # up is positive in a motion
    level = alone.acceleration - (alone.acceleration.mean() if alone.uncorrected else 0.0)
    assert motion.vertical[: level.size] == pytest.approx(sign * level)


@pytest.mark.parametrize(
    ("name", "component", "up"),
    [
        ("cosmos_csmip/ce36456p_CE36456.V2", 90, "UP"),
        ("cosmos_csmip/CE23837.V1C", "360", "Up"),
        ("cosmos_csmip/ce14196p.zip", "channel 1", "UP"),
        ("geonet/20161113_110259_WTMC_20.V2A", 332, "Up"),
        ("geonet/20161113_110259_WTMC_20.V2A", "S62W", "Up"),
        ("renadic/llolleo1002271.v1", "T", "V"),
        ("other/2-EGF.dat", "E", "U"),
        ("other/20170720223109_0921.txt", 0.0, "UD"),
        ("other/5523-1.V1", 177, "V2"),
    ],
)
def test_components_of_one_file(
    shared_records: Path, name: str, component: str | float, up: str
) -> None:
    motion = read_motion(shared_records / name, component=component, vertical="auto")
    assert motion.vertical_origin.component == up
    with pytest.raises(InputError, match=r"horizontal components .*choose with component="):
        read_motion(shared_records / name)
    with pytest.raises(InputError, match="0 components match 'H9'; the file holds"):
        read_motion(shared_records / name, component="H9")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("cosmos_csmip/CE89146.V3", "response and Fourier spectra"),
        ("peer_at2/RSN57_SFERN_ORR021.VT2", "velocity series"),
        ("peer_at2/RSN57_SFERN_ORR021.DT2", "displacement series"),
        ("esm/legacy_16840/16840.metadata", "unknown record format"),
        ("esm/legacy_16840/16840_H1.rs", "unknown record format"),
    ],
)
def test_what_is_no_acceleration(shared_records: Path, name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_components(shared_records / name)


COUNTED = [name for name in ROWS if "kallioras" not in name and "buildings" not in name]


@pytest.mark.parametrize("name", COUNTED or ["none"])
def test_cut_files_are_refused(shared_records: Path, tmp_path: Path, name: str) -> None:
    # less than half of a real file: every format that states a count must notice
    raw = (shared_records / name).read_bytes()
    path = tmp_path / Path(name).name
    path.write_bytes(raw[: len(raw) * 9 // 20])
    with pytest.raises(InputError, match=re.escape(path.name)):
        read_components(path)


@pytest.mark.parametrize("name", [name for name in ROWS if "kallioras" not in name] or ["none"])
def test_a_letter_among_the_numbers_is_named(
    shared_records: Path, tmp_path: Path, name: str
) -> None:
    if name == "none":
        pytest.skip(f"no recorded accelerograms at {CATALOG.parent}")
    lines = (shared_records / name).read_text("latin-1").splitlines()
    at = 100  # within the first series of accelerations
    middle = len(lines[at].rstrip()) // 2
    lines[at] = lines[at][:middle] + "x" + lines[at][middle + 1 :]
    path = tmp_path / Path(name).name
    path.write_text("\n".join(lines), encoding="latin-1")
    with pytest.raises(InputError, match=rf"line {at + 1}: expected"):
        read_components(path, **GIVEN.get(name.split("/")[0], {}))


def test_every_format_was_seen() -> None:
    if not ROWS:
        pytest.skip(f"no recorded accelerograms at {CATALOG.parent}")
    seen = {component.format for name in ROWS for component in read(CATALOG.parent / name)}
    made = {"UNAM ASA", "CSMNC"}  # of these only made-up files are at hand
    assert seen | made == {one.name for one in FORMATS}


def test_origin_travels_with_the_motion(shared_records: Path) -> None:
    motion = read_motion(shared_records / "other" / "20170720223109_0921.txt", component="N-S")
    origin = motion.scaled(2.0).reversed().origin
    assert origin.station.startswith("0921 AYDıN")
    assert origin.event == "2017/07/20 22:31:09 (GMT) M6.5 Mw"
    assert origin.processing[1:] == ("scaled by 2", "reversed")
    assert (origin.component, origin.azimuth) == ("NS", 0.0)


def test_a_folder_is_a_suite(shared_records: Path, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("shaketable.records.cached.user_cache_path", lambda _: tmp_path)
    motions = suite(shared_records / "peer_at2", vertical=True)
    assert len(motions) == 14
    assert sum(motion.vertical is not None for motion in motions) == 12  # not Taft, not El Centro
