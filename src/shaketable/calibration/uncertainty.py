"""A body that is not known exactly under a motion that is not known exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_number, require_whole
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import wilson_interval
from shaketable.simulate import fell, simulate_each
from shaketable.support import Support

MEMBERS = 1024
LEAST_FOOT = 0.02  # of the base: no foot of the centre of gravity lies nearer to a corner


@dataclass(frozen=True, kw_only=True)
class Uncertainty:
    """Standard deviations of uncertain parameters; 0 fixes a parameter.

    Args:
        slenderness: of the logarithm of the base at the same height.
        size: of the logarithm of the body's size at the same shape.
        cg_offset: of the centre of gravity's foot, as a share of the base.
        restitution: of the logarithm of the share of a plastic impact's angular velocity that is
            left; it varies downwards only, for that share is the most that there can be.
        tilt: of the support [rad].
        motion: of the logarithm of the factor on the motion.

    Raises:
        InputError: one that is negative or not finite.
    """

    slenderness: float = 0.05
    size: float = 0.02
    cg_offset: float = 0.03
    restitution: float = 0.1
    tilt: float = 0.005
    motion: float = 0.1

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            require_number(f"Uncertainty.{field.name}", value)
            if not (math.isfinite(value) and value >= 0.0):
                raise InputError(
                    f"Uncertainty.{field.name} must be finite and not negative, got {value!r}"
                )

    def only(self, name: str) -> Uncertainty:
        """The same uncertainty of one quantity, and none of the others."""
        kept = {field.name: 0.0 for field in fields(self) if field.name != name}
        return replace(self, **kept)


class Probability(NamedTuple):
    """A share of an ensemble that falls.

    Attributes:
        value: the share.
        low, high: Wilson's interval for as many independent members; it tells how well the
            ensemble is sampled, not whether the uncertainty is right.
        members: of the ensemble.
    """

    value: float
    low: float
    high: float
    members: int


def overturning_probability(
    body: Body,
    motion: Motion,
    uncertainty: Uncertainty,
    n: int = MEMBERS,
    *,
    support: Support | None = None,
    scale: float = 1.0,
    model: Model | str | None = None,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> Probability:
    """Estimate the probability that an uncertain body overturns under an uncertain motion.

    Args:
        body, motion, support, scale: in the middle of what is possible.
        uncertainty: about them.
        n: members of the ensemble, spread by Sobol's sequence.
        model, progress, threads: as for `simulate_many`.
        seed: of the sequence's scrambling.

    Raises:
        InputError: what `simulate_many` cannot simulate, or an ensemble of no members.
    """
    model = model_of(model)
    if body.restitution_factor is None:
        body = replace(body, restitution_factor=model.restitution_factor)
    beta = (support or Support()).tilt
    bodies, tilts, factors = uncertain(body, beta, uncertainty, n, seed)
    runs = simulate_each(
        bodies,
        motion,
        tilts=tilts,
        scales=scale * factors,
        model=model,
        progress=progress,
        threads=threads,
    )
    share = float(fell(runs).mean())
    low, high = wilson_interval(share, n)
    return Probability(share, float(low), float(high), n)


def uncertain(
    body: Body, tilt: float, uncertainty: Uncertainty, n: int, seed: int = 0
) -> tuple[list[Body], NDArray[np.float64], NDArray[np.float64]]:
    """Bodies, tilts [rad] and factors on the motion, n of each.

    A body without a restitution factor of its own keeps the model's, which is then certain. No body
    falls by itself: what would is brought back to nearly where it stands.
    """
    from scipy.special import ndtri
    from scipy.stats import qmc

    require_whole("n", n)
    sequence = qmc.Sobol(len(fields(Uncertainty)), rng=np.random.default_rng(seed))
    shares = sequence.random_base2(math.ceil(math.log2(n)))[:n] if n > 1 else np.full((1, 6), 0.5)
    normal = ndtri(np.clip(shares, 1e-9, 1.0 - 1e-9))
    of = dict(zip((field.name for field in fields(Uncertainty)), normal.T, strict=True))
    wide = np.exp(uncertainty.slenderness * of["slenderness"])
    large = np.exp(uncertainty.size * of["size"])
    foot = body.left / body.base + uncertainty.cg_offset * of["cg_offset"]
    foot = np.clip(foot, LEAST_FOOT, 1.0 - LEAST_FOOT)
    own = body.restitution_factor
    kept = np.exp(-uncertainty.restitution * np.abs(of["restitution"]))
    bodies = [
        replace(
            body,
            base=body.base * w * s,
            cg_height=body.cg_height * s,
            left=body.base * w * s * f,
            gyration_radius=body.gyration_radius * s,
            restitution_factor=own and k * own,
        )
        for w, s, f, k in zip(*(x.tolist() for x in (wide, large, foot, kept)), strict=True)
    ]
    low, high = np.array([one.standing_range for one in bodies]).T * (1.0 - LEAST_FOOT)
    tilts = np.clip(tilt + uncertainty.tilt * of["tilt"], low, high)
    factors = np.exp(uncertainty.motion * of["motion"])
    return bodies, tilts, factors
