"""What simulations tell: one table of their fields, and the arrays that hold them.

Datasets of `simulate_many` and `simulate_each`, stores of campaigns and the table of
docs/reference/results.md follow from FIELDS.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.engine.endings import Ending
from shaketable.models import Model
from shaketable.outcome import Outcome
from shaketable.surroundings import Surroundings, told_surroundings

if TYPE_CHECKING:
    import xarray as xr

# Who has a field: planar bodies of either model, and solids.
ROCKING, GENERAL, SOLID = "planar rocking", "planar general", "solid"
ALL, MOVING = (ROCKING, GENERAL, SOLID), (GENERAL, SOLID)


class Field(NamedTuple):
    """A result of each simulation.

    Attributes:
        dtype: of its array.
        units: "1" for a number of something, empty for what is none.
        meaning: in words.
        of: who has it.
        flags: what its numbers mean, if they stand for something.
        held: whether only what surroundings hold has it.
        along: a dimension of its own, after those of all.
        edge: whether only what stands on a support with an edge has it.
    """

    dtype: type
    units: str
    meaning: str
    of: tuple[str, ...]
    flags: type[IntEnum] | None = None
    held: bool = False
    along: str = ""
    edge: bool = False

    def is_told(self, surroundings: Sequence[Surroundings | None]) -> bool:
        """Whether bodies have it of which one or each is surrounded so."""
        around = [each for each in surroundings if each]
        if self.edge:
            return any(each.edge for each in around)
        if self.along:
            return any(each.straps for each in around)
        return bool(around) or not self.held

    @property
    def unknown(self) -> float:
        """What stands for it where a body has not got it."""
        return np.nan if self.held and self.dtype is np.float64 else 0

    @property
    def attributes(self) -> dict[str, object]:
        """As CF conventions write them."""
        units = {"units": self.units} if self.units not in ("", "1") else {}
        return {"long_name": self.meaning, **units, **flags_of(self.flags)}


FIELDS = {
    "outcome": Field(np.int8, "", "outcome", ALL, Outcome),
    "overturning_time": Field(
        np.float64, "s", "time of overturning, NaN for what did not overturn", ALL
    ),
    "peak_rotation": Field(
        np.float64, "rad", "largest rotation of the axis from the support's normal", ALL
    ),
    "impacts": Field(np.int32, "1", "number of impacts", ALL),
    "ending": Field(np.int8, "", "how the run ended", ALL, Ending),
    "fall_azimuth": Field(
        np.float64, "rad", "azimuth of the axis as it fell, NaN for what did not fall", (SOLID,)
    ),
    "displacement_x": Field(np.float64, "m", "displacement along x at the end of the run", MOVING),
    "displacement_y": Field(
        np.float64, "m", "displacement along y at the end of the run", (SOLID,)
    ),
    "yaw": Field(np.float64, "rad", "turn about the support's normal at the end", (SOLID,)),
    "slip_downhill": Field(np.float64, "m", "farthest slip downhill", (GENERAL,)),
    "slip_uphill": Field(np.float64, "m", "farthest slip uphill", (GENERAL,)),
    "max_lift": Field(np.float64, "m", "largest clearance under the base", MOVING),
    "displacement_x_at_motion_end": Field(
        np.float64, "m", "displacement along x as the motion ends", (SOLID,)
    ),
    "displacement_y_at_motion_end": Field(
        np.float64, "m", "displacement along y as the motion ends", (SOLID,)
    ),
    "yaw_at_motion_end": Field(np.float64, "rad", "turn as the motion ends", (SOLID,)),
    "farthest_displacement": Field(
        np.float64, "m", "farthest displacement at any time", (SOLID,)
    ),
    "held_up": Field(
        np.bool_, "", "in surroundings: did not fall, and would without its walls and straps",
        MOVING, held=True,
    ),
    "strap_force": Field(
        np.float64, "N", "with straps: largest force of each", MOVING, held=True, along="strap"
    ),
    "strap_broke_at": Field(
        np.float64, "s", "with straps: when each broke, NaN if it did not", MOVING, held=True,
        along="strap",
    ),
    "off_edge": Field(
        np.bool_, "", "with an edge: fell off its support", MOVING, held=True, edge=True
    ),
    "left_support_at": Field(
        np.float64, "s", "with an edge: when it last touched its support, NaN if it did not leave",
        MOVING, held=True, edge=True,
    ),
    "landing_time": Field(
        np.float64, "s", "with an edge: when it came down, NaN if it did not leave", MOVING,
        held=True, edge=True,
    ),
    "landing_x": Field(
        np.float64, "m", "with an edge: centre of gravity along x as it came down", MOVING,
        held=True, edge=True,
    ),
    "landing_y": Field(
        np.float64, "m", "with an edge: centre of gravity along y as it came down", (SOLID,),
        held=True, edge=True,
    ),
    "landing_speed": Field(
        np.float64, "m/s", "with an edge: speed as it came down", MOVING, held=True, edge=True
    ),
    "landing_rotation": Field(
        np.float64, "rad", "with an edge: rotation as it came down", MOVING, held=True,
        edge=True,
    ),
}  # fmt: skip


class Part(NamedTuple):
    """Results of some simulations of an ensemble.

    Attributes:
        members: their numbers in the ensemble, (n,).
        results: by the names of FIELDS, each (n,), or (n, strap).
    """

    members: NDArray[np.intp]
    results: Mapping[str, NDArray[Any]]


class Results:
    """Room for the results of every simulation of an ensemble.

    Arrays have the shape (member,), or (member, strap). What a body's surroundings lack, straps or
    an edge, is NaN, and False.
    """

    def __init__(
        self, of: str, count: int, surroundings: Sequence[Surroundings | None] = ()
    ) -> None:
        """Room for so many, of one of ROCKING, GENERAL, SOLID.

        Args:
            surroundings: of all, or of each.
        """
        self.surroundings = tuple(surroundings)
        straps = max((len(each.straps) for each in surroundings if each), default=0)
        self.arrays: dict[str, NDArray[Any]] = {
            name: np.full(
                (count, straps) if field.along else count, field.unknown, dtype=field.dtype
            )
            for name, field in FIELDS.items()
            if of in field.of and field.is_told(surroundings)
        }

    def store(self, part: Part) -> None:
        """Enter the results of some."""
        for name, array in self.arrays.items():
            if name in part.results:  # not all of them need have surroundings, or as many straps
                found = part.results[name]
                if found.ndim > 1:
                    array[part.members, : found.shape[1]] = found
                else:
                    array[part.members] = found

    def dataset(
        self,
        dimensions: tuple[str, ...],
        shape: tuple[int, ...],
        coordinates: Mapping[str, Any],
        model: Model,
    ) -> xr.Dataset:
        """All of them as a Dataset, brought into a shape."""
        import xarray as xr

        variables = {
            name: (
                (*dimensions, *((FIELDS[name].along,) if FIELDS[name].along else ())),
                values.reshape(*shape, *values.shape[1:]),
                FIELDS[name].attributes,
            )
            for name, values in self.arrays.items()
        }
        told = told_surroundings(self.surroundings)
        held = {"surroundings": told} if told else {}
        return xr.Dataset(variables, coords=coordinates, attrs={"model": repr(model), **held})


def flags_of(kind: type[IntEnum] | None) -> dict[str, object]:
    """What the numbers of a variable mean."""
    if kind is None:
        return {}
    return {
        "flag_values": [int(member) for member in kind],
        "flag_meanings": " ".join(member.name.lower() for member in kind),
    }
