"""The profile of floor accelerations of ASCE 7-22, section 13.3.1."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.building import read_building
from shaketable.synthesis import FloorProfile, profile_motions


def test_amplification_by_hand() -> None:
    """Eqs. 13.3-4 and 13.3-5; T_a = 0.8 s: a1 = 1.25, a2 = 1 - 0.25 = 0.75."""
    known = FloorProfile(storeys=2, period=0.8).amplification()
    assert known == pytest.approx([1.0, 1.0 + 1.25 / 2 + 0.75 / 1024, 3.0], abs=1e-12)
    assert FloorProfile(storeys=2).amplification() == pytest.approx([1.0, 2.25, 3.5], abs=1e-12)
    stiff = FloorProfile(storeys=1, period=0.2).amplification()  # 1/T_a = 5 > 2.5; a2 = 0
    assert stiff == pytest.approx([1.0, 3.5], abs=1e-12)


def test_reduction_by_ductility() -> None:
    """Eq. 13.3-6: R = 8, Omega_0 = 3 give (1.1·8/3)^½ = 1.713, with I_e = 1.5 1.398."""
    told = {"storeys": 1, "response_modification": 8.0, "overstrength": 3.0}
    assert FloorProfile(**told).ductility_reduction == pytest.approx(1.7127, abs=1e-4)
    hospital = FloorProfile(**told, importance=1.5)
    assert hospital.ductility_reduction == pytest.approx(1.3984, abs=1e-4)
    brittle = FloorProfile(storeys=1, response_modification=3.0, overstrength=3.0)
    assert brittle.ductility_reduction == FloorProfile(storeys=1).ductility_reduction == 1.3
    assert hospital.factors() == pytest.approx([1.0, 3.5 / 1.3984], rel=1e-4)


def test_floors_from_a_file(tmp_path: Path, p695: list[Motion]) -> None:
    path = tmp_path / "surgery.toml"
    path.write_text('storeys = 2\nprofile = "ASCE 7-22"\nfirst_period_s = 0.8\n')
    building = read_building(path, p695[:3])
    assert building.computed
    assert list(building.floors) == ["0", "1", "2"]
    roof = building.floors["2"][0]
    assert np.array_equal(roof.horizontal, p695[0].horizontal * (3.0 / 1.3))
    assert roof.transverse is not None  # both directions by the same factor
    assert np.array_equal(roof.transverse, p695[1].horizontal * (3.0 / 1.3))
    assert roof.origin is not None
    assert roof.origin.location == "floor 2"
    assert "2.31 times as strongly as the ground" in building.told
    motion = profile_motions(FloorProfile(storeys=1), p695[0])[0]
    assert motion.peak_ground_acceleration == pytest.approx(
        p695[0].peak_ground_acceleration * 3.5 / 1.3, rel=1e-12
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('storeys = 2\nprofile = "NBC"\n', "profile: accepted is ASCE 7-22, found 'NBC'"),
        ('profile = "ASCE 7-22"\n', "a profile needs storeys"),
        ('storeys = 2\nprofile = "ASCE 7-22"\ndamping = 0.05\n', "damping: unknown; accepted"),
        ('storeys = 2\nprofile = "ASCE 7-22"\noverstrength = 3\n', "are given together"),
        ('storeys = 2.5\nprofile = "ASCE 7-22"\n', "storeys: expected a whole number"),
        ('storeys = 0\nprofile = "ASCE 7-22"\n', "storeys"),
    ],
)
def test_refused(tmp_path: Path, p695: list[Motion], text: str, says: str) -> None:
    path = tmp_path / "b.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=says):
        read_building(path, p695[:1])
