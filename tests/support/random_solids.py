"""Solids, walls, straps, frictions and pulses at random, wilder than any furniture."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from shaketable import General, InputError, Motion, Solid, Strap, Surroundings, Wall, uneven_rims
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.physics.space.drive import move_solid
from shaketable.physics.space.found import Found, make_found, make_trace, numbers_of
from shaketable.simulate.standing import standing_limit


class Shaken(NamedTuple):
    """What is shaken, what holds it, and its stand as the engine takes it: (1, 5)."""

    solid: Solid
    model: General
    motion: Motion
    stand: np.ndarray
    surroundings: Surroundings | None


def solid_of(rng: np.random.Generator, castors: bool) -> Solid:
    """A box, a cylinder, a prism or a body on feet, 0.1 to 3 m high, stocky to needle-like."""
    h = 10.0 ** rng.uniform(-1.0, 0.5)
    w = h * 10.0 ** rng.uniform(-1.2, 0.3)
    d = w * 10.0 ** rng.uniform(-0.7, 0.7)
    resists = {
        name: float(rng.choice([0.0, 0.0, 0.0, 1e-3]))
        for name in ("rolling_friction", "drilling_friction")
    }
    kind, low = rng.integers(5), h * rng.uniform(0.2, 0.8)
    if kind == 0:
        x, y = rng.uniform(0.2, 0.8, 2)
        return Solid.box(w, d, h, eccentricity=(x, y), cg_height=low, **resists)
    if kind == 1:
        return Solid.cylinder(w, h, cg_height=low, **resists)
    angles = np.sort(rng.uniform(0.0, 2.0 * math.pi, int(rng.integers(3, 12 if kind == 2 else 9))))
    around = np.column_stack([w * np.cos(angles), d * np.sin(angles)])
    if kind == 2:
        return Solid.polygon(around, h, **resists)
    inward = rng.uniform(0.3, 1.0, (angles.size, 1)) if kind == 4 else 1.0
    rolls = (rng.random(angles.size) < (0.4 if castors else 0.0)).tolist()
    resistance = float(rng.choice([0.0, 0.01, 0.05]))
    return Solid.on_feet(
        inward * around, h, castors=rolls, rolling_resistance=resistance, **resists
    )


def walls_at_random(rng: np.random.Generator, solid: Solid) -> tuple[Wall, ...]:
    """One to three of them, against the body or up to its height away, smooth to rough."""
    walls = []
    for _ in range(int(rng.integers(1, 4))):
        near = (solid.height or 1.0) * 10.0 ** float(rng.uniform(-4.0, 0.0))
        walls.append(
            Wall(
                azimuth=float(rng.uniform(-math.pi, math.pi)),
                gap=float(rng.choice([0.0, near])),
                vertical=bool(rng.integers(2)),
                friction=float(rng.choice([0.0, 0.1, 0.3, 0.7, 1.5])),
                restitution=float(rng.choice([0.0, 0.3, 0.6, 0.9])),
            )
        )
    return tuple(walls)


def straps_at_random(rng: np.random.Generator, solid: Solid) -> tuple[Strap, ...]:
    """One to four of them, soft to stiff as a rod, millimeters to meters long; some break."""
    mass = solid.mass or math.nan
    straps = []
    for _ in range(int(rng.integers(1, 5))):
        share = rng.dirichlet(np.ones(len(solid.corners)))
        x, y = (share @ solid.corners).tolist()
        z = 2.0 * solid.cg_height * float(rng.uniform(0.0, 0.95 if solid.height else 0.5))
        z = min(z, solid.height or z)
        away = rng.normal(size=3)
        away *= 10.0 ** rng.uniform(-3.0, 0.5) / np.linalg.norm(away)
        stiffness = mass * 10.0 ** rng.uniform(1.0, 6.0)
        weight = 9.81 * mass
        strap = Strap(
            point=(x, y, z),
            anchor=tuple((away + np.array([x, y, z])).tolist()),
            stiffness=stiffness,
            slack=float(rng.choice([0.0, 10.0 ** rng.uniform(-4.0, -1.0)])),
            damping=float(rng.choice([0.0, mass * 10.0 ** rng.uniform(-1.0, 3.0)])),
            strength=float(rng.choice([math.inf, weight * 10.0 ** rng.uniform(-2.0, 1.0)])),
        )
        if strap.slack == 0.0 and rng.random() < 0.3:
            most = min(0.05 * weight, strap.strength)
            strap = replace(strap, pretension=float(rng.uniform(0.0, 0.9)) * most)
        straps.append(strap)
    return tuple(straps)


def case(seed: int, castors: bool, straps: bool = False, walls: bool = False) -> Shaken | None:
    """The case of a number; None where its base does not hold its centre of gravity.

    Half of the cylinders stand on high points of their rims.
    """
    rng = np.random.default_rng(seed)
    try:
        solid = solid_of(rng, castors)
    except InputError:
        return None
    if solid.diameter is not None and seed % 2:
        rise = (max(1e-4 * solid.diameter, 1e-6), 1e-2 * solid.diameter)
        solid = uneven_rims(solid, 1, seed=seed, rise=rise)[0]
    static = float(rng.choice([0.0, 0.05, 0.2, 0.4, 0.7, 1.5, math.inf]))
    kinetic = static if static == math.inf else static * float(rng.choice([1.0, 0.5]))
    model = General(
        static_friction=static,
        kinetic_friction=kinetic,
        normal_restitution=float(rng.choice([0.0, 0.0, 0.2, 0.5, 0.9])),
    )
    n, step = int(rng.integers(5, 120)), float(rng.choice([0.005, 0.01, 0.02, 0.05]))
    t, size = np.arange(n) * step, 10.0 ** rng.uniform(-0.5, 1.5)

    def series() -> np.ndarray:
        wave = np.sin(2.0 * math.pi * rng.uniform(0.3, 8.0) * t + rng.uniform(0.0, 6.0))
        noise = rng.uniform(-1.0, 1.0, n) if rng.random() < 0.3 else 1.0
        return np.asarray(size * rng.uniform(-1.0, 1.0) * wave * noise)

    up = 0.7 * series() if rng.random() < 0.6 else None
    motion = Motion(series(), step, transverse=series(), vertical=up)
    azimuth, turn = rng.uniform(-math.pi, math.pi, 2).tolist()
    tilt = standing_limit(solid, azimuth - turn) * float(rng.choice([0.0, 0.0, 0.1, 0.5, 0.9]))
    stand = np.array([[tilt, azimuth, turn, 1.0, 1.0]])
    around = Surroundings()  # by generators of their own, so that all else is as without
    if straps:
        own = np.random.default_rng([seed, 1])
        solid = replace(solid, mass=10.0 ** float(own.uniform(0.0, 3.0)))
        around = Surroundings(straps=straps_at_random(own, solid))
    if walls:
        beside = walls_at_random(np.random.default_rng([seed, 2]), solid)
        around = replace(around, walls=beside)
    return Shaken(solid, model, motion, stand, around or None)


def run(shaken: Shaken) -> tuple[Found, float]:
    """What was found, and how long a core took for it [s]."""
    shapes, workspaces = shapes_of(shaken.solid, shaken.model, shaken.surroundings)
    found = make_found(1)
    nothing = make_trace(0)
    start = time.process_time()
    move_solid(shapes, workspaces, ground_of(shaken.motion), shaken.stand, False, nothing, found)
    return numbers_of(found), time.process_time() - start


def is_lost(found: Found) -> bool:
    """Whether a run has numbers that are none."""
    told = (found.peak, found.lift, found.yaw, found.displacement_x, found.displacement_y)
    return not all(map(math.isfinite, told))
