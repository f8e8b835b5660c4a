"""What a worker answers in three dimensions."""

from __future__ import annotations

import math

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.spatial.transform import Rotation, Slerp

from shaketable import (
    General,
    InputError,
    Solid,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
    suite,
)
from shaketable.tilting import TURNS
from shaketable.units import STANDARD_GRAVITY
from shaketable.web import shaking, space
from shaketable.web.questions import (
    Beside,
    ManyInSpace,
    Pulse,
    Recording,
    ShakeInSpace,
    Uploaded,
    Upright,
)

CASE = Upright(depth_m=0.32, width_m=0.9, height_m=1.8, friction=0.5)
FLASK = Upright(shape="cylinder", base_m=0.23, height_m=1.6, friction=0.5)
ONE, ACROSS = Recording(name="NORTHR/MUL009"), Recording(name="NORTHR/MUL279")


def test_the_film_is_what_simulate_finds() -> None:
    """Its pictures are interpolated between samples and rounded to a millionth."""
    thing = CASE.model_copy(update={"facing_deg": 30.0, "tilt_deg": 2.0})
    found = space.shake(ShakeInSpace(thing=thing, shaking=ONE, scale=0.8, reverse=True))
    pair = next(each for each in suite("fema-p695", pairs=True) if each.name == ONE.name)
    again = simulate(
        Solid.box(0.32, 0.9, 1.8),
        pair.scaled(0.8).reversed(),
        Support(tilt=math.radians(2.0)),
        model=General(static_friction=0.5),
        orientation=math.radians(30.0),
    )
    at = np.arange(len(found.frames.quaternion)) / 60.0
    turned = Slerp(again.time, again.rotation)(at)
    apart = (turned * Rotation.from_quat(found.frames.quaternion).inv()).magnitude()
    assert apart.max() < 1e-5
    position = np.column_stack([np.interp(at, again.time, each) for each in again.position.T])
    np.testing.assert_allclose(found.frames.position_m, position, atol=1e-6)
    assert found.peak_deg == pytest.approx(math.degrees(again.peak_rotation))
    assert found.components == 2
    assert len(found.frames.ground_m) == at.size


def test_what_stands_beside_it_turns_with_it() -> None:
    """At its back, which is toward its own x."""
    beside = Beside(wall_gap_mm=20, strap_slack_mm=10)
    thing = CASE.model_copy(update={"facing_deg": 90.0, "beside": beside})
    found = space.shake(ShakeInSpace(thing=thing, shaking=ONE))
    pair = next(each for each in suite("fema-p695", pairs=True) if each.name == ONE.name)
    around = Surroundings(
        walls=(Wall(gap=0.02, restitution=0.3),),
        straps=(
            Strap(
                point=(0.16, 0, 1.8), anchor=(0.18, 0, 1.8), stiffness=5e4, slack=0.01,
                damping=100.0,
            ),
        ),
    )  # fmt: skip
    again = simulate(
        Solid.box(0.32, 0.9, 1.8, mass=100.0), pair, model=General(static_friction=0.5),
        orientation=math.pi / 2, surroundings=around.turned(math.pi / 2),
    )  # fmt: skip
    # impacts magnify in what order sines and cosines of the turn are multiplied
    assert found.peak_deg == pytest.approx(math.degrees(again.peak_rotation), rel=1e-4)
    assert found.strap_peak == pytest.approx(
        again.strap_force[0] / (100.0 * STANDARD_GRAVITY), rel=1e-3
    )
    assert len(found.frames.strap) == len(found.frames.quaternion)


def test_off_the_edge_and_held_by_the_lip() -> None:
    """A pulse leaves what is slippery behind, at its front: over the edge."""
    pulse = Pulse(period_s=1.0, peak_g=0.8)
    jar = Upright(depth_m=0.3, width_m=0.35, height_m=0.25, friction=0.2)
    ends = {}
    for lip in (0.0, 30.0):
        thing = jar.model_copy(update={"beside": Beside(edge_mm=20, lip_mm=lip)})
        ends[lip] = space.shake(ShakeInSpace(thing=thing, shaking=pulse))
    assert ends[0.0].off_edge
    assert ends[0.0].outcome == "front"
    assert ends[0.0].frames.position_m[-1][2] < 0.0  # the film goes on until it lands
    assert not ends[30.0].off_edge
    assert ends[30.0].outcome == "standing"


def test_many_shakings_beside_a_wall() -> None:
    """As the study of walls finds: of 64 falls of a bookcase alone 8 remain at 10 mm."""
    wall = CASE.model_copy(update={"beside": Beside(wall_gap_mm=10)})
    falls = {
        each.beside is not None: space.many(ManyInSpace(thing=each, curve=False))
        for each in (CASE, wall)
    }
    alone, walled = falls[False], falls[True]
    assert alone.simulations == 96 * TURNS
    assert 2 * walled.simulations == alone.simulations  # in half of the ways
    assert walled.falls < 0.3 * alone.falls
    assert walled.sides["back"] < 0.1 * walled.falls  # they fall away from the wall
    assert falls[True].strap_90 is None


def test_losses_arrive_in_millimetres() -> None:
    thing = FLASK.model_copy(update={"rolling_friction_mm": 2.0, "contour_friction_mm": 0.5})
    solid = space._solid(thing)
    assert (solid.rolling_friction, solid.contour_friction) == (2e-3, 5e-4)
    box = space._solid(CASE.model_copy(update={"rolling_friction_mm": 2.0}))
    assert box.rolling_friction == 2e-3
    with pytest.raises(InputError, match="the rim of a cylinder"):
        space._solid(CASE.model_copy(update={"contour_friction_mm": 0.5}))


def test_the_other_component_turns_the_room() -> None:
    """A cylinder does the same under both orders of a pair, a quarter of a turn apart."""
    one = space.shake(ShakeInSpace(thing=FLASK, shaking=ONE))
    other = space.shake(ShakeInSpace(thing=FLASK, shaking=ACROSS))
    assert one.fall_azimuth_deg is not None
    assert other.fall_azimuth_deg is not None
    assert (one.fall_azimuth_deg - other.fall_azimuth_deg) % 360.0 == pytest.approx(90.0, abs=1e-3)
    # rounding of the turned components grows in a rocking body, some ten times in each impact
    assert one.time_s == pytest.approx(other.time_s, abs=1e-5)
    assert other.ground.name == ACROSS.name
    expected = shaking.ground_of(shaking.motion_of(ACROSS)).acceleration_g
    np.testing.assert_allclose(other.ground.acceleration_g, expected, atol=1.1e-6)  # as rounded


def test_one_component_alone_is_said() -> None:
    found = space.shake(ShakeInSpace(thing=CASE, shaking=Pulse(period_s=1.0, peak_g=0.3)))
    assert found.components == 1
    assert not np.any(np.array(found.frames.ground_m)[:, 1])
    unknown = space.shake(ShakeInSpace(thing=CASE, shaking=Recording(name="MANJIL/ABBAR--L")))
    assert unknown.components == 1


@pytest.mark.parametrize(
    ("azimuth", "side"),
    [(0.1, "back"), (1.5, "left"), (math.pi, "front"), (-math.pi, "front"), (-1.0, "right")],
)
def test_sides_of_the_room(azimuth: float, side: str) -> None:
    assert space._side(azimuth) == side


def test_a_deep_case_falls_over_its_shorter_side() -> None:
    found = space.many(ManyInSpace(thing=CASE, curve=False))
    assert found.simulations == 96 * TURNS
    assert found.recordings == 48
    assert sum(found.sides.values()) == found.falls > 20
    assert found.sides["front"] + found.sides["back"] > 0.95 * found.falls
    assert found.sides["front"] == found.sides["back"]  # each motion as recorded and reversed
    assert found.curve == []


def test_what_is_turned_falls_to_other_sides_of_the_room() -> None:
    """By a quarter, counterclockwise: from its front to the right, from its back to the left."""
    asked = {"suite": "fema-p695-near-field-pulse", "curve": False}
    turned = CASE.model_copy(update={"facing_deg": 90.0})
    one, other = (space.many(ManyInSpace(thing=each, **asked)).sides for each in (CASE, turned))
    sides = ("front", "right", "back", "left")  # each a quarter from the one before
    assert [other[side] for side in sides] == [one[side] for side in (sides[-1], *sides[:-1])]
    assert other["left"] > other["front"]


def test_round_things_fall_more_often_than_square_ones() -> None:
    """What rolls on its rim loses nothing at impacts (explanation/solids.md: 1.41 times)."""
    square = Upright(depth_m=0.23, width_m=0.23, height_m=1.6, friction=0.5)
    asked = {"suite": "fema-p695-far-field", "scale": 0.5, "curve": False}
    shares = [space.many(ManyInSpace(thing=each, **asked)).share for each in (square, FLASK)]
    assert shares[0] < shares[1]


def test_the_worst_shaking_overturns_at_the_most_strengths() -> None:
    found = space.many(ManyInSpace(thing=CASE, suite="fema-p695-near-field-pulse"))
    assert [point.share for point in found.curve] == sorted(point.share for point in found.curve)
    weakest = next(point.scale for point in found.curve if point.share > 0.0)
    asked = ShakeInSpace(
        thing=CASE,
        shaking=Recording(name=found.worst.name),
        reverse=found.worst.reverse,
        scale=weakest,
    )
    assert space.shake(asked).outcome != "standing"


@pytest.mark.parametrize("samples", [24, 47, 78, 93])
def test_a_film_ends_with_its_motion(samples: int) -> None:
    """At steps of a sixtieth the last picture would lie an ulp beyond the end."""
    uploaded = Uploaded(time_step_s=1 / 60, acceleration=[0.01] * samples)
    found = space.shake(ShakeInSpace(thing=CASE, shaking=uploaded))
    assert len(found.frames.quaternion) >= samples - 1


def test_what_falls_by_itself_is_told_in_words() -> None:
    steep = CASE.model_copy(update={"tilt_deg": 12.0})
    with pytest.raises(InputError, match=r"without any earthquake; it stands below 10\.1°"):
        space.shake(ShakeInSpace(thing=steep, shaking=ONE))


@pytest.mark.parametrize(
    ("sizes", "says"),
    [
        ({"shape": "cylinder", "base_m": 0.3, "depth_m": 0.3}, "a cylinder has base_m"),
        ({"shape": "cylinder"}, "a cylinder has base_m, its diameter,"),
        ({"depth_m": 0.3}, "a box has depth_m and width_m"),
        ({"base_m": 0.3}, "a box has depth_m and width_m"),
    ],
)
def test_each_shape_has_its_sizes(sizes: dict[str, object], says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        Upright.model_validate({**sizes, "height_m": 1.0})
