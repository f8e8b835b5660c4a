"""The engine's view of bodies and motions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY


class Shaken(NamedTuple):
    """A motion as the engine takes it, each of its steps cut into `parts`."""

    push: NDArray[np.float64]  # a_x [m/s²]
    gravity: NDArray[np.float64]  # g + a_y [m/s²]
    time_step: float  # of a part [s]
    parts: int


def refined(motion: Motion, parts: int) -> Shaken:
    """The same motion with every step cut into `parts`."""
    push = motion.horizontal.copy()  # compiled code tells read-only arrays apart
    above = np.zeros_like(push) if motion.vertical is None else motion.vertical
    if parts > 1:
        at = np.arange((push.size - 1) * parts + 1) / parts
        push = np.interp(at, np.arange(push.size), push)
        above = np.interp(at, np.arange(above.size), above)
    return Shaken(push, STANDARD_GRAVITY + above, motion.time_step / parts, parts)


def substeps(blocks: NDArray[np.float64], motion: Motion) -> NDArray[np.intp]:
    """Parts to cut a time step into so that the Taylor series is exact.

    Args:
        blocks: the numbers of a Block for each body, (n, ...).
        motion: to be cut.

    Returns:
        shape (n,).
    """
    from shaketable.kernels.layout import named
    from shaketable.kernels.rocking import Block
    from shaketable.kernels.taylor import MAX_PHASE

    gravity = STANDARD_GRAVITY if motion.vertical is None else STANDARD_GRAVITY + motion.vertical
    strongest = math.sqrt(float(np.max(motion.horizontal**2 + gravity**2)))
    block = named(blocks, Block)
    k = np.maximum(block["right"]["k"], block["left"]["k"])
    phase = np.sqrt(k * strongest) * motion.time_step
    parts: NDArray[np.intp] = np.maximum(1, np.ceil(phase / MAX_PHASE)).astype(np.intp)
    return parts


def sizes_of(bodies: Sequence[Body], restitution_factor: float) -> NDArray[np.float64]:
    """The numbers of a `kernels.rocking.Size` for each body, shape (body, 5).

    Args:
        bodies: a body's own restitution factor wins.
        restitution_factor: of the others.
    """
    return np.array(
        [
            (
                body.width,
                body.cg_height,
                body.left,
                body.gyration_radius,
                restitution_factor if body.restitution_factor is None else body.restitution_factor,
            )
            for body in bodies
        ],
        np.float64,
    ).reshape(-1, 5)


def samples_kept(samples: int, shaken: Shaken) -> NDArray[np.intp]:
    """Of a history at every part: those at the motion's samples, and all after its end."""
    every = np.arange(samples)
    kept: NDArray[np.intp] = every[(every % shaken.parts == 0) | (every >= shaken.push.size)]
    return kept
