"""How far items slide, and which of them walk off what they stand on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.inventory import Item
from shaketable.response import Outcome
from shaketable.tilting import SLIDES

if TYPE_CHECKING:
    import xarray as xr

QUARTILES = {"lower_quartile": 0.25, "median": 0.5, "upper_quartile": 0.75}


def flattened(values: xr.DataArray) -> NDArray[Any]:
    """A variable of simulate_many as (body, tilt, simulation)."""
    ordered = values.transpose("body", "tilt", "motion", "polarity", "scale").values
    return np.asarray(ordered.reshape(*ordered.shape[:2], -1))


@dataclass(frozen=True, eq=False)
class Kept:
    """Results of single simulations, (body, tilt, simulation).

    Attributes:
        peak_rotation: [rad].
        stands: whether the body is upright at the end.
        downhill, uphill: farthest slip [m], both >= 0; zero with the rocking model.
    """

    peak_rotation: NDArray[np.float64]
    stands: NDArray[np.bool_]
    downhill: NDArray[np.float64]
    uphill: NDArray[np.float64]

    @classmethod
    def of(cls, runs: xr.Dataset) -> Kept:
        peak = flattened(runs.peak_rotation)
        nothing = np.zeros_like(peak)
        slides = "slip" in runs
        return cls(
            peak,
            flattened(runs.outcome) == Outcome.STANDING,
            flattened(runs.slip_downhill) if slides else nothing,
            flattened(runs.slip_uphill) if slides else nothing,
        )

    @classmethod
    def joined(cls, parts: Sequence[Kept]) -> Kept:
        return cls(
            np.concatenate([part.peak_rotation for part in parts]),
            np.concatenate([part.stands for part in parts]),
            np.concatenate([part.downhill for part in parts]),
            np.concatenate([part.uphill for part in parts]),
        )


def sliding_columns(items: Sequence[Item], kept: Kept) -> dict[str, NDArray[Any]]:
    """Columns of the table for the general model.

    They tell of the simulations in which the item stays upright: what falls slips as it falls,
    and that is nobody's concern.
    """
    stands = kept.stands[:, 0]
    downhill, uphill = kept.downhill[:, 0], kept.uphill[:, 0]
    farthest = np.maximum(downhill, uphill)
    room = np.array([_room(item) for item in items])
    off = stands & ((downhill > room[:, :1]) | (uphill > room[:, 1:]))
    known = np.isfinite(room).all(axis=1)
    return {
        "slides_share": (stands & (farthest > SLIDES)).mean(axis=1),
        **{
            f"slip_{name}_m": np.array(
                [
                    _observed(slips[upright], q)
                    for slips, upright in zip(farthest, stands, strict=True)
                ]
            )
            for name, q in QUARTILES.items()
        },
        "support_length_m": np.array([item.support_length or np.nan for item in items]),
        "walks_off_share": np.where(known, off.mean(axis=1), np.nan),
    }


def _observed(values: NDArray[np.float64], q: float) -> float:
    """An observed value, as for the peak rotation; NaN of none."""
    return float(np.quantile(values, q, method="inverted_cdf")) if values.size else np.nan


def _room(item: Item) -> tuple[float, float]:
    """How far it may slide downhill and uphill [m] until its centre of gravity is beyond the edge.

    Its base begins in the middle of the support.
    """
    if item.support_length is None:
        return np.nan, np.nan
    off_centre = item.body.left - item.body.width / 2
    return item.support_length / 2 + off_centre, item.support_length / 2 - off_centre
