"""How a body at rest begins to move: it slides, rocks, or slides and rocks.

Shenton H.W. (1996) Criteria for initiation of slide, rock, and slide-rock rigid-body modes,
J. Eng. Mech. 122(7):690-693, for a symmetric block under horizontal acceleration; extended to
non-symmetric bodies and vertical acceleration by Boroschek R., Romo D. (2004) Overturning
criteria for non-anchored non-symmetric rigid bodies, 13th WCEE, paper 295 (eqs. 22-26).

With γ = h/b and κ = i²/b² for the corner that the body would rock on, at the distance b from
the foot of the centre of gravity, and A = |a_x|/(g + a_y):

    rest        A <= μ_s and A <= 1/γ
    rock        A > 1/γ and A <= (γ² μ_s + κ μ_s - γ)/(κ + 1 - γ μ_s)    (eq. 24)
    slide       otherwise, where μ_k <= 1/γ
    slide-rock  otherwise, where μ_k > 1/γ

The bound of eq. 24 holds while κ + 1 - γ μ_s > 0; with more friction rocking never slips, which
the paper does not say. The criteria hold for a level support and g + a_y > 0.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError


class Mode(IntEnum):
    """How a body at rest begins to move."""

    REST = 0
    SLIDE = 1
    ROCK = 2
    SLIDE_ROCK = 3


def shape_of(body: Body, direction: int) -> tuple[float, float]:
    """γ and κ of a body that would rock toward +x (direction 1) or -x (-1).

    The ground then accelerates the other way.
    """
    arm = body.right if direction > 0 else body.left
    return body.cg_height / arm, (body.gyration_radius / arm) ** 2


def slip_limit(friction: ArrayLike, height_ratio: float, inertia: float) -> NDArray[np.float64]:
    """The largest A at which rocking starts without slip (eq. 24); infinite if it never slips.

    Args:
        friction: static friction μ_s, any shape.
        height_ratio: γ.
        inertia: κ.
    """
    mu = np.asarray(friction, np.float64)
    below = inertia + 1 - height_ratio * mu
    with np.errstate(divide="ignore", invalid="ignore"):
        limit = (height_ratio**2 * mu + inertia * mu - height_ratio) / below
    return np.where(below > 0.0, limit, np.inf)


def initial_mode(
    acceleration: ArrayLike,
    static_friction: ArrayLike,
    kinetic_friction: ArrayLike,
    height_ratio: float,
    inertia: float,
) -> NDArray[np.int8]:
    """The Mode in which a body at rest begins to move.

    Args:
        acceleration: A = |a_x|/(g + a_y) [-].
        static_friction, kinetic_friction: μ_s and μ_k <= μ_s; all shapes broadcast together.
        height_ratio: γ = h/b.
        inertia: κ = i²/b².

    Raises:
        InputError: a negative acceleration or friction, or more kinetic than static friction.
    """
    a, mu, kinetic = np.broadcast_arrays(
        *(np.asarray(v, np.float64) for v in (acceleration, static_friction, kinetic_friction))
    )
    if not ((a >= 0).all() and (kinetic >= 0).all() and (kinetic <= mu).all()):
        raise InputError(
            "initial_mode needs acceleration >= 0 and 0 <= kinetic_friction <= static_friction"
        )
    tips = 1.0 / height_ratio
    rests = (a <= mu) & (a <= tips)
    rocks = (a > tips) & (a <= slip_limit(mu, height_ratio, inertia))
    return np.select(
        [rests, rocks, kinetic <= tips], [Mode.REST, Mode.ROCK, Mode.SLIDE], Mode.SLIDE_ROCK
    ).astype(np.int8)


def thresholds(
    static_friction: float, kinetic_friction: float, height_ratio: float, inertia: float
) -> list[tuple[Mode, float]]:
    """Each mode and the A = |a_x|/(g + a_y) beyond which it begins, rising; below all, rest.

    Args:
        static_friction, kinetic_friction: μ_s and μ_k <= μ_s.
        height_ratio: γ = h/b.
        inertia: κ = i²/b².
    """
    slips = Mode.SLIDE if kinetic_friction * height_ratio <= 1.0 else Mode.SLIDE_ROCK
    if static_friction * height_ratio <= 1.0:
        return [(slips, static_friction)]
    limit = float(slip_limit(static_friction, height_ratio, inertia))
    return [(Mode.ROCK, 1.0 / height_ratio)] + ([(slips, limit)] if np.isfinite(limit) else [])
