"""Tables of bodies on their supports."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.kernels.compiled import driver, kernel
from shaketable.kernels.rocking import Block, Side, make_block

FIELDS = 12  # of both Sides of a Block


@kernel
def side_in(row: NDArray[np.float64], first: int) -> Side:
    return Side(
        row[first], row[first + 1], row[first + 2], row[first + 3], row[first + 4], row[first + 5]
    )


@kernel
def block_of(blocks: NDArray[np.float64], lane: int) -> Block:
    return Block(side_in(blocks[lane], 0), side_in(blocks[lane], 6))


@driver
def tabulate_blocks(
    sizes: NDArray[np.float64], tilts: NDArray[np.float64], kept: float
) -> NDArray[np.float64]:
    """Block's fields for each (width, cg_height, left, gyration_radius) and tilt, (n, m, 12)."""
    table = np.empty((sizes.shape[0], tilts.size, FIELDS))
    for b in range(sizes.shape[0]):
        for t in range(tilts.size):
            block = make_block(sizes[b, 0], sizes[b, 1], sizes[b, 2], sizes[b, 3], tilts[t], kept)
            for k in range(6):
                table[b, t, k] = block.right[k]
                table[b, t, 6 + k] = block.left[k]
    return table
