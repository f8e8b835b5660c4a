"""One body under one motion, with its history."""

from __future__ import annotations

import logging
import math

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import SENTENCES, Ending
from shaketable.errors import InputError, SimulationError
from shaketable.kernels.phases import Phase
from shaketable.motion import Motion
from shaketable.response import Outcome, Response
from shaketable.simulate.setup import (
    blocks_of,
    refined,
    require_model,
    require_stable,
    say_what_to_expect,
    stands_of,
    substeps,
)
from shaketable.support import Support

log = logging.getLogger(__name__)

EVENTS = 64  # room for impacts and changes of phase at first


def simulate(
    body: Body,
    motion: Motion,
    support: Support | None = None,
    *,
    model: str = "rocking",
    initial_rotation: float = 0.0,
) -> Response:
    """Shake one body and keep its history.

    Args:
        body: what stands on the support.
        motion: ground acceleration, linear between its samples.
        support: tilt, friction and restitution; a level one without slip by default.
        model: "rocking" (physics.md section 2: no sliding, no jump) or "general" (section 3:
            rest, slide, rock, slide-rock, flight and impacts with friction and restitution).
        initial_rotation: θ [rad] in (-π/2, π/2) at which the body is let go at t = 0.

    Raises:
        InputError: an unknown model, an initial_rotation out of range, or a tilt at which the
            body falls by itself.
        SimulationError: the general model met a million events in one sample.
    """
    support = support or Support()
    require_model(model)
    say_what_to_expect(model, support, support.tilt)
    require_stable([body], support.tilt)
    if not -math.pi / 2 < initial_rotation < math.pi / 2:
        raise InputError(
            f"initial_rotation [rad] must lie between -π/2 and π/2, got {initial_rotation!r}"
        )
    run = _rock if model == "rocking" else _move
    response, ending = run(body, motion, support, float(initial_rotation))
    if ending is Ending.UNRESOLVED:
        raise SimulationError(f"{body.name or 'the body'} {SENTENCES[ending]}")
    if ending in SENTENCES:
        log.warning("%s %s", body.name or "the body", SENTENCES[ending])
    return response


def _rock(body: Body, motion: Motion, support: Support, rotation: float) -> tuple[Response, Ending]:
    """The rocking model."""
    from shaketable.engine import single

    blocks = blocks_of([body], [support.tilt], support)[0]
    parts = int(substeps(blocks[None], motion)[0])
    push, gravity, h = refined(motion, parts)
    samples, events = push.size, EVENTS
    while True:
        time, theta, omega = (np.empty(samples) for _ in range(3))
        history = single.History(time, theta, omega, np.empty(events))
        end = single.rock_one(push, gravity, h, blocks, rotation, history)
        if end.samples <= samples and end.impacts <= events:
            break
        samples, events = end.samples, end.impacts
    kept = _samples_kept(end.samples, parts, push.size)
    theta, omega = theta[kept], omega[kept]
    position, velocity = _pivoted(body, theta, omega)
    changes, phases = _rocking_phases(time[kept], theta)
    return Response(
        outcome=Outcome(end.direction),
        overturning_time=float(end.overturning_time),
        peak_rotation=float(end.peak),
        impacts=int(end.impacts),
        impact_times=history.impact_times[: end.impacts].copy(),
        time=time[kept],
        rotation=theta,
        angular_velocity=omega,
        position=position,
        velocity=velocity,
        slip=np.zeros(kept.size),
        peak_slip=0.0,
        max_lift=0.0,
        phase_times=changes,
        phases=phases,
        model="rocking",
        body=body,
        motion=motion,
        support=support,
    ), Ending(end.ending)


def _move(body: Body, motion: Motion, support: Support, rotation: float) -> tuple[Response, Ending]:
    """The general model."""
    from shaketable.engine import general_one
    from shaketable.kernels.tally import Log

    stands = stands_of([body], [support.tilt], support)[0]
    parts = int(substeps(blocks_of([body], [support.tilt], support), motion)[0])
    push, gravity, h = refined(motion, parts)
    samples, events = push.size, EVENTS
    while True:
        trace = general_one.Trace(*np.empty((8, samples)))
        log = Log(*np.empty((2, events)), *np.empty((2, events), np.int8))
        end = general_one.move_one(push, gravity, h, stands, rotation, trace, log)
        tally = end.tally
        if end.samples <= samples and max(tally.impacts, tally.changes) <= events:
            break
        samples, events = end.samples, max(tally.impacts, tally.changes)
    kept = _samples_kept(end.samples, parts, push.size)
    return Response(
        outcome=Outcome(end.direction),
        overturning_time=float(end.overturning_time),
        peak_rotation=float(tally.peak),
        impacts=int(tally.impacts),
        impact_times=log.impact_times[: tally.impacts].copy(),
        time=trace.time[kept],
        rotation=trace.rotation[kept],
        angular_velocity=trace.angular_velocity[kept],
        position=np.column_stack([trace.along[kept], trace.normal[kept]]),
        velocity=np.column_stack([trace.along_rate[kept], trace.normal_rate[kept]]),
        slip=trace.slip[kept],
        peak_slip=float(max(tally.farthest_up, -tally.farthest_down)),
        max_lift=float(tally.lift),
        phase_times=log.change_times[: tally.changes].copy(),
        phases=tuple(Phase(code) for code in log.phases[: tally.changes]),
        model="general",
        body=body,
        motion=motion,
        support=support,
    ), Ending(end.ending)


def _samples_kept(samples: int, parts: int, shaken: int) -> NDArray[np.intp]:
    """Those at the motion's samples, and all after its end."""
    every = np.arange(samples)
    kept: NDArray[np.intp] = every[(every % parts == 0) | (every >= shaken)]
    return kept


def _pivoted(
    body: Body, theta: NDArray[np.float64], omega: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Centre of gravity of a body whose pivots stay in place [m], its velocity; shape (n, 2)."""
    pivot = np.where(theta >= 0.0, body.right, -body.left)
    across = pivot * np.cos(theta) - body.cg_height * np.sin(theta)  # X, Y of physics.md 3
    down = -pivot * np.sin(theta) - body.cg_height * np.cos(theta)
    return (
        np.column_stack([pivot - across, -down]),
        np.column_stack([-omega * down, omega * across]),
    )


def _rocking_phases(
    time: NDArray[np.float64], theta: NDArray[np.float64]
) -> tuple[NDArray[np.float64], tuple[Phase, ...]]:
    """Rest and rocking as seen at the samples."""
    seen = np.where(
        theta > 0.0, Phase.ROCK_RIGHT, np.where(theta < 0.0, Phase.ROCK_LEFT, Phase.REST)
    )
    first = np.r_[0, 1 + np.flatnonzero(np.diff(seen))]
    return time[first], tuple(Phase(code) for code in seen[first])
