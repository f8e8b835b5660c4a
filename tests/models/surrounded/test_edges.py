"""Edges and lips of the support against closed forms and an independent integration."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    Body,
    Edge,
    General,
    InputError,
    Motion,
    Pad,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
    simulate_many,
)
from tests.support.surrounded import End, Moved, move

G = 9.80665
QUIET = np.zeros(2000)
OVERTURNED = 1


def slides(width: float, height: float, speed: float, edge: Edge, friction: float = 0.0) -> Moved:
    """A body that begins flat with a speed toward +x."""
    body = Body.rectangle(width, height)
    around = Surroundings(edge=edge)
    model = General(static_friction=friction)
    return move(body, QUIET, 2e-3, model, around, state=(0.0, height / 2, 0.0, speed, 0.0, 0.0))


# B, H, speed, drop; when the contact ends, x, θ and t as it lands, from the centre of gravity's
# passage of the edge (DOP853 of a body on an edge, then free)
OFF_A_TABLE = [
    (0.30, 0.20, 0.2, 0.75, 0.346163, 0.260717, 2.029730, 0.620338),
    (0.30, 0.20, 1.0, 0.75, 0.171874, 0.459669, 1.309227, 0.448632),
    (0.20, 0.40, 0.3, 0.75, 0.387698, 0.392311, 1.916783, 0.673986),
    (0.20, 0.40, 1.0, 1.20, 0.122414, 0.596446, 1.207197, 0.586469),
]


@pytest.mark.parametrize("case", OFF_A_TABLE)
def test_how_a_body_slides_off_a_table(case: tuple[float, ...]) -> None:
    """To the digits that are known of it."""
    width, height, speed, drop, ends, x, theta, lands = case
    at = width / 2 + 0.05
    end = slides(width, height, speed, Edge(at=at, friction=0.0, drop=drop)).end
    assert end.off_edge
    assert end.direction == 1.0
    assert end.left_at - at / speed == pytest.approx(ends, abs=1e-6)
    assert end.landing_x - at == pytest.approx(x, abs=1e-6)
    assert end.landing_rotation == pytest.approx(theta, abs=1e-6)
    assert end.landing_time - at / speed == pytest.approx(lands, abs=1e-6)
    # with no friction nothing is lost but where corner and edge part
    fell = 0.5 * end.landing_speed**2
    assert fell < 0.5 * speed**2 + G * (height / 2 + drop)


# B, H, height of the lip; the speed at which a body trips over a smooth lip, and over a rough one,
# from v (h - h_l)/I_P = ω⁺ and the energy that is needed then
LIPS = [
    (0.32, 1.8, 0.020, 0.62087, 0.62777),
    (0.32, 1.8, 0.050, 0.62712, 0.64500),
    (0.45, 1.2, 0.050, 1.13852, 1.18559),
    (0.30, 0.6, 0.030, 1.12522, 1.17890),
]


@pytest.mark.parametrize("case", LIPS)
@pytest.mark.parametrize("rough", [False, True])
def test_who_trips_over_a_lip(case: tuple[float, ...], rough: bool) -> None:
    """1e-5 of a speed on either side of the printed one decides."""
    width, height, lip, smooth, hinged = case
    speed = hinged if rough else smooth
    edge = Edge(at=width / 2 + 0.01, lip=lip, friction=100.0 if rough else 0.0)
    below = slides(width, height, speed * (1 - 2e-5), edge).end
    above = slides(width, height, speed * (1 + 2e-5), edge).end
    assert below.ending != OVERTURNED
    assert above.ending == OVERTURNED
    assert above.direction == 1.0


@pytest.mark.parametrize(("friction", "spin"), [(0.0, 0.827949), (0.3, 0.826018), (0.6, 0.824096)])
def test_the_rate_after_a_lip_was_struck(friction: float, spin: float) -> None:
    """ω⁺ = v (h - h_l)/(I_P + μ h_l b) of a bookcase at 1 m/s."""
    body = Body.rectangle(0.32, 1.8)
    around = Surroundings(edge=Edge(at=0.16, lip=0.05, friction=0.0))
    found = move(
        body, np.zeros(5), 1e-9, General(static_friction=friction), around,
        state=(0.0, 0.9, 0.0, 1.0, 0.0, 0.0), samples=5,
    )  # fmt: skip
    assert found.state[3, 5] == pytest.approx(spin, abs=1e-6)


@pytest.mark.parametrize(("past", "falls"), [(-1e-3, False), (1e-3, True)])
def test_a_body_stands_while_its_centre_of_gravity_is_over_the_support(
    past: float, falls: bool
) -> None:
    """Placed at rest with its foot 1 mm inside, or outside, of a bare edge."""
    body = Body.rectangle(0.32, 1.8)
    around = Surroundings(edge=Edge(at=0.2, friction=0.5))
    state = (0.2 + past, 0.9, 0.0, 0.0, 0.0, 0.0)
    end = move(body, QUIET, 2e-3, General(static_friction=0.5), around, state=state).end
    assert end.off_edge == falls
    assert (end.ending == OVERTURNED) == falls


def test_an_edge_and_its_mirror_image() -> None:
    body = Body.rectangle(0.25, 0.30)
    wave = -8.0 * np.sin(5.0 * 0.01 * np.arange(400))
    ends: list[End] = []
    for side in (1.0, -1.0):
        around = Surroundings(edge=Edge(at=0.14, azimuth=0.0 if side > 0 else math.pi, lip=0.002))
        ends.append(move(body, side * wave, 0.01, General(static_friction=0.2), around).end)
    one, other = ends
    assert one.impacts >= 2
    assert other.impacts == one.impacts
    assert other.slip == pytest.approx(-one.slip, abs=1e-9)
    assert other.peak == pytest.approx(one.peak, abs=1e-9)


def test_a_fall_off_the_support_is_a_fall_to_that_side() -> None:
    t = 1e-3 * np.arange(1500)
    push = Motion(-np.where(t <= 0.4, 0.6 * G * np.sin(math.pi * t / 0.4), 0.0), 1e-3)
    body = Body.rectangle(0.3, 0.25)
    around = Surroundings(edge=Edge(at=0.2, drop=0.9))
    run = simulate(body, push, model=General(static_friction=0.2), surroundings=around)
    assert run.off_edge
    assert run.outcome == 1
    assert run.overturning_time == run.landing_time > run.left_support_at > 0.0
    assert run.landing_x > 0.2
    assert run.time[-1] == run.landing_time
    assert run.position[-1, 0] == run.landing_x
    assert 0.0 < run.landing_speed < 5.0
    assert run.peak_rotation <= math.pi / 2
    free = simulate(body, push, model=General(static_friction=0.2))
    assert free.outcome == 0
    assert math.isnan(free.landing_x)
    lip = Surroundings(edge=Edge(at=0.2, lip=0.05, drop=0.9))
    caught = simulate(body, push, model=General(static_friction=0.2), surroundings=lip)
    assert caught.outcome == 0
    assert not caught.off_edge


@pytest.mark.parametrize("up", [1.5, 2.0, 4.0])
def test_what_jumps_over_the_edge_has_left_its_support(up: float) -> None:
    """Thrown up and away, it may never touch the edge that it passes."""
    t = 1e-3 * np.arange(1500)
    pulse = np.where(t <= 0.3, G * np.sin(math.pi * t / 0.3), 0.0)
    push = Motion(pulse, 1e-3, vertical=-up * pulse)
    around = Surroundings(edge=Edge(at=0.35, azimuth=math.pi))
    box = Body.rectangle(0.3, 0.3)
    run = simulate(box, push, model=General(static_friction=0.5), surroundings=around)
    assert run.off_edge
    assert run.landing_x < -0.35
    many = simulate_many(
        [box], [push], polarities=[1], model=General(static_friction=0.5), surroundings=around,
        progress=False,
    )  # fmt: skip
    assert bool(many.off_edge.item())
    assert float(many.landing_x.item()) == run.landing_x


def test_what_slides_on_for_ever_comes_to_the_edge_and_to_the_wall() -> None:
    """On a tilt that friction does not hold it slides on after the motion, whatever lies ahead."""
    t = 1e-2 * np.arange(60)
    push = Motion(0.5 * np.sin(10 * t), 1e-2)
    steep, slippery = Support(tilt=math.radians(6)), General(static_friction=0.05)
    box = Body.rectangle(0.3, 0.3)
    for at in (0.30, 0.60, 5.0):
        around = Surroundings(edge=Edge(at=at, azimuth=math.pi, friction=0.05))
        run = simulate(box, push, steep, model=slippery, surroundings=around)
        assert run.off_edge, at
    rough = Surroundings(edge=Edge(at=0.30, azimuth=math.pi, friction=0.3))
    held = simulate(box, push, steep, model=slippery, surroundings=rough)
    assert held.settled  # the edge takes more of its weight the farther it hangs over, and stops it
    assert -0.30 < held.displacement_x < -0.15
    stop = Surroundings(walls=(Wall(azimuth=math.pi, gap=3.0, vertical=False),))
    run = simulate(box, push, steep, model=slippery, surroundings=stop)
    assert run.settled
    assert run.displacement_x == pytest.approx(-3.0, abs=1e-6)
    away = Surroundings(walls=(Wall(gap=3.0, vertical=False),))
    assert not simulate(box, push, steep, model=slippery, surroundings=away).settled


def test_what_hangs_past_the_edge_in_its_straps_has_left_its_support() -> None:
    body = Body.rectangle(0.3, 0.6, mass=10.0)
    push = np.zeros(1500)
    push[:100] = -6.0
    straps = tuple(
        Strap(point=(-0.15, z), anchor=(-0.2, z), stiffness=1e4, slack=0.6, damping=200.0)
        for z in (0.0, 0.6)
    )
    around = Surroundings(edge=Edge(at=0.2, drop=5.0), straps=straps)
    run = simulate(body, Motion(push, 0.01), model=General(static_friction=0.2),
                   surroundings=around)  # fmt: skip
    assert run.position[-1, 1] < 0.0  # its centre of gravity hangs below the support
    assert run.off_edge
    assert run.outcome == 1
    assert not run.held_up
    assert 0.0 < run.left_support_at < 3.0
    assert math.isnan(run.landing_time)


def test_what_tips_over_the_edge_does_not_jump() -> None:
    """`max_lift` is of what is in the air over its support, not of a corner that is past it."""
    wave = np.zeros(300)
    wave[:50] = -4.5 * np.sin(2 * math.pi * 0.01 * np.arange(50) / 0.5)
    body, model = Body.rectangle(0.2, 0.6), General(static_friction=1.0)
    for at in (0.1, 0.1001, 0.3):
        run = simulate(body, Motion(wave, 0.01), model=model,
                       surroundings=Surroundings(edge=Edge(at=at)))  # fmt: skip
        assert run.max_lift < 1e-9, at


def test_a_body_that_is_let_go_in_the_lip_is_told() -> None:
    body, lip = Body.rectangle(0.3, 0.6), Surroundings(edge=Edge(at=0.15, lip=0.3))
    with pytest.raises(InputError, match="stands in the lip"):
        simulate(body, Motion(QUIET, 0.01), model=General(), initial_rotation=0.2,
                 surroundings=lip)  # fmt: skip
    flat = Surroundings(edge=Edge(at=0.15, drop=0.5))
    falls = simulate(body, Motion(QUIET, 0.01), model=General(static_friction=0.6),
                     initial_rotation=0.6, surroundings=flat)  # fmt: skip
    assert falls.off_edge
    assert falls.left_support_at >= 0.0


def test_a_base_beyond_the_edge_is_told() -> None:
    around = Surroundings(edge=Edge(at=0.1))
    with pytest.raises(InputError, match=r"beyond the edge of the support at 0\.1 m"):
        simulate(
            Body.rectangle(0.3, 1.0), Motion(QUIET, 0.01), model=General(), surroundings=around
        )


def glued(size: float, body: Body, friction: float, strength: float) -> float:
    """Peak rotation and slip under a half sine of a size [g], its feet glued [g of its weight]."""
    t = 1e-3 * np.arange(1500)
    pulse = np.where(t <= 0.5, size * G * np.sin(math.pi * t / 0.5), 0.0)
    around = Surroundings(pad=Pad(pull_off=strength * G * body.mass)) if strength else None
    run = simulate(
        body, Motion(pulse, 1e-3), model=General(static_friction=friction), surroundings=around
    )
    return run.peak_rotation + run.peak_slip


def test_pads_delay_uplift_and_slide() -> None:
    """a* = (g b + s B)/h, 0.21333 g of a bookcase with s = 0.1 g; and μ (g + 2 s) of a slide."""
    shelf = Body.rectangle(0.32, 1.8, mass=80.0)
    assert glued(0.2133, shelf, 5.0, 0.1) == 0.0
    assert glued(0.2134, shelf, 5.0, 0.1) > 0.0
    assert glued(0.2134, shelf, 5.0, 0.2) == 0.0
    flat = Body.rectangle(1.0, 0.3, mass=80.0)
    assert glued(0.527, flat, 0.44, 0.1) == 0.0
    assert glued(0.529, flat, 0.44, 0.1) > 0.0


def test_what_was_pulled_off_is_free() -> None:
    """It does not glue again: once off it does what it does without, from where it is."""
    shelf = Body.rectangle(0.32, 1.8, mass=80.0)
    free, held = glued(0.5, shelf, 0.6, 0.0), glued(0.5, shelf, 0.6, 0.05)
    assert 0.0 < held < free
    with pytest.raises(InputError, match="newtons need a mass"):
        simulate(
            Body.rectangle(0.3, 1.0), Motion(QUIET, 0.01), model=General(),
            surroundings=Surroundings(pad=Pad(pull_off=5.0)),
        )  # fmt: skip
