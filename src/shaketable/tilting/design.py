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
from shaketable.simulate import ShakingSet, require_stable
from shaketable.simulate.kinds import PLANE
from shaketable.simulate.standing import model_for_solids
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.surroundings import Surroundings
from shaketable.tilting.counts import TiltCounts, steepest
from shaketable.tilting.curves import Interval, TiltCurves, curves_of, share_interval
from shaketable.tilting.rates import downhill_share, fall_share
from shaketable.tilting.stands import BodyStand, SolidStand, TiltedBody
from shaketable.units import degrees

TILTS = np.radians(np.arange(0.0, 10.01, 0.25))  # those that are tried
CONTROL = 0.95  # the share that is wanted by default


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
        straight_share: share of a solid's falls that go downhill within 45°, NaN if they are too
            few to tell, and in a plane.
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
    straight_share: float
    gcor: float
    scor: float
    slides_share: float


@dataclass(frozen=True, kw_only=True, eq=False)
class TiltDesign:
    """The tilt from which on a wanted share of a body's falls goes downhill.

    Attributes:
        body: what stands on the support; of a solid its section along the tilt.
        control: wanted share.
        recording_count, motion_count: how many the simulation used.
        turns: in how many ways a solid was turned to the motions; 1 in a plane.
        gcor_tilt, scor_tilt: that tilt by the published curves [rad]; infinite beyond their limit,
            NaN where SCOR has no curve.
        curves: shares over the tilt by simulation, with its control tilt.
        level, effect: the effect without tilt, and at the simulated tilt if there is one.
    """

    body: Body
    control: float
    recording_count: int
    motion_count: int
    turns: int
    gcor_tilt: float
    scor_tilt: float
    curves: TiltCurves
    level: TiltEffect
    effect: TiltEffect | None


def shim_height(length: float, tilt: float) -> float:
    """Return the height [m] of the wedge that tilts a base or a board.

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
    body: Body | Solid,
    motions: Sequence[Motion],
    *,
    control: float = CONTROL,
    azimuth: float = math.pi,
    scale: float = 1.0,
    model: Model | str | None = None,
    surroundings: Surroundings | None = None,
    seed: int = 0,
    progress: Progress = True,
) -> TiltDesign:
    """Find the smallest tilt that sends the share `control` of a body's falls downhill.

    Args:
        body: what stands on the support; SCOR takes it for a rectangle of twice the height of
            its centre of gravity. A Solid is turned in TURNS ways to the motions.
        motions: at least one; each counts in both directions. Of a Solid each should have both
            horizontal components.
        control: wanted share of the falls, in (0.5, 1).
        azimuth: of a Solid, the direction of its base that is downhill, from its x toward its y
            [rad]; π, toward -x, for planar bodies.
        scale: factor on the motions.
        model: as for simulate_many.
        surroundings: what stands beside the body and holds it, as for simulate; of a Solid in its
            own directions, and turned with it.
        seed: seed of the bootstrap.
        progress: as for simulate_many.

    Raises:
        InputError: values out of range.
    """
    require_control(control)
    stand = stand_of(body, motions, azimuth, scale, model, surroundings)
    section = stand.body
    tilts = TILTS[(steepest([section], stand.trial.model) > TILTS) | (TILTS == 0.0)]
    total = 2 * len(stand.trial.motions) * stand.turns * (tilts.size + 3)
    with meter("tilting", total, progress) as done:
        counts = stand.count(tilts, done)
        curves = curves_of(counts, resamples(counts.recordings, seed=seed), control)
        effect = partial(effect_of, stand, seed=seed, progress=done)
        level = effect(0.0)
        found = effect(curves.control_tilt) if math.isfinite(curves.control_tilt) else None
    return TiltDesign(
        body=section,
        control=control,
        recording_count=counts.recordings,
        motion_count=len(motions),
        turns=stand.turns,
        gcor_tilt=tilt_for(control, C1),
        scor_tilt=tilt_for(control, scor_c1(section.base, 2 * section.cg_height)),
        curves=curves,
        level=level,
        effect=found,
    )


def tilt_effect(
    body: Body | Solid,
    motions: Sequence[Motion],
    tilt: float,
    *,
    azimuth: float = math.pi,
    scale: float = 1.0,
    model: Model | str | None = None,
    surroundings: Surroundings | None = None,
    seed: int = 0,
    progress: Progress = True,
) -> TiltEffect:
    """Simulate the effect of a given tilt [rad]; other arguments as for `design_tilt`.

    Raises:
        InputError: values out of range, or a tilt on which the body falls or slides by itself.
    """
    stand = stand_of(body, motions, azimuth, scale, model, surroundings)
    return effect_of(stand, tilt, seed=seed, progress=progress)


def stand_of(
    body: Body | Solid,
    motions: Sequence[Motion],
    azimuth: float,
    scale: float,
    model: Model | str | None,
    surroundings: Surroundings | None = None,
) -> TiltedBody:
    """What is tilted and how it is shaken; arguments as for `design_tilt`."""
    if isinstance(body, Solid):
        require_number("azimuth", azimuth)
        trial = ShakingSet(motions, scale, model_for_solids(model), surroundings)
        return SolidStand(body, azimuth, trial)
    PLANE.require_axes(azimuth, 0.0)
    return BodyStand(body, ShakingSet(motions, scale, model_of(model), surroundings))


def effect_of(stand: TiltedBody, tilt: float, *, seed: int, progress: Progress) -> TiltEffect:
    """`tilt_effect` for what is tilted."""
    body, trial = stand.body, stand.trial
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
    counts = stand.count(tilts, progress)
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
        straight_share=_straight(counts, float(shares[0])),
        gcor=float(gcor(tilt)),
        scor=float(scor(tilt, body.base, 2 * body.cg_height)),
        slides_share=stand.slides(tilt) if trial.model.slides else np.nan,
    )


def _straight(counts: TiltCounts, downhill: float) -> float:
    """Share of the falls on the last tilt that go straight downhill, where `downhill` is known."""
    if counts.straight is None or math.isnan(downhill):
        return math.nan
    return float(counts.straight[0, -1].sum() / counts.falls[0, -1].sum())
