"""Solids as data: the usual ones, and those that no body can be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Solid, Support, simulate


def motion(transverse: bool = True) -> Motion:
    t = np.arange(200) * 0.01
    return Motion(np.sin(7 * t), 0.01, transverse=np.cos(5 * t) if transverse else None)


def test_a_box_is_the_prism_of_its_corners_in_either_sense() -> None:
    box = Solid.box(0.3, 0.5, 1.2, eccentricity=(0.4, 0.6))
    corners = box.corners
    for order in (corners, corners[::-1], np.roll(corners, 1, axis=0)):
        prism = Solid.polygon(order, 1.2)
        assert prism.inertia == pytest.approx(box.inertia, abs=1e-15)
        assert {tuple(c) for c in prism.corners.tolist()} == {tuple(c) for c in corners.tolist()}
    assert box.corners.min(axis=0).tolist() == [-0.4 * 0.3, -0.6 * 0.5]


def test_a_polygon_of_many_corners_is_a_cylinder() -> None:
    """Moments of inertia of a regular 64-gon; its area is 0.16 % less than the circle's."""
    angles = 2 * np.pi * np.arange(64) / 64
    prism = Solid.polygon(0.2 * np.column_stack([np.cos(angles), np.sin(angles)]), 1.0)
    assert prism.inertia == pytest.approx(Solid.cylinder(0.4, 1.0).inertia, rel=2e-3, abs=1e-12)


def test_corners_on_a_side_are_left_out() -> None:
    box = Solid.box(0.2, 0.2, 0.5)
    more = np.insert(box.corners, 1, (box.corners[0] + box.corners[1]) / 2, axis=0)
    assert Solid.polygon(more, 0.5).corners.tolist() == box.corners.tolist()


def test_feet_keep_those_inside_and_their_castors() -> None:
    feet = [[0.0, 0.05], [0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]]
    cart = Solid.on_feet(feet, 0.9, castors=[False, True, False, False, False])
    assert cart.contacts[-1].tolist() == [0.0, 0.05]
    assert cart.contacts[cart.castors.index(True)].tolist() == [0.2, 0.2]
    assert len(cart.corners) == 4


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Solid.polygon([[-1, -1], [1, -1], [0, 0.1], [1, 1], [-1, 1]], 1.0), "convex"),
        (lambda: Solid.polygon([[-1, -1], [1, -1], [1, -1], [1, 1], [-1, 1]], 1.0), "repeats"),
        (lambda: Solid.polygon([[-1, -1], [1, 1], [-1, 1], [1, -1]], 1.0), "no area"),
        (lambda: Solid.polygon([[-1, 0], [0, 0], [1, 0]], 1.0), "no area"),
        (lambda: Solid.polygon([[0.1, 0.1], [1, 0.1], [1, 1]], 1.0), "inside the base"),
        (lambda: Solid.polygon([[-1, -1], [1, math.nan], [1, 1]], 1.0), "finite"),
        (lambda: Solid.polygon("abc", 1.0), "pairs"),
        (lambda: Solid.polygon([[-1, -1], [1, -1]], 1.0), "three pairs"),
        (lambda: Solid.on_feet(np.random.default_rng(0).normal(size=(9, 2)), 1.0), "3 to 8 feet"),
        (lambda: Solid.on_feet([[0, 0], [0, 1], [1, 0]], 1.0), "inside the base"),
        (
            lambda: Solid.on_feet([[-1, -1], [1, -1], [0, 1]], 1.0, castors=[True]),
            "of each foot",
        ),
        (lambda: Solid.box(0.3, 0.3, 1.0, eccentricity=(0.5, 1.0)), "between 0 and 1"),
        (lambda: Solid.box(0.3, -0.3, 1.0), "size_y"),
        (lambda: Solid.box(0.3, 0.3, 1.0, drilling_friction=-1.0), "drilling_friction"),
        (lambda: Solid(None, 0.5, np.eye(3)), "either points or a diameter"),
        (lambda: Solid(None, 0.5, np.eye(3), diameter=0.2, castors=(True,)), "are feet"),
        (lambda: Solid(None, 0.5, np.diag([1.0, 1.0, 2.1]), diameter=0.2), "no body has"),
        (lambda: Solid(None, 0.5, np.diag([1.0, -1.0, 1.0]), diameter=0.2), "no body has"),
        (lambda: Solid(None, 0.5, np.triu(np.ones((3, 3))), diameter=0.2), "symmetric"),
        (lambda: Solid(None, 0.5, np.ones((2, 2)), diameter=0.2), "shape (2, 2)"),
    ],
)
def test_what_no_body_can_be_is_refused(make, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=said.replace("(", r"\(").replace(")", r"\)")):
        make()


def test_a_lamina_is_a_limit_that_is_allowed() -> None:
    """A moment equal to the sum of the others is that of a plane body."""
    Solid(None, 0.5, np.diag([1.0, 1.0, 2.0]), diameter=0.2)


@pytest.mark.parametrize(
    ("run", "said"),
    [
        (lambda: simulate(Solid.box(0.3, 0.3, 1.0), motion(), model="rocking"), "one edge"),
        (
            lambda: simulate(Body.rectangle(0.3, 1.0), motion(), Support(tilt=0.1, azimuth=1.0)),
            "vertical plane of x",
        ),
        (lambda: simulate(Body.rectangle(0.3, 1.0), motion(), orientation=0.1), "one plane"),
        (
            lambda: simulate(Solid.box(0.3, 0.3, 1.0), motion(), initial_rotation=0.1),
            "begins on its base",
        ),
        (lambda: simulate(Solid.box(0.3, 0.3, 1.0), motion(), orientation=math.inf), "finite"),
        (
            lambda: simulate(Solid.box(0.3, 0.5, 1.0), motion(), Support(tilt=0.3, azimuth=0.0)),
            "falls by itself",
        ),
    ],
)
def test_what_a_solid_is_not_simulated_with(run, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=said):
        run()


def test_one_component_alone_is_told(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level("INFO", logger="shaketable"):
        simulate(Solid.box(0.3, 0.3, 1.0), motion(transverse=False))
    assert "one horizontal component alone" in caplog.text


def test_a_planar_body_stands_on_azimuth_zero_as_on_a_negative_tilt() -> None:
    body, strong = Body.rectangle(0.3, 1.2), motion(False).scaled(3.0)
    one = simulate(body, strong, Support(tilt=0.05, azimuth=0.0))
    other = simulate(body, strong, Support(tilt=-0.05))
    assert one.outcome == other.outcome
    assert one.peak_rotation == other.peak_rotation
