"""The tilt that a body needs, by the published curves and by simulation, and what it does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import C1, gcor, scor, scor_c1, tilt_for
from shaketable.errors import InputError, require_number
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import ends, resamples
from shaketable.simulate import Trial, fell, require_stable
from shaketable.support import Support
from shaketable.tilting.counts import count_outcomes, steepest
from shaketable.tilting.curves import Interval, TiltCurves, curves_of, share_interval
from shaketable.tilting.rates import downhill_share, fall_share
from shaketable.units import degrees

TILTS = np.radians(np.arange(0.0, 10.01, 0.25))  # those that are tried
CONTROL = 0.95  # the share that is wanted by default
SLIDES = 0.01  # m: a smaller slip counts as staying


@dataclass(frozen=True, kw_only=True)
class TiltEffect:
    """What a support of one tilt does to a body; intervals have the level CONFIDENCE.

    Attributes:
        tilt: β [rad].
        simulations, falls, downhill: how many, in both directions of every motion.
        downhill_share: share of the falls, NaN if they are too few to tell.
        downhill_binomial: Wilson's interval for it, the recordings with falls as experiments; NaN
            likewise.
        downhill_interval: its interval by bootstrap over recordings; it has no width where all
            falls go downhill.
        fall_share, fall_share_interval: share of the simulations that overturn the body, and
            Wilson's interval with the recordings as experiments.
        likelier, likelier_interval: that share divided by the one on a level support.
        gcor, scor: share of the falls that go downhill by the published curves.
        slides_share: share of the simulations in which the body stays upright and slides more
            than SLIDES; NaN with the rocking model.
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
        recording_count, motion_count: how many the simulation used.
        gcor_tilt, scor_tilt: that tilt by the published curves [rad]; infinite beyond their limit,
            NaN where SCOR has no curve.
        curves: shares over the tilt by simulation, with its control tilt.
        level, effect: the effect without tilt, and at the simulated tilt if there is one.
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
    """How far [m] the uphill edge of a base or a board stands above the other edge.

    Args:
        length: of the base or the board [m].
        tilt: [rad].
    """
    return length * math.sin(tilt)


def require_control(control: float) -> None:
    """InputError unless a share of falls can be asked for."""
    require_number("control", control)
    if not 0.5 < control < 1.0:
        raise InputError(f"control must lie between 0.5 and 1, got {control!r}")


def design_tilt(
    body: Body,
    motions: Sequence[Motion],
    *,
    control: float = CONTROL,
    scale: float = 1.0,
    model: Model | str | None = None,
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
        model: as for simulate_many.
        seed: seed of the bootstrap.
        progress: as for simulate_many.

    Raises:
        InputError: values out of range.
    """
    require_control(control)
    trial = Trial(motions, scale, model_of(model))
    tilts = TILTS[(steepest([body], trial.model) > TILTS) | (TILTS == 0.0)]
    total = 2 * len(trial.motions) * (tilts.size + 3)
    with meter("tilting", total, progress) as done:
        counts = count_outcomes([body], trial, tilts, progress=done)
        curves = curves_of(counts, resamples(counts.recordings, seed=seed), control)
        effect = partial(effect_of, body, trial, seed=seed, progress=done)
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
    model: Model | str | None = None,
    seed: int = 0,
    progress: Progress = True,
) -> TiltEffect:
    """What a support of a given tilt [rad] does; the other arguments as for `design_tilt`.

    Raises:
        InputError: values out of range, or a tilt on which the body falls or slides by itself.
    """
    return effect_of(
        body, Trial(motions, scale, model_of(model)), tilt, seed=seed, progress=progress
    )


def effect_of(
    body: Body, trial: Trial, tilt: float, *, seed: int, progress: Progress
) -> TiltEffect:
    """`tilt_effect` for the motions and the model of a trial."""
    Support(tilt=tilt)  # raises InputError for a tilt out of range
    if tilt < 0.0:
        raise InputError(f"the tilt must not be negative, got {degrees(tilt):.4g}°")
    require_stable([body], tilt)
    limit, slides = float(steepest([body], trial.model)[0]), trial.model.slides
    if tilt > 0.0 and not tilt < limit:
        raise InputError(
            f"a tilt of {degrees(tilt):.4g}° is too near to the one on which it falls"
            + (" or slides" if slides else "")
            + f" by itself: take one below {degrees(limit):.4g}°"
            + (" or more friction" if slides else "")
        )
    tilts = np.array([0.0, tilt] if tilt else [0.0])
    counts = count_outcomes([body], trial, tilts, progress=progress)
    weights = resamples(counts.recordings, seed=seed)
    shares, falls = downhill_share(counts, weights)[:, 0, -1], fall_share(counts, weights)[:, 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        likelier = falls[:, -1] / falls[:, 0]
    by_recording, downhill = counts.falls[0, -1], int(counts.downhill[0, -1].sum())
    fallen = int(by_recording.sum())
    return TiltEffect(
        tilt=tilt,
        simulations=int(counts.simulations.sum()),
        falls=fallen,
        downhill=downhill,
        downhill_share=float(shares[0]),
        downhill_binomial=share_interval(float(shares[0]), int((by_recording > 0).sum())),
        downhill_interval=ends(shares[1:]),
        fall_share=float(falls[0, -1]),
        fall_share_interval=share_interval(float(falls[0, -1]), counts.recordings),
        likelier=float(likelier[0]),
        likelier_interval=ends(likelier[1:]),
        gcor=float(gcor(tilt)),
        scor=float(scor(tilt, body.width, 2 * body.cg_height)),
        slides_share=_slides(body, trial, tilt) if trial.model.slides else np.nan,
    )


def _slides(body: Body, trial: Trial, tilt: float) -> float:
    """Share of the simulations in which the body stays upright and slides more than SLIDES."""
    runs = trial.run([body], [tilt], progress=False)
    farthest = np.maximum(runs.slip_downhill, runs.slip_uphill)
    return float((~fell(runs) & (farthest > SLIDES)).mean())
