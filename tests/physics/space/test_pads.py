"""Solids on glued feet: when these let go, and what follows."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import (
    General,
    InputError,
    Motion,
    Outcome,
    Pad,
    Solid,
    Surroundings,
    simulate,
    simulate_many,
)
from shaketable.units import STANDARD_GRAVITY as G

MASS = 100.0
STEP, RAMP = 0.001, 0.3 * G  # s, m/s³: 3e-4 g more at each sample
ROUGH = General(static_friction=100.0)
BOX = Solid.box(0.32, 0.9, 1.8, mass=MASS)


def pads(weights: float) -> Surroundings:
    """Each bears so many times the weight."""
    return Surroundings(pad=Pad(pull_off=weights * MASS * G))


def onset(solid: Solid, around: Surroundings | None, azimuth: float, model: General) -> float:
    """The acceleration toward an azimuth, growing steadily, at which a solid moves [g]."""
    a = RAMP * STEP * np.arange(2500)
    motion = Motion(a * math.cos(azimuth), STEP, transverse=a * math.sin(azimuth))
    run = simulate(solid, motion, model=model, surroundings=around)
    moves = np.linalg.norm(np.diff(run.position, axis=0), axis=1) > 0.0
    moves |= np.linalg.norm(np.diff(run.quaternions, axis=0), axis=1) > 0.0
    return float(a[np.argmax(moves)] / G)


@pytest.mark.parametrize("share", [0.0, 0.025, 0.1])
@pytest.mark.parametrize("azimuth", [0.0, 1.0, math.pi])
def test_when_it_begins_to_rock(share: float, azimuth: float) -> None:
    """Four feet of s W each pull at their middle: a cos ψ h = (g + 4 s g) b, of the nearer side.

    The least component that rocks it is along x; the ramp has steps of 3e-4 g.
    """
    expected = (0.32 / 1.8) * (1.0 + 4.0 * share) / abs(math.cos(azimuth))
    found = onset(BOX, pads(share) if share else None, azimuth, ROUGH)
    assert found == pytest.approx(expected, abs=4e-4)


def test_a_circle_has_four() -> None:
    drum = Solid.cylinder(0.32, 1.8, mass=MASS)
    assert onset(drum, pads(0.05), 0.7, ROUGH) == pytest.approx(0.32 / 1.8 * 1.2, abs=4e-4)


def test_glue_pulls_in_the_middle_of_the_feet() -> None:
    """The centre of gravity is 0.10 m from one side and 0.22 m from the other.

    a h = g b + 4 s g B/2: toward −x about the nearer side, toward +x about the other.
    """
    corners = [(-0.10, -0.45), (0.22, -0.45), (0.22, 0.45), (-0.10, 0.45)]
    solid = Solid.polygon(corners, 1.8, mass=MASS)
    assert solid.cg_height == pytest.approx(0.9)
    for azimuth, arm in ((0.0, 0.10), (math.pi, 0.22)):  # the body falls against the motion
        expected = (arm + 0.4 * 0.16) / 0.9
        assert onset(solid, pads(0.1), azimuth, ROUGH) == pytest.approx(expected, abs=4e-4)


def test_glue_adds_to_friction() -> None:
    """μ (1 + 4 s) where that is below what rocks it."""
    found = onset(BOX, pads(0.1), 0.4, General(static_friction=0.1))
    assert found == pytest.approx(0.14, abs=4e-4)


def test_what_stays_glued_does_not_move() -> None:
    """Not by a bit, and it is at rest once the motion has ended; mirror images are alike."""
    t = np.arange(800) * 0.005
    motion = Motion(4.0 * np.sin(9 * t), 0.005, transverse=3.0 * np.cos(7 * t), name="strong")
    held = simulate(BOX, motion, model=ROUGH, surroundings=pads(1.0))
    assert held.outcome is Outcome.STANDING
    assert held.settled
    assert held.peak_rotation == 0.0
    assert (held.position == held.position[0]).all()
    free = simulate(BOX, motion, model=ROUGH)
    assert free.peak_rotation > 0.1
    both = simulate_many([BOX], [motion], model=ROUGH, surroundings=pads(0.02), progress=False)
    one = simulate(BOX, motion, model=ROUGH, surroundings=pads(0.02))
    # the first of both polarities is that run, to the bit
    assert float(both.peak_rotation[0, 0, 0, 0, 0, 0]) == one.peak_rotation
    mirrored = simulate(BOX, motion.reversed(), model=ROUGH, surroundings=pads(0.02))
    assert mirrored.peak_rotation == pytest.approx(one.peak_rotation, rel=1e-9)


def test_newtons_need_a_mass() -> None:
    still = Motion(np.zeros(3), 0.01)
    with pytest.raises(InputError, match="a pull-off force in N needs a mass"):
        simulate(Solid.box(0.3, 0.3, 1.0), still, surroundings=Surroundings(pad=Pad(pull_off=5.0)))
