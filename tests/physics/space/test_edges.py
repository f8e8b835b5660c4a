"""Solids at the edge of their support, and at a lip there.

Numbers of sections of a page are of planar bodies, which a deep box is, and come from a body on an
edge by DOP853, then free, and from closed forms.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from shaketable import (
    Body,
    Edge,
    General,
    InputError,
    Motion,
    Solid,
    Strap,
    Support,
    Surroundings,
    Wall,
    simulate,
    simulate_many,
)
from shaketable.physics.space.landing import (
    LANDING_SPEED,
    LANDING_TIME,
    LANDING_TURN,
    LANDING_X,
    LEFT_AT,
    OFF,
)
from shaketable.physics.space.run import OVERTURNED
from tests.support.solids import Run, energy, quiet, released

G = 9.80665
BOX = Solid.box(0.30, 0.40, 0.25)
SLIPPERY = General(static_friction=0.2)
FIVE = [(0.16, 0.0), (0.08, 0.15), (-0.1, 0.12), (-0.15, -0.05), (0.05, -0.15)]
DEEP = 5.0  # m across: what does not turn out of its plane


def push(size: float = 0.6, along: float = 0.0) -> Motion:
    """A half sine of a size [g] that throws things toward an azimuth [rad]."""
    t = 1e-3 * np.arange(1500)
    pulse = -np.where(t <= 0.4, size * G * np.sin(math.pi * t / 0.4), 0.0)
    return Motion(pulse * math.cos(along), 1e-3, transverse=pulse * math.sin(along))


def slides(
    width: float, height: float, speed: float, edge: Edge, friction: float = 0.0, x: float = 0.0
) -> Run:
    """A box that begins flat with a speed toward +x."""
    return released(
        Solid.box(width, DEEP, height), General(static_friction=friction), quiet(4.0, 2e-3),
        position=(x, 0.0, height / 2), rotation=Rotation.identity(), velocity=(speed, 0.0, 0.0),
        surroundings=Surroundings(edge=edge),
    )  # fmt: skip


# B, H, speed, drop; when the contact ends, x, θ and t as it lands, from the centre of gravity's
# passage of the edge
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
    told = slides(width, height, speed, Edge(at=at, friction=0.0, drop=drop)).edge
    assert told[OFF] == 1.0
    assert told[LEFT_AT] - at / speed == pytest.approx(ends, abs=1e-6)
    assert told[LANDING_X] - at == pytest.approx(x, abs=1e-6)
    assert told[LANDING_TURN] == pytest.approx(theta, abs=1e-6)
    assert told[LANDING_TIME] - at / speed == pytest.approx(lands, abs=1e-6)
    # with no friction nothing is lost but where corner and edge part
    assert 0.5 * told[LANDING_SPEED] ** 2 < 0.5 * speed**2 + G * (height / 2 + drop)


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
    """2e-5 of a speed on either side of the printed one decides."""
    width, height, lip, smooth, hinged = case
    speed = hinged if rough else smooth
    edge = Edge(at=width / 2 + 0.01, lip=lip, friction=100.0 if rough else 0.0)
    below = slides(width, height, speed * (1 - 2e-5), edge)
    above = slides(width, height, speed * (1 + 2e-5), edge)
    assert np.degrees(below.rotation.magnitude()).max() < 89.0
    assert below.edge[OFF] == 0.0
    assert above.found.ending == OVERTURNED  # type: ignore[attr-defined]


@pytest.mark.parametrize(("friction", "spin"), [(0.0, 0.827949), (0.3, 0.826018), (0.6, 0.824096)])
def test_the_rate_after_a_lip_was_struck(friction: float, spin: float) -> None:
    """ω⁺ = v (h - h_l)/(I_P + μ h_l b) of a bookcase at 1 m/s."""
    edge = Edge(at=0.16, lip=0.05, friction=0.0)
    run = released(
        Solid.box(0.32, DEEP, 1.8), General(static_friction=friction), quiet(2e-9, 1e-9),
        position=(0.0, 0.0, 0.9), rotation=Rotation.identity(), velocity=(1.0, 0.0, 0.0),
        surroundings=Surroundings(edge=edge),
    )  # fmt: skip
    assert run.spin[1, 1] == pytest.approx(spin, abs=1e-6)


@pytest.mark.parametrize(("past", "falls"), [(-1e-3, False), (1e-3, True)])
@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_a_body_stands_while_its_centre_of_gravity_is_over_the_support(
    past: float, falls: bool, turn: float
) -> None:
    """Placed at rest with its foot 1 mm inside, or outside, of a bare edge, also askew."""
    run = released(
        Solid.box(0.32, 0.5, 0.6), General(static_friction=0.5), quiet(4.0),
        position=(0.4 + past, 0.0, 0.3), rotation=Rotation.from_rotvec((0.0, 0.0, turn)),
        surroundings=Surroundings(edge=Edge(at=0.4, friction=0.5)),
    )  # fmt: skip
    assert (run.edge[OFF] == 1.0) == falls


def random_pulse(rng: np.random.Generator) -> NDArray[np.float64]:
    """Six sines of 0.6 to 4 Hz within five seconds, at 5 ms [m/s²]."""
    t = 5e-3 * np.arange(1200)
    sines = sum(
        rng.normal() * np.sin(2 * np.pi * rng.uniform(0.6, 4.0) * t + rng.uniform(0.0, 6.3))
        for _ in range(6)
    )
    window = np.sin(np.pi * np.minimum(t / 5.0, 1.0)) ** 2
    return np.asarray(sines * window * rng.uniform(0.15, 0.5) * G / math.sqrt(3.0))


def planar_case(seed: int, lip: bool) -> tuple[Body, Solid, Edge, General, Motion]:
    """A body near an edge, and the deep box that is like it."""
    rng = np.random.default_rng(seed)
    base, height = rng.uniform(0.12, 0.5), rng.uniform(0.15, 1.8)
    share = rng.uniform(0.35, 0.65)
    side = (0.0, math.pi)[seed % 2]
    reach = (1.0 - share) * base if side == 0.0 else share * base
    edge = Edge(
        at=reach + rng.choice([1e-6, 0.01, 0.03, 0.08]), azimuth=side,
        friction=rng.uniform(0.1, 0.6), drop=rng.uniform(0.3, 1.0),
        lip=rng.uniform(0.003, 0.05) if lip else 0.0,
    )  # fmt: skip
    model = General(
        static_friction=rng.uniform(0.15, 0.9), normal_restitution=(0.0, 0.1)[seed % 3 > 1]
    )
    return (
        Body.rectangle(base, height, eccentricity=share),
        Solid.box(base, DEEP, height, eccentricity=(share, 0.5)), edge, model,
        Motion(random_pulse(rng), 5e-3),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(16))
def test_a_deep_box_at_an_edge_is_a_planar_body(seed: int) -> None:
    """Outcomes equal, peaks to 1 % and landings to 5 ms and 5 mm, by another solver."""
    body, solid, edge, model, motion = planar_case(seed, lip=False)
    around = Surroundings(edge=edge)
    plane = simulate(body, motion, model=model, surroundings=around)
    space = simulate(solid, motion, model=model, surroundings=around)
    assert space.outcome == plane.outcome
    assert space.off_edge == plane.off_edge
    assert space.peak_rotation == pytest.approx(plane.peak_rotation, rel=0.01, abs=1e-3)
    if plane.off_edge:
        assert space.landing_time == pytest.approx(plane.landing_time, abs=5e-3)
        assert space.landing_x == pytest.approx(plane.landing_x, abs=5e-3)
        assert space.landing_y == pytest.approx(0.0, abs=1e-6)


def test_deep_boxes_at_a_lip_fall_as_planar_bodies_do() -> None:
    """Of 24 random ones one may differ: what bangs on a lip 100 times is chaotic."""
    differ, falls = [], 0
    for seed in range(24):
        body, solid, edge, model, motion = planar_case(seed, lip=True)
        around = Surroundings(edge=edge)
        plane = simulate(body, motion, model=model, surroundings=around)
        space = simulate(solid, motion, model=model, surroundings=around)
        falls += plane.outcome != 0
        if (space.outcome, space.off_edge) != (plane.outcome, plane.off_edge):
            differ.append(seed)
    assert len(differ) <= 1
    assert 4 <= falls <= 20


@pytest.mark.parametrize("turn", [0.0, 0.3, 1.1, 2.9])
def test_what_is_flush_with_the_edge_stands_on_all_of_its_base(turn: float) -> None:
    """Its front is on the line but for round-off, to either side: nothing differs (to 1e-9)."""
    push_back = push(0.35, along=turn + math.pi)
    model = General(static_friction=0.2)
    around = Surroundings(edge=Edge(at=0.15, azimuth=turn))
    flush = simulate(BOX, push_back, model=model, orientation=turn, surroundings=around)
    alone = simulate(BOX, push_back, model=model, orientation=turn)
    assert flush.displacement_x == pytest.approx(alone.displacement_x, abs=1e-9)
    assert flush.peak_rotation == pytest.approx(alone.peak_rotation, abs=1e-9)
    assert abs(alone.displacement_x) + abs(alone.displacement_y) > 0.01


def test_where_it_leaves_and_where_it_lands() -> None:
    """As the planar body, in both doors; it falls to the side of the edge."""
    around = Surroundings(edge=Edge(at=0.25, drop=0.9))
    run = simulate(BOX, push(), model=SLIPPERY, surroundings=around)
    assert run.off_edge
    assert run.outcome == 1
    assert run.fall_azimuth == 0.0
    assert run.overturning_time == run.landing_time > run.left_support_at > 0.4
    assert run.time[-1] == run.landing_time
    assert run.position[-1, 0] == pytest.approx(run.landing_x, abs=1e-12)
    assert run.landing_speed == pytest.approx(float(np.linalg.norm(run.velocity[-1])), abs=1e-12)
    assert "EDGE" in {each.name for each in run.contact}
    plane = simulate(Body.rectangle(0.30, 0.25), push(), model=SLIPPERY, surroundings=around)
    assert run.landing_time == pytest.approx(plane.landing_time, abs=1e-6)
    assert run.landing_x == pytest.approx(plane.landing_x, abs=1e-6)
    many = simulate_many([BOX], [push()], polarities=[1], model=SLIPPERY, surroundings=around,
                         progress=False)  # fmt: skip
    assert float(many.landing_x.item()) == run.landing_x
    assert bool(many.off_edge.item())


@pytest.mark.parametrize(
    "solid",
    [
        BOX,
        Solid.cylinder(0.3, 0.3),
        Solid.polygon(FIVE, 0.3),
        Solid.on_feet([(0.15, 0.12), (-0.15, 0.12), (-0.15, -0.12), (0.15, -0.12)], 0.3,
                      inertia=np.diag([0.01, 0.012, 0.015])),
    ],
    ids=["box", "cylinder", "polygon", "feet"],
)  # fmt: skip
@pytest.mark.parametrize("lip", [0.0, 0.01])
def test_an_edge_in_any_direction(solid: Solid, lip: float) -> None:
    """Edge, push and body turned together by 50°: the same, turned; mirrored, the mirror image."""
    turn = math.radians(50.0)
    edge = Edge(at=0.18, lip=lip, drop=0.8)
    straight = simulate(solid, push(0.7), model=SLIPPERY, surroundings=Surroundings(edge=edge))
    turned = simulate(
        solid, push(0.7, along=turn), model=SLIPPERY, orientation=turn,
        surroundings=Surroundings(edge=Edge(at=0.18, lip=lip, drop=0.8, azimuth=turn)),
    )  # fmt: skip
    assert turned.off_edge == straight.off_edge
    assert straight.off_edge == (lip == 0.0)
    assert turned.peak_rotation == pytest.approx(straight.peak_rotation, rel=1e-4, abs=1e-7)
    if straight.off_edge:
        assert turned.landing_time == pytest.approx(straight.landing_time, abs=1e-5)
        x, y = straight.landing_x, straight.landing_y
        there = (x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn))
        assert (turned.landing_x, turned.landing_y) == pytest.approx(there, abs=1e-4)


def test_an_edge_out_of_reach_changes_no_bit() -> None:
    run = simulate(BOX, push(), model=SLIPPERY)
    far = simulate(BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=5.0)))
    assert np.array_equal(run.position, far.position)
    assert not far.off_edge
    assert math.isnan(far.landing_x)
    away = simulate(
        BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.16, azimuth=math.pi))
    )
    assert not away.off_edge


@pytest.mark.parametrize("seed", range(12))
def test_energy_never_rises_at_an_edge(seed: int) -> None:
    """Of boxes and cylinders thrown at a bare edge or a lip on a resting support; to 1e-8."""
    rng = np.random.default_rng(100 + seed)
    solid = Solid.cylinder(0.3, 0.4) if seed % 3 == 0 else Solid.box(0.3, 0.4, 0.5)
    edge = Edge(at=0.3, lip=(0.0, 0.02)[seed % 2], friction=rng.uniform(0.0, 0.6), drop=0.5)
    yaw = Rotation.from_rotvec((0.0, 0.0, rng.uniform(-3.0, 3.0)))
    run = released(
        solid, General(static_friction=rng.uniform(0.1, 0.5), normal_restitution=0.2), quiet(1.5),
        position=(0.0, 0.0, solid.cg_height), rotation=yaw,
        velocity=(rng.uniform(0.8, 2.0), rng.uniform(-0.5, 0.5), 0.0),
        spin=(0.0, 0.0, rng.uniform(-3.0, 3.0)), surroundings=Surroundings(edge=edge),
    )  # fmt: skip
    total = energy(solid, run)
    assert np.diff(total).max() <= 1e-8 * total[0]


@pytest.mark.parametrize("up", [1.5, 2.0, 4.0])
def test_what_jumps_over_the_edge_has_left_its_support(up: float) -> None:
    """Thrown up and away, it may never touch the edge that it passes."""
    t = 1e-3 * np.arange(1500)
    pulse = np.where(t <= 0.3, G * np.sin(math.pi * t / 0.3), 0.0)
    motion = Motion(pulse, 1e-3, vertical=-up * pulse)
    around = Surroundings(edge=Edge(at=0.35, azimuth=math.pi))
    run = simulate(Solid.box(0.3, DEEP, 0.3), motion, model=General(static_friction=0.5),
                   surroundings=around)  # fmt: skip
    assert run.off_edge
    assert run.landing_x < -0.35


def test_what_slides_on_for_ever_comes_to_the_edge_and_to_the_wall() -> None:
    """On a tilt that friction does not hold it slides on after the motion, whatever lies ahead."""
    t = 1e-2 * np.arange(60)
    shake = Motion(0.5 * np.sin(10 * t), 1e-2)
    steep, slippery = Support(tilt=math.radians(6)), General(static_friction=0.05)
    box = Solid.box(0.3, DEEP, 0.3)
    for at in (0.30, 0.60):
        around = Surroundings(edge=Edge(at=at, azimuth=math.pi, friction=0.05))
        assert simulate(box, shake, steep, model=slippery, surroundings=around).off_edge, at
    rough = Surroundings(edge=Edge(at=0.30, azimuth=math.pi, friction=0.3))
    held = simulate(box, shake, steep, model=slippery, surroundings=rough)
    assert held.settled  # the edge takes more of its weight the farther it hangs over, and stops it
    assert -0.30 < held.displacement_x < -0.15
    stop = Surroundings(walls=(Wall(azimuth=math.pi, gap=1.0, vertical=False),))
    run = simulate(box, shake, steep, model=slippery, surroundings=stop)
    assert run.settled
    assert run.displacement_x == pytest.approx(-1.0, abs=1e-6)
    away = Surroundings(walls=(Wall(gap=3.0, vertical=False),))
    assert not simulate(box, shake, steep, model=slippery, surroundings=away).settled


def test_what_hangs_past_the_edge_in_its_straps_has_left_its_support() -> None:
    body = Solid.box(0.3, DEEP, 0.6, mass=10.0)
    shake = np.zeros(1500)
    shake[:100] = -6.0
    straps = tuple(
        Strap(point=(-0.15, 0.0, z), anchor=(-0.2, 0.0, z), stiffness=1e4, slack=0.6, damping=200.0)
        for z in (0.0, 0.6)
    )
    around = Surroundings(edge=Edge(at=0.2, drop=5.0), straps=straps)
    run = simulate(body, Motion(shake, 0.01), model=General(static_friction=0.2),
                   surroundings=around)  # fmt: skip
    assert run.position[-1, 2] < 0.0  # its centre of gravity hangs below the support
    assert run.off_edge
    assert run.outcome == 1
    assert not run.held_up
    assert 0.0 < run.left_support_at < 3.0
    assert math.isnan(run.landing_time)


def test_what_tips_over_the_edge_does_not_jump() -> None:
    """`max_lift` is of what is in the air over its support, not of a corner that is past it."""
    wave = np.zeros(300)
    wave[:50] = -4.5 * np.sin(2 * math.pi * 0.01 * np.arange(50) / 0.5)
    body, model = Solid.box(0.2, DEEP, 0.6), General(static_friction=1.0)
    for at in (0.1, 0.1001, 0.3):
        run = simulate(body, Motion(wave, 0.01), model=model,
                       surroundings=Surroundings(edge=Edge(at=at)))  # fmt: skip
        assert run.max_lift < 1e-9, at


def test_a_post_that_tips_toward_the_edge_falls_over_it() -> None:
    post = Solid.box(0.12, 0.12, 0.6)
    around = Surroundings(edge=Edge(at=0.08, drop=1.0))
    run = simulate(post, push(0.5), model=General(static_friction=0.3), surroundings=around)
    assert run.outcome == 1


def test_a_lip_holds_what_would_slide_off() -> None:
    """In lists, too, it is simulated: the box that leaves a bare edge stays behind 5 mm."""
    bare = simulate(BOX, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.25)))
    lip = Surroundings(edge=Edge(at=0.25, lip=0.005))
    held = simulate(BOX, push(), model=SLIPPERY, surroundings=lip)
    assert bare.off_edge
    assert not held.off_edge
    assert held.outcome == 0
    assert 0.08 < held.displacement_x <= 0.1  # its front is 0.10 m from the lip


def test_what_cannot_be_near_an_edge_is_told() -> None:
    with pytest.raises(InputError, match=r"its base reaches 0\.25 m"):
        simulate(
            BOX, push(), orientation=math.atan2(0.4, 0.3), model=SLIPPERY,
            surroundings=Surroundings(edge=Edge(at=0.2)),
        )  # fmt: skip
    around = np.linspace(0.0, 2.0 * math.pi, 18)[:-1]
    many = Solid.polygon(0.2 * np.column_stack([np.cos(around), np.sin(around)]), 0.3)
    with pytest.raises(InputError, match="near an edge has at most 16 corners, got 17"):
        simulate(many, push(), model=SLIPPERY, surroundings=Surroundings(edge=Edge(at=0.3)))
