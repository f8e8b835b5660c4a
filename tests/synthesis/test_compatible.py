"""Artificial and matched motions have the spectra they promise."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.signal import Spectrum, displacement, response_spectrum, velocity
from shaketable.synthesis import (
    asce_7,
    eurocode_8,
    match_spectrum,
    read_spectrum,
    spectrum_compatible,
)
from tests.support.builders import G

#: Where nothing was checked while the motions were made.
PERIODS = np.geomspace(0.05, 3.0, 777)
TARGETS = {
    "Eurocode 8, B": eurocode_8(0.3 * G, "B"),
    "Eurocode 8, D, type 2": eurocode_8(0.15 * G, "D", kind=2),
    "ASCE 7": asce_7(1.0 * G, 0.6 * G),
}


def ratios(motions: list[Motion], wanted: np.ndarray) -> np.ndarray:
    return np.array([response_spectrum(one, PERIODS).acceleration / wanted for one in motions])


@pytest.mark.parametrize("name", TARGETS)
@pytest.mark.parametrize("envelope", ["trapezoid", "jennings"])
def test_code_spectra(name: str, envelope: str) -> None:
    motions = spectrum_compatible(TARGETS[name], 8, duration=25.0, envelope=envelope, seed=3)
    found = ratios(motions, TARGETS[name].at(PERIODS))
    assert np.abs(found - 1.0).max() < 0.10  # the tolerance asked for
    assert np.abs(found.mean(axis=0) - 1.0).max() < 0.05
    for motion in motions:
        assert velocity(motion.horizontal, 0.01)[-1] == pytest.approx(0.0, abs=1e-10)
        assert displacement(motion.horizontal, 0.01)[-1] == pytest.approx(0.0, abs=1e-10)
        assert motion.horizontal[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-12)
        assert motion.duration == pytest.approx(25.0)
    # phases of their own: no two alike
    likeness = np.corrcoef([motion.horizontal for motion in motions]) - np.eye(8)
    assert np.abs(likeness).max() < 0.35


def test_recorded_spectra(p695: list[Motion]) -> None:
    # the paper's way (C): a recorded motion's own spectrum, which has kinks where peaks change
    # hands; a mean of other motions rounds those off by some per cent
    for target in p695[0:24:12]:
        motions = spectrum_compatible(target, 8, seed=1)
        found = ratios(motions, response_spectrum(target, PERIODS).acceleration)
        assert np.abs(found - 1.0).max() < 0.10
        mean = np.abs(found.mean(axis=0) - 1.0)
        assert np.quantile(mean, 0.9) < 0.05
        assert motions[0].duration == pytest.approx(target.duration, abs=0.01)


def test_the_same_seed_gives_the_same_motions() -> None:
    target = TARGETS["ASCE 7"]
    first = spectrum_compatible(target, 3, seed=7)
    again = spectrum_compatible(target, 2, seed=7)
    other = spectrum_compatible(target, 2, seed=8)
    for a, b in zip(first, again, strict=False):
        np.testing.assert_array_equal(a.horizontal, b.horizontal)
    assert np.abs(np.corrcoef(first[0].horizontal, other[0].horizontal)[0, 1]) < 0.35
    assert first[1].name != first[0].name
    assert "seed 7, no. 2" in first[1].origin.processing[0]


def test_envelope_of_ones_own() -> None:
    late = spectrum_compatible(
        TARGETS["ASCE 7"], 1, duration=30.0, envelope=lambda x: np.clip((x - 0.5) / 0.2, 0, 1)
    )[0]
    share = (late.horizontal[:1300] ** 2).sum() / (late.horizontal**2).sum()
    assert share < 0.02  # nothing but what brings it to rest in the first 13 of 30 s


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"seed": -1}, "seed must be"),
        ({"n": 0}, "n must be"),
        ({"n": 1.5}, "n must be"),
        ({"duration": 3.0}, "too short"),
        ({"duration": math.nan}, "duration"),
        ({"time_step": 0.02}, "cannot hold periods"),
        ({"envelope": "box"}, "unknown envelope 'box'; accepted: trapezoid, jennings"),
        ({"envelope": lambda x: 0 * x}, "not all zero"),
        ({"tolerance": 0.0}, "tolerance"),
        (
            {"band": (0.05, 20.0), "duration": 50.0},
            "goes from 0.01 to 4 s, but the band is 0.05 to 20 s",
        ),
        ({"band": (1.0, 0.5)}, "0 < low < high"),
        ({"tolerance": 1e-4}, "no motion came nearer to the target"),
    ],
)
def test_compatible_refuses(change: dict, message: str) -> None:
    arguments = {"target": TARGETS["Eurocode 8, B"], "n": 1, **change}
    with pytest.raises(InputError, match=message):
        spectrum_compatible(**arguments)


def test_recorded_seeds_are_matched(p695: list[Motion]) -> None:
    target = TARGETS["Eurocode 8, B"]
    for seed in p695[:6]:
        motion = match_spectrum(seed, target)
        assert np.abs(ratios([motion], target.at(PERIODS)) - 1.0).max() < 0.10
        assert motion.horizontal.size == seed.horizontal.size
        assert velocity(motion.horizontal, motion.time_step)[-1] == pytest.approx(0.0, abs=1e-10)
        # still that earthquake
        assert np.corrcoef(seed.horizontal, motion.horizontal)[0, 1] > 0.6
        assert "matched to Eurocode 8" in motion.origin.processing[-1]


def test_matching_refuses() -> None:
    target = TARGETS["ASCE 7"]
    with pytest.raises(InputError, match="at rest"):
        match_spectrum(Motion(np.zeros(3000), 0.01), target)
    with pytest.raises(InputError, match=r"could be brought only to within \d+% of .*, not 0%"):
        match_spectrum(Motion(np.sin(np.arange(300) / 3), 0.01), target, tolerance=1e-4)
    nothing = Spectrum(np.array([0.01, 4.0]), np.array([0.0, 0.0]))
    with pytest.raises(InputError, match="is zero in the band"):
        match_spectrum(Motion(np.sin(np.arange(300) / 3), 0.01), nothing)


def test_eurocode_8_by_hand() -> None:
    # EN 1998-1, ground C, type 1: S 1.15, TB 0.2, TC 0.6, TD 2; a_g = 2 m/s²
    spectrum = eurocode_8(2.0, "c")
    plateau = 2.0 * 1.15 * 2.5
    assert spectrum.at([0.2, 0.4, 0.6]) == pytest.approx([plateau] * 3)
    assert spectrum.at([1.2, 2.0]) == pytest.approx([plateau / 2, plateau * 0.3])
    assert spectrum.at([4.0]) == pytest.approx(plateau * 0.6 * 2 / 16)
    # linear below TB, 1 + T/TB (2.5 - 1); between 300 periods a chord in logarithms
    assert spectrum.at([0.1]) == pytest.approx(2.3 * 1.75, rel=1e-3)
    assert eurocode_8(2.0, "C", damping=0.10).at([0.4]) == pytest.approx(plateau * math.sqrt(2 / 3))
    assert eurocode_8(2.0, "C", damping=0.50).at([0.4]) == pytest.approx(plateau * 0.55)
    with pytest.raises(InputError, match="grounds A to E"):
        eurocode_8(2.0, "F")


def test_asce_7_by_hand() -> None:
    # S_DS 10, S_D1 6 m/s²: T0 0.12, TS 0.6, TL 4
    spectrum = asce_7(10.0, 6.0, long_period=4.0)
    assert spectrum.at([0.12, 0.3, 0.6, 1.2, 4.0]) == pytest.approx([10, 10, 10, 5, 1.5])
    assert spectrum.at([8.0]) == pytest.approx(6.0 * 4.0 / 64.0, rel=1e-3)
    assert spectrum.at([0.06]) == pytest.approx(7.0, rel=1e-3)
    with pytest.raises(InputError):
        asce_7(0.0, 6.0)


@pytest.mark.parametrize(
    ("text", "given", "factor"),
    [
        ("period_s,sa_g\n0.1,0.5\n1,0.2\n", {}, G),
        ("T (s), SA (m/s2)\n0.1,0.5\n1,0.2\n", {}, 1.0),
        ("T [s], SA [cm/s2]\n0.1,0.5\n1,0.2\n", {}, 0.01),
        ("0.1,0.5\n1,0.2\n", {"units": "gal"}, 0.01),
        ("period,acceleration\n0.1,0.5\n\n1,0.2\n", {"units": "g"}, G),
        ("T (s)\tSA (g)\n0.1\t0.5\n1\t0.2\n", {}, G),
        ("period_s;sa_avg_g\n0.1;0.5\n1;0.2\n", {}, G),
    ],
)
def test_targets_of_files(tmp_path: Path, text: str, given: dict, factor: float) -> None:
    path = tmp_path / "target.csv"
    path.write_text(text)
    spectrum = read_spectrum(path, **given)
    assert spectrum.acceleration == pytest.approx(np.array([0.5, 0.2]) * factor)
    assert spectrum.name == "target"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1,0.5\n1,0.2\n", "names no unit of acceleration"),
        ("f (Hz),SA (g)\n0.1,0.5\n1,0.2\n", r"first column must be the period in s, found 'f"),
        ("T,SA (g),SV\n0.1,0.5,1\n1,0.2,1\n", "expected two columns, found 3"),
        ("period_s,sa (furlong)\n0.1,0.5\n1,0.2\n", "unknown unit of acceleration"),
        ("period_s,sa_g\n0.1,0.5\n1,x\n", "line 3: expected a number, found 'x'"),
        ("period_s,sa_g\n0.1,0.5,3\n1,1,1\n", "line 2: expected"),
        ("period_s,sa_g\n1,0.5\n0.1,0.2\n", "target.csv: a spectrum's periods must rise"),
        ("period_s,sa_g\n", "holds 0 rows"),
        ("", "empty"),
    ],
)
def test_targets_of_files_refuse(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "target.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_spectrum(path)
    with pytest.raises(InputError, match="no such file"):
        read_spectrum(tmp_path / "none.csv")
