"""Tables of bodies on supports with friction and restitution, for the general model."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.blocks import FIELDS as BLOCK_FIELDS
from shaketable.engine.blocks import block_of
from shaketable.kernels.compiled import driver, kernel
from shaketable.kernels.contact import Stand
from shaketable.kernels.holding import Grip, make_grip

OWN = len(Stand._fields) - 1  # fields of a Stand before its Block's
GRIP_ROW = len(Grip._fields)
BOUNCE_SPEED = 1e-4  # m/s: a bounce of 5e-10 m
SETTLE_SPEED = 1e-5  # m/s: of the corner of a sliding body that rocks


def tabulate_stands(
    sizes: NDArray[np.float64],
    tilts: NDArray[np.float64],
    blocks: NDArray[np.float64],
    friction: tuple[float, float],
    restitution: float,
    ends: tuple[float, float] = (BOUNCE_SPEED, SETTLE_SPEED),
) -> NDArray[np.float64]:
    """Stand's fields for each (width, cg_height, left, gyration_radius) and tilt, (n, m, OWN + 12).

    `blocks` is what `tabulate_blocks` gives for the same; `friction` is (μ_s, μ_k).
    """
    width, cg_height, left, gyration = sizes.T
    table = np.empty((sizes.shape[0], tilts.size, OWN + BLOCK_FIELDS))
    of_body = np.column_stack([cg_height, width - left, left, gyration**2])
    table[:, :, :4] = of_body[:, None, :]
    table[:, :, 4] = np.sin(tilts)
    table[:, :, 5] = np.cos(tilts)
    shares = [share for mu in friction for share in cone_shares(mu)]
    table[:, :, 6:OWN] = [*shares, restitution, *ends]
    table[:, :, OWN:] = blocks
    return table


def cone_shares(friction: float) -> tuple[float, float]:
    """μ/(1 + μ) and 1/(1 + μ)."""
    if math.isinf(friction):
        return 1.0, 0.0
    return friction / (1.0 + friction), 1.0 / (1.0 + friction)


@kernel
def stand_of(stands: NDArray[np.float64], lane: int) -> Stand:
    row = stands[lane]
    return Stand(
        row[0],
        row[1],
        row[2],
        row[3],
        row[4],
        row[5],
        row[6],
        row[7],
        row[8],
        row[9],
        row[10],
        row[11],
        row[12],
        block_of(stands[:, OWN:], lane),
    )


@kernel
def grip_of(grips: NDArray[np.float64], lane: int, side: float) -> Grip:
    row = grips[lane]
    first = 0 if side > 0.0 else GRIP_ROW
    return Grip(
        row[first],
        row[first + 1],
        row[first + 2],
        row[first + 3],
        row[first + 4],
        row[first + 5],
    )


@driver
def tabulate_grips(stands: NDArray[np.float64]) -> NDArray[np.float64]:
    """Fields of the right and the left Grip of each row of `stands`, (n, 12)."""
    table = np.empty((stands.shape[0], 2 * GRIP_ROW))
    for lane in range(stands.shape[0]):
        stand = stand_of(stands, lane)
        right, left = make_grip(stand, 1.0), make_grip(stand, -1.0)
        for k in range(GRIP_ROW):
            table[lane, k] = right[k]
            table[lane, GRIP_ROW + k] = left[k]
    return table
