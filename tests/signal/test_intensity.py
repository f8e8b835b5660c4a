"""Intensity measures against closed forms, eqsig, NumPy and PEER's own integrals."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion, read_motion
from shaketable.signal import displacement, intensity_measures, measures, velocity
from shaketable.synthesis import one_sine
from tests.support.builders import G

NAMES = ["Rinaldi228", "RSN15_KERN_TAF021", "RSN1633_MANJIL_ABBAR--L", "RSN57_SFERN_ORR021"]


@pytest.fixture(scope="module")
def recorded(shared_records: Path) -> list[Motion]:
    return [read_motion(shared_records / "peer_at2" / f"{name}.AT2") for name in NAMES]


def test_one_sine_in_closed_form() -> None:
    a, T = 3.0, 0.8
    found = intensity_measures(one_sine(a, T, samples=4000))
    # a polygon of 4000 sides; areas of an inscribed one are (π/4000)²/3·… below 1e-6
    assert found["PGA"] == pytest.approx(a, rel=1e-6)
    assert found["PGV"] == pytest.approx(a * T / math.pi, rel=1e-6)
    assert found["PGD"] == pytest.approx(a * T * T / (2 * math.pi), rel=1e-6)
    assert found["PGV/PGA"] == pytest.approx(T / math.pi, rel=1e-6)
    assert found["Arias"] == pytest.approx(math.pi / (2 * G) * a * a * T / 2, rel=1e-6)
    assert found["CAV"] == pytest.approx(2 * a * T / math.pi, rel=1e-6)
    # |a| reaches 0.05 g at t = asin(0.05 g/a)/w, and last as long before the end
    reach = math.asin(0.05 * G / a) * T / (2 * math.pi)
    assert found["Dbracketed"] == pytest.approx(T - 2 * reach, rel=1e-6)
    # share of ∫sin²: (φ - sin φ cos φ)/2π
    phases = np.linspace(0.0, 2 * math.pi, 200_001)
    share = (phases - np.sin(phases) * np.cos(phases)) / (2 * math.pi)
    ends = np.interp([0.05, 0.75, 0.95], share, phases) * T / (2 * math.pi)
    assert found["D5-75"] == pytest.approx(ends[1] - ends[0], rel=1e-4)
    assert found["D5-95"] == pytest.approx(ends[2] - ends[0], rel=1e-4)


def test_against_eqsig(recorded: list[Motion]) -> None:
    # eqsig sums rectangles and trapezoids and takes peaks at samples: on a record sampled 8 times
    # as finely that is 1e-3 of any of them
    import eqsig

    for motion in recorded[3:]:
        h = motion.time_step / 8
        even = np.arange(8 * (motion.horizontal.size - 1) + 1) * h
        signal = eqsig.AccSignal(np.interp(even, motion.time, motion.horizontal), h)
        found = intensity_measures(motion)
        assert found["Arias"] == pytest.approx(eqsig.im.calc_arias_intensity(signal)[-1], rel=1e-3)
        assert found["CAV"] == pytest.approx(eqsig.im.calc_cav(signal)[-1], rel=1e-3)
        # to a sample of the fine record at either end
        assert found["D5-95"] == pytest.approx(
            eqsig.im.calc_sig_dur(signal, start=0.05, end=0.95), abs=3 * h
        )
        assert found["D5-75"] == pytest.approx(
            eqsig.im.calc_sig_dur(signal, start=0.05, end=0.75), abs=3 * h
        )
        assert found["Dbracketed"] == pytest.approx(
            eqsig.im.calc_brac_dur(signal, 0.05 * G), abs=3 * h
        )
        # ordinates of eqsig's spectra
        periods = np.linspace(0.1, 2.5, 121)
        signal.generate_response_spectrum(response_times=periods)
        psv = signal.s_a * periods / (2 * math.pi)
        assert found["Housner"] == pytest.approx(np.trapezoid(psv, periods), rel=1e-3)
        averaged = np.linspace(0.2, 3.0, 100)
        signal.generate_response_spectrum(response_times=averaged)
        assert found["AvgSA(1.0)"] == pytest.approx(np.exp(np.log(signal.s_a).mean()), rel=1e-3)
        signal.generate_response_spectrum(response_times=np.array([0.3, 1.0]))
        assert [found["SA(0.3)"], found["SA(1.0)"]] == pytest.approx(signal.s_a, rel=1e-3)
        signal.generate_response_spectrum(response_times=np.geomspace(0.02, 5.0, 200))
        largest = float(np.geomspace(0.02, 5.0, 200)[np.argmax(signal.s_a)])
        assert found["Tp"] == pytest.approx(largest, rel=1e-9)


def test_mean_period_by_definition(recorded: list[Motion]) -> None:
    # Rathje et al. (1998), the discrete Fourier transform written out for every tenth frequency
    # would be slow; NumPy's FFT of another length (df = 0.01 Hz) is independent enough
    for motion in recorded:
        count = round(100.0 / motion.time_step)
        f = np.fft.rfftfreq(count, motion.time_step)
        C = np.abs(np.fft.rfft(motion.horizontal, count))
        inside = (f >= 0.25) & (f <= 20.0)
        expected = (C**2 / np.where(f > 0, f, 1))[inside].sum() / (C**2)[inside].sum()
        # sums over different frequencies of a line spectrum
        assert intensity_measures(motion)["Tm"] == pytest.approx(expected, rel=5e-3)


def test_mean_period_of_a_sine() -> None:
    t = np.arange(8000) * 0.005
    motion = Motion(np.sin(2 * math.pi * t / 0.5) * np.sin(math.pi * t / 40) ** 2, 0.005)
    assert intensity_measures(motion)["Tm"] == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize(("ending", "of"), [("VT2", velocity), ("DT2", displacement)])
def test_against_peers_own_integrals(shared_records: Path, ending: str, of) -> None:
    """PEER's velocity [cm/s] and displacement [cm] of the same record."""
    motion = read_motion(shared_records / "peer_at2" / "RSN57_SFERN_ORR021.AT2")
    text = (shared_records / "peer_at2" / f"RSN57_SFERN_ORR021.{ending}").read_text()
    header, *rows = re.split(r"NPTS.*\n", text)
    assert header
    theirs = 0.01 * np.array(rows[0].split(), dtype=float)
    ours = of(motion.horizontal, motion.time_step)
    # their processing leaves a small trend that is not in the acceleration printed
    assert np.abs(ours - theirs).max() < 0.01 * np.abs(theirs).max()


def test_exact_for_a_polygon() -> None:
    # two triangles of opposite sign, by hand: a = 0, 2, -2, 0 m/s² at 1 s
    found = intensity_measures(Motion([0.0, 2.0, -2.0, 0.0], 1.0))
    assert found["CAV"] == pytest.approx(1 + 1 + 1)
    assert found["PGV"] == pytest.approx(1.0)
    assert found["Arias"] == pytest.approx(math.pi / (2 * G) * (4 / 3 + 4 / 3 + 4 / 3))
    assert velocity(np.array([0.0, 2.0, -2.0, 0.0]), 1.0) == pytest.approx([0, 1, 1, 0])
    # x = t³/3, then 1/3 + t + t² - 2t³/3, then 5/3 + t - t² + t³/3
    assert displacement(np.array([0.0, 2.0, -2.0, 0.0]), 1.0) == pytest.approx([0, 1 / 3, 5 / 3, 2])


def test_rest_and_bad_periods() -> None:
    still = intensity_measures(Motion([0.0, 0.0, 0.0], 0.01))
    # of a spectrum of zeros the first period is the largest
    assert all(value == 0.0 or name == "Tp" for name, value in still.items())
    assert {measure.name for measure in measures()} == set(still)
    assert all(measure.unit and measure.meaning for measure in measures())
    with pytest.raises(InputError, match="period"):
        measures(sa=[0.0])


def test_scaling(recorded: list[Motion]) -> None:
    once = intensity_measures(recorded[0])
    twice = intensity_measures(recorded[0].scaled(2.0))
    powers = dict.fromkeys(once, 1)
    powers |= {"Arias": 2} | dict.fromkeys(["D5-75", "D5-95", "Tp", "Tm", "PGV/PGA"], 0)
    for name, power in powers.items():
        if name != "Dbracketed":
            assert twice[name] == pytest.approx(2**power * once[name], rel=1e-9)
