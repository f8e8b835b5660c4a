"""The general model's planar bodies among walls, straps, an edge and on pads.

A body is first simulated as if it stood alone: what never comes near its surroundings has just
those results. What does is simulated again by `physics.surrounded`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.errors import InputError
from shaketable.models.engine_input import samples_shown
from shaketable.models.model import Held, ManyRuns, OneRun
from shaketable.models.one_sided import side_of
from shaketable.physics.plane.phases import Phase, on_tilt
from shaketable.surroundings import SEQUENTIAL, Surroundings

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking
    from shaketable.physics.surrounded.scene import Scenes

MARGIN = 1e-9  # m: of what counts as near
FLIGHT = 1.0  # m: and of a body that flew, with ten times its clearance
EVENTS = 64  # impacts and changes of phase for which memory is allocated at first


class Friction(NamedTuple):
    """The support's, and what its impacts leave."""

    static: float
    kinetic: float
    restitution: float
    factor: float


def require_surrounded(body: Body, around: Surroundings) -> None:
    """InputError if a planar body cannot stand in its surroundings."""
    name = body.name or repr(body)
    for k, wall in enumerate(around.walls, 1):
        side_of(wall.azimuth, "wall")
        if wall.restitution == SEQUENTIAL:
            raise InputError(
                f'{name}, wall {k}: restitution="{SEQUENTIAL}" belongs to one-sided rocking, '
                "Rocking(...); give a number from 0 to 1"
            )
    held = [f"strap {k}" for k in range(1, len(around.straps) + 1)] + ["pad"] * bool(around.pad)
    if held and body.mass is None:
        raise InputError(f"{name}, {held[0]}: newtons need a mass; give Body(mass=...) [kg]")
    for k, strap in enumerate(around.straps, 1):
        if len(strap.point) != 2:
            raise InputError(
                f"{name}, strap {k}: in the plane its point and its anchor are (x, z), got "
                f"{strap.point}"
            )
        x, z = strap.point
        slack = MARGIN * body.base
        inside = -body.left - slack <= x <= body.right + slack
        if not (inside and 0.0 <= z <= body.whole_height * (1.0 + MARGIN)):
            raise InputError(
                f"{name}, strap {k}: its point {strap.point} [m] lies outside the body, whose "
                "frame begins at the foot of its centre of gravity and which is "
                f"{body.whole_height:g} m high"
            )
        length = math.dist(strap.point, strap.anchor)
        if not length > strap.stretch_at_start:
            raise InputError(
                f"{name}, strap {k}: from its point to its anchor are {length:g} m at the start, "
                f"which must be more than its stretch of {strap.stretch_at_start:g} m"
            )
    if around.edge:
        reach = body.right if side_of(around.edge.azimuth, "edge") > 0.0 else body.left
        if not around.edge.at >= reach * (1.0 - MARGIN):
            raise InputError(
                f"{name}: its base reaches {reach:g} m from the foot of the centre of gravity, "
                f"beyond the edge of the support at {around.edge.at:g} m"
            )


def scenes_of(
    bodies: Sequence[Body],
    tilts: NDArray[np.float64],
    surroundings: Sequence[Surroundings | None],
    friction: Friction,
) -> Scenes:
    """What surrounds bodies on their supports, for the engine; one entry of each argument each."""
    from shaketable.engine.body_tables import cone_shares
    from shaketable.physics.surrounded.scene import no_scenes

    scenes = no_scenes(len(bodies))
    for name, values in {
        "h": [body.cg_height for body in bodies],
        "right": [body.right for body in bodies],
        "left": [body.left for body in bodies],
        "over": [body.whole_height - body.cg_height for body in bodies],
        "i2": [body.gyration_radius**2 for body in bodies],
        "factor": [
            friction.factor if body.restitution_factor is None else body.restitution_factor
            for body in bodies
        ],
        "mass": [math.nan if body.mass is None else body.mass for body in bodies],
        "tilt_sine": np.sin(tilts),
        "tilt_cosine": np.cos(tilts),
        "restitution": friction.restitution,
    }.items():
        scenes[name] = values
    scenes["a_stick"], scenes["b_stick"] = cone_shares(friction.static)
    scenes["a_slip"], scenes["b_slip"] = cone_shares(friction.kinetic)
    for scene, body, around in zip(scenes, bodies, surroundings, strict=True):
        if around:
            _surround(scene, body, around)
    return scenes


def _surround(scene: Any, body: Body, around: Surroundings) -> None:
    """Write what surrounds one body."""
    from shaketable.engine.body_tables import cone_shares

    scene["walls"], scene["straps"] = len(around.walls), len(around.straps)
    height = body.whole_height
    corners = [(x, z) for x in (body.right, -body.left) for z in (0.0, height)]
    for k, wall in enumerate(around.walls):
        side = side_of(wall.azimuth, "wall")
        n_x, n_y = -side, 0.0
        if wall.vertical:
            n_x, n_y = -side * scene["tilt_cosine"], side * scene["tilt_sine"]
        offset = min(n_x * x + n_y * z for x, z in corners) - wall.gap
        bounce = 0.0 if wall.restitution is None else float(wall.restitution)
        scene["wall"][k] = (n_x, n_y, offset, *cone_shares(wall.friction), bounce)
    mass = scene["mass"]
    for k, strap in enumerate(around.straps):
        x, z = strap.point
        scene["strap"][k, :8] = (
            x, z - body.cg_height, *strap.anchor, strap.stiffness / mass, strap.damping / mass,
            strap.excess, strap.strength / mass,
        )  # fmt: skip
    if around.edge:
        edge = around.edge
        side = side_of(edge.azimuth, "edge")
        scene["edge"], scene["edge_at"] = side, max(edge.at, body.right if side > 0 else body.left)
        scene["lip"], scene["drop"], scene["edge_e"] = edge.lip, edge.drop, edge.restitution
        scene["edge_a"], scene["edge_b"] = cone_shares(edge.friction)
    if around.pad:
        scene["glue"] = around.pad.pull_off / mass


def comes_near(scenes: Scenes, runs: ManyRuns) -> NDArray[np.bool_]:
    """Whether free bodies came so far that they may have met what surrounds them.

    No point of a body that keeps a corner on its support goes farther than that corner, and the
    diagonal times the chord of its rotation. What flew may have gone farther than it shows: some
    more is taken for that, which is no bound. What slides on for ever comes near anything.
    """
    from shaketable.physics.surrounded.scene import OFFSET, SLACK, WALL_X, WALL_Y

    slip = np.maximum(-runs.farthest_left, runs.farthest_right)
    width, height = scenes["left"] + scenes["right"], scenes["h"] + scenes["over"]
    reach = slip + 2.0 * np.hypot(width, height) * np.sin(0.5 * np.abs(runs.peak))
    reach = reach + MARGIN + np.where(runs.lift > 0.0, FLIGHT + 10.0 * runs.lift, 0.0)
    reach = np.where(runs.ending == int(Ending.STILL_SLIDING), math.inf, reach)
    near = scenes["glue"] > 0.0
    walls, straps = scenes["wall"].shape[1], scenes["strap"].shape[1]
    for k in range(walls):
        wall = scenes["wall"][:, k]
        at = [
            wall[:, WALL_X] * x + wall[:, WALL_Y] * z
            for x in (scenes["right"], -scenes["left"])
            for z in (np.zeros(len(height)), height)
        ]
        gap = np.min(at, axis=0) - wall[:, OFFSET]
        near = near | ((k < scenes["walls"]) & (gap <= reach))
    for k in range(straps):
        near = near | ((k < scenes["straps"]) & (scenes["strap"][:, k, SLACK] <= reach))
    base = np.where(scenes["edge"] > 0.0, scenes["right"], scenes["left"])
    near = near | ((scenes["edge"] != 0.0) & (scenes["edge_at"] - base <= reach))
    found: NDArray[np.bool_] = near
    return found


def run_surrounded(
    scenes: Scenes, polarity: NDArray[np.float64], shaking: Shaking, runs: ManyRuns
) -> ManyRuns:
    """The runs of free bodies, with those that met what surrounds them simulated again."""
    from shaketable.physics.surrounded.run import (
        SurroundedSummary,
        SurroundedTrace,
        move_surrounded,
    )
    from shaketable.physics.surrounded.scene import STATE, make_workspace

    found = nothing_found(scenes)
    columns = {name: found[:, k] for k, name in enumerate(SurroundedSummary._fields)}
    near = np.flatnonzero(comes_near(scenes, runs))
    if near.size:
        trace = SurroundedTrace(
            np.empty((0, STATE)), np.empty(0), np.empty(0), np.empty(0, np.int8), np.empty(0)
        )
        some = np.zeros((near.size, found.shape[1]))
        move_surrounded(
            scenes[near], make_workspace(), shaking, polarity[near], 0.0, False, trace, some
        )
        met = some[:, SurroundedSummary._fields.index("used")] > 0.0
        found[near[met]] = some[met]
        for name in ManyRuns._fields:
            if name != "held":
                getattr(runs, name)[near[met]] = columns[name][near[met]]
    return runs._replace(held=held_of(scenes, found))


def require_clear(scene: Any, rotation: float) -> None:
    """InputError if a body that is let go at a rotation [rad] stands in a wall."""
    pivot = scene["right"] if rotation > 0.0 else -scene["left"]
    cosine, sine = math.cos(rotation), math.sin(rotation)
    corners = np.array(
        [
            (pivot + (x - pivot) * cosine + z * sine, z * cosine - (x - pivot) * sine)
            for x in (scene["right"], -scene["left"])
            for z in (0.0, scene["h"] + scene["over"])
        ]
    )
    for k in range(int(scene["walls"])):
        wall = scene["wall"][k]
        gap = float((corners @ wall[:2]).min() - wall[2])
        if gap < -MARGIN:
            raise InputError(
                f"initial_rotation [rad]: at {rotation!r} the body stands {-gap:.3g} m in wall "
                f"{k + 1}"
            )


def _require_clear_of_lip(scene: Any, rotation: float) -> None:
    """InputError if the lip of the edge is inside of a body that is let go at a rotation [rad]."""
    pivot = scene["right"] if rotation > 0.0 else -scene["left"]
    x, z = scene["edge"] * scene["edge_at"] - pivot, scene["lip"]
    xi = pivot + x * math.cos(rotation) - z * math.sin(rotation)
    up = x * math.sin(rotation) + z * math.cos(rotation)
    inside = -scene["left"] + MARGIN < xi < scene["right"] - MARGIN
    if scene["edge"] and inside and MARGIN < up < scene["h"] + scene["over"] - MARGIN:
        raise InputError(f"initial_rotation [rad]: at {rotation!r} the body stands in the lip")


def nothing_found(scenes: Scenes) -> NDArray[np.float64]:
    """What runs find that never meet what surrounds them, (run, column)."""
    from shaketable.physics.surrounded.run import SUMMARY, SurroundedSummary

    found = np.full((len(scenes), SUMMARY + 2 * int(scenes["straps"].max())), np.nan)
    found[:, SUMMARY::2] = 0.0
    for name in ("leaning", "off_edge"):
        found[:, SurroundedSummary._fields.index(name)] = 0.0
    return found


def nothing_held(scenes: Scenes) -> Held:
    """What surroundings do that are never met."""
    return held_of(scenes, nothing_found(scenes))


def held_of(scenes: Scenes, found: NDArray[np.float64]) -> Held:
    """What surroundings did, by what runs have found, (run, column)."""
    from shaketable.physics.surrounded.run import SUMMARY, SurroundedSummary

    told = dict(zip(SurroundedSummary._fields, found.T, strict=False))
    each = found[:, SUMMARY:].reshape(len(found), -1, 2)
    return Held(
        leaning=told["leaning"] > 0.5,
        strap_force=np.where(np.isnan(scenes["mass"]), 0.0, scenes["mass"])[:, None] * each[..., 0],
        strap_broke_at=each[..., 1].copy(),
        off_edge=told["off_edge"] > 0.5,
        left_support_at=told["left_at"].copy(),
        landing_time=told["landing_time"].copy(),
        landing_x=told["landing_x"].copy(),
        landing_speed=told["landing_speed"].copy(),
        landing_rotation=told["landing_rotation"].copy(),
    )


def run_one_surrounded(
    scenes: Scenes, tilt: float, shaking: Shaking, parts: int, rotation: float
) -> OneRun | None:
    """One body among its surroundings with its history; None if it never met them.

    Raises:
        InputError: let go at a rotation [rad] at which it stands in a wall.
    """
    from shaketable.physics.surrounded.run import (
        FREE_STEP,
        SUMMARY,
        SurroundedSummary,
        SurroundedTrace,
        move_surrounded,
    )
    from shaketable.physics.surrounded.scene import (
        SPIN,
        STATE,
        TURN,
        V_X,
        V_Y,
        X,
        Y,
        make_workspace,
    )

    require_clear(scenes[0], rotation)
    _require_clear_of_lip(scenes[0], rotation)
    samples, changes, impacts = 2 * shaking.a_x.size, EVENTS, EVENTS
    found = np.zeros((1, SUMMARY + 2 * int(scenes["straps"][0])))
    while True:
        trace = SurroundedTrace(
            np.empty((samples, STATE)), np.empty(samples), np.empty(changes),
            np.empty(changes, np.int8), np.empty(impacts),
        )  # fmt: skip
        move_surrounded(
            scenes, make_workspace(), shaking, np.ones(1), rotation, False, trace, found
        )
        end = SurroundedSummary(*found[0, :SUMMARY].tolist())
        if end.samples <= samples and end.changes <= changes and end.impacts <= impacts:
            break
        samples, changes, impacts = int(end.samples), int(end.changes), int(end.impacts)
    if not end.used:
        return None
    shown = samples_shown(int(end.samples), parts, shaking)
    last = shaking.a_x.size - 1
    after = last * shaking.time_step + (shown - last) * max(shaking.time_step, FREE_STEP)
    state = trace.state[shown]
    return OneRun(
        ending=Ending(int(end.ending)),
        direction=int(end.direction),
        overturning_time=end.overturning_time,
        peak_rotation=end.peak,
        impact_times=trace.impact_times[: int(end.impacts)].copy(),
        time=np.where(shown <= last, shown * shaking.time_step, after),
        rotation=state[:, TURN].copy(),
        angular_velocity=state[:, SPIN].copy(),
        position=state[:, [X, Y]],
        velocity=state[:, [V_X, V_Y]],
        slip=trace.slip[shown],
        end_slip=end.slip,
        farthest_left=end.farthest_left,
        farthest_right=end.farthest_right,
        max_lift=end.lift,
        phase_times=trace.change_times[: int(end.changes)].copy(),
        phases=tuple(on_tilt(Phase(code), tilt) for code in trace.phases[: int(end.changes)]),
        held=held_of(scenes, found),
        fallbacks=int(end.fallbacks),
    )
