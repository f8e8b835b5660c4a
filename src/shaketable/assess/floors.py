"""The main job in a building: every floor's items under that floor's motions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.assess.job import Assessment, assess
from shaketable.building import Building
from shaketable.errors import InputError, joined
from shaketable.inventory import Item
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, kw_only=True, eq=False)
class Part:
    """The assessment of what stands in one place.

    Attributes:
        floor: its label, "" where there is no building.
        assessment: of its items.
        smallest_pga_g, largest_pga_g: of its motions, scaled.
    """

    floor: str
    assessment: Assessment
    smallest_pga_g: float
    largest_pga_g: float

    @property
    def pieces(self) -> int:
        return int(self.assessment.table["quantity"].sum())

    @property
    def expected_falls(self) -> float:
        """How many of the pieces fall, on average over the motions."""
        table = self.assessment.table
        return float((table["fall_share"] * table["quantity"]).sum())


def part_of(floor: str, items: Sequence[Item], motions: Sequence[Any], **options: Any) -> Part:
    """Assess the items of one place; options as for `assess`."""
    scale = options.get("scale", 1.0)
    peaks = [motion.peak_ground_acceleration * scale / STANDARD_GRAVITY for motion in motions]
    return Part(
        floor=floor,
        assessment=assess(items, motions, **options),
        smallest_pga_g=min(peaks),
        largest_pga_g=max(peaks),
    )


def assess_floors(items: Sequence[Item], building: Building, **options: Any) -> list[Part]:
    """Assess the items of every floor that has any, from the lowest to the highest.

    Args:
        items: each with the label of its floor.
        building: the motions of the floors.
        options: as for `assess`.

    Raises:
        InputError: items without a floor, or on one that the building does not have.
    """
    known = ", ".join(building.floors)
    faults = [
        f"{item.name!r}: no floor is given; {building.name} has {known}"
        for item in items
        if not item.floor
    ]
    faults += [
        f"{item.name!r}: stands on floor {item.floor!r}; {building.name} has {known}"
        for item in items
        if item.floor and item.floor not in building.floors
    ]
    if faults:
        raise InputError(joined(faults))
    return [
        part_of(label, here, motions, **options)
        for label, motions in building.floors.items()
        if (here := [item for item in items if item.floor == label])
    ]


def whole_table(parts: Sequence[Part]) -> pd.DataFrame:
    """The tables of all parts, one below the other, with their floors."""
    import pandas as pd

    tables = [part.assessment.table for part in parts]
    if len(parts) == 1 and not parts[0].floor:
        return tables[0]
    floors = np.repeat([part.floor for part in parts], [len(table) for table in tables])
    whole = pd.concat(tables, ignore_index=True)
    whole.insert(1, "floor", floors)
    return whole
