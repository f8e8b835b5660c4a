"""What fell in a campaign, by object: a table with intervals."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.campaign import sketch
from shaketable.campaign.arrays import CELLS
from shaketable.campaign.plan import ALL, Plan
from shaketable.campaign.summary import moments_of
from shaketable.outcome import Outcome
from shaketable.resampling import wilson_interval
from shaketable.simulate.checks import unique_names
from shaketable.solid import Solid
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

QUANTILES = (0.5, 0.84, 0.95)


def falls_table(results: xr.Dataset, plan: Plan) -> pd.DataFrame:
    """A row for each body, tilt and scale.

    Shares count simulations; their intervals are Wilson's over the recordings, as motions of one
    recording are no experiments of their own. `fall_error_events` is the standard error of the
    share where events are the experiments: recordings of one earthquake may be alike. In
    surroundings `held_up` counts bodies that did not fall, and would without their walls and
    straps.

    Args:
        results: what `open_campaign` returns.
        plan: of the campaign.
    """
    import pandas as pd

    ensemble = plan.ensemble
    each = len(ensemble.motions) * ensemble.repeats
    recordings = int(np.unique(plan.sources.recording).size)
    down, up, error, peaks = (
        _of_all(results, plan) if plan.keep == ALL else _of_summary(results, each)
    )
    falls = down + up
    low, high = wilson_interval(falls / each, recordings)
    with np.errstate(invalid="ignore", divide="ignore"):
        toward = down / falls
    body, tilt, scale = (index.ravel() for index in np.indices(falls.shape))
    table = {
        "body": np.array(unique_names(ensemble.bodies), object)[body],
        **{name: values[body] for name, values in _sizes(ensemble.bodies).items()},
        "tilt_deg": np.array([degrees(one) for one in ensemble.tilts.tolist()])[tilt],
        "scale": ensemble.scales[scale],
        "simulations": each,
        "recordings": recordings,
        "falls": falls.ravel(),
        "falls_downhill": down.ravel(),
        "falls_uphill": up.ravel(),
        "fall_share": (falls / each).ravel(),
        "fall_share_low": low.ravel(),
        "fall_share_high": high.ravel(),
        "fall_error_events": error.ravel(),
        "downhill_share": toward.ravel(),
    }
    if ensemble.held_field:
        table[ensemble.held_field] = _held(results, plan).ravel()
    for share in QUANTILES:
        at = sketch.quantile(peaks, share)
        table[f"peak_rotation_{100 * share:.0f}_deg"] = np.degrees(at).ravel()
    return pd.DataFrame(table)


def by_recording_table(results: xr.Dataset) -> pd.DataFrame:
    """A row for each body, tilt, scale and recording: falls to both sides.

    Args:
        results: what `open_campaign` returns of a summary that keeps recordings.
    """
    import pandas as pd

    counts = results["by_recording"].transpose("body", "tilt", "scale", "recording", "direction")
    at = [index.ravel() for index in np.indices(counts.shape[:-1])]
    names_of = ("body", "tilt", "scale", "recording")
    table = {name: results[name].values[k] for name, k in zip(names_of, at, strict=True)}
    table["tilt_deg"] = np.degrees(table.pop("tilt"))
    order = ["body", "tilt_deg", "scale", "recording"]
    found = pd.DataFrame(table)[order]
    for k, way in enumerate(results["direction"].values):
        found[f"falls_{way}"] = counts.values[..., k].ravel()
    return found


def _sizes(bodies: Sequence[Body] | Sequence[Solid]) -> dict[str, NDArray[np.float64]]:
    """Sizes that tell bodies apart [m], by column, (body,)."""
    table = [
        {"depth_m": body.extent[0], "width_m": body.extent[1], "cg_height_m": body.cg_height}
        if isinstance(body, Solid)
        else {"base_m": body.base, "cg_height_m": body.cg_height, "left_m": body.left}
        for body in bodies
    ]
    return {name: np.array([row[name] for row in table]) for name in table[0]}


Counts = tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]


def _of_all(results: xr.Dataset, plan: Plan) -> Counts:
    """Counts from every simulation, some bodies at a time."""
    bodies, some = len(plan.ensemble.bodies), plan.bodies_per_block
    shape = (bodies, plan.ensemble.tilts.size, plan.ensemble.scales.size)
    down, up = np.zeros((2, *shape), np.int64)
    error = np.zeros(shape)
    peaks = np.zeros((*shape, sketch.BINS), np.int64)
    recording, event = plan.sources
    for first in range(0, bodies, some):
        needed = results[["outcome", "peak_rotation"]]
        here = needed.isel(body=slice(first, first + some)).load()
        repeats = [name for name in ("polarity", "orientation") if name in here.dims]
        order = ("motion", *repeats, "body", "tilt", "scale")
        rows = (here.sizes["motion"], plan.ensemble.repeats, here.sizes["body"], *shape[1:])
        outcome, peak = (
            here[name].transpose(*order).values.reshape(rows)
            for name in ("outcome", "peak_rotation")
        )
        which = slice(first, first + outcome.shape[2])
        by_motion = [(outcome == one).sum(axis=1) for one in (Outcome.DOWNHILL, Outcome.UPHILL)]
        down[which], up[which] = (one.sum(axis=0) for one in by_motion)
        _, of_event = moments_of(by_motion[0], by_motion[1], recording, event, outcome.shape[1])
        number, events = outcome.shape[0] * outcome.shape[1], int(np.unique(event).size)
        error[which] = _error(of_event, down[which] + up[which], number, events)
        peaks[which] = _binned(outcome, peak)
    return down, up, error, peaks


def _held(results: xr.Dataset, plan: Plan) -> NDArray[np.int64]:
    """Counts of the field that tells what is held, (body, tilt, scale); some bodies at a time."""
    found = []
    for first in range(0, len(plan.ensemble.bodies), plan.bodies_per_block):
        here = results[plan.ensemble.held_field].isel(
            body=slice(first, first + plan.bodies_per_block)
        )
        others = [name for name in here.dims if name not in CELLS]
        found.append(here.sum(others).transpose(*CELLS).values)
    return np.concatenate(found).astype(np.int64)


def _binned(outcome: NDArray[np.int8], peak: NDArray[np.float64]) -> NDArray[np.int64]:
    """Counts by bin, (body, tilt, scale, bin), of (motion, repeat, body, tilt, scale)."""
    shape = outcome.shape[2:]
    cells = int(np.prod(shape))
    first = sketch.BINS * np.arange(cells).reshape(shape)
    found = np.zeros(cells * sketch.BINS, np.int64)
    for of_motion, rotation in zip(outcome, peak, strict=True):  # a motion at a time: for memory
        bins = first + sketch.bins_of(rotation, of_motion != Outcome.STANDING)
        found += np.bincount(bins.ravel(), minlength=found.size)
    return found.reshape(*shape, sketch.BINS)


def _of_summary(results: xr.Dataset, each: int) -> Counts:
    down, up = results["downhill"].values, results["uphill"].values
    moments = results["moments"].sel(level="event").values
    error = _error(moments, down + up, each, results.attrs["events"])
    return down, up, error, results["peaks"].values


def _error(
    moments: NDArray[np.int64], falls: NDArray[np.int64], number: int, events: int
) -> NDArray[np.float64]:
    """Standard error of the share of falls, a ratio of sums over events (Cochran 1977, eq. 6.9).

    Args:
        moments: sums over the events, see `summary.MOMENTS`, (moment, ...).
        falls: of all events, (...).
        number: of simulations of all events.
        events: how many.
    """
    if events < 2:
        return np.full(falls.shape, np.nan)
    dd, uu, du, dn, un, nn = moments.astype(np.float64)
    share = falls / number
    squares = dd + uu + 2.0 * du - 2.0 * share * (dn + un) + share**2 * nn
    return np.asarray(np.sqrt(np.maximum(squares, 0.0) * events / (events - 1)) / number)
