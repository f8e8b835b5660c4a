"""Series, first roots and the small-angle rotation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from shaketable.physics.plane.taylor import (
    MAX_ADVANCE,
    NO_ROOT,
    ORDER,
    Series,
    first_root,
    highest,
    lowest,
    small_sin_cos,
    value,
    without_leading_zeros,
)

# A reading of a polynomial near its root is good to this, in units of its largest coefficient.
ROUND_OFF = 1e-13

coefficients = st.lists(st.floats(-1, 1, allow_subnormal=False), min_size=9, max_size=9)


def series(numbers: list[float]) -> Series:
    return Series(*[float(c) for c in numbers])


def exact(q: Series, u: np.ndarray) -> np.ndarray:
    return np.polynomial.polynomial.polyval(u, np.array(q))


@settings(max_examples=300, deadline=None)
@given(st.floats(1e-3, 1), coefficients)
@example(0.001953125, [0.0] * 8 + [-1.0])  # far from a parabola: the most steps
def test_first_root_is_a_root_and_the_first(start: float, rest: list[float]) -> None:
    q = series([start, *rest])
    root = first_root(q, 0.0)
    until = 1.0 if root == NO_ROOT else root
    # nothing before it is below zero, to round-off
    assert exact(q, np.linspace(0, until, 2001)).min() > -ROUND_OFF
    if root != NO_ROOT:
        assert abs(value(q, root)) < ROUND_OFF


@settings(max_examples=100, deadline=None)
@given(st.floats(0.05, 0.9), st.floats(1e-6, 0.05))
def test_first_of_two_close_roots(at: float, gap: float) -> None:
    # (u - at)(u - at - gap): a graze that a sign at the interval's ends does not show
    q = series([at * (at + gap), -(2 * at + gap), 1, 0, 0, 0, 0, 0, 0, 0])
    # the two roots move by round-off over their distance
    assert first_root(q, 0.0) == pytest.approx(at, abs=2e-9 + 1e-15 / gap)


def test_double_root_and_near_miss() -> None:
    touch = series([0.25, -1, 1, 0, 0, 0, 0, 0, 0, 0])
    assert first_root(touch, 0.0) == pytest.approx(0.5, abs=1e-7)  # √round-off
    miss = series([0.25 + 1e-12, -1, 1, 0, 0, 0, 0, 0, 0, 0])
    assert first_root(miss, 0.0) == NO_ROOT


def test_root_at_the_start_is_left_out() -> None:
    # u (u - 0.3): the body stands on the ground and comes back at 0.3
    q = series([0, 0.3, -1, 0, 0, 0, 0, 0, 0, 0])
    assert first_root(q, 0.0) == 0.0
    assert first_root(without_leading_zeros(q, 1), 0.0) == pytest.approx(0.3, rel=1e-15)


@settings(max_examples=200, deadline=None)
@given(coefficients, st.floats(-1, 1))
def test_bounds_hold(rest: list[float], start: float) -> None:
    q = series([start, *rest])
    values = exact(q, np.linspace(0, 1, 501))
    assert values.min() >= lowest(q) - ROUND_OFF
    assert values.max() <= highest(q) + ROUND_OFF


@pytest.mark.parametrize("x", np.linspace(-MAX_ADVANCE, MAX_ADVANCE, 21))
def test_small_sin_cos(x: float) -> None:
    sine, cosine = small_sin_cos(float(x))
    assert sine == pytest.approx(math.sin(x), abs=2e-16)
    assert cosine == pytest.approx(math.cos(x), abs=2.3e-16)


def test_order_is_what_the_series_has() -> None:
    assert len(Series._fields) == ORDER + 2
