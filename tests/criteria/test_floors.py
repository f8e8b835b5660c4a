"""Kaneko & Hayashi 2004 and Cimellaro 2020 against hand-computed numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import InputError
from shaketable.criteria import cimellaro_2020 as cimellaro
from shaketable.criteria import kaneko_hayashi_2004 as kaneko
from shaketable.criteria import shaketable_2026_floors as ours
from tests.support.builders import G

#: Cimellaro et al. (2020), table 3: B/H, then PGA [g] and OR of the mean, largest and smallest
#: overturning PGA.
TABLE_3 = {
    "AL1": (0.32, ((0.41, 0.66), (0.58, 0.82), (0.23, 0.36))),
    "AL2": (0.14, ((0.19, 0.67), (0.24, 0.76), (0.14, 0.58))),
    "W1": (0.32, ((0.43, 0.68), (0.58, 0.82), (0.23, 0.36))),
    "W2": (0.14, ((0.18, 0.66), (0.25, 0.77), (0.1, 0.50))),
    "W3": (0.39, ((0.5, 0.67), (0.61, 0.76), (0.4, 0.55))),
    "G": (0.39, ((0.52, 0.69), (0.73, 0.81), (0.41, 0.56))),
    "IB0": (0.30, ((0.49, 0.78), (0.9, 0.87), (0.33, 0.57))),
    "IB2": (0.21, ((0.34, 0.76), (0.5, 0.94), (0.23, 0.59))),
    "IB4": (0.28, ((0.39, 0.69), (0.76, 0.93), (0.24, 0.45))),
}


def test_cimellaro_gives_all_27_entries_of_table_3() -> None:
    found, printed, classes = [], [], []
    for ratio, entries in TABLE_3.values():
        for pga, risk in entries:
            found.append(float(cimellaro.overturning_ratio(ratio, pga * G)))
            printed.append(risk)
            classes.append(kaneko.risk_class(found[-1]))
    assert np.abs(np.array(found) - printed).max() <= 0.0055  # printed to two digits
    # "very high for mean and maximum PGAs, high for minimum PGAs" (Cimellaro et al. (2020),
    # section 5): not of the means, which lie about the border of 0.7
    assert set(classes[1::3]) == {"very high"}
    assert set(classes[2::3]) == {"high"}
    assert set(classes[0::3]) == {"high", "very high"}


def test_cimellaro_is_no_probability() -> None:
    # theory, section 8: 0.28 at PFA = 0 for B/H = 0.14, and falls beyond 640 to 775 cm/s²
    assert float(cimellaro.overturning_ratio(0.14, 0.0)) == pytest.approx(0.28, abs=0.005)
    turns = 100 * cimellaro.turning_acceleration(np.array(cimellaro.SHOWN))
    assert turns == pytest.approx([640, 760], abs=20)
    for ratio in cimellaro.SHOWN:
        top = cimellaro.turning_acceleration(ratio)
        rises = cimellaro.surface(ratio, top * np.array([0.99, 1.0, 1.01]))
        assert rises[1] == rises.max()
    assert float(cimellaro.surface(0.2, 5.5)) > 0.9
    assert float(cimellaro.overturning_ratio(0.9, 0.0)) == 0.0  # -0.66 as it comes


def test_cimellaro_flags_what_it_was_not_made_for() -> None:
    assert cimellaro.out_of_range(0.2, 2.0) == []
    (reason,) = cimellaro.out_of_range(0.5, 4.0)
    assert reason == "B/H = 0.5 is outside 0.14 to 0.39"
    reasons = cimellaro.out_of_range(0.2, 9.0)
    assert any("falls as the motion grows" in reason for reason in reasons)
    assert any("not a probability" in reason for reason in cimellaro.out_of_range(0.39, 0.0))
    for bad in ((0.0, 1.0), (-1.0, 1.0), (0.2, -1.0), (0.2, math.nan)):
        with pytest.raises(InputError, match=r"B/H|pfa"):
            cimellaro.overturning_ratio(*bad)


def test_kaneko_by_hand() -> None:
    # B = 40 cm, H = 180 cm: A50 = (0.2222)(980.665)(1.2222) = 266.3 cm/s²,
    # V50 = 400/13.416 · 1.2222^2.5 = 49.24 cm/s
    assert 100 * float(kaneko.median_acceleration(0.4, 1.8)) == pytest.approx(266.35, abs=0.05)
    assert 100 * float(kaneko.median_velocity(0.4, 1.8)) == pytest.approx(49.24, abs=0.01)
    # at the medians one half, one deviation above 0.8413
    half = kaneko.overturning_ratio(0.4, 1.8, 2.6635, 9.0)
    assert float(half) == pytest.approx(0.5, abs=1e-3)
    above = kaneko.overturning_ratio(0.4, 1.8, 2.6635 * math.exp(0.25), 9.0)
    assert float(above) == pytest.approx(0.8413, abs=1e-3)
    fast = kaneko.overturning_ratio(0.4, 1.8, 90.0, 0.4924 * math.exp(0.34))
    assert float(fast) == pytest.approx(0.8413, abs=1e-3)
    wide = kaneko.overturning_ratio(0.4, 1.8, 90.0, 0.4924 * math.exp(0.34), zeta_v=0.68, slide=0.5)
    assert float(wide) == pytest.approx(0.5 * 0.6915, abs=1e-3)  # Φ(0.5)


def test_the_branch_is_that_of_the_smaller_demand() -> None:
    rng = np.random.default_rng(5)
    width, height = rng.uniform(0.05, 1.0, 4000), rng.uniform(0.2, 3.0, 4000)
    pfa, pfv = np.exp(rng.uniform(-2, 3, 4000)), np.exp(rng.uniform(-4, 1, 4000))
    slow = kaneko.floor_frequency(pfa, pfv) <= kaneko.body_frequency(width, height)
    a, v = kaneko.demands(width, height, pfa, pfv)
    # 15.6 is 980.665/20π = 15.608 rounded: they may differ where both demands do by less than that
    unlike = slow != (a <= v)
    assert np.abs(a - v)[unlike].max(initial=0.0) < 15.608 / 15.6 - 1 + 1e-4
    assert unlike.mean() < 0.001
    printed = np.where(slow, a / kaneko.ZETA_A, v / kaneko.ZETA_V)[~unlike]
    found = kaneko.overturning_ratio(width, height, pfa, pfv)[~unlike]
    assert found == pytest.approx([0.5 * math.erfc(-z / math.sqrt(2)) for z in printed], abs=1e-12)


def test_kaneko_classes_and_bad_input() -> None:
    names = [kaneko.risk_class(r) for r in (0.0, 0.029, 0.03, 0.3, 0.69, 0.7, 1.0)]
    assert names == ["low", "low", "medium", "high", "high", "very high", "very high"]
    for none in (math.nan, math.inf, -0.1):
        with pytest.raises(InputError, match=r"ratio must lie in \[0, 1\]"):
            kaneko.risk_class(none)
    with pytest.raises(InputError, match=r"pfv \[m/s\]"):
        kaneko.overturning_ratio(0.4, 1.8, 3.0, math.nan)
    with pytest.raises(InputError, match="positive base"):
        kaneko.overturning_ratio(0.0, 1.8, 3.0, 0.4)
    with pytest.raises(InputError, match="zeta_a"):
        kaneko.overturning_ratio(0.4, 1.8, 3.0, 0.4, zeta_a=0.0)


def test_the_fitted_curve_by_hand_and_its_gate() -> None:
    # at both medians x = c_0
    a, v = float(kaneko.median_acceleration(0.4, 1.8)), float(kaneko.median_velocity(0.4, 1.8))
    at = 1 / (1 + math.exp(-ours.CONSTANT))
    assert float(ours.overturning_ratio(0.4, 1.8, a, v)) == pytest.approx(at)
    more = ours.overturning_ratio(0.4, 1.8, a * math.exp(0.2), v * 9)
    assert float(more) == pytest.approx(1 / (1 + math.exp(-ours.CONSTANT - 0.2 * ours.SLOPE)))
    # (B/H) g = 2.179 m/s² lifts no corner
    gate = ours.overturning_ratio(0.4, 1.8, [2.17, 2.19], 5.0)
    assert gate[0] == 0.0
    assert gate[1] > 0.0
    with pytest.raises(InputError, match="pfv"):
        ours.overturning_ratio(0.4, 1.8, 3.0, math.nan)
    assert ours.out_of_range(0.4, 1.8) == []
    assert ours.out_of_range(0.4, 0.4) == [
        "height [m] = 0.4 is outside 0.5 to 3",
        "B/H = 1 is outside 0.1 to 0.45",
    ]
