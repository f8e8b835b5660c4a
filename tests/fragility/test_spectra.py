"""Spectra: regions and borders against closed forms and numbers found independently."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import InputError, Motion, Rocking, simulate_many
from shaketable.fragility import Fate, borders, overturning_spectrum, rocking_spectrum
from shaketable.fragility.pulse_borders import without_impact
from shaketable.fragility.spectra import PULSES, block_of

ALPHA, P = 0.25, 2.14  # the block of Zhang and Makris (2001)
BLOCK = block_of(P, ALPHA)
TO_TAN = ALPHA / math.tan(ALPHA)  # from a_p/(α g) to a_p/(g tan α)


@pytest.mark.parametrize(
    ("pulse", "frequencies", "known"),
    [
        ("half sine", (1, 2, 3), (1.3224, 1.8007, 2.2939)),
        ("sine", (1, 2, 3, 5), (1.4183, 2.3499, 3.6311, 7.1681)),
    ],
)
def test_closed_forms(pulse: str, frequencies: tuple[float, ...], known: tuple[float, ...]) -> None:
    """Numbers to the digits printed, found by integrating the linear equation on its own."""
    found = without_impact(pulse, frequencies)
    assert found is not None
    assert np.round(found, 4).tolist() == pytest.approx(known, abs=1.1e-4)


@pytest.mark.parametrize("pulse", ["sine", "cosine", "half sine", "rectangular"])
def test_slender_blocks_meet_the_closed_forms(pulse: str) -> None:
    """The equation is linear but for terms of α², here 1e-4.

    Longer pulses would let the block reach 90° before they end, which a linear one never does.
    """
    slender, frequencies = block_of(2.0, 0.01), [2.0, 3.0]
    closed = without_impact(pulse, frequencies)
    assert closed is not None
    amplitudes = np.sort(np.r_[0.995 * closed, 1.005 * closed])
    found = overturning_spectrum(
        slender, pulse=pulse, frequencies=frequencies, amplitudes=amplitudes, samples=4000
    )
    assert found["closed_form"].values == pytest.approx(closed, rel=1e-4)
    refined = borders(slender, found, samples=4000)
    last = refined[refined["above"] == "overturns_without_impact"]
    assert last["amplitude"].to_numpy() == pytest.approx(closed, rel=1e-3)


@pytest.mark.parametrize(
    ("model", "known"),
    [
        (Rocking(restitution=0.9), (3.0324, 6.7430, 7.4930)),
        (Rocking(), (2.9448, 6.8264, 7.4930)),
    ],
)
def test_one_sine_pulse(model: Rocking, known: tuple[float, ...]) -> None:
    """Zhang and Makris (2001): safe, overturns after an impact, safe, overturns without impact."""
    found = overturning_spectrum(
        BLOCK, frequencies=[5.0], amplitudes=np.linspace(0.5, 9.0, 120), model=model, samples=8000
    )
    refined = borders(BLOCK, found, model=model, samples=8000)
    assert refined["above"].tolist() == [
        "rocks", "overturns_after_impacts", "rocks", "overturns_without_impact",
    ]  # fmt: skip
    amplitude = refined["amplitude"].to_numpy()
    assert amplitude[0] == pytest.approx(1.0, rel=2e-6)  # uplift: a_p = g tan α
    # one unit of the last digit printed: some are of the sine, some of 500 straight pieces of it
    assert amplitude[1:] / TO_TAN == pytest.approx(known, abs=1e-4)
    assert found.attrs["p"] == pytest.approx(P)
    assert found.attrs["slenderness"] == pytest.approx(ALPHA)


def test_a_spectrum_is_what_simulations_give() -> None:
    frequencies, amplitudes = np.array([1.0, 3.0, 6.0]), np.linspace(0.5, 8.0, 9)
    for pulse in PULSES:
        found = overturning_spectrum(
            BLOCK, pulse=pulse, frequencies=frequencies, amplitudes=amplitudes
        )
        motions = [PULSES[pulse](w * P, 1000) for w in frequencies.tolist()]
        for k, motion in enumerate(motions):
            unit = 9.80665 * math.tan(ALPHA) / motion.peak_ground_acceleration
            runs = simulate_many(
                [BLOCK], [motion], scales=amplitudes * unit, polarities=[1], progress=False
            )
            fallen = runs.outcome.values.ravel() != 0
            assert ((found["fate"].values[k] >= Fate.OVERTURNS_AFTER_IMPACTS) == fallen).all()
        assert (found["fate"].values[:, 0] == Fate.RESTS).all()  # below g tan α nothing moves
        assert set(np.unique(found["fate"])) >= {Fate.RESTS, Fate.ROCKS}


def test_a_rocking_spectrum(p695: list[Motion]) -> None:
    slender, periods = np.radians([10.0, 20.0]), np.array([1.0, 2.0, 4.0])
    found = rocking_spectrum(p695[0], slender, periods)
    for j, alpha in enumerate(slender.tolist()):
        for k, period in enumerate(periods.tolist()):
            body = block_of(2.0 * math.pi / period, alpha)
            runs = simulate_many([body], [p695[0]], progress=False)
            assert float(found["peak_rotation"][j, k]) == float(runs.peak_rotation.max())
            assert bool(found["overturns"][j, k]) == bool((runs.outcome != 0).any())
    assert found["share"].values == pytest.approx(found["peak_rotation"] / slender[:, None])


def test_blocks_have_their_p_and_slenderness() -> None:
    body = block_of(2.0, 0.3)
    half_diagonal = math.hypot(body.base / 2, body.cg_height)
    assert math.sqrt(3 * 9.80665 / (4 * half_diagonal)) == pytest.approx(2.0)
    assert body.slenderness_right == pytest.approx(0.3)


def test_bad_input(p695: list[Motion]) -> None:
    axes = {"frequencies": [1.0], "amplitudes": [1.0]}
    for given, said in (
        ({"pulse": "sinus"}, "unknown pulse 'sinus'; accepted: sine, cosine"),
        ({"frequencies": [0.0]}, "frequencies= must be above 0, got 0"),
        ({"amplitudes": [-1.0]}, "amplitudes= must be above 0, got -1"),
        ({"samples": 2}, "at least 4 samples"),
    ):
        with pytest.raises(InputError, match=said):
            overturning_spectrum(BLOCK, **(axes | given))
    with pytest.raises(InputError, match="between 0 and π/2 rad"):
        rocking_spectrum(p695[0], [2.0], [1.0])
    with pytest.raises(InputError, match="above 0 s"):
        rocking_spectrum(p695[0], [0.2], [-1.0])
