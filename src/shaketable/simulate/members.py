"""The results of every simulation of an ensemble, and the Dataset that holds them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import Ending
from shaketable.lazy_motions import Head
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.simulate.ensemble import Part
from shaketable.solid import Solid

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Members:
    """An entry for each simulation, arrays of shape (member,); units as in `simulate_many`."""

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
    def empty(cls, count: int) -> Members:
        return cls(
            outcome=np.zeros(count, np.int8),
            overturning_time=np.full(count, np.nan),
            peak_rotation=np.zeros(count),
            impacts=np.zeros(count, np.int32),
            ending=np.zeros(count, np.int8),
            slip=np.zeros(count),
            slip_downhill=np.zeros(count),
            slip_uphill=np.zeros(count),
            max_lift=np.zeros(count),
        )

    def enter(self, part: Part) -> None:
        """Enter the results of some members."""
        where, runs, downhill = part
        toward_left, toward_right = np.abs(runs.farthest_left), runs.farthest_right
        self.outcome[where] = runs.direction * downhill
        self.overturning_time[where] = runs.overturning_time
        self.peak_rotation[where] = runs.peak
        self.impacts[where] = runs.impacts
        self.ending[where] = runs.ending
        self.slip[where] = runs.slip
        self.slip_downhill[where] = np.where(downhill > 0, toward_left, toward_right)
        self.slip_uphill[where] = np.where(downhill > 0, toward_right, toward_left)
        self.max_lift[where] = runs.lift

    def reshaped(self, shape: tuple[int, ...], axes: tuple[int, ...]) -> dict[str, NDArray[Any]]:
        """Every array of (member,) brought into a shape, its axes then reordered."""
        return {
            field.name: getattr(self, field.name).reshape(shape).transpose(axes)
            for field in fields(self)
        }


def dataset(
    arrays: dict[str, NDArray[Any]],
    dimensions: tuple[str, ...],
    coordinates: dict[str, Any],
    model: Model,
) -> xr.Dataset:
    """A Dataset of members, with units and with the variables that their model has.

    Args:
        arrays: one for every field of `Members`, over the dimensions.
        dimensions: names of the axes.
        coordinates: as xarray takes them.
        model: the contact model that was simulated.
    """
    import xarray as xr

    variables = {
        "outcome": (dimensions, arrays["outcome"], {"long_name": "outcome", **flags(Outcome)}),
        "impacts": (dimensions, arrays["impacts"], {"long_name": "number of impacts"}),
    }
    for name, (long_name, units) in {
        "overturning_time": ("time of overturning", "s"),
        "peak_rotation": ("peak rotation", "rad"),
        **{each.name: (each.long_name, each.units) for each in model.variables},
    }.items():
        variables[name] = (dimensions, arrays[name], {"long_name": long_name, "units": units})
    attributes = {"long_name": "how the run ended", **flags(Ending)}
    variables["ending"] = (dimensions, arrays["ending"], attributes)
    return xr.Dataset(variables, coords=coordinates, attrs={"model": repr(model)})


def flags(kind: type[Outcome] | type[Ending]) -> dict[str, object]:
    """What the numbers of a variable mean, as CF conventions write it."""
    return {
        "flag_values": [int(member) for member in kind],
        "flag_meanings": " ".join(member.name.lower() for member in kind),
    }


def factors_of(dimension: str, bodies: Sequence[Body], model: Model) -> dict[str, Any]:
    """The coordinate that tells restitution factors, where a body has one of its own."""
    own = [body.restitution_factor for body in bodies]
    if all(factor is None for factor in own):
        return {}
    factors = [model.restitution_factor if factor is None else factor for factor in own]
    return {"restitution_factor": (dimension, np.array(factors, np.float64))}


def names(
    things: Sequence[Body] | Sequence[Solid] | Sequence[Motion] | Sequence[Head],
) -> list[str]:
    """Their names, with a number where two share one or one has none."""
    given = [thing.name for thing in things]
    if all(given) and len(set(given)) == len(given):
        return given
    return [f"{name or 'unnamed'} #{index}" for index, name in enumerate(given)]
