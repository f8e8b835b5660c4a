"""Scores of probabilities."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable.calibration import brier_difference, reliability, scores


def test_scores_by_hand() -> None:
    """Two tests: 0.8 and it fell, 0.4 and it fell.

    Brier: (0.04 + 0.36)/2. Spiegelhalter: Σ(y-p)(1-2p) = 0.2·(-0.6) + 0.6·0.2 = 0, so z = 0.
    """
    found = scores([0.8, 0.4], [True, True])
    assert found.share_right == 0.5
    assert found.brier == pytest.approx(0.2)
    assert found.spiegelhalter == pytest.approx(0.0, abs=1e-12)


def test_spiegelhalter_by_hand() -> None:
    """One test: z = (y-p)(1-2p)/√((1-2p)² p(1-p)) = -0.9/0.3 at p = 0.1 and y = 1 has z = 3."""
    assert scores([0.1], [True]).spiegelhalter == pytest.approx(3.0)


def test_certain_probabilities_have_no_z() -> None:
    assert math.isnan(scores([0.0, 1.0], [False, True]).spiegelhalter)


def test_right_probabilities_pass_and_bold_ones_do_not() -> None:
    """z is about normal for right probabilities: beyond 4 once in 16,000."""
    rng = np.random.default_rng(1)
    p = rng.uniform(0.02, 0.98, 5000)
    fell = rng.uniform(size=p.size) < p
    assert abs(scores(p, fell).spiegelhalter) < 4.0
    bold = np.where(p > 0.5, 1.0 - (1.0 - p) / 3, p / 3)
    assert abs(scores(bold, fell).spiegelhalter) > 10.0


def test_reliability_counts_every_test() -> None:
    p = np.array([0.0, 0.1, 0.55, 0.59, 1.0])
    found = reliability(p, [False, True, True, False, True])
    assert found.tests.tolist() == [2, 2, 1]
    assert found.predicted == pytest.approx([0.05, 0.57, 1.0])
    assert found.seen == pytest.approx([0.5, 0.5, 1.0])
    assert (found.low <= found.seen).all()
    assert (found.high >= found.seen).all()


def test_the_difference_of_two_briers_by_hand() -> None:
    """Squares 0.04 and 0.16 against 0.25 each; a bootstrap of recordings holds the mean."""
    group = np.arange(20).repeat(2)
    fell = np.tile([1, 0], 20)
    ours = np.tile([0.8, 0.4], 20)
    off, low, high = brier_difference(ours, np.full(40, 0.5), fell, group)
    assert off == pytest.approx(0.25 - 0.10)
    assert low == pytest.approx(off)  # every recording gains alike
    assert high == pytest.approx(off)
    mixed = np.where(group % 2, ours, 1.0 - ours)
    off, low, high = brier_difference(mixed, np.full(40, 0.5), fell, group)
    assert off == pytest.approx(0.25 - (0.10 + 0.50) / 2)  # 0.64 and 0.36 where it is wrong
    assert low < off < high
