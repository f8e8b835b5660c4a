"""The suites of FEMA P-695."""

from __future__ import annotations

import pytest

from shaketable import InputError, Motion, suite
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
    assert len(SUITES) == 4
