"""What becomes of every simulation of `simulate_many`, and the Dataset it ends up in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.motion import Motion
from shaketable.response import Outcome

if TYPE_CHECKING:
    import xarray as xr

DIMENSIONS = ("body", "motion", "polarity", "tilt", "scale")


@dataclass(frozen=True)
class Members:
    """An entry for each simulation, arrays of shape (motion, scale, lane)."""

    outcome: NDArray[np.int8]
    overturning_time: NDArray[np.float64]
    peak_rotation: NDArray[np.float64]
    impacts: NDArray[np.int32]
    ending: NDArray[np.int8]
    slip: NDArray[np.float64]
    slip_downhill: NDArray[np.float64]
    slip_uphill: NDArray[np.float64]
    max_lift: NDArray[np.float64]

    @classmethod
    def empty(cls, shape: tuple[int, int, int]) -> Members:
        return cls(
            outcome=np.zeros(shape, np.int8),
            overturning_time=np.full(shape, np.nan),
            peak_rotation=np.zeros(shape),
            impacts=np.zeros(shape, np.int32),
            ending=np.zeros(shape, np.int8),
            slip=np.zeros(shape),
            slip_downhill=np.zeros(shape),
            slip_uphill=np.zeros(shape),
            max_lift=np.zeros(shape),
        )


def dataset(
    members: Members,
    model: str,
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    polarities: list[int],
    tilts: list[float],
    scales: list[float],
) -> xr.Dataset:
    """The members over DIMENSIONS, with units; what only the general model has too."""
    import xarray as xr

    def variable(values: NDArray[np.generic], **attributes: object) -> tuple[object, ...]:
        split = values.reshape(len(motions), len(scales), len(bodies), len(polarities), len(tilts))
        return DIMENSIONS, split.transpose(2, 0, 3, 4, 1), attributes

    def flags(kind: type[Outcome] | type[Ending]) -> dict[str, object]:
        return {
            "flag_values": [int(member) for member in kind],
            "flag_meanings": " ".join(member.name.lower() for member in kind),
        }

    def measured(values: NDArray[np.generic], long_name: str, units: str) -> tuple[object, ...]:
        return variable(values, long_name=long_name, units=units)

    variables = {
        "outcome": variable(members.outcome, long_name="outcome", **flags(Outcome)),
        "overturning_time": measured(members.overturning_time, "time of overturning", "s"),
        "peak_rotation": measured(members.peak_rotation, "peak rotation", "rad"),
        "impacts": variable(members.impacts, long_name="number of impacts"),
    }
    if model == "general":
        downhill = measured(members.slip_downhill, "farthest slip downhill", "m")
        variables |= {
            "ending": variable(members.ending, long_name="how the run ended", **flags(Ending)),
            "slip": measured(members.slip, "slip at the end, + uphill", "m"),
            "slip_downhill": downhill,
            "slip_uphill": measured(members.slip_uphill, "farthest slip uphill", "m"),
            "max_lift": measured(members.max_lift, "largest clearance under the base", "m"),
        }
    return xr.Dataset(
        variables,
        coords={
            "body": names(bodies),
            "motion": names(motions),
            "polarity": polarities,
            "tilt": ("tilt", tilts, {"units": "rad", "long_name": "tilt of the support"}),
            "scale": scales,
        },
        attrs={"model": model},
    )


def names(things: Sequence[Body] | Sequence[Motion]) -> list[str]:
    """Their names, with a number where two share one or one has none."""
    given = [thing.name for thing in things]
    if all(given) and len(set(given)) == len(given):
        return given
    return [f"{name or 'unnamed'} #{index}" for index, name in enumerate(given)]
