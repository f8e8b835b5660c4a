"""What is known of a body before its tests: a range for each of its parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_number, require_whole

UNIFORM, LOG_UNIFORM = "uniform", "log-uniform"
#: About measured sizes, as factors. A body stands on less than the width that was measured, for
#: its edges are round and its base is uneven; one that is no rectangle rocks like a larger one.
ABOUT_SLENDERNESS = (1 / 3, 1.5)
ABOUT_SIZE = (1 / 1.5, 1.5)


@dataclass(frozen=True)
class Range:
    """The values that a parameter may have, all alike likely, or all alike likely in its logarithm.

    Args:
        low, high: ends; equal ends fix the parameter.
        distribution: "uniform" or "log-uniform".

    Raises:
        InputError: ends that are not finite or not in order, a log-uniform range that is not
            positive, or another distribution.
    """

    low: float
    high: float
    distribution: str = UNIFORM

    def __post_init__(self) -> None:
        for end in (self.low, self.high):
            require_number("an end of a range", end)
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low <= self.high):
            raise InputError(
                f"a range needs finite ends in order, got {self.low!r} to {self.high!r}"
            )
        if self.distribution not in (UNIFORM, LOG_UNIFORM):
            raise InputError(
                f"a distribution must be {UNIFORM} or {LOG_UNIFORM}, got {self.distribution!r}"
            )
        if self.distribution == LOG_UNIFORM and self.low <= 0.0:
            raise InputError(f"a {LOG_UNIFORM} range must begin above 0, got {self.low!r}")

    def at(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """The values below which these shares of the range lie."""
        if self.distribution == LOG_UNIFORM:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + (self.high - self.low) * share)

    def __str__(self) -> str:
        if self.low == self.high:
            return f"{self.low:.4g}"
        return f"{self.low:.4g} to {self.high:.4g}, {self.distribution}"


class Parameter(NamedTuple):
    """A parameter in words."""

    unit: str
    meaning: str


PARAMETERS = {
    "slenderness": Parameter("rad", "angle between the height and the line to a base corner"),
    "half_diagonal": Parameter("m", "distance from a base corner to the centre of gravity"),
    "cg_offset": Parameter("", "centre of gravity off the middle, as a share of the base"),
    "restitution_factor": Parameter("", "share of a plastic impact's velocity that is left"),
    "tilt": Parameter("rad", "of the support, downhill toward -x"),
}


@dataclass(frozen=True, kw_only=True)
class Prior:
    """Ranges of slenderness, size, offset and restitution before any test.

    A body that is no rectangle has one that rocks like it: with its own angle to the corner, and
    with the half diagonal that gives its frequency p = √(3g/4r).

    Args:
        slenderness: α of the rectangle with its centre of gravity in the middle [rad].
        half_diagonal: r of that rectangle [m].
        cg_offset: of the foot of the centre of gravity from the middle of the base toward +x, as
            a share of the base.
        restitution_factor: multiplies the angular velocity that a plastic impact leaves.
        tilt: β of the support [rad].

    Raises:
        InputError: ranges that hold no body, or a body that falls by itself.
    """

    slenderness: Range = Range(0.05, 0.6, LOG_UNIFORM)
    half_diagonal: Range = Range(0.2, 2.0, LOG_UNIFORM)
    cg_offset: Range = Range(-0.2, 0.2)
    restitution_factor: Range = Range(0.5, 1.0)
    tilt: Range = Range(0.0, 0.0)

    def __post_init__(self) -> None:
        if not 0.0 < self.slenderness.low <= self.slenderness.high < math.pi / 2:
            raise InputError(f"slenderness must lie between 0 and π/2 rad, got {self.slenderness}")
        if self.half_diagonal.low <= 0.0:
            raise InputError(f"half_diagonal must be above 0 m, got {self.half_diagonal}")
        if not -0.5 < self.cg_offset.low <= self.cg_offset.high < 0.5:
            raise InputError(f"cg_offset must lie between -0.5 and 0.5, got {self.cg_offset}")
        if not 0.0 < self.restitution_factor.low <= self.restitution_factor.high <= 1.0:
            raise InputError(
                f"restitution_factor must lie in (0, 1], got {self.restitution_factor}"
            )
        offset = max(abs(self.cg_offset.low), abs(self.cg_offset.high))
        steepest = max(abs(self.tilt.low), abs(self.tilt.high))
        least = math.atan((1.0 - 2.0 * offset) * math.tan(self.slenderness.low))
        if steepest >= least:
            raise InputError(
                f"a tilt of {steepest:g} rad overturns the most slender body of these ranges, "
                f"whose angle to the nearer corner is {least:.4g} rad"
            )

    @classmethod
    def around(cls, depth: float, height: float) -> Prior:
        """Ranges about a body whose sizes [m] were measured, and that is nearly a rectangle.

        The factors on its slenderness and its half diagonal are ABOUT_SLENDERNESS and ABOUT_SIZE.
        """
        body = Body.rectangle(depth, height)
        alpha, r = body.slenderness_right, math.hypot(body.right, body.cg_height)
        least, most = (alpha * factor for factor in ABOUT_SLENDERNESS)
        return cls(
            slenderness=Range(least, min(most, 1.5), LOG_UNIFORM),
            half_diagonal=Range(r * ABOUT_SIZE[0], r * ABOUT_SIZE[1], LOG_UNIFORM),
        )

    def sample(self, members: int, seed: int = 0) -> BodyEnsemble:
        """Bodies spread evenly over the ranges, by Sobol's sequence.

        Args:
            members: how many; powers of two are spread best.
            seed: of the sequence's scrambling.
        """
        from scipy.stats import qmc

        require_whole("members", members)
        sequence = qmc.Sobol(len(PARAMETERS), rng=np.random.default_rng(seed))
        shares = sequence.random_base2(math.ceil(math.log2(members)))[:members]
        ranges = [getattr(self, field.name) for field in fields(self)]
        return BodyEnsemble(
            np.column_stack([r.at(s) for r, s in zip(ranges, shares.T, strict=True)])
        )


@dataclass(frozen=True, eq=False)
class BodyEnsemble:
    """Bodies that may be the one that was tested.

    Attributes:
        values: their parameters in the order of PARAMETERS, shape (member, parameter).
    """

    values: NDArray[np.float64]

    def of(self, parameter: str) -> NDArray[np.float64]:
        """The values of a parameter, shape (member,)."""
        return self.values[:, list(PARAMETERS).index(parameter)]

    @property
    def bodies(self) -> list[Body]:
        return [rectangle(*row[:4]) for row in self.values.tolist()]


def rectangle(
    slenderness: float, half_diagonal: float, cg_offset: float, restitution_factor: float
) -> Body:
    """The rectangle with these parameters; units as in `Prior`."""
    return Body.rectangle(
        2.0 * half_diagonal * math.sin(slenderness),
        2.0 * half_diagonal * math.cos(slenderness),
        eccentricity=0.5 + cg_offset,
        restitution_factor=restitution_factor,
    )
