"""The method of Dormand and Prince (1980) of order 5 with an error of order 4.

Stages are rows of an array of rates, of which the first holds those at the step's start; `out` is
the state at which the next row is to be written.
"""

from __future__ import annotations

import math

from shaketable.compiled import kernel

NODES = (0.2, 0.3, 0.8, 8.0 / 9.0, 1.0)  # of the stages, in parts of the step
SAFETY, SHRINK, GROW = 0.8, 0.2, 5.0


@kernel
def to_stage(  # type: ignore[no-untyped-def]
    first: int, end: int, stage: int, h: float, y, k, out
) -> None:
    """Write numbers of a stage, 1 to 6, of a step of h [s] from y; the sixth is its end."""
    for j in range(first, end):
        if stage == 1:
            out[j] = y[j] + h * (0.2 * k[0, j])
        elif stage == 2:
            out[j] = y[j] + h * (3.0 / 40.0 * k[0, j] + 9.0 / 40.0 * k[1, j])
        elif stage == 3:
            out[j] = y[j] + h * (
                44.0 / 45.0 * k[0, j] - 56.0 / 15.0 * k[1, j] + 32.0 / 9.0 * k[2, j]
            )
        elif stage == 4:
            out[j] = y[j] + h * (
                19372.0 / 6561.0 * k[0, j]
                - 25360.0 / 2187.0 * k[1, j]
                + 64448.0 / 6561.0 * k[2, j]
                - 212.0 / 729.0 * k[3, j]
            )
        elif stage == 5:
            out[j] = y[j] + h * (
                9017.0 / 3168.0 * k[0, j]
                - 355.0 / 33.0 * k[1, j]
                + 46732.0 / 5247.0 * k[2, j]
                + 49.0 / 176.0 * k[3, j]
                - 5103.0 / 18656.0 * k[4, j]
            )
        else:
            out[j] = y[j] + h * (
                35.0 / 384.0 * k[0, j]
                + 500.0 / 1113.0 * k[2, j]
                + 125.0 / 192.0 * k[3, j]
                - 2187.0 / 6784.0 * k[4, j]
                + 11.0 / 84.0 * k[5, j]
            )


@kernel
def error_of(first: int, end: int, h: float, k, out) -> float:  # type: ignore[no-untyped-def]
    """The largest error of numbers of a step of h [s] that ends at `out`, over 1 and its size."""
    worst = 0.0
    for j in range(first, end):
        error = h * (
            71.0 / 57600.0 * k[0, j]
            - 71.0 / 16695.0 * k[2, j]
            + 71.0 / 1920.0 * k[3, j]
            - 17253.0 / 339200.0 * k[4, j]
            + 22.0 / 525.0 * k[5, j]
            - 1.0 / 40.0 * k[6, j]
        )
        worst = max(worst, abs(error) / (1.0 + abs(out[j])))
    return worst


@kernel
def next_part(du: float, error: float) -> float:
    """The part of an interval to try after a step of du with this error, 1 being accepted."""
    if error <= 0.0:
        return GROW * du
    if error == math.inf:
        return SHRINK * du
    return du * min(GROW, max(SHRINK, SAFETY * float(error**-0.2)))
