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
from shaketable.models.held import held_of
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
    from shaketable.physics.space.found import Found

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
    from shaketable.physics.space.found import OVERTURNED, make_found, make_trace, numbers_of
    from shaketable.physics.space.workspace import P, Q, V, W

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
    all_found = make_found(1)
    while True:
        trace = make_trace(samples)
        move_solid(shapes, workspaces, ground, stands, False, trace, all_found)
        found = numbers_of(all_found)
        if found.samples <= samples:
            break
        samples = found.samples
    n = found.samples
    log_ending(found, solid)
    fell = found.ending == OVERTURNED
    held = held_of(all_found, surroundings, solid.mass) if surroundings else None
    state = trace.state[:n]
    toward = math.cos(found.fall_azimuth - azimuth) if fell else math.nan
    return SolidResponse(
        outcome=outcome_of(toward),
        overturning_time=found.time,
        fall_azimuth=found.fall_azimuth,
        within_45_of_dip=fell and abs(toward) >= math.sqrt(0.5),
        pivot_contacts=tuple(row for row in (found.lowest, found.beside) if row >= 0),
        peak_rotation=found.peak,
        displacement_x=found.displacement_x,
        displacement_y=found.displacement_y,
        yaw=found.yaw,
        displacement_x_at_motion_end=found.shaken_x,
        displacement_y_at_motion_end=found.shaken_y,
        yaw_at_motion_end=found.shaken_yaw,
        farthest_displacement=found.farthest,
        max_lift=found.lift,
        ending=Ending(found.ending),
        impacts=found.impacts,
        time=times_of(motion, n, found.landing_time if found.off_edge else found.time),
        position=state[:, P : P + 3].copy(),
        velocity=state[:, V : V + 3].copy(),
        quaternions=state[:, [Q + 1, Q + 2, Q + 3, Q]],
        angular_velocity=state[:, W : W + 3].copy(),
        contact=tuple(Contact(code) for code in trace.rank[:n]),
        grip=tuple(Grip(code) for code in trace.hold[:n]),
        fallbacks=found.fallbacks,
        orientation=float(orientation),
        **held_by(held),
        surroundings=surroundings,
        model=general,
        body=solid,
        motion=motion,
        support=support,
    )


def times_of(motion: Motion, samples: int, fall: float) -> NDArray[np.float64]:
    """Times of a history's samples [s].

    Args:
        motion, samples: that of the ground, and how many samples the history has.
        fall: when it ends with a fall; NaN if it hangs on over the edge, or did not fall.
    """
    from shaketable.physics.space.ending import FREE_STEP

    last = motion.horizontal.size - 1
    step = max(motion.time_step, FREE_STEP)
    at = np.arange(samples, dtype=np.float64)
    time = np.where(at <= last, at * motion.time_step, motion.duration + (at - last) * step)
    if math.isfinite(fall):
        time[-1] = fall
    return time


def log_ending(found: Found, solid: Solid) -> None:
    """Log what a user should know of how a run ended."""
    from shaketable.physics.space.ending import SENTENCES

    if found.ending in SENTENCES:
        log.warning("%s %s", solid.name or "the solid", translated(SENTENCES[found.ending]))


def outcome_of(toward: float) -> Outcome:
    """The outcome of a fall whose azimuth has this cosine to downhill, NaN for none."""
    if math.isnan(toward):
        return Outcome.STANDING
    return Outcome.DOWNHILL if toward >= 0.0 else Outcome.UPHILL
