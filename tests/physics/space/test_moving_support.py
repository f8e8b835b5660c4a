"""The published cases of a box on a moving support have the answers that stand beside them."""

from __future__ import annotations

import json

import numpy as np
import pytest
from benchmarks.moving_support import ours
from benchmarks.moving_support.cases import FILE, Case, read_cases, written
from benchmarks.moving_support.sliding import slip_of

from shaketable.units import STANDARD_GRAVITY as G

CASES = read_cases()


@pytest.mark.parametrize("case", CASES, ids=[each.name for each in CASES])
def test_its_answer_is_found(case: Case) -> None:
    found, known = ours.run(case), case.answers
    assert found.falls == known.falls
    if known.slip is not None:
        assert found.slip == pytest.approx(known.slip, abs=case.within)
    if known.peak is not None:
        assert found.peak == pytest.approx(known.peak, rel=case.within, abs=1e-12)


def test_the_file_says_what_is_read() -> None:
    told = json.loads(FILE.read_text(encoding="utf-8"))["cases"]
    assert [json.loads(json.dumps(written(each))) for each in CASES] == told
    assert len({each["name"] for each in told}) == len(told)


def test_the_slip_of_a_pulse_by_hand() -> None:
    """Of twice the friction's f at its peak and T long (Newmark 1965); it slides from T/4 on.

    By quarters of the pulse it goes 1/96, 5/96 and 5/96 of f T², then 1/128 until it stops.
    """
    length, friction = 0.4, 0.3
    t = np.arange(201) * 0.01
    push = 2 * friction * G * np.maximum(0.0, 1.0 - np.abs(2.0 * t / length - 1.0))
    slip = slip_of(push, np.full_like(push, G), friction, 0.01)
    # round-off
    assert slip == pytest.approx(47 / 384 * friction * G * length**2, rel=1e-12)
