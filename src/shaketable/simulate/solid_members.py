"""The results of every simulation of solids, and the Dataset that holds them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.models import General
from shaketable.outcome import Outcome
from shaketable.simulate.members import flags
from shaketable.simulate.solid_batches import SolidPart

if TYPE_CHECKING:
    import xarray as xr


class Variable(NamedTuple):
    """A variable of the Dataset, and the field of `solids.run.Found` that it shows."""

    field: str
    long_name: str
    units: str
    kind: type = np.float64


VARIABLES = {
    "impacts": Variable("impacts", "number of impacts", "1", np.int32),
    "overturning_time": Variable("time", "time of overturning", "s"),
    "fall_azimuth": Variable("fall_azimuth", "azimuth of the axis as it fell", "rad"),
    "peak_rotation": Variable("peak", "peak nutation", "rad"),
    "displacement_x": Variable("displacement_x", "displacement of the foot along x", "m"),
    "displacement_y": Variable("displacement_y", "displacement of the foot along y", "m"),
    "yaw": Variable("yaw", "turn about the support's normal", "rad"),
    "displacement_x_at_motion_end": Variable(
        "shaken_x", "displacement along x as the motion ends", "m"
    ),
    "displacement_y_at_motion_end": Variable(
        "shaken_y", "displacement along y as the motion ends", "m"
    ),
    "yaw_at_motion_end": Variable("shaken_yaw", "turn as the motion ends", "rad"),
    "max_lift": Variable("lift", "largest clearance under the base", "m"),
}
IRREGULAR = "the run was given up while the solid moved"


class SolidMembers:
    """An entry for each simulation, arrays of shape (member,)."""

    def __init__(self, count: int) -> None:
        self.arrays: dict[str, NDArray[Any]] = {
            "outcome": np.zeros(count, np.int8),
            "irregular": np.zeros(count, np.bool_),
            **{name: np.zeros(count, each.kind) for name, each in VARIABLES.items()},
        }

    def enter(self, part: SolidPart) -> None:
        """Enter the results of some members."""
        from shaketable.solids.run import SENTENCES

        self.arrays["outcome"][part.members] = part.outcome
        self.arrays["irregular"][part.members] = np.isin(part.column("ending"), list(SENTENCES))
        for name, each in VARIABLES.items():
            self.arrays[name][part.members] = part.column(each.field)

    def dataset(
        self,
        dimensions: tuple[str, ...],
        shape: tuple[int, ...],
        coordinates: dict[str, Any],
        model: General,
    ) -> xr.Dataset:
        """A Dataset of all members, brought into a shape."""
        import xarray as xr

        about: dict[str, dict[str, object]] = {
            "outcome": {"long_name": "outcome", **flags(Outcome)},
            "irregular": {"long_name": IRREGULAR},
        }
        for name, (_, long_name, units, _) in VARIABLES.items():
            about[name] = {"long_name": long_name, **({} if units == "1" else {"units": units})}
        variables = {
            name: (dimensions, values.reshape(shape), about[name])
            for name, values in self.arrays.items()
        }
        return xr.Dataset(variables, coords=coordinates, attrs={"model": repr(model)})
