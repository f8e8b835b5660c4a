"""Spectra against closed forms, an independent library, brute force, and networks' own spectra."""

from __future__ import annotations

import math
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion, read_components, read_motion
from shaketable.signal import PERIODS, Spectrum, response_spectrum
from shaketable.signal.spectra import spectral_acceleration
from shaketable.synthesis import half_sine, rectangular
from tests.support.builders import G


@pytest.mark.parametrize("ratio", [0.1, 0.3, 0.5, 1.0, 2.0])
def test_undamped_half_sine(ratio: float) -> None:
    """Chopra, Dynamics of structures, eqs. 4.8.3 and 4.8.5: shock spectrum of a half-sine pulse.

    With r = td/Tn below 1/2 the peak comes in free vibration: |(Tn/td) cos(π r)/((Tn/2td)² - 1)|;
    above, during the pulse: 1/(1 - Tn/2td) sin(2πl/(1 + 2 td/Tn)), the largest l.
    """
    duration = 0.8
    Tn = duration / ratio
    found = response_spectrum(half_sine(1.0, duration, samples=4000), [Tn], damping=0.0)
    if ratio == 0.5:
        expected = math.pi / 2
    elif ratio < 0.5:
        expected = abs(
            (Tn / duration) * math.cos(math.pi * ratio) / ((Tn / (2 * duration)) ** 2 - 1)
        )
    else:
        beta = Tn / (2 * duration)
        inside = [
            abs(math.sin(2 * math.pi * n / (1 + 1 / beta)) / (1 - beta))
            for n in range(1, 1 + round(0.5 * (1 + 1 / beta)))
        ]
        expected = max(inside)
    # a polygon of 4000 sides: (π/4000)²/8 of curvature
    assert found.acceleration[0] == pytest.approx(expected, rel=1e-6)


def test_undamped_step() -> None:
    # a rectangular pulse longer than Tn/2 doubles the static response; it rises in one sample of
    # 4e-5 s, (2π 4e-5/1)²/24 of a cycle
    assert response_spectrum(
        rectangular(1.0, 2.0, samples=50_000), [1.0], damping=0.0
    ).acceleration[0] == pytest.approx(2.0, rel=1e-6)


def test_resonance_reaches_the_steady_state() -> None:
    # 60 cycles of sine at the oscillator's period: amplification 1/(2ζ) (1 - e^{-ζ 2π 60})
    T, z = 0.5, 0.05
    t = np.linspace(0.0, 60 * T, 60 * 400 + 1)
    motion = Motion(np.sin(2 * math.pi * t / T), t[1])
    found = response_spectrum(motion, [T], damping=z).acceleration[0]
    assert found == pytest.approx(1 / (2 * z), rel=2e-3)  # the peak of u is off resonance by ζ²/2


@pytest.fixture(scope="module")
def recorded(shared_records: Path) -> list[Motion]:
    names = ["Rinaldi228", "RSN15_KERN_TAF021", "RSN1633_MANJIL_ABBAR--L", "RSN57_SFERN_ORR021"]
    return [read_motion(shared_records / "peer_at2" / f"{name}.AT2") for name in names]


@pytest.mark.parametrize("damping", [0.01, 0.05, 0.2])
def test_against_eqsig(recorded: list[Motion], damping: float) -> None:
    # eqsig (Nigam-Jennings, too) takes peaks at the samples: sampled 20 times as finely it loses
    # (wh)²/8, 2.5e-5 at 0.1 s and 0.02/20 s
    import eqsig

    periods = np.array([0.1, 0.3, 1.0, 3.0, 8.0])
    for motion in recorded[:2]:
        h = motion.time_step / 20
        even = np.arange(20 * (motion.horizontal.size - 1) + 1) * h
        fine = np.interp(even, motion.time, motion.horizontal)
        fine = np.pad(fine, (0, round(9.0 / h)))  # free vibration counts, too
        signal = eqsig.AccSignal(fine, h)
        signal.generate_response_spectrum(response_times=periods, xi=damping)
        found = response_spectrum(motion, periods, damping=damping).acceleration
        assert found == pytest.approx(signal.s_a, rel=6e-4)


def test_peaks_between_samples(recorded: list[Motion]) -> None:
    # the same polygon with more vertices has the same spectrum: here 7 times as many
    for motion in recorded:
        even = np.arange(7 * (motion.horizontal.size - 1) + 1) / 7 * motion.time_step
        fine = np.interp(even, motion.time, motion.horizontal)
        coarse = spectral_acceleration(motion.horizontal, motion.time_step, PERIODS)
        # an extreme's time is right to 2e-4 rad; u is level there
        assert spectral_acceleration(fine, motion.time_step / 7, PERIODS) == pytest.approx(
            coarse, rel=1e-7
        )


def test_ends_of_the_range(recorded: list[Motion]) -> None:
    motion = recorded[0]
    stiff, soft = response_spectrum(motion, [0.0, 1e-3]), response_spectrum(motion, [200.0])
    assert stiff.acceleration == pytest.approx([motion.peak_ground_acceleration] * 2, rel=1e-3)
    from shaketable.signal import displacement

    # a soft oscillator stays where it was: its relative displacement is the ground's, within w t
    peak = np.abs(displacement(motion.horizontal, motion.time_step)).max()
    assert soft.displacement[0] == pytest.approx(peak, rel=0.05)


def test_against_csmip_volume_3(shared_records: Path) -> None:
    """CSMIP's own 5 % spectrum of the Inglewood record, in its volume 3 file: SD in inches."""
    path = shared_records / "cosmos_csmip" / "ce14196p.zip"
    with zipfile.ZipFile(path) as archive:
        lines = archive.read("INGLEWOO.V3").decode("latin-1").splitlines()
    fourier = next(n for n, line in enumerate(lines) if line.startswith("FOURIER"))
    at = next(n for n, line in enumerate(lines) if line.startswith("DAMPING =  .05"))
    periods, inches = (
        np.array([float(x) for x in re.findall(r"\S{4,}", text.replace("E ", "E+"))])
        for text in ("\n".join(lines[fourier - 13 : fourier]), "\n".join(lines[at + 1 : at + 14]))
    )
    inside = (periods >= 0.1) & (periods <= 3.0)  # beyond, their initial velocity matters
    component = read_components(path)[0]
    found = spectral_acceleration(component.acceleration, component.time_step, periods[inside])
    found = found * (periods[inside] / (2 * math.pi)) ** 2 / 0.0254
    # three digits; theirs takes peaks at samples of 0.02 s: up to (2π 0.02/T)²/8
    allowed = 0.01 + (2 * math.pi * 0.02 / periods[inside]) ** 2 / 8
    assert (np.abs(found / inches[inside] - 1.0) <= allowed).all()


def test_against_the_network_s_own_spectrum(shared_records: Path) -> None:
    """ITACA's 5 % spectra beside its legacy records, in m/s²."""
    folder = shared_records / "esm" / "legacy_16840"
    for code in ("H1", "H2", "V"):
        table = np.loadtxt(folder / f"16840_{code}.rs", skiprows=1, usecols=(0, 2))
        table = table[(table[:, 0] >= 0.1)]
        (component,) = read_components(folder / f"16840_{code}.cor.acc")
        found = spectral_acceleration(component.acceleration, component.time_step, table[:, 0])
        # theirs takes peaks at samples of 0.005 s: (2π 0.005/0.1)²/8 = 1.2 % at 0.1 s
        assert found == pytest.approx(table[:, 1], rel=0.013)


def test_spectrum_is_checked() -> None:
    spectrum = Spectrum(np.array([0.1, 1.0]), np.array([10.0, 1.0]), name="a")
    assert spectrum.at([0.1, math.sqrt(0.1), 1.0]) == pytest.approx([10.0, math.sqrt(10.0), 1.0])
    assert spectrum.velocity == pytest.approx([1 / (2 * math.pi)] * 2)
    assert spectrum.displacement[1] == pytest.approx(1 / (2 * math.pi) ** 2)
    with pytest.raises(InputError, match=r"goes from 0.1 to 1 s; asked for 0.05"):
        spectrum.at(0.05)
    for periods, values in [([1, 1], [1, 1]), ([1, 2], [1]), ([1, 2], [1, -1]), ([-1, 2], [1, 1])]:
        with pytest.raises(InputError):
            Spectrum(np.array(periods, float), np.array(values, float))
    motion = Motion([0.0, 1.0, 0.0], 0.01)
    for arguments in ({"damping": 1.0}, {"damping": -0.1}, {"periods": [-1.0]}):
        with pytest.raises(InputError):
            response_spectrum(motion, **{"periods": [1.0], **arguments})
    assert (response_spectrum(Motion([0.0, 0.0], 0.01)).acceleration == 0.0).all()
    assert response_spectrum(Motion([0.0, G], 0.01), [0.0]).acceleration[0] == G
