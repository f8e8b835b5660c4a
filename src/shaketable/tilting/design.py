"""The tilt that a body needs, by the published curves and by simulation, and what it does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import C1, gcor, scor, scor_c1, tilt_for
from shaketable.errors import InputError, require_positive
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.recordings import binomial_interval, pair, resamples
from shaketable.response import Outcome
from shaketable.simulate import require_model, require_stable, simulate_many
from shaketable.support import Support
from shaketable.tilting.counts import count_outcomes, steepest
from shaketable.tilting.curves import Interval, TiltCurves, curves_of
from shaketable.tilting.rates import downhill_share, fall_share
from shaketable.units import degrees

TILTS = np.radians(np.arange(0.0, 10.01, 0.25))
CONTROL = 0.95  # wanted, by default
SLIDES = 0.01  # m: less than this counts as staying


@dataclass(frozen=True, kw_only=True)
class TiltEffect:
    """What a support of one tilt does to a body; intervals are of CONFIDENCE.

    Attributes:
        tilt: β [rad].
        simulations, falls, downhill: how many, in both directions of every motion.
        downhill_share: of the falls, NaN if they are too few to tell.
        downhill_binomial: Wilson's interval of it, as if every fall were an experiment.
        downhill_interval: by bootstrap over recordings; it has no width where all falls go
            downhill.
        fall_share, fall_share_interval: share of the simulations that overturn the body; where
            none or all do, Wilson's interval, with the motions as experiments.
        likelier, likelier_interval: that share over the one on a level support.
        gcor, scor: share of the falls that go downhill by the published curves.
        slides_share: share of the simulations in which it stays upright and slides more than
            SLIDES; NaN with the rocking model.
    """

    tilt: float
    simulations: int
    falls: int
    downhill: int
    downhill_share: float
    downhill_binomial: Interval
    downhill_interval: Interval
    fall_share: float
    fall_share_interval: Interval
    likelier: float
    likelier_interval: Interval
    gcor: float
    scor: float
    slides_share: float


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltDesign:
    """The tilt from which on a wanted share of a body's falls goes downhill.

    Attributes:
        body: what stands on the support.
        control: wanted share.
        recording_count, motion_count: how many the simulation took.
        gcor_tilt, scor_tilt: by the published curves [rad]; infinite beyond their limit, NaN
            where SCOR has no curve.
        curves: by simulation, with the tilt.
        level, effect: without tilt, and at the simulated tilt if there is one.
    """

    body: Body
    control: float
    recording_count: int
    motion_count: int
    gcor_tilt: float
    scor_tilt: float
    curves: TiltCurves
    level: TiltEffect
    effect: TiltEffect | None


def shim_height(length: float, tilt: float) -> float:
    """How far [m] the uphill edge of a base or a board of that length [m] stands above the other.

    Args:
        tilt: [rad].
    """
    return length * math.sin(tilt)


def require_control(control: float) -> None:
    """InputError unless a share of falls can be wanted."""
    if not 0.5 < control < 1.0:
        raise InputError(f"control must lie between 0.5 and 1, got {control!r}")


def design_tilt(
    body: Body,
    motions: Sequence[Motion],
    *,
    control: float = CONTROL,
    scale: float = 1.0,
    model: str = "rocking",
    support: Support | None = None,
    seed: int = 0,
    progress: Progress = True,
) -> TiltDesign:
    """The smallest tilt that sends `control` of a body's falls downhill, and what it costs.

    Args:
        body: what stands on the support; SCOR takes it for a rectangle of twice the height of
            its centre of gravity.
        motions: at least one; each counts in both directions.
        control: wanted share of the falls, in (0.5, 1).
        scale: factor on the motions.
        model, support: as for simulate_many; the support's tilt must be 0.
        seed: of the bootstrap.
        progress: as for simulate_many.

    Raises:
        InputError: values out of range.
    """
    require_control(control)
    support = _checked(motions, scale, model, support)
    tilts = TILTS[(steepest([body], model, support) > TILTS) | (TILTS == 0.0)]
    total = 2 * len(motions) * (tilts.size + 3)
    with meter("tilting", total, progress) as done:
        count = partial(
            count_outcomes,
            [body],
            motions,
            scale=scale,
            model=model,
            support=support,
            progress=done,
        )
        counts = count(tilts)
        curves = curves_of(counts, resamples(counts.recordings, seed=seed), control)
        effect = partial(
            tilt_effect,
            body,
            motions,
            scale=scale,
            model=model,
            support=support,
            seed=seed,
            progress=done,
        )
        level = effect(0.0)
        found = effect(curves.control_tilt) if math.isfinite(curves.control_tilt) else None
    return TiltDesign(
        body=body,
        control=control,
        recording_count=counts.recordings,
        motion_count=len(motions),
        gcor_tilt=tilt_for(control, C1),
        scor_tilt=tilt_for(control, scor_c1(body.width, 2 * body.cg_height)),
        curves=curves,
        level=level,
        effect=found,
    )


def tilt_effect(
    body: Body,
    motions: Sequence[Motion],
    tilt: float,
    *,
    scale: float = 1.0,
    model: str = "rocking",
    support: Support | None = None,
    seed: int = 0,
    progress: Progress = True,
) -> TiltEffect:
    """What a support of that tilt [rad] does; arguments as for `design_tilt`.

    Raises:
        InputError: values out of range, or a tilt on which the body falls or slides by itself.
    """
    support = _checked(motions, scale, model, support)
    Support(tilt=tilt)  # raises what is out of range
    require_stable([body], tilt)
    limit = float(steepest([body], model, support)[0])
    if tilt > 0.0 and not tilt < limit:
        raise InputError(
            f"a tilt of {degrees(tilt):.4g}° is too near to the one on which it falls"
            + (" or slides" if model == "general" else "")
            + f" by itself: take one below {degrees(limit):.4g}°"
            + (" or more friction" if model == "general" else "")
        )
    tilts = np.array([0.0, tilt] if tilt else [0.0])
    counts = count_outcomes(
        [body], motions, tilts, scale=scale, model=model, support=support, progress=progress
    )
    weights = resamples(counts.recordings, seed=seed)
    shares, falls = downhill_share(counts, weights)[:, 0, -1], fall_share(counts, weights)[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        likelier = falls[:, -1] / falls[:, 0]
    fell, downhill = int(counts.falls[0, -1].sum()), int(counts.downhill[0, -1].sum())
    low, high = binomial_interval(downhill, fell)
    return TiltEffect(
        tilt=tilt,
        simulations=int(counts.simulations.sum()),
        falls=fell,
        downhill=downhill,
        downhill_share=float(shares[0]),
        downhill_binomial=(float(low), float(high)),
        downhill_interval=pair(shares[1:]),
        fall_share=float(falls[0, -1]),
        fall_share_interval=_fall_interval(falls[:, -1], len(motions)),
        likelier=float(likelier[0]),
        likelier_interval=pair(likelier[1:]),
        gcor=float(gcor(tilt)),
        scor=float(scor(tilt, body.width, 2 * body.cg_height)),
        slides_share=_slides(body, motions, tilt, scale, support) if model == "general" else np.nan,
    )


def _checked(
    motions: Sequence[Motion], scale: float, model: str, support: Support | None
) -> Support:
    support = support or Support()
    require_model(model)
    if not motions:
        raise InputError("a tilt is designed for at least one motion")
    require_positive("scale", scale)
    if support.tilt != 0.0:
        raise InputError("the support's own tilt must be 0: tilts are what is tried")
    return support


def _fall_interval(draws: NDArray[np.float64], motions: int) -> Interval:
    if 0.0 < draws[0] < 1.0:
        return pair(draws[1:])
    low, high = binomial_interval(draws[0] * motions, motions)
    return float(low), float(high)


def _slides(
    body: Body, motions: Sequence[Motion], tilt: float, scale: float, support: Support
) -> float:
    runs = simulate_many(
        [body],
        motions,
        tilts=[tilt],
        scales=[scale],
        support=support,
        model="general",
        progress=False,
    )
    farthest = np.maximum(runs.slip_downhill, runs.slip_uphill)
    return float(((runs.outcome == Outcome.STANDING) & (farthest > SLIDES)).mean())
