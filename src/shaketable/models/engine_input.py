"""The engine's view of bodies and motions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from shaketable.physics.plane.forcing import Shaking

MOST_STEPS = 1e8  # parts of steps: 2 GiB of memory


def refined(motion: Motion, parts: int) -> Shaking:
    """The same motion with every step cut into `parts`."""
    from shaketable.physics.plane.forcing import Shaking

    a_x = motion.horizontal.copy()  # compiled code tells read-only arrays apart
    above = np.zeros_like(a_x) if motion.vertical is None else motion.vertical
    if parts > 1:
        at = np.arange((a_x.size - 1) * parts + 1) / parts
        a_x = np.interp(at, np.arange(a_x.size), a_x)
        above = np.interp(at, np.arange(above.size), above)
    return Shaking(a_x, STANDARD_GRAVITY + above, motion.time_step / parts)


def substeps(blocks: NDArray[np.float64], motion: Motion) -> NDArray[np.intp]:
    """Parts into which a time step is cut so that the Taylor series is exact.

    Args:
        blocks: the numbers of a Block for each body, (n, ...).
        motion: the motion whose steps are cut.

    Returns:
        shape (n,).

    Raises:
        InputError: accelerations so strong, or steps so long, that too many parts would be needed.
    """
    from shaketable.physics.plane.layout import struct_view
    from shaketable.physics.plane.rocking import Block
    from shaketable.physics.plane.taylor import MAX_PHASE

    g_effective = (
        STANDARD_GRAVITY if motion.vertical is None else STANDARD_GRAVITY + motion.vertical
    )
    with np.errstate(over="ignore"):  # refused below; np.hypot would be 30 times slower
        strongest = math.sqrt(float(np.max(motion.horizontal**2 + g_effective**2)))
    block = struct_view(blocks, Block)
    k = np.maximum(block["right"]["k"], block["left"]["k"])
    phase = np.sqrt(k * strongest) * motion.time_step
    parts: NDArray[np.float64] = np.maximum(1, np.ceil(phase / MAX_PHASE))
    if not parts.max() * motion.horizontal.size <= MOST_STEPS:
        raise InputError(
            f"motion {motion.name!r}: {motion.horizontal.size} steps of {motion.time_step:g} s "
            f"with accelerations up to {strongest:.3g} m/s² would each have to be cut into "
            f"{parts.max():.3g} parts for a body of this size; at most {MOST_STEPS:.0e} parts in "
            "all are accepted. Are the accelerations in m/s² and the time step in s?"
        )
    return parts.astype(np.intp)


def sizes_of(bodies: Sequence[Body], restitution_factor: float) -> NDArray[np.float64]:
    """The numbers of a `physics.plane.rocking.Size` for each body, shape (body, 5).

    Args:
        bodies: a body's own restitution factor takes precedence.
        restitution_factor: factor of the other bodies.
    """
    from shaketable.physics.plane.layout import length
    from shaketable.physics.plane.rocking import Size

    sizes = [
        Size(
            base=body.base,
            cg_height=body.cg_height,
            left=body.left,
            gyration_radius=body.gyration_radius,
            restitution_factor=restitution_factor
            if body.restitution_factor is None
            else body.restitution_factor,
        )
        for body in bodies
    ]
    return np.array(sizes, np.float64).reshape(-1, length(Size))


def samples_shown(samples: int, parts: int, shaking: Shaking) -> NDArray[np.intp]:
    """Which samples of a history at every part are shown.

    They are those at the motion's own samples, and all after its end.
    """
    every = np.arange(samples)
    shown: NDArray[np.intp] = every[(every % parts == 0) | (every >= shaking.a_x.size)]
    return shown
