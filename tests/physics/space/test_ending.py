"""When what still moves after the motion is given up."""

from __future__ import annotations

import numpy as np
import pytest

from shaketable import General, Motion, Solid, SolidResponse, Strap, Surroundings, simulate

G = 9.80665
STEP = 0.01
DRUM = Solid.cylinder(0.5, 1.0, mass=70.0)
TALL = Solid.box(0.4, 0.5, 1.2, mass=70.0)


def pulse(size: float) -> Motion:
    """Half a second of a sine along x and a quarter of it along y [g]."""
    t = STEP * np.arange(51)
    push = size * G * np.sin(2.0 * np.pi * t / 0.5)
    return Motion(push, STEP, transverse=0.25 * push)


def after(run: SolidResponse) -> float:
    """How long it was followed after the motion [s]."""
    return float(run.time[-1] - 0.5)


def strap(solid: Solid) -> Surroundings:
    """From the top of its back, which never breaks."""
    x, height = 0.5 * (solid.diameter or 0.4), solid.height
    assert height is not None
    point, anchor = (x, 0.0, height), (x + 0.05, 0.0, height)
    return Surroundings(straps=(Strap(point=point, anchor=anchor, stiffness=1.4e5, slack=0.02),))


def test_what_hangs_in_a_strap_is_given_up() -> None:
    """It is tipped over, and its energy would do to fall: ten seconds after the motion."""
    thin = Solid.cylinder(0.3, 1.0, mass=70.0)
    run = simulate(thin, pulse(0.65), model=General(), surroundings=strap(thin))
    assert run.ending.name == "STILL_ROCKING"
    assert run.held_up
    assert after(run) == pytest.approx(10.0, abs=0.05)


@pytest.mark.parametrize("held", [False, True])
def test_what_wobbles_on_is_given_up(held: bool) -> None:
    """On its rim it loses nothing: ten seconds alone, as it may go far; three in a strap."""
    run = simulate(DRUM, pulse(0.55), model=General(), surroundings=strap(DRUM) if held else None)
    assert run.ending.name == "STILL_ROCKING"
    assert run.peak_rotation > 1e-3
    assert after(run) == pytest.approx(3.0 if held else 10.0, abs=0.05)


def test_what_comes_to_rest_in_a_strap_is_followed_until_it_does() -> None:
    """A box loses energy at each impact, and stands when it has lost all."""
    run = simulate(TALL, pulse(1.0), model=General(), surroundings=strap(TALL))
    assert run.ending.name == "STANDING"
    assert after(run) > 2.5
    assert run.velocity[-1] == pytest.approx([0.0, 0.0, 0.0])
