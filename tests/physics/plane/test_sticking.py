"""When the lanes may have a body of the general model (physics/plane/sticking.py)."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, General
from shaketable.physics.plane import contact, rocking, sticking
from shaketable.physics.plane.contact import force_of
from shaketable.physics.plane.forcing import Forcing, rest_of, seen_from
from tests.support.builders import G, contact_body

CASES = 800
POINTS = 60


def random_body(rng: np.random.Generator) -> contact.ContactBody:
    height = rng.uniform(0.2, 2.0)
    body = Body.rectangle(
        height * rng.uniform(0.1, 1.0), height, eccentricity=rng.uniform(0.3, 0.7)
    )
    tilt = float(rng.choice([0.0, 0.08]))
    model = General(static_friction=rng.choice([0.2, 0.5, 1.0, 3.0, math.inf]))
    return contact_body(body, model, tilt)


def random_forcing(rng: np.random.Generator) -> Forcing:
    a, change = rng.normal(size=2) * [5.0, 2.0]
    up, lift = rng.normal(size=2) * [3.0, 1.0]
    return Forcing(G + up, lift, a, change)


def true_margins(
    body: contact.ContactBody, side: float, height: float, rate: float, h: float, force: Forcing
) -> np.ndarray:
    """The smaller of a N ± b T by `contact.stick`, along the rocking model's own motion."""
    of_side = rocking.side_of(body.block, side)
    own = seen_from(force, side)
    margins = []
    for u in np.linspace(0.0, 1.0, POINTS):
        phase = of_side.phase - height
        part = Forcing(own.g_effective, u * own.g_effective_change, own.a_x, u * own.a_x_change)
        w = rocking.velocity_over(
            rate, math.sin(phase), math.cos(phase), of_side.k, max(u, 1e-9) * h, part
        )
        q = rocking.height_over(height, w)
        theta, omega = side * sum(q), side * sum(w) / (max(u, 1e-9) * h)
        f = force_of(body, rest_of(force, u))
        X, Y = contact.corner(body, side, theta)
        found = contact.stick(body, X, Y, omega, f)
        margins.append(body.a_stick * found.normal - body.b_stick * abs(found.along))
    return np.array(margins)


def test_margins_are_the_forces_and_sag_by_no_more_than_said() -> None:
    rng = np.random.default_rng(21)
    tight = 0.0
    for _ in range(CASES):
        body = random_body(rng)
        side, height = rng.choice([1.0, -1.0]), rng.uniform(0.05, 0.6)
        rate, force = rng.normal() * 2.0, random_forcing(rng)
        of_side = rocking.side_of(body.block, side)
        # as long as intervals are: √(k F) h <= 0.1 (taylor.MAX_PHASE), and no impact in it
        strength = math.hypot(
            force.g_effective + force.g_effective_change, force.a_x + force.a_x_change
        )
        h = min(rng.uniform(0.02, 0.1) / math.sqrt(of_side.k * max(strength, G)), 0.02 / abs(rate))
        margins = true_margins(body, side, height, rate, h, force)
        cone, own = sticking.make_cone(body, side), seen_from(force, side)
        phase = of_side.phase - height
        start = sticking.margin(
            cone, of_side.k, rate, math.sin(phase), math.cos(phase), own.g_effective, own.a_x
        )
        assert start == pytest.approx(margins[0], abs=1e-6)  # u = 1e-9 there
        bound = sticking.sag(cone.radius, of_side.k, rate, h, own)
        drop = min(margins[0], margins[-1]) - margins.min()
        assert drop <= bound + 1e-9
        tight = max(tight, drop / bound)
    assert tight > 0.02  # a bound that is never near says nothing


@pytest.mark.slow
def test_what_sticks_throughout_does_so_wherever_it_may_get() -> None:
    rng = np.random.default_rng(22)
    stuck, tight = 0, math.inf
    for _ in range(CASES // 2):
        body = random_body(rng)
        force = random_forcing(rng)
        height, rate = rng.uniform(0.0, 0.05), rng.normal() * 0.3
        h = 0.1 / math.sqrt(max(body.block.right.k, body.block.left.k) * 2.5 * G)
        state = rocking.State(1.0, height, rate, 0.0, 1.0)
        corners = sticking.make_corners(body)
        if not sticking.sticks_throughout(body.block, corners, state, h, force):
            continue
        stuck += 1
        for side in (1.0, -1.0):
            for q in (0.0, height):
                for speed in (rate, -rate, 0.0):
                    margins = true_margins(body, side, q, speed, h, force)
                    assert margins.min() > 0.0
                    tight = min(tight, margins.min())
        for u in (0.0, 1.0):  # and at rest
            f = force_of(body, rest_of(force, u))
            assert body.a_stick * -f.normal > body.b_stick * abs(f.along)
    assert stuck > 0.05 * CASES
    assert tight < 0.5  # m/s²: it is not only what is far from slipping that is let pass


@pytest.mark.parametrize(
    ("friction", "restitution", "plain"), [(1.0, 0.0, True), (0.05, 0.0, False), (1.0, 0.2, False)]
)
def test_plain_impacts(friction: float, restitution: float, plain: bool) -> None:
    model = General(static_friction=friction, normal_restitution=restitution)
    body = contact_body(Body.rectangle(0.3, 1.0, eccentricity=0.45), model)
    for side in (1.0, -1.0):
        keep = sticking.corner_of(sticking.make_corners(body), side).velocity_ratio
        assert keep == (
            pytest.approx(rocking.side_of(body.block, side).velocity_ratio, rel=1e-12)
            if plain
            else 0.0
        )


def test_what_rests_gives_way_to_the_weaker_of_friction_and_weight() -> None:
    body = Body.rectangle(0.4, 1.0)
    for friction, tilt in ((0.2, 0.05), (0.9, 0.05)):
        seen = contact_body(body, General(static_friction=friction), tilt)
        resting = sticking.resting_block(seen)
        hold = min(math.atan(friction), math.atan(0.4))
        yields = G * math.tan(hold - tilt)  # downhill, a_x > 0
        for factor, lifts in ((0.999, False), (1.001, True)):
            assert (rocking.tipping(resting.left, G, factor * yields) > 0.0) == lifts


def test_the_bound_of_a_fast_rotation_under_hardly_any_force_is_near() -> None:
    """Then the centripetal part alone sags, by r q'² w²/8 where its direction turns by w."""
    rng = np.random.default_rng(22)
    tight = 0.0
    for _ in range(400):
        body = random_body(rng)
        side, height = rng.choice([1.0, -1.0]), rng.uniform(0.05, 0.6)
        rate, h = rng.choice([-1.0, 1.0]) * rng.uniform(2.0, 4.0), 0.03
        force = Forcing(1e-4, 1e-4, 1e-4, -1e-4)
        margins = true_margins(body, side, height, rate, h, force)
        cone, own = sticking.make_cone(body, side), seen_from(force, side)
        of_side = rocking.side_of(body.block, side)
        bound = sticking.sag(cone.radius, of_side.k, rate, h, own)
        drop = min(margins[0], margins[-1]) - margins.min()
        assert drop <= bound + 1e-9
        tight = max(tight, drop / bound)
    assert tight > 0.5
