"""Motions: their components, and what is done to all of them."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, ShearBuilding, floor_motions, simulate
from shaketable.origin import Origin
from shaketable.signal import filtered
from shaketable.simulate import simulate_many

X, Y, Z = np.random.default_rng(0).normal(size=(3, 400))


@pytest.fixture
def motion() -> Motion:
    return Motion(
        X, 0.01, transverse=Y, vertical=Z, name="made", origin=Origin(azimuth=90.0),
        transverse_origin=Origin(azimuth=0.0),
    )  # fmt: skip


def test_a_pair(motion: Motion) -> None:
    assert motion.transverse is not None
    assert not motion.transverse.flags.writeable
    assert "with vertical and transverse" in repr(motion)
    with pytest.raises(InputError, match=r"Motion\.transverse has 3 samples and .* 400"):
        Motion(X, 0.01, transverse=np.zeros(3))
    with pytest.raises(InputError, match=r"Motion\.transverse must be finite"):
        Motion(X, 0.01, transverse=np.full(400, np.nan))


def test_scaled_and_reversed(motion: Motion) -> None:
    """Scaling takes all components, polarity both horizontal ones and never the vertical."""
    twice = motion.scaled(2.0)
    assert np.array_equal(twice.transverse, 2.0 * Y)
    assert np.array_equal(twice.vertical, 2.0 * Z)
    back = motion.reversed()
    assert np.array_equal(back.horizontal, -X)
    assert np.array_equal(back.transverse, -Y)
    assert np.array_equal(back.vertical, Z)
    assert back.transverse_origin is not None
    assert back.transverse_origin.processing == ("reversed",)
    assert back.vertical_origin is None


def test_rotated(motion: Motion) -> None:
    """Counterclockwise from above: what shook toward +x shakes toward +y after a right angle."""
    turned = motion.rotated(np.pi / 2)
    assert turned.horizontal == pytest.approx(-Y, abs=1e-12)
    assert turned.transverse == pytest.approx(X, abs=1e-12)
    assert np.array_equal(turned.vertical, Z)
    some = motion.rotated(0.3).rotated(0.5)
    assert some.horizontal == pytest.approx(motion.rotated(0.8).horizontal, abs=1e-12)
    assert some.transverse == pytest.approx(X * np.sin(0.8) + Y * np.cos(0.8), abs=1e-12)
    assert some.origin is not None
    assert some.origin.azimuth is None
    alone = Motion(X, 0.01).rotated(np.pi / 6)
    assert alone.transverse == pytest.approx(0.5 * X)
    with pytest.raises(InputError, match="finite"):
        motion.rotated(np.inf)


def test_processing_takes_all_components(motion: Motion) -> None:
    one = filtered(motion, high=20.0)
    assert np.array_equal(one.transverse, filtered(Motion(Y, 0.01), high=20.0).horizontal)
    assert one.transverse_origin is not None
    assert "lowpass 20 Hz" in one.transverse_origin.processing[-1]


def test_floors_of_a_pair(motion: Motion) -> None:
    """A building that is alike in both directions does to each component what it does to one."""
    house = ShearBuilding(storeys=2, first_period=0.3)
    along, across = (floor_motions(house, Motion(series, 0.01)) for series in (X, Y))
    for floor, one, other in zip(floor_motions(house, motion), along, across, strict=True):
        assert np.array_equal(floor.horizontal, one.horizontal)
        assert np.array_equal(floor.transverse, other.horizontal)


def test_a_planar_body_says_that_it_feels_one_component(
    motion: Motion, caplog: pytest.LogCaptureFixture
) -> None:
    body = Body.rectangle(0.3, 1.0)
    plain = Motion(X, 0.01, vertical=Z)
    with caplog.at_level(logging.WARNING):
        simulate(body, plain)
        assert not caplog.text
        one = simulate(body, motion)
    assert "the transverse components of 1 motions are not felt" in caplog.text
    assert one.peak_rotation == simulate(body, plain).peak_rotation
    caplog.clear()
    simulate_many([body], [plain, motion, motion])
    assert "the transverse components of 2 motions are not felt" in caplog.text
