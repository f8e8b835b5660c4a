"""miniSEED with and without a response, and K-NET against ObsPy's reader."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_components, read_motion

obspy = pytest.importorskip("obspy", reason="miniSEED needs ObsPy")


def station_xml(units: str, gain: float) -> object:
    from obspy.core.inventory import (
        Channel,
        InstrumentSensitivity,
        Inventory,
        Network,
        PolesZerosResponseStage,
        Response,
        Station,
    )

    poles = [-0.037 + 0.037j, -0.037 - 0.037j] if units == "M/S" else []
    zeros = [0j, 0j] if units == "M/S" else []
    stage = PolesZerosResponseStage(
        1, gain, 1.0, units, "COUNTS", "LAPLACE (RADIANS/SECOND)", 1.0, zeros, poles,
        normalization_factor=1.0,
    )  # fmt: skip
    response = Response(
        instrument_sensitivity=InstrumentSensitivity(gain, 1.0, units, "COUNTS"),
        response_stages=[stage],
    )
    channels = [
        Channel(code, "", 0, 0, 0, 0, azimuth=azimuth, dip=dip, sample_rate=100, response=response)
        for code, azimuth, dip in (("HNE", 92.0, 0.0), ("HNZ", 0.0, -90.0))
    ]
    station = Station("ABC", 0, 0, 0, channels=channels)
    return Inventory(networks=[Network("XX", stations=[station])], source="test")


def write_mseed(path: Path, counts: np.ndarray, channel: str) -> None:
    head = {"network": "XX", "station": "ABC", "channel": channel, "sampling_rate": 100.0}
    obspy.Stream([obspy.Trace(counts, head)]).write(str(path), format="MSEED")


def test_miniseed_of_an_accelerometer(tmp_path: Path) -> None:
    counts = np.round(1e5 * np.sin(np.arange(2000) / 30)).astype(np.int32)
    write_mseed(tmp_path / "a.HNE.mseed", counts, "HNE")
    write_mseed(tmp_path / "a.HNZ.mseed", 2 * counts, "HNZ")
    with pytest.raises(InputError, match=r"no StationXML .* has a response for XX.ABC..HNE"):
        read_components(tmp_path / "a.HNE.mseed")
    (raw,) = read_components(tmp_path / "a.HNE.mseed", units="mm/s2")
    assert raw.acceleration == pytest.approx(counts * 0.001)
    station_xml("M/S**2", 4e5).write(str(tmp_path / "station.xml"), format="STATIONXML")
    (component,) = read_components(tmp_path / "a.HNE.mseed")
    assert component.acceleration == pytest.approx(counts / 4e5)
    assert (component.azimuth, component.time_step, component.station) == (92.0, 0.01, "XX.ABC")
    motion = read_motion(tmp_path / "a.HNE.mseed", vertical="auto")
    assert motion.vertical_origin.component == "HNZ"


def test_miniseed_of_a_seismometer(tmp_path: Path) -> None:
    # ground velocity sin(w t), 0.5 Hz, as the instrument of station_xml sees it: a = w cos(w t)
    w, t = np.pi, np.arange(12000) / 100
    seen = (1j * w) ** 2 / ((1j * w + 0.037 - 0.037j) * (1j * w + 0.037 + 0.037j))
    counts = np.round(6e8 * np.imag(seen * np.exp(1j * w * t))).astype(np.int32)
    write_mseed(tmp_path / "a.mseed", counts, "HNE")
    station_xml("M/S", 6e8).write(str(tmp_path / "a.xml"), format="STATIONXML")
    (component,) = read_components(tmp_path / "a.mseed")
    middle = slice(4000, 8000)
    # ObsPy's water level, taper and pre-filter leave some thousandths
    assert component.acceleration[middle] == pytest.approx(
        (w * np.cos(w * t))[middle], abs=0.02 * w
    )
    assert "response removed" in component.processing[0]


def test_miniseed_with_a_gap(tmp_path: Path) -> None:
    head = {"network": "XX", "station": "ABC", "channel": "HNE", "sampling_rate": 100.0}
    first = obspy.Trace(np.arange(100, dtype=np.int32), head)
    second = obspy.Trace(np.arange(100, dtype=np.int32), head)
    second.stats.starttime += 5.0
    path = tmp_path / "gap.mseed"
    obspy.Stream([first, second]).write(str(path), format="MSEED")
    with pytest.raises(InputError, match="has gaps"):
        read_components(path, units="gal")


def test_knet_agrees_with_obspy(shared_records: Path) -> None:
    for path in sorted((shared_records / "knet_kiknet").iterdir()):
        (component,) = read_components(path)
        (trace,) = obspy.read(str(path), format="KNET", apply_calib=True)
        assert component.time_step == pytest.approx(trace.stats.delta, rel=1e-12)
        # ObsPy's calibration is in m/s²
        assert component.acceleration == pytest.approx(trace.data, rel=1e-9, abs=1e-12)


def test_miniseed_that_was_cut(tmp_path: Path) -> None:
    path = tmp_path / "a.mseed"
    write_mseed(path, np.arange(2000, dtype=np.int32) ** 2 % 977, "HNE")
    whole = path.read_bytes()
    assert len(whole) > 1500
    path.write_bytes(whole[:-1000])  # within a record of 512 bytes
    with pytest.raises(InputError, match="cannot be read as miniSEED"):
        read_components(path, units="m/s2")


def test_miniseed_beside_a_log(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    text = np.frombuffer(b"clock set", "|S1")
    path, other = tmp_path / "a.mseed", tmp_path / "log.mseed"
    write_mseed(path, np.arange(500, dtype=np.int32), "HNE")
    head = {"network": "XX", "station": "A", "channel": "LOG", "sampling_rate": 0.0}
    obspy.Stream([obspy.Trace(text, head)]).write(str(other), format="MSEED")
    path.write_bytes(path.read_bytes() + other.read_bytes())
    (component,) = read_components(path, units="m/s2")
    assert component.code == "HNE"
    assert "left out, no samples: XX.A..LOG" in caplog.text
