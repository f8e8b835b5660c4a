"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.bases import BASE_GRID, FINER_BASES, safe_bases
from shaketable.assess.criteria import criteria_columns
from shaketable.assess.sliding import Kept, flattened, sliding_columns
from shaketable.assess.table import overturning_table
from shaketable.body import Body
from shaketable.errors import InputError, require_positive
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.recordings import interval, recordings_of, resamples
from shaketable.response import Outcome
from shaketable.simulate import require_model, require_stable, simulate_many
from shaketable.support import Support
from shaketable.tilting import (
    CONTROL,
    TiltCounts,
    TiltCurves,
    count_outcomes,
    curves_of,
    downhill_share,
    pieces,
    require_control,
)
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

TILT_GRID_DEG = np.arange(0.0, 10.01, 0.5)


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """Results of `assess`.

    Attributes:
        table: one row an item, in the inventory's order; units are in the columns' names.
        tilts_deg: the tilts tried, shape (t,).
        curves: how often each item falls on them, which way, and the tilt that controls it.
        control: wanted share of falls that go downhill.
        tilt_deg: tilt at which the items stand now.
        scale: factor on the motions.
        motions: their names.
        model: "rocking" or "general".
        support: its friction and restitution.
    """

    table: pd.DataFrame
    tilts_deg: NDArray[np.float64]
    curves: list[TiltCurves]
    control: float
    tilt_deg: float
    scale: float
    motions: tuple[str, ...]
    model: str
    support: Support

    def worst_first(self) -> pd.DataFrame:
        """The table, what falls most on top."""
        return self.table.sort_values("fall_share", ascending=False, kind="stable")


def assess(
    items: Sequence[Item],
    motions: Sequence[Motion],
    *,
    scale: float = 1.0,
    tilt: float = 0.0,
    control: float = CONTROL,
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
    require_positive("scale", scale)
    support = support or Support()
    if support.tilt != 0.0:
        raise InputError("assess takes the tilt from tilt=, not from its support")
    bodies = [item.body for item in items]
    require_model(model)
    require_stable(bodies, tilt)
    per_body = 1 + TILT_GRID_DEG.size + BASE_GRID.size + FINER_BASES
    total = len(items) * per_body * len(motions) * 2
    with meter("assessing", total, progress) as done:
        shake = partial(
            simulate_many,
            motions=motions,
            tilts=(tilt,),
            scales=(scale,),
            support=support,
            model=model,
            progress=done,
        )
        now, kept = _at_present(bodies, recordings_of(motions), shake)
        grid = count_outcomes(
            bodies,
            motions,
            np.radians(TILT_GRID_DEG),
            scale=scale,
            model=model,
            support=support,
            progress=done,
        )
        bases = safe_bases(items, tilt, partial(_fall_shares, shake))
    weights = resamples(grid.recordings)
    toward = interval(downhill_share(now, weights)[1:, :, 0])
    curves = [curves_of(grid.body(k), weights, control) for k in range(len(items))]
    table = overturning_table(items, now, toward, kept, bases, curves)
    if tilt == 0.0:  # the criteria know no other support
        table = table.assign(**criteria_columns(items, motions, scale, kept))
    if model == "general":
        table = table.assign(**sliding_columns(items, kept))
    return Assessment(
        table=table,
        tilts_deg=TILT_GRID_DEG,
        curves=curves,
        control=control,
        tilt_deg=degrees(tilt),
        scale=scale,
        motions=tuple(motion.name for motion in motions),
        model=model,
        support=support,
    )


def _at_present(
    bodies: Sequence[Body], recording: NDArray[np.intp], shake: Callable[..., xr.Dataset]
) -> tuple[TiltCounts, Kept]:
    """Counts and single simulations, a bounded number of bodies at a time."""
    counts, kept = [], []
    for some in pieces(len(bodies)):
        runs = shake(bodies[some])
        counts.append(TiltCounts.of(runs, recording))
        kept.append(Kept.of(runs))
    return TiltCounts.joined(counts), Kept.joined(kept)


def _fall_shares(shake: Callable[..., xr.Dataset], bodies: Sequence[Body]) -> NDArray[np.float64]:
    """Share of the simulations that overturns each body, (body,)."""
    outcomes = [flattened(shake(bodies[some]).outcome)[:, 0] for some in pieces(len(bodies))]
    return np.concatenate([(each != Outcome.STANDING).mean(axis=1) for each in outcomes])
