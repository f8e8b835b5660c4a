"""Both horizontal components of a file, or of files side by side, by their azimuths."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, read_motion
from tests.support.record_files import write_at2


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """East, north and up of one recording, and a stranger."""
    series = np.random.default_rng(0).normal(size=(4, 40)) / 10
    names = (("RSN1_A-E.AT2", "090"), ("RSN1_A-N.AT2", "000"), ("RSN1_A-UP.AT2", "UP"))
    for (name, code), each in zip((*names, ("RSN2_B-N.AT2", "000")), series, strict=True):
        write_at2(tmp_path, name, code, each)
    return tmp_path


def test_east_and_north_as_they_are(folder: Path) -> None:
    pair = read_motion(folder / "RSN1_A-E.AT2", components=2)
    north = read_motion(folder / "RSN1_A-N.AT2")
    assert pair.transverse is not None
    assert np.array_equal(pair.transverse, north.horizontal)
    assert pair.vertical is None
    three = read_motion(folder / "RSN1_A-E.AT2", components=3)
    assert three.vertical is not None
    assert np.array_equal(three.horizontal, pair.horizontal)


def test_north_and_east_reversed(folder: Path) -> None:
    """To the left of north lies west."""
    pair = read_motion(folder / "RSN1_A-N.AT2", components=2)
    east = read_motion(folder / "RSN1_A-E.AT2")
    assert pair.transverse is not None
    assert np.array_equal(pair.transverse, -east.horizontal)
    assert pair.transverse_origin is not None
    assert pair.transverse_origin.azimuth == 270.0
    assert "reversed: recorded toward 90°" in pair.transverse_origin.processing


def test_one_alone_is_no_pair(folder: Path) -> None:
    with pytest.raises(InputError, match=r"at azimuth 270°.*none is; choose"):
        read_motion(folder / "RSN2_B-N.AT2", components=2)
    with pytest.raises(InputError, match="components= must be 1, 2 or 3"):
        read_motion(folder / "RSN2_B-N.AT2", components=4)


def test_several_are_not_guessed(folder: Path) -> None:
    write_at2(folder, "RSN1_A-W.AT2", "270", np.zeros(40))
    with pytest.raises(InputError, match="several are at a right angle"):
        read_motion(folder / "RSN1_A-N.AT2", components=2)


def test_unknown_azimuths_are_no_pair(tmp_path: Path) -> None:
    for name in ("A_H1.AT2", "A_H2.AT2"):
        write_at2(tmp_path, name, name[2:4], np.ones(10))
    with pytest.raises(InputError, match="the azimuth of H1 is not known"):
        read_motion(tmp_path / "A_H1.AT2", components=2)


@pytest.mark.parametrize(
    ("name", "azimuths", "turned"),
    [
        ("peer_at2/RSN164_IMPVALL.H_H-CPE237.AT2", (237.0, 147.0), False),
        ("peer_at2/Rinaldi228.AT2", (228.0, 138.0), True),
        ("smc/0111a.smc", (360.0, 270.0), False),
        ("knet_kiknet/AOM0031801241951.EW", (90.0, 0.0), False),
        ("knet_kiknet/AICH040010061330.NS2", (0.0, 270.0), True),
        ("other/5523-1.V1", (267.0, 177.0), False),  # one file holds all three
    ],
)
def test_recorded_triples(
    shared_records: Path, name: str, azimuths: tuple[float, float], turned: bool
) -> None:
    triple = read_motion(shared_records / name, components=3)
    assert triple.origin is not None
    assert triple.transverse_origin is not None
    assert (triple.origin.azimuth, triple.transverse_origin.azimuth) == azimuths
    said = " ".join(triple.transverse_origin.processing)
    assert ("reversed" in said) is turned
    assert triple.vertical is not None
