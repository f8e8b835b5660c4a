"""The general model's planar bodies among walls, straps, an edge and on pads: deep solids.

A body is first simulated as if it stood alone: what never comes near its surroundings has just
those results. What does is simulated in space (`deep`), and told of as a planar body (theory,
section 12).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import Ending
from shaketable.models.deep import Moved, ground_of, move
from shaketable.models.engine_input import samples_shown
from shaketable.models.held import nothing_held
from shaketable.models.model import Held, ManyRuns, OneRun
from shaketable.models.planar_history import phases_of, planar_states, slips_of
from shaketable.models.scene import MARGIN, Scene, let_go, require_clear

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking
    from shaketable.physics.space.found import Found

FLIGHT = 1.0  # m: of what counts as near of a body that flew, with ten times its clearance
IMPACTS = 64  # for which memory is allocated at first
FREE_SAMPLES = 500  # likewise, for the time after the motion's end


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


def run_surrounded(
    scenes: NDArray[np.object_], polarity: NDArray[np.float64], shaking: Shaking, runs: ManyRuns
) -> ManyRuns:
    """The runs of free bodies, with those that met what surrounds them simulated again."""
    from shaketable.physics.space.found import make_trace, numbers_of

    held = nothing_held([scene.surroundings for scene in scenes])
    ground, nothing = ground_of(shaking), make_trace(0)
    for k in np.flatnonzero(comes_near(scenes, runs)).tolist():
        moved = move(scenes[k], ground, polarity[k : k + 1], nothing)
        if not has_met(moved):
            continue
        told = told_of(numbers_of(moved.found), shaking.a_x.size)
        for name, value in told.items():
            getattr(runs, name)[k] = value
        put_held(held, k, moved.held)
    return runs._replace(held=held)


def has_met(moved: Moved) -> bool:
    """Whether a run met anything but its support."""
    found = moved.found[0]
    return bool(found["off_edge"] or found["met"] or (moved.held.strap_force[0] > 0.0).any())


def put_held(held: Held, k: int, one: Held) -> None:
    """Write what the surroundings of one run did among those of many, whose straps may be more."""
    for name, value in one._asdict().items():
        if value is not None:
            whole = getattr(held, name)
            if whole.ndim > 1:
                whole[k, : value.shape[1]] = value[0]
            else:
                whole[k] = value[0]


def told_of(found: Found, samples: int) -> dict[str, float]:
    """What is told of one run, by the names of ManyRuns."""
    fell = not math.isnan(found.fall_azimuth)
    toward = math.copysign(1.0, math.cos(found.fall_azimuth)) if fell else 0.0
    return {
        "ending": float(ending_of(found, samples)),
        "direction": toward,
        "overturning_time": found.time,
        "peak": found.peak,
        "impacts": float(found.impacts),
        "slip": found.slip,
        "farthest_left": found.slip_back,
        "farthest_right": found.slip_front,
        "lift": found.lift,
    }


def ending_of(found: Found, samples: int) -> Ending:
    """How a run ended; what is given up before its motion ends is not resolved."""
    ending = Ending(found.ending)
    given_up = ending is Ending.STILL_ROCKING and found.samples < samples
    return Ending.UNRESOLVED if given_up else ending


def times_of(shaking: Shaking, end: Found) -> NDArray[np.float64]:
    """When the samples of a run are [s]; the last one of a body that fell is at its fall."""
    from shaketable.physics.space.ending import FREE_STEP

    at, last = np.arange(end.samples), shaking.a_x.size - 1
    after = last * shaking.time_step + (at - last) * max(shaking.time_step, FREE_STEP)
    time: NDArray[np.float64] = np.where(at <= last, at * shaking.time_step, after)
    fell = end.landing_time if end.off_edge else end.time
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
    from shaketable.physics.space.found import make_trace, numbers_of

    require_clear(scene, rotation)
    ground, place = ground_of(shaking), let_go(scene.body, rotation) if rotation else None
    samples, impacts = shaking.a_x.size + FREE_SAMPLES, IMPACTS
    while True:
        trace = make_trace(samples, impacts)
        moved = move(scene, ground, np.ones(1), trace, place)
        end = numbers_of(moved.found)
        if end.samples <= samples and end.impacts <= impacts:
            break
        samples, impacts = max(samples, end.samples), max(impacts, end.impacts)
    if not has_met(moved):
        return None
    told = told_of(end, shaking.a_x.size)
    body, time = scene.body, times_of(shaking, end)
    shown = np.union1d(samples_shown(time.size, parts, shaking), [time.size - 1])
    state = planar_states(trace.state[shown])
    changes, phases = phases_of(body, scene.tilt, trace, time.size, time)
    return OneRun(
        ending=Ending(int(told["ending"])),
        direction=int(told["direction"]),
        overturning_time=end.time,
        peak_rotation=end.peak,
        impact_times=trace.impact_times[: end.impacts].copy(),
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
        held=moved.held,
        fallbacks=end.fallbacks,
    )
