"""What an assessment finds; page, terminal, CSV and words are views of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from shaketable.criteria.kaneko_hayashi_2004 import risk_class
from shaketable.inventory import Item
from shaketable.models import Model
from shaketable.tilting import TiltCurves
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd


class Share(NamedTuple):
    """A share in [0, 1] with its 95 % interval; NaN where it cannot be told."""

    value: float
    low: float
    high: float


class Quartiles(NamedTuple):
    """Observed values: a quarter, a half and three quarters of all are at most that large."""

    lower: float
    median: float
    upper: float


class CriterionResult(NamedTuple):
    """What a simple criterion says of an item."""

    share: float  # of the motions under which it says that the item may overturn
    missed: int  # simulated falls under motions that it calls safe


class FloorRatios(NamedTuple):
    """Mean overturning ratios by formulas for floors."""

    kaneko_hayashi: float
    cimellaro: float
    cimellaro_out_of_range: float  # share of the motions


class Sliding(NamedTuple):
    """How far an item slides in the simulations that leave it upright."""

    share: float  # of all simulations: it stays upright and slides more than tilting.SLIDES
    slip: Quartiles  # m, the farthest in either direction; NaN of none
    walks_off: float  # share of all simulations; NaN where the support's length is not known


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult:
    """One item under the motions of its place.

    Attributes:
        item: what it is.
        simulations: how many; every motion in both directions.
        recordings: how many independent ones the motions are of.
        falls, falls_downhill: of the simulations.
        fall: share of the simulations that overturn it, with Wilson's interval.
        downhill: share of the falls that go downhill, with its interval by bootstrap.
        peak_rotation: [rad]; a fall counts as π/2.
        curves: over the tilts tried, with the one that controls the direction.
        safe_width: base width from which on few overturn it [m], NaN if none does.
        criteria: by the criterion's name; None on a tilted support, which they do not know.
        floor_ratios: likewise.
        sliding: None where the model does not slide.
    """

    item: Item
    simulations: int
    recordings: int
    falls: int
    falls_downhill: int
    fall: Share
    downhill: Share
    peak_rotation: Quartiles
    curves: TiltCurves
    safe_width: float
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None
    sliding: Sliding | None = None

    @property
    def risk(self) -> str:
        """Class of Kaneko and Hayashi (2004)."""
        return risk_class(self.fall.value)


@dataclass(frozen=True, kw_only=True, eq=False)
class FloorAssessment:
    """What stands on one floor, or in the one place where there is no building.

    Attributes:
        floor: its label, "" where there is no building.
        results: of its items, in the inventory's order.
        motions: names.
        recordings: how many independent ones they are of.
        smallest_pga, largest_pga: of the motions, scaled [m/s²].
    """

    floor: str
    results: Sequence[ItemResult]
    motions: Sequence[str]
    recordings: int
    smallest_pga: float
    largest_pga: float

    @property
    def pieces(self) -> int:
        return sum(result.item.quantity for result in self.results)

    @property
    def expected_falls(self) -> float:
        """How many of the pieces fall, on average over the motions."""
        return sum(result.fall.value * result.item.quantity for result in self.results)

    def worst_first(self) -> list[ItemResult]:
        """What falls most on top."""
        return sorted(self.results, key=lambda result: -result.fall.value)


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """Results of `assess`.

    Attributes:
        floors: from the lowest to the highest that has items; one where there is no building.
        control: wanted share of falls that go downhill.
        tilt: β [rad] on which the items stand now.
        scale: factor on the motions.
        model: the contact model.
    """

    floors: Sequence[FloorAssessment]
    control: float
    tilt: float
    scale: float
    model: Model

    @property
    def results(self) -> list[ItemResult]:
        """Of all items."""
        return [result for floor in self.floors for result in floor.results]

    @property
    def table(self) -> pd.DataFrame:
        """One row an item; units are in the columns' names."""
        from shaketable.assess.table import table_of

        return table_of(self)

    def __repr__(self) -> str:
        worst = max(self.results, key=lambda result: result.fall.value)
        pieces = sum(floor.pieces for floor in self.floors)
        return (
            f"Assessment({len(self.results)} items, {pieces} pieces, {self.model!r}, tilt "
            f"{degrees(self.tilt):.3g}°; {worst.item.name!r} falls in "
            f"{100 * worst.fall.value:.0f} % of {worst.simulations} simulations)"
        )

    def _repr_html_(self) -> str:
        """For notebooks: the table."""
        return self.table.to_html(float_format=lambda value: f"{value:.3g}")
