"""Bodies, supports and motions cannot be wrong."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Rocking, Support, simulate


def test_rectangle() -> None:
    body = Body.rectangle(0.2, 1.0, eccentricity=0.3, restitution_factor=0.9)
    assert body.restitution_factor == 0.9
    assert (body.left, body.right) == pytest.approx((0.06, 0.14))
    assert body.cg_height == 0.5
    assert body.gyration_radius**2 == pytest.approx((0.2**2 + 1.0**2) / 12)
    assert body.slenderness_left == pytest.approx(math.atan(0.06 / 0.5))


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("field", ["base", "cg_height", "gyration_radius"])
def test_body_sizes_are_positive(field: str, bad: float) -> None:
    good = {"base": 0.3, "cg_height": 0.5, "left": 0.1, "gyration_radius": 0.3}
    with pytest.raises(InputError, match=field):
        Body(**{**good, field: bad})


@pytest.mark.parametrize("bad", [1e200, 1e-200, 1e7])
def test_body_sizes_are_those_of_things(bad: float) -> None:
    with pytest.raises(InputError, match=r"between 1e-06 and 1e\+06 m"):
        Body.rectangle(0.3, bad)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Body.rectangle("0.3", 1.0),
        lambda: Body.rectangle(0.3, None),
        lambda: Body.rectangle(0.3, 1.0, eccentricity="middle"),
        lambda: Body.rectangle(0.3, 1.0, restitution_factor=[0.9]),
        lambda: Body(base=0.3, cg_height=0.5, left=None, gyration_radius=0.3),
        lambda: Support(tilt="5°"),
        lambda: Rocking(restitution="0.9"),
        lambda: Rocking(restitution_factor=None),
        lambda: General(static_friction=None),
        lambda: General(static_friction=0.3, kinetic_friction="0.2"),
        lambda: General(normal_restitution=1j),
        lambda: Motion([0.0, 1.0], "0.01"),
        lambda: Motion([0.0, 1.0], 0.01).scaled("2"),
        lambda: simulate(
            Body.rectangle(0.3, 1.0), Motion([0.0, 1.0], 0.01), initial_rotation="0.1"
        ),
    ],
)
def test_what_is_no_number_is_refused(make: Callable[[], object]) -> None:
    with pytest.raises(InputError, match="must be a number, got"):
        make()


@pytest.mark.parametrize("left", [0.0, 0.3, -0.1, 0.31, math.nan])
def test_centre_of_gravity_stands_over_the_base(left: float) -> None:
    with pytest.raises(InputError, match="inside the base"):
        Body(base=0.3, cg_height=0.5, left=left, gyration_radius=0.3)


@pytest.mark.parametrize("eccentricity", [0.0, 1.0, -0.2, math.nan])
def test_eccentricity(eccentricity: float) -> None:
    with pytest.raises(InputError, match="eccentricity"):
        Body.rectangle(0.3, 1.0, eccentricity=eccentricity)


@pytest.mark.parametrize("tilt", [-math.pi / 2, math.pi / 2, math.nan])
def test_support_ranges(tilt: float) -> None:
    with pytest.raises(InputError, match="tilt"):
        Support(tilt=tilt)


@pytest.mark.parametrize("factor", [0.0, 1.001, -0.5, math.nan])
def test_restitution_factor_of_a_body(factor: float) -> None:
    with pytest.raises(InputError, match=r"restitution_factor, the share .* in \(0, 1\]"):
        Body(base=0.3, cg_height=0.5, left=0.15, gyration_radius=0.3, restitution_factor=factor)


def test_each_is_one_readable_line() -> None:
    body = Body.rectangle(0.3, 1.0, eccentricity=0.4, name="shelf")
    assert repr(body) == (
        "Body('shelf', base=0.3 m, cg_height=0.5 m, left=0.12 m, gyration_radius=0.3014 m)"
    )
    motion = Motion([0.0, 9.80665, 0.0], 0.01, name="jolt")
    assert repr(motion) == "Motion('jolt', 3 samples of 0.01 s, peak 1 g)"


def test_everything_is_frozen() -> None:
    motion = Motion([0.0, 1.0], 0.01)
    for thing, field in [(Body.rectangle(1, 2), "base"), (Support(), "tilt"), (motion, "name")]:
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(thing, field, 1)
    with pytest.raises(ValueError, match="read-only"):
        motion.horizontal[0] = 1.0


@pytest.mark.parametrize(
    ("horizontal", "message"),
    [
        ([1.0], "at least 2"),
        ([[1.0, 2.0]], "one series"),
        ([0.0, math.nan], "sample 1 is nan"),
        ([0.0, math.inf, math.inf], "2 samples in all"),
        (["a", "b"], "numbers"),
    ],
)
def test_motion_samples(horizontal: list, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Motion(horizontal, 0.01)


@pytest.mark.parametrize("step", [0.0, -0.01, math.nan])
def test_motion_time_step(step: float) -> None:
    with pytest.raises(InputError, match="time_step"):
        Motion([0.0, 1.0], step)


def test_motion_vertical_has_the_same_length() -> None:
    with pytest.raises(InputError, match="3 samples"):
        Motion([0.0, 1.0], 0.01, vertical=[0.0, 1.0, 2.0])


def test_scaled_and_reversed() -> None:
    motion = Motion([1.0, -2.0], 0.01, vertical=[0.5, 0.5], name="it")
    assert motion.scaled(2).horizontal == pytest.approx([2, -4])
    assert motion.scaled(2).vertical == pytest.approx([1, 1])
    assert motion.reversed().horizontal == pytest.approx([-1, 2])
    assert motion.reversed().vertical == pytest.approx([0.5, 0.5])  # horizontal only
    assert motion.reversed().name == "it"
    with pytest.raises(InputError, match="scale"):
        motion.scaled(-1)
    assert motion.peak_ground_acceleration == 2
    assert motion.duration == pytest.approx(0.01)
    assert np.allclose(motion.time, [0, 0.01], rtol=0, atol=1e-16)


@pytest.mark.parametrize("motion", [Motion([0.0, 1e300], 0.01), Motion([0.0, 1.0], 1e9)])
def test_motions_that_cannot_be_in_si_units(motion: Motion) -> None:
    with pytest.raises(InputError, match="Are the accelerations in m/s² and the time step in s"):
        simulate(Body.rectangle(0.3, 1.0), motion)
