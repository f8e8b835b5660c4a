"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.sliding import Kept, flattened, sliding_columns
from shaketable.assess.table import overturning_table
from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.response import Outcome
from shaketable.simulate import require_model, require_stable, simulate_many
from shaketable.support import Support
from shaketable.tilting import (
    BODIES_AT_ONCE,
    TILT_RESERVE,
    TiltCounts,
    control_share,
    control_tilt,
    count_outcomes,
    fall_share,
    interval,
    require_control,
    resamples,
)
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd

ACCEPTED_FALLS = 0.10  # share of motions that may still overturn an object made safer
TILT_GRID_DEG = np.arange(0.0, 10.01, 0.5)
DRAWS = 400  # of the bootstrap
BASE_GRID = np.r_[np.geomspace(0.25, 1.0, 13), np.geomspace(1.0, 6.0, 16)[1:]]  # times the width
FINER_BASES = 8  # widths tried between two of the grid


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """Results of `assess`.

    Attributes:
        table: one row an item, in the inventory's order; units are in the columns' names.
        tilts_deg: the tilts tried, shape (t,).
        fall_share: share of simulations that overturn each item at each tilt, (item, t);
            NaN where the item falls or, with the general model, slides by itself.
        downhill_share: share of those falls that go downhill, (item, t).
        control: wanted share of falls that go downhill.
        tilt_deg: tilt at which the items stand now.
        scale: factor on the motions.
        motions: their names.
        model: "rocking" or "general".
        support: its friction and restitution.
    """

    table: pd.DataFrame
    tilts_deg: NDArray[np.float64]
    fall_share: NDArray[np.float64]
    downhill_share: NDArray[np.float64]
    control: float
    tilt_deg: float
    scale: float
    motions: tuple[str, ...]
    model: str
    support: Support

    def worst_first(self) -> pd.DataFrame:
        """The table, what falls most on top."""
        return self.table.sort_values("fall_share", ascending=False, kind="stable")


@dataclass(frozen=True, eq=False)
class _Counts:
    """Outcomes of some bodies, (body,), and single simulations where they were kept."""

    simulations: int
    falls: NDArray[np.int64]
    downhill: NDArray[np.int64]
    kept: Kept | None


def assess(
    items: Sequence[Item],
    motions: Sequence[Motion],
    *,
    scale: float = 1.0,
    tilt: float = 0.0,
    control: float = 0.95,
    model: str = "rocking",
    support: Support | None = None,
    progress: Progress = True,
) -> Assessment:
    """Who overturns, which way, and which tilt or base would help; who slides, and how far.

    Every motion counts twice, with its horizontal component as recorded and reversed.

    Args:
        items: the inventory.
        motions: horizontal, with a vertical component or not.
        scale: factor on all motions.
        tilt: β [rad] of what the items stand on now.
        control: share of the falls that the wanted tilt sends downhill, in (0.5, 1).
        model: "rocking" or "general", as for simulate_many; only the latter slides.
        support: friction and restitution of what the items stand on; its tilt must be 0.
        progress: as for simulate_many.

    Raises:
        InputError: no items or motions, values out of range, or an item that falls by itself.
    """
    if not items or not motions:
        raise InputError("assess needs at least one item and one motion")
    require_control(control)
    if not (np.isfinite(scale) and scale > 0.0):
        raise InputError(f"scale must be a positive finite number, got {scale!r}")
    support = support or Support()
    if support.tilt != 0.0:
        raise InputError("assess takes the tilt from tilt=, not from its support")
    bodies = [item.body for item in items]
    require_model(model)
    require_stable(bodies, tilt)
    per_body = 1 + TILT_GRID_DEG.size + BASE_GRID.size + FINER_BASES
    total = len(items) * per_body * len(motions) * 2
    with meter("assessing", total, progress) as done:

        def run(some: Sequence[Body], keep: bool = False) -> _Counts:
            return _count(some, motions, scale, tilt, model, support, done, keep)

        now = run(bodies, keep=True)
        grid = count_outcomes(
            bodies,
            motions,
            np.radians(TILT_GRID_DEG),
            scale=scale,
            model=model,
            support=support,
            progress=done,
        )
        bases = [_safe_base(chunk, tilt, run) for chunk in _chunks(items)]
    observed = resamples(grid, 0)
    fall_shares, downhill_shares = fall_share(grid, observed)[0], control_share(grid, observed)[0]
    tilts = _control_tilts(grid, control)
    assert now.kept is not None
    table = overturning_table(
        items,
        now.simulations,
        now.falls,
        now.downhill,
        now.kept,
        np.concatenate(bases),
        tilts,
        _at(tilts[0], fall_shares),
    )
    if model == "general":
        table = table.assign(**sliding_columns(items, now.kept))
    return Assessment(
        table=table,
        tilts_deg=TILT_GRID_DEG,
        fall_share=fall_shares,
        downhill_share=downhill_shares,
        control=control,
        tilt_deg=degrees(tilt),
        scale=scale,
        motions=tuple(motion.name for motion in motions),
        model=model,
        support=support,
    )


Runner = Callable[..., _Counts]


def _chunks(items: Sequence[Item]) -> list[Sequence[Item]]:
    size = max(1, BODIES_AT_ONCE // BASE_GRID.size)
    return [items[start : start + size] for start in range(0, len(items), size)]


def _count(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    scale: float,
    tilt: float,
    model: str,
    support: Support,
    done: Callable[[int], None],
    keep: bool,
) -> _Counts:
    """Simulate and count, a bounded number of bodies at a time."""
    falls, downhill, kept = [], [], []
    for start in range(0, len(bodies), BODIES_AT_ONCE):
        runs = simulate_many(
            bodies[start : start + BODIES_AT_ONCE],
            motions,
            tilts=(tilt,),
            scales=(scale,),
            support=support,
            model=model,
            progress=done,
        )
        outcome = flattened(runs.outcome)[:, 0]
        falls.append((outcome != Outcome.STANDING).sum(axis=1))
        downhill.append((outcome == Outcome.DOWNHILL).sum(axis=1))
        if keep:
            kept.append(Kept.of(runs))
    return _Counts(
        2 * len(motions),
        np.concatenate(falls),
        np.concatenate(downhill),
        Kept.joined(kept) if keep else None,
    )


def _control_tilts(grid: TiltCounts, control: float) -> NDArray[np.float64]:
    """The tilt that controls each item's falls, and its interval's ends [degrees], (3, item).

    NaN where no tilt tried does; an end may be infinite.
    """
    weights = resamples(grid, DRAWS)
    found = np.full((3, len(grid.falls)), np.nan)
    for k in range(len(grid.falls)):  # the draws of all items at once would fill the memory
        drawn = control_tilt(TILT_GRID_DEG, control_share(grid.body(k), weights)[:, 0], control)
        if np.isfinite(drawn[0]):
            found[:, k] = drawn[0], *interval(drawn[1:])
    return found


def _at(tilts_deg: NDArray[np.float64], shares: NDArray[np.float64]) -> NDArray[np.float64]:
    """Each item's share at its tilt, interpolated on TILT_GRID_DEG; NaN without a tilt."""
    known = [np.isfinite(share) for share in shares]
    return np.array(
        [
            np.interp(tilt, TILT_GRID_DEG[ok], share[ok])
            for tilt, share, ok in zip(tilts_deg, shares, known, strict=True)
        ]
    )


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
        counts = run(trials)
        unsafe[stable] = counts.falls > ACCEPTED_FALLS * counts.simulations
    return unsafe


def _last(unsafe: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Index of the last True of each row, or -1."""
    backwards = np.c_[unsafe[:, ::-1], np.ones(len(unsafe), np.bool_)]
    return np.asarray(unsafe.shape[1] - 1 - np.argmax(backwards, axis=1))
