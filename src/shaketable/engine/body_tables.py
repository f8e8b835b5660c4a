"""Tables of bodies on their supports: one row per body, its numbers those of a NamedTuple.

`physics.plane.layout.struct_view` shows a table by its fields' names.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from shaketable.compiled import driver, kernel
from shaketable.physics.plane.contact import ContactBody
from shaketable.physics.plane.layout import Columns, columns, length, struct_view
from shaketable.physics.plane.rocking import Block, Side, Size, State, least_demand, make_block
from shaketable.physics.plane.sticking import Cone, StickingCorner, StickingCorners, make_corners

SIZE = columns(Size)
STATE = columns(State)
BLOCK = columns(Block)
BODY = columns(ContactBody)
CORNERS = columns(StickingCorners)

BOUNCE_SPEED = 1e-4  # m/s: a bounce of 5e-10 m
SETTLE_SPEED = 1e-5  # m/s: of the corner of a sliding body that rocks


# Readers of a row, given the numbers, where the row begins among them, and its columns from there.


@kernel
def read_side(numbers: NDArray[np.float64], at: int, c: Columns) -> Side:
    return Side(
        numbers[at + c.sign],
        numbers[at + c.k],
        numbers[at + c.phase],
        numbers[at + c.sine],
        numbers[at + c.cosine],
        numbers[at + c.velocity_ratio],
        numbers[at + c.onward],
    )


@kernel
def read_block(numbers: NDArray[np.float64], at: int, c: Columns) -> Block:
    return Block(read_side(numbers, at, c.right), read_side(numbers, at, c.left))


@kernel
def read_state(numbers: NDArray[np.float64], at: int, c: Columns) -> State:
    return State(
        numbers[at + c.side],
        numbers[at + c.rotation],
        numbers[at + c.rate],
        numbers[at + c.sine],
        numbers[at + c.cosine],
    )


@kernel
def read_cone(numbers: NDArray[np.float64], at: int, c: Columns) -> Cone:
    return Cone(
        numbers[at + c.radius],
        numbers[at + c.first_x],
        numbers[at + c.first_y],
        numbers[at + c.second_x],
        numbers[at + c.second_y],
    )


@kernel
def read_corner(numbers: NDArray[np.float64], at: int, c: Columns) -> StickingCorner:
    return StickingCorner(read_cone(numbers, at, c.cone), numbers[at + c.velocity_ratio])


@kernel
def read_corners(numbers: NDArray[np.float64], at: int, c: Columns) -> StickingCorners:
    return StickingCorners(read_corner(numbers, at, c.right), read_corner(numbers, at, c.left))


@kernel
def read_body(numbers: NDArray[np.float64], at: int, c: Columns) -> ContactBody:
    return ContactBody(
        numbers[at + c.h],
        numbers[at + c.right],
        numbers[at + c.left],
        numbers[at + c.i2],
        numbers[at + c.tilt_sine],
        numbers[at + c.tilt_cosine],
        numbers[at + c.a_stick],
        numbers[at + c.b_stick],
        numbers[at + c.a_slip],
        numbers[at + c.b_slip],
        numbers[at + c.normal_restitution],
        numbers[at + c.bounce_speed],
        numbers[at + c.settle_speed],
        numbers[at + c.restitution_factor],
        read_block(numbers, at, c.block),
    )


# Writers, likewise. They name every number, because a tuple index that is no constant is slow.


@kernel
def write_side(numbers: NDArray[np.float64], at: int, c: Columns, side: Side) -> None:
    numbers[at + c.sign] = side.sign
    numbers[at + c.k] = side.k
    numbers[at + c.phase] = side.phase
    numbers[at + c.sine] = side.sine
    numbers[at + c.cosine] = side.cosine
    numbers[at + c.velocity_ratio] = side.velocity_ratio
    numbers[at + c.onward] = side.onward


@kernel
def write_state(numbers: NDArray[np.float64], at: int, c: Columns, state: State) -> None:
    numbers[at + c.side] = state.side
    numbers[at + c.rotation] = state.rotation
    numbers[at + c.rate] = state.rate
    numbers[at + c.sine] = state.sine
    numbers[at + c.cosine] = state.cosine


@kernel
def write_cone(numbers: NDArray[np.float64], at: int, c: Columns, cone: Cone) -> None:
    numbers[at + c.radius] = cone.radius
    numbers[at + c.first_x] = cone.first_x
    numbers[at + c.first_y] = cone.first_y
    numbers[at + c.second_x] = cone.second_x
    numbers[at + c.second_y] = cone.second_y


@driver
def write_blocks(
    sizes: NDArray[np.float64], tilts: NDArray[np.float64], kept: float, table: NDArray[np.float64]
) -> None:
    """Write a Block for each row of `sizes` (a Size) and its tilt [rad]; `kept` is η or NaN."""
    for n in range(sizes.shape[0]):
        numbers = sizes[n]
        size = Size(
            numbers[SIZE.base],
            numbers[SIZE.cg_height],
            numbers[SIZE.left],
            numbers[SIZE.gyration_radius],
            numbers[SIZE.restitution_factor],
        )
        block = make_block(size, tilts[n], kept)
        write_side(table[n], 0, BLOCK.right, block.right)
        write_side(table[n], 0, BLOCK.left, block.left)


def tabulate_blocks(
    sizes: NDArray[np.float64], tilts: NDArray[np.float64], kept: float
) -> NDArray[np.float64]:
    """The rocking model's table, (n, numbers of a Block).

    Args:
        sizes: the numbers of a Size for each body, (n, 5).
        tilts: tilt of its support [rad], (n,).
        kept: η, or NaN for an impact that keeps angular momentum.
    """
    table = np.empty((sizes.shape[0], length(Block)))
    # it is compiled for one type
    write_blocks(np.array(sizes), np.array(tilts), kept, table)
    return table


@driver
def write_demands(blocks: NDArray[np.float64], demands: NDArray[np.float64]) -> None:
    """Write the `least_demand` of each Block."""
    for n in range(demands.size):
        demands[n] = least_demand(read_block(blocks[n], 0, BLOCK))


def tabulate_demands(blocks: NDArray[np.float64]) -> NDArray[np.float64]:
    """The smallest |a_x| / (g + a_y) at which each body of a table of Blocks can tip, (n,)."""
    demands = np.empty(blocks.shape[0])
    write_demands(np.ascontiguousarray(blocks), demands)
    return demands


def tabulate_bodies(
    sizes: NDArray[np.float64],
    tilts: NDArray[np.float64],
    friction: tuple[float, float],
    normal_restitution: float,
) -> NDArray[np.float64]:
    """The general model's table, (n, numbers of a ContactBody).

    Args:
        sizes, tilts: as for `tabulate_blocks`.
        friction: (μ_s, μ_k).
        normal_restitution: e_n.
    """
    table = np.empty((sizes.shape[0], length(ContactBody)))
    body, size = struct_view(table, ContactBody), struct_view(np.ascontiguousarray(sizes), Size)
    body["h"], body["left"] = size["cg_height"], size["left"]
    body["right"] = size["base"] - size["left"]
    body["i2"] = size["gyration_radius"] ** 2
    body["tilt_sine"], body["tilt_cosine"] = np.sin(tilts), np.cos(tilts)
    body["a_stick"], body["b_stick"] = cone_shares(friction[0])
    body["a_slip"], body["b_slip"] = cone_shares(friction[1])
    body["normal_restitution"] = normal_restitution
    body["bounce_speed"], body["settle_speed"] = BOUNCE_SPEED, SETTLE_SPEED
    body["restitution_factor"] = size["restitution_factor"]
    blocks_of(table)[:] = tabulate_blocks(sizes, tilts, math.nan)
    return table


def blocks_of(bodies: NDArray[np.float64]) -> NDArray[np.float64]:
    """The part of `tabulate_bodies` that the rocking model reads: the same memory."""
    first = int(BODY.block.right.sign)
    return bodies[:, first : first + length(Block)]


def cone_shares(friction: float) -> tuple[float, float]:
    """μ/(1 + μ) and 1/(1 + μ)."""
    if math.isinf(friction):
        return 1.0, 0.0
    return friction / (1.0 + friction), 1.0 / (1.0 + friction)


@driver
def write_corners(bodies: NDArray[np.float64], table: NDArray[np.float64]) -> None:
    """Write the StickingCorners of each ContactBody."""
    for n in range(bodies.shape[0]):
        corners = make_corners(read_body(bodies[n], 0, BODY))
        write_cone(table[n], 0, CORNERS.right.cone, corners.right.cone)
        write_cone(table[n], 0, CORNERS.left.cone, corners.left.cone)
        table[n, CORNERS.right.velocity_ratio] = corners.right.velocity_ratio
        table[n, CORNERS.left.velocity_ratio] = corners.left.velocity_ratio


def tabulate_corners(bodies: NDArray[np.float64]) -> NDArray[np.float64]:
    """The StickingCorners of each row of `tabulate_bodies`, (n, numbers)."""
    table = np.empty((bodies.shape[0], length(StickingCorners)))
    write_corners(bodies, table)
    return table
