"""The tilt that a body needs, by the published curves and by simulation, and what it does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import C1, gcor, scor, scor_c1, tilt_for
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.recordings import CONFIDENCE, pair, resamples
from shaketable.response import Outcome
from shaketable.simulate import require_model, require_stable, simulate_many
from shaketable.support import Support
from shaketable.tilting.counts import TILT_RESERVE, count_outcomes, stands_at
from shaketable.tilting.curves import Interval, TiltCurves, curves_of
from shaketable.tilting.rates import control_share, fall_share
from shaketable.units import degrees

TILTS = np.radians(np.arange(0.0, 10.01, 0.25))
DRAWS = 1000
SLIDES = 0.01  # m: who slides farther than this slides


@dataclass(frozen=True, kw_only=True)
class TiltEffect:
    """What a support of one tilt does to a body; intervals are of CONFIDENCE.

    Attributes:
        tilt: β [rad].
        simulations, falls, downhill: how many, in both directions of every motion.
        control: share of the falls that go downhill, NaN if they are too few to tell.
        control_binomial: Wilson's interval of it, as if every fall were an experiment.
        control_interval: by bootstrap over recordings; narrower than it is where all falls go
            downhill.
        fall_share, fall_share_interval: share of the simulations that overturn the body.
        likelier, likelier_interval: that share over the one on a level support.
        gcor, scor: control by the published curves.
        slides_share: share of the simulations in which it stays upright and slides more than
            SLIDES; NaN with the rocking model.
    """

    tilt: float
    simulations: int
    falls: int
    downhill: int
    control: float
    control_binomial: Interval
    control_interval: Interval
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
        recordings, motions: how many the simulation took.
        gcor_tilt, scor_tilt: by the published curves [rad]; infinite beyond their limit, NaN
            where SCOR has no curve.
        curves: by simulation, with the tilt.
        level, effect: without tilt, and at the simulated tilt if there is one.
    """

    body: Body
    control: float
    recordings: int
    motions: int
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
    control: float = 0.95,
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
    stands = stands_at([body], TILTS, model, support)[0]
    total = 2 * len(motions) * (int(stands.sum()) + 3)
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
        counts = count(TILTS[stands])
        curves = curves_of(counts, resamples(counts.falls.shape[2], DRAWS, seed), control)
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
        found = effect(curves.tilt) if math.isfinite(curves.tilt) else None
    return TiltDesign(
        body=body,
        control=control,
        recordings=counts.falls.shape[2],
        motions=len(motions),
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
    from statsmodels.stats.proportion import proportion_confint

    support = _checked(motions, scale, model, support)
    Support(tilt=tilt)  # its range
    require_stable([body], tilt)
    tilts = np.array([0.0, tilt])[0 if tilt else 1 :]
    if not stands_at([body], tilts, model, support).all():
        limit = degrees(min(body.slenderness_left, math.atan(support.static_friction)))
        raise InputError(
            f"a tilt of {degrees(tilt):.4g}° is beyond the one at which it slides or falls by "
            f"itself, {limit:.4g}°, less {degrees(TILT_RESERVE):g}° of reserve"
        )
    counts = count_outcomes(
        [body], motions, tilts, scale=scale, model=model, support=support, progress=progress
    )
    weights = resamples(counts.falls.shape[2], DRAWS, seed)
    shares, falls = control_share(counts, weights)[:, 0, -1], fall_share(counts, weights)[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        likelier = falls[:, -1] / falls[:, 0]
    fell, downhill = int(counts.falls[0, -1].sum()), int(counts.downhill[0, -1].sum())
    binomial = proportion_confint(downhill, fell, 1 - CONFIDENCE, method="wilson") if fell else None
    return TiltEffect(
        tilt=tilt,
        simulations=int(counts.simulations.sum()),
        falls=fell,
        downhill=downhill,
        control=float(shares[0]),
        control_binomial=binomial or (math.nan, math.nan),
        control_interval=pair(shares[1:]),
        fall_share=float(falls[0, -1]),
        fall_share_interval=pair(falls[1:, -1]),
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
    if not (np.isfinite(scale) and scale > 0.0):
        raise InputError(f"scale must be a positive finite number, got {scale!r}")
    if support.tilt != 0.0:
        raise InputError("the support's own tilt must be 0: tilts are what is tried")
    return support


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
