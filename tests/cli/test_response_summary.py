"""What a simulation among surroundings says in words."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from shaketable import Body, Edge, General, Motion, Solid, Strap, Surroundings, simulate
from shaketable.cli.response_summary import sentence_of, summary_of
from shaketable.response import Response

G = 9.80665
SLIPPERY = General(static_friction=0.2)
EDGE = Edge(at=0.25, drop=0.9)


def push(size: float = 0.6) -> Motion:
    """A half sine of a size [g] that throws things toward +x."""
    t = 1e-3 * np.arange(1500)
    return Motion(-np.where(t <= 0.4, size * G * np.sin(math.pi * t / 0.4), 0.0), 1e-3)


def planar(strap: Strap | None = None) -> Response:
    body = Body.rectangle(0.30, 0.25, mass=10.0)
    around = Surroundings(edge=EDGE, straps=(strap,) if strap else ())
    return simulate(body, push(), model=SLIPPERY, surroundings=around)


def solid(strap: Strap | None = None) -> Response:
    body = Solid.box(0.30, 0.40, 0.25, mass=10.0)
    around = Surroundings(edge=EDGE, straps=(strap,) if strap else ())
    return simulate(body, push(), model=SLIPPERY, surroundings=around)


def test_how_a_planar_body_fell_off() -> None:
    """When, where and how fast it came down are the response's, each with its unit."""
    run = planar()
    said = sentence_of(run)
    assert said.startswith(
        f"falls off its support right (+x): leaves it at {run.left_support_at:.3f} s and comes "
        f"down at {run.landing_time:.3f} s, {run.landing_x:.3g} m from where it stood, with "
        f"{run.landing_speed:.3g} m/s; it slides by up to "
    )
    told = summary_of(run)
    assert told["off_edge"] is True
    assert told["landing_x_m"] == run.landing_x
    assert told["landing_y_m"] is None
    assert told["overturning_time_s"] == told["landing_time_s"] > told["left_support_at_s"] > 0.4


def test_what_its_strap_bore_is_told_where_a_body_fell_off() -> None:
    """In the plane and in space: the strap breaks at its strength of 20 N, while they slide."""
    flat = planar(
        Strap(point=(-0.15, 0.1), anchor=(-0.5, 0.1), stiffness=5e4, slack=0.05, strength=20.0)
    )
    deep = solid(
        Strap(
            point=(-0.15, 0.0, 0.1),
            anchor=(-0.5, 0.0, 0.1),
            stiffness=5e4,
            slack=0.05,
            strength=20.0,
        )
    )
    for run in (flat, deep):
        assert run.off_edge
        assert sentence_of(run).startswith("falls off its support ")
        broke = run.strap_broke_at[0]
        assert 0.0 < broke < run.left_support_at
        assert sentence_of(run).endswith(f"; its strap breaks at {broke:.3f} s, under 20 N")
        assert summary_of(run)["strap_broke_at_s"] == [broke]


@pytest.mark.parametrize("strapped", [True, False])
def test_a_fall_that_never_landed(strapped: bool) -> None:
    """It hangs in its straps if it has any, and otherwise its fall is said to be unknown."""
    strap = Strap(point=(-0.15, 0.1), anchor=(-0.5, 0.1), stiffness=5e4, slack=0.05, strength=20.0)
    run = dataclasses.replace(planar(strap if strapped else None), landing_time=math.nan)
    said = sentence_of(run)
    assert " comes down " not in said
    assert ("and hangs in its straps" in said) is strapped
    assert ("; it was not followed to the floor" in said) is not strapped
    assert summary_of(run)["landing_time_s"] is None
