"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.assessment import Assessment, FloorAssessment
from shaketable.assess.bases import BASE_GRID, FINER_BASES, safe_bases
from shaketable.assess.criteria import criteria_of, peaks_of
from shaketable.assess.present import present_runs
from shaketable.assess.results import ItemResult, Share
from shaketable.assess.sliding import sliding_of
from shaketable.building import Building
from shaketable.errors import InputError, joined, require_number
from shaketable.inventory import Item
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import interval, resamples, wilson_interval
from shaketable.simulate import Trial, listed, require_stable
from shaketable.tilting import (
    CONTROL,
    TILTS,
    count_outcomes,
    curves_of,
    downhill_share,
    pieces,
    require_control,
)
from shaketable.units import degrees

_ITEM = "an Item: read some with read_inventory(path), or make one with Item(body=..., height=...)"


def assess(
    items: Sequence[Item],
    motions: Sequence[Motion] | Building,
    *,
    scale: float = 1.0,
    tilt: float = 0.0,
    control: float = CONTROL,
    model: Model | str | None = None,
    progress: Progress = True,
) -> Assessment:
    """Who overturns, which way, and which tilt or base would help; who slides, and how far.

    Every motion counts twice, with its horizontal component as recorded and reversed.

    Args:
        items: the inventory; in a building each item has the label of its floor.
        motions: horizontal ones, with or without a vertical component; or a building with those
            of its floors.
        scale: factor on all motions.
        tilt: β [rad] >= 0 of what the items stand on now.
        control: share of the falls that the wanted tilt sends downhill, in (0.5, 1).
        model, progress: as for simulate_many; only a model that slides tells how far things slide.

    Raises:
        InputError: no items or motions, values out of range, an item that falls by itself, or one
            without a floor in a building.
    """
    items = listed("items", items, Item, _ITEM)
    require_control(control)
    require_number("tilt", tilt)
    if not tilt >= 0.0:
        raise InputError(f"the tilt must not be negative, got {degrees(tilt):.4g}°")
    model = model_of(model)
    require_stable([item.body for item in items], tilt)
    floors = [
        _assess_floor(label, here, Trial(there, scale, model), tilt, control, progress)
        for label, here, there in _places(items, motions)
    ]
    return Assessment(floors=floors, control=control, tilt=tilt, scale=scale, model=model)


def _places(
    items: Sequence[Item], motions: Sequence[Motion] | Building
) -> list[tuple[str, Sequence[Item], Sequence[Motion]]]:
    """Label, items and motions of every floor that has items, or of the only place."""
    if not isinstance(motions, Building):
        return [("", items, motions)]
    known = ", ".join(motions.floors)
    faults = [
        f"{item.name!r}: no floor is given; {motions.name} has {known}"
        if not item.floor
        else f"{item.name!r}: stands on floor {item.floor!r}; {motions.name} has {known}"
        for item in items
        if item.floor not in motions.floors
    ]
    if faults:
        raise InputError(joined(faults))
    return [
        (label, here, there)
        for label, there in motions.floors.items()
        if (here := [item for item in items if item.floor == label])
    ]


def _assess_floor(
    label: str, items: Sequence[Item], trial: Trial, tilt: float, control: float, progress: Progress
) -> FloorAssessment:
    """The items of one place under its motions."""
    weights = resamples(int(trial.recording.max()) + 1)
    peaks = peaks_of(trial) if tilt == 0.0 else None  # the criteria do not know tilts
    place = _Place(trial, tilt, control, weights, peaks)
    each = 2 * len(trial.motions)
    per_item = each * (1 + TILTS.size + BASE_GRID.size + FINER_BASES)
    results: list[ItemResult] = []
    with meter("assessing", len(items) * per_item, progress) as done:
        # simulations of some items at a time, so that those of all need not be kept
        for some in pieces(len(items), each * TILTS.size):
            results += _results(items[some], place, done)
    strongest = [trial.scale * motion.peak_ground_acceleration for motion in trial.motions]
    return FloorAssessment(
        floor=label,
        results=results,
        motions=tuple(motion.name for motion in trial.motions),
        recordings=weights.shape[1],
        smallest_pga=min(strongest),
        largest_pga=max(strongest),
    )


class _Place(NamedTuple):
    """What the items of one place have in common."""

    trial: Trial
    tilt: float  # rad, of what they stand on now
    control: float
    weights: NDArray[np.float64]  # of what was observed and of draws, as `resamples` gives them
    peaks: tuple[NDArray[np.float64], NDArray[np.float64]] | None  # of the motions; None on a tilt


def _results(items: Sequence[Item], place: _Place, done: Callable[[int], None]) -> list[ItemResult]:
    """What becomes of each of some items of a place; `done` is told how many were simulated."""
    trial, tilt, control, weights, peaks = place
    bodies = [item.body for item in items]
    now = present_runs(bodies, trial, tilt, done)
    grid = count_outcomes(bodies, trial, TILTS, progress=done)
    bases = safe_bases(items, tilt, trial, done)
    falls, downhill = (now.counts.falls[:, 0].sum(axis=1), now.counts.downhill[:, 0].sum(axis=1))
    share = falls / now.simulations
    low, high = wilson_interval(share, grid.recordings)
    toward = downhill_share(now.counts, weights)[:, :, 0]
    downhill_low, downhill_high = interval(toward[1:])
    criteria = criteria_of(items, *peaks, now) if peaks else None
    sliding = sliding_of(items, now) if trial.model.slides else None
    return [
        ItemResult(
            item=item,
            curves=curves_of(grid.body(k), weights, control),
            safe_width=float(bases[k]),
            criteria=criteria[k][0] if criteria else None,
            floor_ratios=criteria[k][1] if criteria else None,
            sliding=sliding[k] if sliding else None,
            simulations=now.simulations,
            recordings=grid.recordings,
            falls=int(falls[k]),
            falls_downhill=int(downhill[k]),
            fall=Share(*(float(each[k]) for each in (share, low, high))),
            downhill=Share(*(float(each[k]) for each in (toward[0], downhill_low, downhill_high))),
            peak_rotation=now.peak_quartiles(k),
        )
        for k, item in enumerate(items)
    ]
