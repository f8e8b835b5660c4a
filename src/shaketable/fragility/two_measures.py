"""One fragility function of two measures at once, of bodies of all sizes and slendernesses.

What a slender block does under a motion depends on p·PGV/(g tan α) and PGA/(g tan α), and on the
shape of the motion: the equation of rocking holds nothing else (Dimitrakopoulos E.G., Paraskeva
T.S. (2015) Dimensionless fragility curves for rocking response to near-fault excitations,
Earthquake Engng Struct. Dyn. 44(12):2015-2033). The probability that the block reaches a state is
Φ(c₀ + c₁ ln(p·PGV/(g tan α)) + c₂ ln(PGA/(g tan α))), by maximum likelihood over all bodies,
motions and scales under which it moves; below PGA = g tan α it does not, and the probability is 0.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.capacities import tipping_scales
from shaketable.fragility.cloud import cloud_of
from shaketable.fragility.intensities import intensities
from shaketable.fragility.limit_states import OVERTURNS, SLIDES, LimitState
from shaketable.fragility.limit_states import limit_state as state_of
from shaketable.fragility.lognormal import (
    AT_ONCE,
    MIN_FITTED_SHARE,
    Points,
    basic_limits,
    fit_many,
    ndtr,
    scored,
)
from shaketable.fragility.pulse_borders import size_of
from shaketable.models import General, Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS, ends, events_of, nested_resamples, recordings_of
from shaketable.signal import measure_named
from shaketable.simulate import listed
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import pandas as pd

log = logging.getLogger(__name__)

BOTH = "both, dimensionless"
NAMES = ("PGA", "PGV", "PGA/(g tan α)", "p·PGV/(g tan α)", BOTH)


@dataclass(frozen=True, kw_only=True, eq=False)
class VectorFragility:
    """The probability of a state from two measures, for blocks of any size.

    Attributes:
        state: that is reached.
        coefficients: c₀, c₁ and c₂, of what was observed, then of the draws of a bootstrap, (1 +
            draw, 3).
        least: PGA/(g tan α) below which nothing rocks: 1, or less where vertical motion lightened
            a body.
        compared: how much each measure, and both, tell of all bodies together, of those
            simulations in which a body can move: a row for each with the dispersion of the factor
            on a motion that the state takes, and its 95 % interval.
        slenderness: the least and the largest α of the bodies [rad].
        size: the least and the largest p [rad/s].
        recordings, events: how many independent experiments there are.
    """

    state: LimitState
    coefficients: NDArray[np.float64]
    least: float
    compared: pd.DataFrame
    slenderness: tuple[float, float]
    size: tuple[float, float]
    recordings: int
    events: int

    @property
    def intervals(self) -> NDArray[np.float64]:
        """95 % intervals of the coefficients, (3, 2); NaN without draws."""
        if np.isfinite(self.coefficients[1:, 0]).sum() < MIN_FITTED_SHARE * len(self.coefficients):
            return np.full((3, 2), np.nan)
        observed = self.coefficients[0]
        return np.array([ends(2.0 * observed[k] - self.coefficients[1:, k]) for k in range(3)])

    @property
    def dispersion(self) -> float:
        """Of the factor on a motion that the state takes, where both measures are known."""
        return float(1.0 / self.coefficients[0, 1:].sum())

    def probability(self, body: Body, pgv: ArrayLike, pga: ArrayLike) -> NDArray[np.float64]:
        """That a body reaches the state under a PGV [m/s] and a PGA [m/s²], which are broadcast.

        A body outside of the sizes and slendernesses of those that were simulated is warned of.

        Raises:
            InputError: a negative measure.
        """
        p, slenderness = size_of(body)
        for value, (low, high), what in (
            (p, self.size, "p [rad/s]"), (slenderness, self.slenderness, "α [rad]"),
        ):  # fmt: skip
            if not low * (1.0 - 1e-9) <= value <= high * (1.0 + 1e-9):
                log.warning(
                    "%s: %s is %.3g, those of the bodies that were simulated lie between %.3g and "
                    "%.3g", body.name or "the body", what, value, low, high,
                )  # fmt: skip
        g_tan = STANDARD_GRAVITY * math.tan(slenderness)
        velocity, acceleration = np.asarray(pgv, np.float64), np.asarray(pga, np.float64)
        return self.at(p * velocity / g_tan, acceleration / g_tan)

    def at(
        self, velocity: NDArray[np.float64], acceleration: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """The same at p·PGV/(g tan α) and PGA/(g tan α), which are broadcast."""
        if (velocity < 0.0).any() or (acceleration < 0.0).any():
            raise InputError("PGV and PGA must not be negative")
        c0, c1, c2 = self.coefficients[0]
        with np.errstate(divide="ignore"):
            share = ndtr(c0 + c1 * np.log(velocity) + c2 * np.log(acceleration))
        return np.where(acceleration <= self.least, 0.0, share)


def vector_fragility(
    bodies: Body | Sequence[Body],
    motions: Sequence[Motion],
    *,
    limit_state: str = OVERTURNS,
    scales: ArrayLike | None = None,
    polarities: ArrayLike = (1, -1),
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> VectorFragility:
    """The probability of a state from p·PGV/(g tan α) and PGA/(g tan α), of bodies together.

    Args:
        bodies: one or more, on a level support.
        motions, scales, polarities, model, draws, seed, progress, threads: as for `fragility`.
        limit_state: one of them.

    Raises:
        InputError: what `simulate_many` says; sliding, or a friction at which bodies slide before
            they rock; or simulations that do not tell, as all or none of them reach the state,
            or as it becomes less likely the stronger they are.
    """
    import pandas as pd

    bodies = [bodies] if isinstance(bodies, Body) else listed("bodies", bodies, Body)
    motions = listed("motions", motions, Motion)
    state, model = state_of(limit_state), model_of(model)
    if state.kind == SLIDES:
        raise InputError(f"{state.name!r}: sliding depends on friction, not on p and g tan α")
    recording, event = recordings_of(motions), events_of(motions)
    sizes = np.array([size_of(body) for body in bodies])
    _require_rocking(model, sizes)
    counts, tried = cloud_of(
        bodies, motions, [state], scales=scales, tilt=0.0, polarities=polarities, model=model,
        progress=progress, threads=threads,
    )  # fmt: skip
    reached = counts.reached[:, 0].ravel()
    g_tan = STANDARD_GRAVITY * np.tan(sizes[:, 1])
    shape = (len(bodies), len(motions), tried.size)
    pga, pgv = (
        np.broadcast_to(intensities(motions, measure_named(name), tried), shape)
        for name in ("PGA", "PGV")
    )
    acceleration = (pga / g_tan[:, None, None]).ravel()
    velocity = (pgv * (sizes[:, 0] / g_tan)[:, None, None]).ravel()
    of_point = np.tile(np.repeat(recording, tried.size), len(bodies))
    weights = nested_resamples(event, draws, seed)
    least, tipping = _movable(bodies, motions, g_tan)
    moves = (tried > tipping[:, :, None]).ravel()
    rest = reached[moves], np.full(moves.sum(), counts.trials), of_point[moves]
    often = rest[0].sum()
    if not 0 < often < rest[1].sum():
        found = "all" if often else "none"
        raise InputError(
            f"{found} of the simulations in which a body can move reach {state.name!r}: there is "
            "nothing to tell from both measures"
        )
    each = [
        fit_many(Points(im[moves], *rest), weights).beta
        for im in (pga.ravel(), pgv.ravel(), acceleration, velocity)
    ]
    coefficients = _fitted(velocity[moves], Points(acceleration[moves], *rest), weights)
    together = coefficients[:, 1:].sum(axis=1)
    if not (coefficients[0, 1:] > 0.0).all():
        raise InputError(
            f"{state.name!r} cannot be told from both measures: what reaches it is parted sharply "
            "from what does not, or becomes less likely with one of them; give more motions"
        )
    each.append(1.0 / np.where(together > 0.0, together, np.nan))
    return VectorFragility(
        state=state,
        coefficients=coefficients,
        least=least,
        compared=pd.DataFrame(
            {
                "measure": NAMES,
                "dispersion": [one[0] for one in each],
                "low": [basic_limits(one)[0] for one in each],
                "high": [basic_limits(one)[1] for one in each],
            }
        ),
        slenderness=(float(sizes[:, 1].min()), float(sizes[:, 1].max())),
        size=(float(sizes[:, 0].min()), float(sizes[:, 0].max())),
        recordings=int(recording.max()) + 1,
        events=int(event.max()) + 1,
    )


def _fitted(
    velocity: NDArray[np.float64], points: Points, weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """c₀, c₁ and c₂ of each set of weights, (set, 3); points are at accelerations."""
    logarithms = np.log(np.stack([velocity, points.intensity]))
    center = logarithms.mean(axis=1, keepdims=True)
    columns = np.concatenate([np.ones((1, velocity.size)), logarithms - center])
    some = max(1, AT_ONCE // velocity.size)
    parts = []
    for k in range(0, len(weights), some):
        often = weights[k : k + some][:, points.recording]
        parts.append(scored(columns, often * points.reached, often * points.trials))
    found = np.concatenate(parts)
    found[:, 0] -= found[:, 1:] @ center[:, 0]
    return found


def _movable(
    bodies: Sequence[Body], motions: Sequence[Motion], g_tan: NDArray[np.float64]
) -> tuple[float, NDArray[np.float64]]:
    """PGA/(g tan α) below which none tips, and the scale from which each may, (body, motion)."""
    scales = np.stack([tipping_scales(bodies, motion) for motion in motions], axis=1)
    peaks = np.array([np.abs(motion.horizontal).max() for motion in motions])
    return float((scales * peaks / g_tan[:, None]).min()), scales


def _require_rocking(model: Model, sizes: NDArray[np.float64]) -> None:
    """InputError unless friction lets the bodies rock before they slide."""
    needed = float(np.tan(sizes[:, 1]).max())
    if isinstance(model, General) and model.static_friction < needed:
        raise InputError(
            f"with a friction of {model.static_friction:g} a body of tan α = {needed:.3g} slides "
            "before it rocks: p·PGV and g tan α do not tell what it does"
        )
