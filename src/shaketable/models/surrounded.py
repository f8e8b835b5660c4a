"""The general model's planar bodies among walls, straps, an edge and on pads: deep solids.

A body is first simulated as if it stood alone: what never comes near its surroundings has just
those results. What does is simulated in space, as a solid so deep that it moves in the plane of x
and z alone, and told of as a planar body (theory, section 12).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.errors import InputError
from shaketable.models.engine_input import samples_shown
from shaketable.models.held import columns_of, held_of, nothing_held
from shaketable.models.in_plane import phases_of, planar_states, slips_of
from shaketable.models.model import Held, ManyRuns, OneRun
from shaketable.models.one_sided import side_of
from shaketable.models.solid_input import ContactLaws, shapes_of
from shaketable.solid import Solid
from shaketable.surroundings import SEQUENTIAL, Pad, Strap, Surroundings, Wall
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking
    from shaketable.physics.space.run import GroundAcceleration, RunSummary, SolidTrace
    from shaketable.physics.space.workspace import Workspaces

MARGIN = 1e-9  # m: of what counts as near
FLIGHT = 1.0  # m: and of a body that flew, with ten times its clearance
DEPTH = 4.4  # of its diagonal: any will do
IMPACTS = 64  # for which memory is allocated at first
FREE_SAMPLES = 500  # likewise, for the time after the motion's end


class Scene(NamedTuple):
    """A planar body among its surroundings, if it has any.

    Attributes:
        body, tilt, surroundings: what stands, how its support is tilted [rad], and among what.
        laws: of its contacts with the support.
        clearance: what is nearest of its surroundings is no nearer than this as it stands [m].
    """

    body: Body
    tilt: float
    surroundings: Surroundings | None
    laws: ContactLaws
    clearance: float


class Place(NamedTuple):
    """Where a planar body is: its centre of gravity, and how it is turned."""

    x: float  # m
    z: float
    rotation: float  # rad


class Found(NamedTuple):
    """What runs of one scene have found, (run, ...).

    Attributes:
        summary: the numbers of a `physics.space.run.RunSummary`, (run, field).
        plane: those that `physics.space.in_plane` writes, (run, column).
        held: what the surroundings did.
    """

    summary: NDArray[np.float64]
    plane: NDArray[np.float64]
    held: Held


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
    laws: ContactLaws,
) -> NDArray[np.object_]:
    """A Scene of each body on its support, (body,)."""
    scenes = np.empty(len(bodies), np.object_)
    for k, (body, tilt, around) in enumerate(zip(bodies, tilts, surroundings, strict=True)):
        near = clearance(body, float(tilt), around) if around else math.inf
        scenes[k] = Scene(body, float(tilt), around, laws, near)
    return scenes


def placed(body: Body, points: NDArray[np.float64], place: Place) -> NDArray[np.float64]:
    """Where points of its frame are on its support, (n, 2) [m]."""
    sine, cosine = math.sin(place.rotation), math.cos(place.rotation)
    x, up = points[:, 0], points[:, 1] - body.cg_height
    return np.column_stack([place.x + x * cosine + up * sine, place.z + up * cosine - x * sine])


def corners_of(body: Body) -> NDArray[np.float64]:
    """Its four, in its frame; (4, 2) [m]."""
    height = body.whole_height
    return np.array([(x, z) for x in (body.right, -body.left) for z in (0.0, height)])


def gap_of(wall: Wall, scene: Scene, place: Place) -> float:
    """Distance of a body from a wall that is given as it stands upright [m]."""
    side, lean = side_of(wall.azimuth, "wall"), scene.tilt if wall.vertical else 0.0
    normal = np.array([-side * math.cos(lean), side * math.sin(lean)])
    corners = corners_of(scene.body)
    upright, now = (
        (placed(scene.body, corners, each) @ normal).min()
        for each in (upright_of(scene.body), place)
    )
    return float(wall.gap + now - upright)


def clearance(body: Body, tilt: float, around: Surroundings) -> float:
    """How far something of a body can move, upright at first, and meet nothing [m]."""
    if around.pad:
        return 0.0
    near = [wall.gap for wall in around.walls] + [strap.excess for strap in around.straps]
    if around.edge:
        side = side_of(around.edge.azimuth, "edge")
        near.append(around.edge.at - (body.right if side > 0.0 else body.left))
    return min(near, default=math.inf)


def comes_near(scenes: NDArray[np.object_], runs: ManyRuns) -> NDArray[np.bool_]:
    """Whether free bodies came so far that they may have met what surrounds them.

    No point of a body that keeps a corner on its support goes farther than that corner, and the
    diagonal times the chord of its rotation. What flew may have gone farther than it shows: some
    more is taken for that, which is no bound. What slides on for ever comes near anything.
    """
    clear = np.array([scene.clearance for scene in scenes])
    diagonal = np.array([math.hypot(s.body.base, s.body.whole_height) for s in scenes])
    slip = np.maximum(-runs.farthest_left, runs.farthest_right)
    reach = slip + 2.0 * diagonal * np.sin(0.5 * np.abs(runs.peak))
    reach = reach + MARGIN + np.where(runs.lift > 0.0, FLIGHT + 10.0 * runs.lift, 0.0)
    far = np.isinf(clear)
    reach = np.where((runs.ending == int(Ending.STILL_SLIDING)) & ~far, math.inf, reach)
    found: NDArray[np.bool_] = clear <= reach
    return found


def deep(body: Body) -> Solid:
    """A planar body as a solid that moves in its plane alone, its radius of gyration as it is."""
    depth, i2 = DEPTH * math.hypot(body.base, body.whole_height), body.gyration_radius**2
    across = depth**2 / 12.0 + i2
    right, left, half = body.right, body.left, depth / 2.0
    return Solid(
        np.array([(right, half), (-left, half), (-left, -half), (right, -half)]),
        body.cg_height,
        np.diag([across, i2, across]),
        height=body.whole_height,
        name=body.name,
        mass=body.mass,
    )


def around_deep(scene: Scene, place: Place) -> Surroundings:
    """The surroundings of a body as those of its deep solid, which begins at a place."""
    around = scene.surroundings or Surroundings()
    walls = tuple(replace(wall, gap=max(gap_of(wall, scene, place), 0.0)) for wall in around.walls)
    straps = tuple(_strap_in_space(strap) for strap in around.straps)
    # its four corners pull as two do; what is let go at a rotation stands on none
    glued = around.pad is not None and place.rotation == 0.0
    pad = Pad(pull_off=0.5 * around.pad.pull_off) if around.pad and glued else None
    return replace(around, walls=walls, straps=straps, pad=pad)


def require_clear(scene: Scene, rotation: float) -> None:
    """InputError if a body that is let go at a rotation [rad] stands in a wall, or in the lip."""
    place = let_go(scene.body, rotation)
    for k, wall in enumerate(scene.surroundings.walls if scene.surroundings else (), 1):
        gap = gap_of(wall, scene, place)
        if gap < -MARGIN:
            raise InputError(
                f"initial_rotation [rad]: at {rotation!r} the body stands {-gap:.3g} m in wall {k}"
            )
    _require_clear_of_lip(scene, rotation)


def _strap_in_space(strap: Strap) -> Strap:
    (x, z), (anchor_x, anchor_z) = strap.point, strap.anchor
    return replace(strap, point=(x, 0.0, z), anchor=(anchor_x, 0.0, anchor_z))


def _require_clear_of_lip(scene: Scene, rotation: float) -> None:
    """InputError if the lip of the edge is inside of a body that is let go at a rotation [rad]."""
    body, edge = scene.body, scene.surroundings.edge if scene.surroundings else None
    if edge is None:
        return
    pivot = body.right if rotation > 0.0 else -body.left
    x, z = side_of(edge.azimuth, "edge") * edge.at - pivot, edge.lip
    xi = pivot + x * math.cos(rotation) - z * math.sin(rotation)
    up = x * math.sin(rotation) + z * math.cos(rotation)
    inside = -body.left + MARGIN < xi < body.right - MARGIN
    if inside and MARGIN < up < body.whole_height - MARGIN:
        raise InputError(f"initial_rotation [rad]: at {rotation!r} the body stands in the lip")


def ground_of(shaking: Shaking) -> GroundAcceleration:
    """A planar motion in space."""
    from shaketable.physics.space.run import GroundAcceleration

    acceleration = np.zeros((shaking.a_x.size, 3))
    acceleration[:, 0] = shaking.a_x
    acceleration[:, 2] = shaking.g_effective - STANDARD_GRAVITY
    return GroundAcceleration(acceleration, float(shaking.time_step))


def upright_of(body: Body) -> Place:
    """Where a body stands at rest."""
    return Place(0.0, body.cg_height, 0.0)


def let_go(body: Body, rotation: float) -> Place:
    """Where it is at a rotation [rad], on the corner that it then stands on, where that stood."""
    pivot = body.right if rotation > 0.0 else -body.left
    sine, cosine = math.sin(rotation), math.cos(rotation)
    return Place(
        pivot - (pivot * cosine - body.cg_height * sine),
        body.cg_height * cosine + pivot * sine,
        rotation,
    )


def state_of(place: Place, rates: Sequence[float] = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """The state of its deep solid, (STATE,), its velocities along x and z and its spin given."""
    half, (v_x, v_z, spin) = 0.5 * place.rotation, rates
    turned = [math.cos(half), 0.0, math.sin(half), 0.0]
    return np.array([place.x, 0.0, place.z, *turned, v_x, 0.0, v_z, 0.0, spin, 0.0])


def move(
    scene: Scene,
    ground: GroundAcceleration,
    polarity: NDArray[np.float64],
    trace: SolidTrace,
    place: Place | None = None,
    rates: Sequence[float] = (0.0, 0.0, 0.0),
) -> Found:
    """Simulate the deep solid of a scene, once for each polarity; the last one is traced.

    Args:
        scene: what is simulated.
        ground: the motion.
        polarity: of each run, (run,).
        trace: for its history.
        place, rates: where it begins, and how fast it is there; None at rest on its base.
    """
    from shaketable.physics.space.drive import move_solid
    from shaketable.physics.space.in_plane import IN_PLANE
    from shaketable.physics.space.run import SUMMARY

    body, begins = scene.body, place or upright_of(scene.body)
    around = around_deep(scene, begins)
    reach = max(body.left, body.right)
    shapes, workspaces = shapes_of(deep(body), scene.laws, around, planar_reach=reach)
    if body.restitution_factor is not None:
        shapes["factor"] = body.restitution_factor
    if place is not None:
        workspaces["state"][0] = state_of(place, rates)
        _measure_upright(scene, place, workspaces)
    found = np.zeros((polarity.size, columns_of(around) + IN_PLANE))
    stands = np.zeros((polarity.size, 5))
    # toward azimuth 0 below zero, so that its sines are exact: downhill is -x on a positive tilt
    stands[:, 0], stands[:, 3], stands[:, 4] = -scene.tilt, 1.0, polarity
    move_solid(shapes, workspaces, ground, stands, place is not None, trace, found)
    held = held_of(found, around, body.mass)._replace(landing_y=None)
    return Found(found[:, :SUMMARY], found[:, columns_of(around) :], held)


def _measure_upright(scene: Scene, place: Place, workspaces: Workspaces) -> None:
    """Let the straps of what begins elsewhere be as long as where it stands upright."""
    for k, strap in enumerate(scene.surroundings.straps if scene.surroundings else ()):
        now = placed(scene.body, np.array([strap.point]), place)[0]
        longer = math.dist(strap.point, strap.anchor) - math.dist(now, strap.anchor)
        workspaces["straps"][0, k]["slack"] += longer


def ending_of(summary: RunSummary, samples: int) -> Ending:
    """How a run ended; what is given up before its motion ends is not resolved."""
    ending = Ending(int(summary.ending))
    given_up = ending is Ending.STILL_ROCKING and summary.samples < samples
    return Ending.UNRESOLVED if given_up else ending


def run_surrounded(
    scenes: NDArray[np.object_], polarity: NDArray[np.float64], shaking: Shaking, runs: ManyRuns
) -> ManyRuns:
    """The runs of free bodies, with those that met what surrounds them simulated again."""
    from shaketable.physics.space.run import RunSummary, make_trace

    held = nothing_held([scene.surroundings for scene in scenes])
    ground, nothing = ground_of(shaking), make_trace(0)
    for k in np.flatnonzero(comes_near(scenes, runs)).tolist():
        found = move(scenes[k], ground, polarity[k : k + 1], nothing)
        if not has_met(found):
            continue
        told = told_of(RunSummary(*found.summary[0].tolist()), found, shaking.a_x.size)
        for name, value in told.items():
            getattr(runs, name)[k] = value
        put_held(held, k, found.held)
    return runs._replace(held=held)


def has_met(found: Found) -> bool:
    """Whether a run met anything but its support."""
    from shaketable.physics.space.in_plane import MET

    gone = found.held.off_edge is not None and bool(found.held.off_edge[0])
    return gone or found.plane[0, MET] > 0.0 or bool((found.held.strap_force[0] > 0.0).any())


def put_held(held: Held, k: int, one: Held) -> None:
    """Write what the surroundings of one run did among those of many, whose straps may be more."""
    for name, value in one._asdict().items():
        if value is not None:
            whole = getattr(held, name)
            if whole.ndim > 1:
                whole[k, : value.shape[1]] = value[0]
            else:
                whole[k] = value[0]


def told_of(summary: RunSummary, found: Found, samples: int) -> dict[str, float]:
    """What is told of one run, by the names of ManyRuns."""
    from shaketable.physics.space.in_plane import BACK, FRONT, SLIP

    fell = not math.isnan(summary.fall_azimuth)
    toward = math.copysign(1.0, math.cos(summary.fall_azimuth)) if fell else 0.0
    plane = found.plane[0]
    return {
        "ending": float(ending_of(summary, samples)),
        "direction": toward,
        "overturning_time": summary.time,
        "peak": summary.peak,
        "impacts": summary.impacts,
        "slip": float(plane[SLIP]),
        "farthest_left": float(plane[BACK]),
        "farthest_right": float(plane[FRONT]),
        "lift": summary.lift,
    }


def times_of(shaking: Shaking, end: RunSummary, held: Held) -> NDArray[np.float64]:
    """When the samples of a run are [s]; the last one of a body that fell is at its fall."""
    from shaketable.physics.space.run import FREE_STEP

    at, last = np.arange(int(end.samples)), shaking.a_x.size - 1
    after = last * shaking.time_step + (at - last) * max(shaking.time_step, FREE_STEP)
    time: NDArray[np.float64] = np.where(at <= last, at * shaking.time_step, after)
    over = held.off_edge is not None and bool(held.off_edge[0])
    fell = float(held.landing_time[0]) if over and held.landing_time is not None else end.time
    if math.isfinite(fell):
        time[-1] = fell
    return time


def run_one_surrounded(
    scene: Scene, shaking: Shaking, parts: int, rotation: float
) -> OneRun | None:
    """One body among its surroundings with its history; None if it never met them.

    Raises:
        InputError: let go at a rotation [rad] at which it stands in a wall.
    """
    from shaketable.physics.space.run import RunSummary, make_trace

    require_clear(scene, rotation)
    ground, place = ground_of(shaking), let_go(scene.body, rotation) if rotation else None
    samples, impacts = shaking.a_x.size + FREE_SAMPLES, IMPACTS
    while True:
        trace = make_trace(samples, impacts)
        found = move(scene, ground, np.ones(1), trace, place)
        end = RunSummary(*found.summary[0].tolist())
        if end.samples <= samples and end.impacts <= impacts:
            break
        samples, impacts = max(samples, int(end.samples)), max(impacts, int(end.impacts))
    if not has_met(found):
        return None
    told = told_of(end, found, shaking.a_x.size)
    body, time = scene.body, times_of(shaking, end, found.held)
    shown = samples_shown(time.size, parts, shaking)
    state = planar_states(trace.state[shown])
    changes, phases = phases_of(body, scene.tilt, trace, time.size, time)
    return OneRun(
        ending=Ending(int(told["ending"])),
        direction=int(told["direction"]),
        overturning_time=end.time,
        peak_rotation=end.peak,
        impact_times=trace.impact_times[: int(end.impacts)].copy(),
        time=time[shown],
        rotation=state[:, 2].copy(),
        angular_velocity=state[:, 5].copy(),
        position=state[:, :2].copy(),
        velocity=state[:, 3:5].copy(),
        slip=slips_of(body, state),
        end_slip=told["slip"],
        farthest_left=told["farthest_left"],
        farthest_right=told["farthest_right"],
        max_lift=end.lift,
        phase_times=changes,
        phases=phases,
        held=found.held,
        fallbacks=int(end.fallbacks),
    )
