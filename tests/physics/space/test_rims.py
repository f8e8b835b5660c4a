"""Cylinders whose rims stand on a few high points (theory, section 11)."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import General, InputError, Motion, Outcome, Solid, Support, simulate, uneven_rims
from shaketable.campaign.as_json import from_json, to_json

THREE = tuple(np.radians([10.0, 130.0, 250.0]).tolist())
DRUM = Solid.cylinder(0.3, 0.9)


def pulse(size: float) -> Motion:
    """Half a sine of 0.175 s, along and a little later across."""
    t = np.arange(300) * 0.01
    push = size * np.sin(2 * np.pi * t / 0.35) * (t < 0.175)
    return Motion(push, 0.01, transverse=0.3 * np.roll(push, 4))


def test_below_the_rim_it_is_a_body_on_feet() -> None:
    """As long as the rim does not touch, which it does here at 0.05 rad; steps are of 1e-9."""
    drum = replace(DRUM, high_points=THREE, rise=4e-3)
    feet = Solid.on_feet(drum.contacts, 0.9, inertia=drum.inertia)
    model = General(static_friction=0.4)
    one, other = (simulate(solid, pulse(3.5), model=model) for solid in (drum, feet))
    assert 0.01 < one.peak_rotation < math.atan(4e-3 / (0.15 * (1 - math.cos(math.pi / 3))))
    assert one.nutation == pytest.approx(other.nutation, abs=1e-8)
    assert one.foot == pytest.approx(other.foot, abs=1e-8)


def test_lower_points_come_to_the_ideal_rim() -> None:
    """On points of 1 µm the peak is that of an ideal rim to 1 %; on 1 mm it is half as much again.

    What stands on three points begins to tip over the side between two of them under half the
    acceleration that tips it over its rim.
    """
    ideal, low, high = (
        simulate(replace(DRUM, high_points=points, rise=rise), pulse(7.0)).peak_rotation
        for points, rise in (((), 0.0), (THREE, 1e-6), (THREE, 1e-3))
    )
    assert ideal > 0.05
    assert low == pytest.approx(ideal, rel=0.015)
    assert high > 1.5 * ideal


def test_on_a_slope_it_leans_on_its_rim() -> None:
    """Over the side between two points at c = R cos(π/3), and on to the rim: tan φ = rise/(R - c).

    The side's limit is atan(c/h) = 9.5°, the rim's 18.4°. Rolling friction brings it to rest.
    """
    drum = replace(DRUM, high_points=THREE, rise=1e-3, rolling_friction=1e-3)
    quiet = Motion(np.zeros(400), 0.01)
    for degrees, leans in ((9.0, False), (10.0, True)):
        support = Support(tilt=math.radians(degrees), azimuth=math.radians(70.0))
        found = simulate(drum, quiet, support)
        assert found.outcome is Outcome.STANDING
        assert found.settled
        expected = math.atan(1e-3 / (0.15 * (1 - math.cos(math.pi / 3)))) if leans else 0.0
        assert found.nutation[-1] == pytest.approx(expected, abs=1e-8)


def test_it_rolls_over_a_high_point_with_a_loss() -> None:
    """A rim that is released leaning wobbles to rest; an ideal one goes on."""
    ideal, uneven = (
        simulate(solid, pulse(7.0), model=General(static_friction=0.8))
        for solid in (DRUM, replace(DRUM, high_points=THREE, rise=3e-4))
    )
    assert not ideal.settled
    assert uneven.settled
    assert uneven.impacts > 10


def test_draws_stand_and_are_repeated() -> None:
    drums = uneven_rims(DRUM, 200, seed=4)
    for drum in drums:
        assert 3 <= len(drum.high_points) <= 5
        assert 1e-4 <= drum.rise <= 1e-3
        assert (drum.diameter, drum.cg_height) == (DRUM.diameter, DRUM.cg_height)
    counts = np.bincount([len(drum.high_points) for drum in drums])[3:]
    assert counts.min() > 45  # of 200 in three parts: 67 each, with a deviation of 6.7
    middle = np.median([math.log10(drum.rise) for drum in drums])
    assert middle == pytest.approx(-3.5, abs=0.1)  # its own deviation is 0.036
    assert [drum.rise for drum in uneven_rims(DRUM, 2, seed=4)] == [d.rise for d in drums[:2]]
    assert uneven_rims(DRUM, 1, seed=5)[0].rise != drums[0].rise


def test_a_solid_on_high_points_comes_back_from_its_numbers() -> None:
    drum = replace(DRUM, high_points=THREE, rise=1e-3)
    again = from_json(json.loads(json.dumps(to_json(drum))))
    assert again.high_points == drum.high_points
    assert "3 points 0.001 m high" in repr(again)
    assert not drum.round
    assert DRUM.round


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"high_points": THREE}, "both their azimuths and their rise"),
        ({"rise": 1e-3}, "both their azimuths and their rise"),
        ({"high_points": THREE[:2], "rise": 1e-3}, "3 to 8 high points, got 2"),
        ({"high_points": (0.0, 1.0, 2.0), "rise": 1e-3}, "less than half the rim"),
        ({"high_points": (0.0, 0.0, 2.0, 4.0), "rise": 1e-3}, "0.01 rad apart"),
        ({"high_points": (0.0, 2.0, math.nan), "rise": 1e-3}, "azimuth of Solid.high_points"),
        ({"high_points": THREE, "rise": 0.6}, "below cg_height"),
        ({"high_points": THREE, "rise": -1e-3}, "Solid.rise"),
        ({"high_points": THREE, "rise": 1e-3, "inner_ring": 0.3}, "has neither"),
        ({"high_points": THREE, "rise": 1e-3, "contour_friction": 1e-3}, "has neither"),
    ],
)
def test_rims_that_cannot_be(given: dict[str, object], told: str) -> None:
    with pytest.raises(InputError, match=told):
        Solid.cylinder(0.3, 0.9, **given)  # type: ignore[arg-type]


def test_boxes_have_no_rim() -> None:
    with pytest.raises(InputError, match="rim of a circular base"):
        replace(Solid.box(0.3, 0.3, 0.9), high_points=THREE, rise=1e-3)
    with pytest.raises(InputError, match="plain circular base"):
        uneven_rims(Solid.box(0.3, 0.3, 0.9), 1, seed=0)


@pytest.mark.parametrize(
    ("given", "told"),
    [({"rise": (1e-3, 1e-4)}, "heights"), ({"rise": (0.0, 1e-3)}, "heights"),
     ({"points": (2, 4)}, "numbers in order"), ({"points": (5, 4)}, "numbers in order")],
)  # fmt: skip
def test_bounds_that_cannot_be(given: dict[str, tuple[float, float]], told: str) -> None:
    with pytest.raises(InputError, match=told):
        uneven_rims(DRUM, 1, seed=0, **given)  # type: ignore[arg-type]
