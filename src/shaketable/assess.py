"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.response import Outcome
from shaketable.simulate import require_stable, simulate_many
from shaketable.units import degrees, radians

if TYPE_CHECKING:
    import pandas as pd

CONFIDENCE = 0.95
ACCEPTED_FALLS = 0.10  # share of motions that may still overturn an object made safer
FEWEST_FALLS = 10  # below it no direction is judged
TILT_GRID_DEG = np.arange(0.0, 10.01, 0.5)
TILT_RESERVE = radians(0.25)  # between the largest tilt tried and the one at which it falls
BASE_GRID = np.r_[np.geomspace(0.25, 1.0, 13), np.geomspace(1.0, 6.0, 16)[1:]]  # times the width
FINER_BASES = 8  # widths tried between two of the grid
BODIES_AT_ONCE = 256  # bounds the memory of one call

#: Classes of overturning ratio by their upper limits (Kaneko & Hayashi 2004; physics.md 4).
RISK_CLASSES = {"low": 0.03, "medium": 0.3, "high": 0.7, "very high": np.inf}


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """Results of `assess`.

    Attributes:
        table: one row an item, in the inventory's order; units are in the columns' names.
        tilts_deg: the tilts tried, shape (t,).
        fall_share: share of simulations that overturn each item at each tilt, (item, t);
            NaN where the item falls by itself.
        downhill_share: share of those falls that go downhill, (item, t).
        control: wanted share of falls that go downhill.
        tilt_deg: tilt at which the items stand now.
        scale: factor on the motions.
        motions: their names.
    """

    table: pd.DataFrame
    tilts_deg: NDArray[np.float64]
    fall_share: NDArray[np.float64]
    downhill_share: NDArray[np.float64]
    control: float
    tilt_deg: float
    scale: float
    motions: tuple[str, ...]

    def worst_first(self) -> pd.DataFrame:
        """The table, what falls most on top."""
        return self.table.sort_values("fall_share", ascending=False, kind="stable")


@dataclass(frozen=True, eq=False)
class _Counts:
    """Outcomes of some bodies, (body, tilt); peaks in rad, (body, tilt, simulation)."""

    simulations: int
    falls: NDArray[np.int64]
    downhill: NDArray[np.int64]
    peaks: NDArray[np.float64] | None


def assess(
    items: Sequence[Item],
    motions: Sequence[Motion],
    *,
    scale: float = 1.0,
    tilt: float = 0.0,
    control: float = 0.95,
    progress: Progress = True,
) -> Assessment:
    """Who overturns, which way, and which tilt or base would help.

    Every motion counts twice, with its horizontal component as recorded and reversed.

    Args:
        items: the inventory.
        motions: horizontal, with a vertical component or not.
        scale: factor on all motions.
        tilt: β [rad] of what the items stand on now.
        control: share of the falls that the wanted tilt sends downhill, in (0.5, 1).
        progress: as for simulate_many.

    Raises:
        InputError: no items or motions, values out of range, or an item that falls by itself.
    """
    if not items or not motions:
        raise InputError("assess needs at least one item and one motion")
    if not 0.5 < control < 1.0:
        raise InputError(f"control must lie between 0.5 and 1, got {control!r}")
    if not (np.isfinite(scale) and scale > 0.0):
        raise InputError(f"scale must be a positive finite number, got {scale!r}")
    bodies = [item.body for item in items]
    require_stable(bodies, tilt)
    per_body = 1 + TILT_GRID_DEG.size + BASE_GRID.size + FINER_BASES
    total = len(items) * per_body * len(motions) * 2
    with meter("assessing", total, progress) as done:

        def run(some: Sequence[Body], tilts: Sequence[float], peaks: bool = False) -> _Counts:
            return _count(some, motions, scale, tilts, done, peaks)

        now = run(bodies, [tilt], peaks=True)
        grid = _tilt_grid(bodies, run)
        bases = [_safe_base(chunk, tilt, run) for chunk in _chunks(items)]
    fall_share = grid.falls / grid.simulations
    with np.errstate(invalid="ignore"):
        downhill_share = grid.downhill / grid.falls
    fall_share[grid.falls < 0] = np.nan
    downhill_share[grid.falls < FEWEST_FALLS] = np.nan
    return Assessment(
        table=_table(items, now, np.concatenate(bases), fall_share, downhill_share, control),
        tilts_deg=TILT_GRID_DEG,
        fall_share=fall_share,
        downhill_share=downhill_share,
        control=control,
        tilt_deg=degrees(tilt),
        scale=scale,
        motions=tuple(motion.name for motion in motions),
    )


Runner = Callable[..., _Counts]


def _chunks(items: Sequence[Item]) -> list[Sequence[Item]]:
    size = max(1, BODIES_AT_ONCE // BASE_GRID.size)
    return [items[start : start + size] for start in range(0, len(items), size)]


def _count(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    scale: float,
    tilts: Sequence[float],
    done: Callable[[int], None],
    keep_peaks: bool,
) -> _Counts:
    """Simulate and count, a bounded number of bodies at a time."""
    falls, downhill, peaks = [], [], []
    for start in range(0, len(bodies), BODIES_AT_ONCE):
        runs = simulate_many(
            bodies[start : start + BODIES_AT_ONCE],
            motions,
            tilts=tilts,
            scales=(scale,),
            progress=done,
        )
        outcome = runs.outcome.transpose("body", "tilt", "motion", "polarity", "scale").values
        outcome = outcome.reshape(*outcome.shape[:2], -1)
        falls.append((outcome != Outcome.STANDING).sum(axis=2))
        downhill.append((outcome == Outcome.DOWNHILL).sum(axis=2))
        if keep_peaks:
            peak = runs.peak_rotation.transpose("body", "tilt", "motion", "polarity", "scale")
            peaks.append(peak.values.reshape(outcome.shape))
    return _Counts(
        2 * len(motions),
        np.concatenate(falls),
        np.concatenate(downhill),
        np.concatenate(peaks) if peaks else None,
    )


def _tilt_grid(bodies: Sequence[Body], run: Runner) -> _Counts:
    """Outcomes on the grid of tilts, -1 where a body would fall by itself."""
    tilts = np.radians(TILT_GRID_DEG)
    allowed = np.array([(tilts < b.slenderness_left - TILT_RESERVE).sum() for b in bodies])
    allowed = np.maximum(allowed, 1)  # the level support always
    falls = np.full((len(bodies), tilts.size), -1)
    downhill = falls.copy()
    simulations = 0
    for count in np.unique(allowed):
        which = np.flatnonzero(allowed == count)
        counts = run([bodies[int(k)] for k in which], list(tilts[:count]))
        falls[which, :count], downhill[which, :count] = counts.falls, counts.downhill
        simulations = counts.simulations
    return _Counts(simulations, falls, downhill, None)


def _safe_base(items: Sequence[Item], tilt: float, run: Runner) -> NDArray[np.float64]:
    """The smallest base width [m] from which on at most ACCEPTED_FALLS overturn; NaN if none.

    Searched on BASE_GRID, then between the last width of it that falls too often and the next.
    """
    rows = np.arange(len(items))
    widths = np.outer([item.body.width for item in items], BASE_GRID)
    unsafe = _unsafe(items, widths, tilt, run)
    # by chance a wider base may fall a little more often: one that is safe now needs no wider one
    present = int(np.argmin(np.abs(BASE_GRID - 1.0)))
    unsafe[~unsafe[:, present], present:] = False
    below = _last(unsafe)
    hopeless = below == BASE_GRID.size - 1
    low = widths[rows, np.maximum(below, 0)]
    high = widths[rows, np.minimum(below + 1, BASE_GRID.size - 1)]
    finer = np.linspace(low, high, FINER_BASES + 2, axis=1)[:, 1:]
    found = finer[rows, _last(_unsafe(items, finer[:, :-1], tilt, run)) + 1]
    found = np.where(below < 0, widths[:, 0], found)
    return np.where(hopeless, np.nan, found)


def _unsafe(
    items: Sequence[Item], widths: NDArray[np.float64], tilt: float, run: Runner
) -> NDArray[np.bool_]:
    """Whether too many fall at each of an item's `widths`, (item, k)."""
    bodies = [
        [item.with_base(width) for width in row] for item, row in zip(items, widths, strict=True)
    ]
    stable = np.array([[tilt < b.slenderness_left - TILT_RESERVE for b in row] for row in bodies])
    unsafe = ~stable
    trials = [bodies[i][k] for i, k in np.argwhere(stable)]
    if trials:
        counts = run(trials, [tilt])
        unsafe[stable] = counts.falls[:, 0] > ACCEPTED_FALLS * counts.simulations
    return unsafe


def _last(unsafe: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Index of the last True of each row, or -1."""
    backwards = np.c_[unsafe[:, ::-1], np.ones(len(unsafe), np.bool_)]
    return np.asarray(unsafe.shape[1] - 1 - np.argmax(backwards, axis=1))


def _control_tilt(
    downhill_share: NDArray[np.float64], control: float
) -> tuple[float, NDArray[np.float64]]:
    """The smallest tilt [degrees] from which on `control` of the falls go downhill, interpolated.

    Returns it and the weights on TILT_GRID_DEG that interpolate anything else there; NaN if no
    tilt does, or if too few fall at the tilt before to tell.
    """
    weights = np.zeros(TILT_GRID_DEG.size)
    short = np.flatnonzero(~(downhill_share >= control) & np.isfinite(downhill_share))
    k = int(short[-1]) + 1 if short.size else 0
    if k == downhill_share.size or not downhill_share[k] >= control:
        return np.nan, weights
    before = downhill_share[k - 1] if k else control
    part = (control - before) / (downhill_share[k] - before) if k else 1.0
    weights[k] = part
    if k:
        weights[k - 1] = 1.0 - part
    return float(weights @ TILT_GRID_DEG), weights


def risk_class(share: float) -> str:
    """Low, medium, high or very high, by the share of motions that overturn."""
    return next(name for name, limit in RISK_CLASSES.items() if share < limit)


def _table(
    items: Sequence[Item],
    now: _Counts,
    bases: NDArray[np.float64],
    fall_share: NDArray[np.float64],
    downhill_share: NDArray[np.float64],
    control: float,
) -> pd.DataFrame:
    import pandas as pd
    from statsmodels.stats.proportion import proportion_confint

    assert now.peaks is not None
    falls, downhill = now.falls[:, 0], now.downhill[:, 0]
    # The two directions of a motion are one experiment for a symmetric body on a level support,
    # and related ones otherwise: the interval counts motions, not simulations.
    motions = now.simulations // 2
    low, high = proportion_confint(
        falls / now.simulations * motions, motions, 1 - CONFIDENCE, method="wilson"
    )
    # observed values: half way between a rotation that stood and 90° nothing ever was
    quartiles = np.degrees(
        np.quantile(now.peaks[:, 0], [0.25, 0.5, 0.75], axis=1, method="inverted_cdf")
    )
    tilts = [_control_tilt(share, control) for share in downhill_share]
    at_tilt = np.array(
        [weights @ np.nan_to_num(s) for (_, weights), s in zip(tilts, fall_share, strict=True)]
    )
    known = np.isfinite([tilt for tilt, _ in tilts])
    share = falls / now.simulations
    with np.errstate(invalid="ignore"):
        toward = downhill / falls
    return pd.DataFrame(
        {
            "name": [item.name for item in items],
            "location": [item.location for item in items],
            "quantity": [item.quantity for item in items],
            "width_m": [item.body.width for item in items],
            "height_m": [item.height for item in items],
            "cg_height_m": [item.body.cg_height for item in items],
            "eccentricity": [item.body.left / item.body.width for item in items],
            "gyration_radius_m": [item.body.gyration_radius for item in items],
            "simulations": now.simulations,
            "falls": falls,
            "fall_share": share,
            "fall_share_low": low,
            "fall_share_high": high,
            "risk": [risk_class(s) for s in share],
            "falls_downhill": downhill,
            "downhill_share": toward,
            "peak_rotation_lower_quartile_deg": quartiles[0],
            "peak_rotation_median_deg": quartiles[1],
            "peak_rotation_upper_quartile_deg": quartiles[2],
            "control_tilt_deg": [tilt for tilt, _ in tilts],
            "fall_share_at_control_tilt": np.where(known, at_tilt, np.nan),
            "safe_width_m": bases,
            "note": [item.note for item in items],
        }
    )
