"""How stacks of two begin to rock."""

from __future__ import annotations

import math

import pytest

from shaketable import Body, InputError
from shaketable.criteria.psycharis_1990 import StackMode, stack_borders, stack_mode

G = 9.80665
UPPER, WHOLE, SAME, AGAINST = (
    StackMode.UPPER, StackMode.WHOLE, StackMode.SAME_WAY, StackMode.AGAINST,
)  # fmt: skip


def of(width: float, height: float, mass: float) -> Body:
    return Body.rectangle(width, height, mass=mass)


# lower, upper, and the borders in g by the equations of the file, worked out by hand
STACKS = [
    (of(0.5, 0.8, 30), of(0.3, 0.5, 10), {WHOLE: 0.44444, AGAINST: 11.51}),
    (of(0.4, 1.2, 30), of(0.5, 0.3, 10), {WHOLE: 0.25397}),  # it overhangs
    (of(0.4, 1.0, 30), of(0.15, 0.3, 2), {WHOLE: 0.36994, AGAINST: 2.92}),
    (of(0.6, 0.3, 40), of(0.2, 0.9, 10), {UPPER: 0.22222}),
    (of(0.4, 0.8, 40), of(0.3, 0.4, 10), {WHOLE: 0.38462}),
]


@pytest.mark.parametrize("stack", STACKS)
def test_borders(stack: tuple[Body, Body, dict[StackMode, float]]) -> None:
    lower, upper, known = stack
    found = dict(stack_borders(lower, upper))
    for mode, border in known.items():
        assert found[mode] / G == pytest.approx(border, rel=2e-3 if border > 1 else 2e-5)


@pytest.mark.parametrize(
    ("lower", "upper", "border", "stepped"),
    [
        (of(0.4, 1.0, 100), of(0.15, 0.5, 5), 0.3802, 0.3802),
        (of(0.6, 0.3, 40), of(0.2, 0.9, 10), 2.0576, 2.0559),
        (of(0.5, 0.8, 30), of(0.2, 0.8, 30), 0.4143, 0.4145),
        (of(0.8, 0.75, 30), of(0.2, 0.5, 15), 0.9333, 0.9341),
        (of(0.6, 0.4, 20), of(0.3, 1.5, 80), 1.1649, 1.1661),
    ],
)
def test_where_the_upper_rocks_alone_the_lower_begins_later(
    lower: Body, upper: Body, border: float, stepped: float
) -> None:
    """By hand, and by a time stepping of both bodies whose accelerations were raised in steps."""
    found = stack_borders(lower, upper)
    assert found[0][0] == UPPER
    assert found[1][0] != UPPER
    assert found[1][1] / G == pytest.approx(border, abs=1e-4)
    assert found[1][1] / G == pytest.approx(stepped, rel=1e-3)


def test_more_shaking_can_look_calmer() -> None:
    """A vase of 5 kg on a pedestal: alone at 0.30 g, both at 0.38 g, as one again at 0.481 g."""
    lower, upper = of(0.4, 1.0, 100), of(0.15, 0.5, 5)
    borders = stack_borders(lower, upper)
    assert [mode for mode, _ in borders[:3]] == [UPPER, SAME, WHOLE]
    assert [at / G for _, at in borders[:3]] == pytest.approx([0.30, 0.3802, 0.481], abs=5e-4)
    assert stack_mode(lower, upper, 0.29 * G) == StackMode.REST
    assert stack_mode(lower, upper, 0.379 * G) == UPPER
    assert stack_mode(lower, upper, 0.382 * G) == SAME
    assert stack_mode(lower, upper, 0.60 * G) == WHOLE


def test_what_overhangs_turns_about_the_edge_that_it_lies_on() -> None:
    """A board of 0.8 m on a post of 0.2 m: at 0.1/0.05 g about the post's edge, not 0.4/0.05 g."""
    post, board = of(0.2, 0.1, 200), of(0.8, 0.1, 1)
    (mode, at), *_ = stack_borders(post, board)
    assert mode == WHOLE
    assert dict(stack_borders(of(1.0, 0.1, 200), of(0.2, 0.1, 1)))[UPPER] == pytest.approx(2 * G)
    assert at < 2 * G


def test_each_border_parts_two_modes() -> None:
    """A hair on either side of it; and two alike that are stacked are one that is twice as high."""
    for lower, upper, _ in STACKS:
        for mode, at in stack_borders(lower, upper):
            assert stack_mode(lower, upper, at * (1 + 1e-9)) == mode
            assert stack_mode(lower, upper, at * (1 - 1e-9)) != mode
    half = of(0.3, 0.5, 10)
    (mode, at), *_ = stack_borders(half, half)
    assert mode == WHOLE
    assert at == pytest.approx(G * 0.3 / 1.0)


def test_what_is_no_stack_of_two() -> None:
    with pytest.raises(InputError, match="lower body of a stack needs a mass"):
        stack_mode(Body.rectangle(0.4, 1.0), of(0.2, 0.3, 5), 1.0)
    with pytest.raises(InputError, match="upper body of a stack must be symmetric"):
        stack_mode(of(0.4, 1.0, 10), Body.rectangle(0.2, 0.3, eccentricity=0.4, mass=5), 1.0)
    with pytest.raises(InputError, match="must be 0 or more"):
        stack_mode(of(0.4, 1.0, 10), of(0.2, 0.3, 5), -1.0)
    with pytest.raises(InputError):
        stack_mode(of(0.4, 1.0, 10), of(0.2, 0.3, 5), math.nan)
