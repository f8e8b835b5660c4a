"""What both ways to simulate need: checks, and the engine's view of bodies and motions."""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, joined
from shaketable.motion import Motion
from shaketable.support import Support
from shaketable.units import STANDARD_GRAVITY, degrees

log = logging.getLogger(__name__)

MODELS = ("rocking", "general")


def require_model(model: str) -> None:
    """InputError that names the models there are."""
    if model not in MODELS:
        raise InputError(f"unknown model {model!r}; accepted: {', '.join(MODELS)}")


def require_stable(bodies: Sequence[Body], tilt: float) -> None:
    """InputError that names each body that falls downhill by itself at `tilt` [rad]."""
    faults = [
        f"body {body.name or index}: falls by itself on a support tilted {degrees(tilt):.4g}°; "
        f"it stands below {degrees(body.slenderness_left):.4g}° = atan(left / cg_height)"
        for index, body in enumerate(bodies)
        if tilt >= body.slenderness_left
    ]
    if faults:
        raise InputError(joined(faults))


def say_what_to_expect(model: str, support: Support, tilt: float) -> None:
    """Warn of what the model ignores, and of a support on which everything slides by itself."""
    if model == "rocking":
        if math.isfinite(support.static_friction) or support.restitution:
            log.warning(
                "the rocking model ignores the support's friction and normal restitution; "
                'model="general" uses them'
            )
        return
    if support.rocking_restitution is not None:
        log.warning("the general model ignores rocking_restitution; restitution is for it")
    if math.tan(tilt) > support.static_friction:
        log.warning(
            "on a support tilted %.4g° a body slides by itself: static friction %.4g holds it "
            "up to %.4g°",
            degrees(tilt),
            support.static_friction,
            degrees(math.atan(support.static_friction)),
        )


def sizes_of(bodies: Sequence[Body]) -> NDArray[np.float64]:
    """Width, height of the centre of gravity, left, radius of gyration [m], shape (body, 4)."""
    return np.array([(b.width, b.cg_height, b.left, b.gyration_radius) for b in bodies], float)


def blocks_of(
    bodies: Sequence[Body], tilts: Sequence[float], support: Support
) -> NDArray[np.float64]:
    """The rocking model's view of each body on each tilt, shape (body, tilt, 12)."""
    from shaketable.engine import blocks

    kept = support.rocking_restitution
    return blocks.tabulate_blocks(
        sizes_of(bodies), np.array(tilts, float), math.nan if kept is None else kept
    )


def stands_of(
    bodies: Sequence[Body], tilts: Sequence[float], support: Support
) -> NDArray[np.float64]:
    """The general model's view of each body on each tilt, shape (body, tilt, fields)."""
    from shaketable.engine import blocks, stands

    sizes, angles = sizes_of(bodies), np.array(tilts, float)
    plain = blocks.tabulate_blocks(sizes, angles, math.nan)
    friction = (support.static_friction, support.sliding_friction)
    return stands.tabulate_stands(sizes, angles, plain, friction, support.restitution)


def substeps(blocks: NDArray[np.float64], motion: Motion) -> NDArray[np.intp]:
    """Parts to cut a time step into for each body, so that the series is exact, shape (body,)."""
    from shaketable.kernels.taylor import MAX_PHASE

    gravity = STANDARD_GRAVITY if motion.vertical is None else STANDARD_GRAVITY + motion.vertical
    strongest = math.sqrt(float(np.max(motion.horizontal**2 + gravity**2)))
    k = blocks[:, 0, [1, 7]].max(axis=1)  # of both sides
    phase = np.sqrt(k * strongest) * motion.time_step
    parts: NDArray[np.intp] = np.maximum(1, np.ceil(phase / MAX_PHASE)).astype(np.intp)
    return parts


def refined(motion: Motion, parts: int) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """a_x, g + a_y and the time step, with every step cut into `parts`: the same motion."""
    push = motion.horizontal.copy()  # compiled code tells read-only arrays apart
    lift = np.zeros_like(push) if motion.vertical is None else motion.vertical
    if parts > 1:
        at = np.arange((push.size - 1) * parts + 1) / parts
        push = np.interp(at, np.arange(push.size), push)
        lift = np.interp(at, np.arange(lift.size), lift)
    return push, STANDARD_GRAVITY + lift, motion.time_step / parts
