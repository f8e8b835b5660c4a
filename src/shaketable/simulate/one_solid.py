"""One solid under one motion, with its history."""

from __future__ import annotations

import logging
import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import Ending
from shaketable.errors import InputError, require_number
from shaketable.language import translated
from shaketable.models import Model
from shaketable.models.held import columns_of, held_of
from shaketable.models.model import Held
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate.around import held_by
from shaketable.simulate.standing import (
    model_for_solids,
    require_standing,
    require_surrounded,
    upright,
)
from shaketable.solid import Solid
from shaketable.solid_response import Contact, Grip, SolidResponse
from shaketable.support import Support
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    from shaketable.physics.space.run import RunSummary

log = logging.getLogger(__name__)

FREE_SAMPLES = 500  # allocated at first for the time after the motion's end


def simulate_solid(
    solid: Solid,
    motion: Motion,
    support: Support,
    *,
    model: Model | str | None,
    orientation: float,
    surroundings: Surroundings | None,
) -> SolidResponse:
    """Shake one solid and keep its history; arguments as for `simulate`."""
    from shaketable.physics.space.drive import move_solid
    from shaketable.physics.space.run import OVERTURNED, SUMMARY, RunSummary, make_trace
    from shaketable.physics.space.workspace import Q

    general = model_for_solids(model)
    require_number("orientation [rad]", orientation)
    if not math.isfinite(orientation):
        raise InputError(f"orientation [rad] must be finite, got {orientation!r}")
    require_standing(solid, support, orientation)
    require_surrounded(solid, surroundings, orientation)
    if motion.transverse is None:
        log.info("%s has one horizontal component alone", motion.name or "the motion")
    tilt, azimuth = upright(support)
    shapes, workspaces = shapes_of(solid, general, surroundings)
    ground, stands = ground_of(motion), np.array([[tilt, azimuth, orientation, 1.0, 1.0]])
    samples = motion.horizontal.size + FREE_SAMPLES
    numbers = np.zeros((1, columns_of(surroundings)))
    while True:
        trace = make_trace(samples)
        move_solid(shapes, workspaces, ground, stands, False, trace, numbers)
        found = RunSummary(*numbers[0, :SUMMARY].tolist())
        if found.samples <= samples:
            break
        samples = int(found.samples)
    n = int(found.samples)
    log_ending(found, solid)
    fell = int(found.ending) == OVERTURNED
    held = held_of(numbers, surroundings, solid.mass) if surroundings else None
    state = trace.state[:n]
    toward = math.cos(found.fall_azimuth - azimuth) if fell else math.nan
    return SolidResponse(
        outcome=outcome_of(toward),
        overturning_time=found.time,
        fall_azimuth=found.fall_azimuth,
        within_45_of_dip=fell and abs(toward) >= math.sqrt(0.5),
        pivot_contacts=tuple(int(row) for row in (found.lowest, found.beside) if row >= 0.0),
        peak_rotation=found.peak,
        displacement_x=found.displacement_x,
        displacement_y=found.displacement_y,
        yaw=found.yaw,
        displacement_x_at_motion_end=found.shaken_x,
        displacement_y_at_motion_end=found.shaken_y,
        yaw_at_motion_end=found.shaken_yaw,
        farthest_displacement=found.farthest,
        max_lift=found.lift,
        ending=Ending(int(found.ending)),
        impacts=int(found.impacts),
        time=times_of(motion, n, last_of(found, held)),
        position=state[:, :Q].copy(),
        velocity=state[:, 7:10].copy(),
        quaternions=state[:, [Q + 1, Q + 2, Q + 3, Q]],
        angular_velocity=state[:, 10:].copy(),
        contact=tuple(Contact(code) for code in trace.rank[:n]),
        grip=tuple(Grip(code) for code in trace.hold[:n]),
        fallbacks=int(found.fallbacks),
        orientation=float(orientation),
        **held_by(held),
        surroundings=surroundings,
        model=general,
        body=solid,
        motion=motion,
        support=support,
    )


def last_of(found: RunSummary, held: Held | None) -> float:
    """When the history of a solid that fell ends [s]; NaN if it hangs on over the edge."""
    if held is not None and held.off_edge is not None and held.off_edge[0]:
        assert held.landing_time is not None
        return float(held.landing_time[0])
    return found.time


def times_of(motion: Motion, samples: int, fall: float) -> NDArray[np.float64]:
    """Times of a history's samples [s]; the last one of a solid that fell is at its fall."""
    from shaketable.physics.space.run import FREE_STEP

    last = motion.horizontal.size - 1
    step = max(motion.time_step, FREE_STEP)
    at = np.arange(samples, dtype=np.float64)
    time = np.where(at <= last, at * motion.time_step, motion.duration + (at - last) * step)
    if math.isfinite(fall):
        time[-1] = fall
    return time


def log_ending(found: RunSummary, solid: Solid) -> None:
    """Log what a user should know of how a run ended."""
    from shaketable.physics.space.run import SENTENCES

    if int(found.ending) in SENTENCES:
        log.warning("%s %s", solid.name or "the solid", translated(SENTENCES[int(found.ending)]))


def outcome_of(toward: float) -> Outcome:
    """The outcome of a fall whose azimuth has this cosine to downhill, NaN for none."""
    if math.isnan(toward):
        return Outcome.STANDING
    return Outcome.DOWNHILL if toward >= 0.0 else Outcome.UPHILL
