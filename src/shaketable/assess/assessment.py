"""What an assessment finds: floor by floor, item by item."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

from shaketable.assess.castors import CastorFriction
from shaketable.assess.item_result import ItemResult
from shaketable.assess.mitigation.premises import Premises, premises_of
from shaketable.assess.ranking import Weights, ranked
from shaketable.assess.results import ACCEPTED_FALLS
from shaketable.assess.results_table import table_of
from shaketable.assess.walls import Walls
from shaketable.errors import require_positive
from shaketable.inventory import Item
from shaketable.models import Model
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, kw_only=True)
class Level:
    """A level of shaking.

    Attributes:
        name: what to call it.
        scale: factor on the motions, above zero.
    """

    name: str
    scale: float

    def __post_init__(self) -> None:
        require_positive(f"Level.scale of {self.name!r}", self.scale)


class LevelSummary(NamedTuple):
    """What all items come to at one level of shaking."""

    falls: float  # how many pieces fall, on average
    kinds: int  # how many kinds fall in more than ACCEPTED_FALLS


@dataclass(frozen=True, kw_only=True, eq=False)
class FloorAssessment:
    """What stands on one floor, or in the one place where there is no building.

    Attributes:
        floor: its label, "" where there is no building.
        results: those of its items, in the inventory's order.
        motions: their names.
        recordings: how many independent recordings the motions come from.
        pairs: how many motions have both horizontal components, by which solids were shaken.
        artificial: whether nobody recorded them.
        smallest_pga, largest_pga: among the scaled motions [m/s²].
    """

    floor: str
    results: Sequence[ItemResult]
    motions: Sequence[str]
    recordings: int
    smallest_pga: float
    largest_pga: float
    pairs: int = 0
    artificial: bool = False

    @property
    def pieces(self) -> int:
        return sum(result.item.quantity for result in self.results)

    @property
    def expected_falls(self) -> float:
        """How many of the pieces fall, on average over the motions."""
        return sum(each.overturns.value * each.item.quantity for each in self.results)


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessment:
    """Results of `assess`.

    Attributes:
        floors: those that have items, from the lowest up; one where there is no building.
        control: wanted share of falls that go downhill.
        tilt: β [rad] of the supports on which the items stand now.
        scale: factor on the motions.
        model: the contact model.
        levels: of shaking, for which falls were counted beside those at `scale`.
        castors: friction of what stands on castors.
        weights: what counts in the order of objects.
        premises: where they stand.
        anchored, hanging: items that were not simulated.
        walls: whether things stand against a wall.
        crustal: whether all motions are packaged ones, which are of shallow crustal earthquakes.
        vertical: whether motions have a vertical component.
        tried: the buildings of which the worst leads for each object, in words.
    """

    floors: Sequence[FloorAssessment]
    control: float
    tilt: float
    scale: float
    model: Model
    levels: Sequence[Level] = ()
    castors: CastorFriction = field(default_factory=CastorFriction)
    weights: Weights = field(default_factory=Weights)
    premises: Premises = field(default_factory=lambda: premises_of(None))
    anchored: Sequence[Item] = ()
    hanging: Sequence[Item] = ()
    walls: Walls = Walls.UNKNOWN
    crustal: bool = False
    vertical: bool = True
    tried: Sequence[str] = ()

    @property
    def in_building(self) -> bool:
        """Whether objects stand on the floors of a building, each with its own motions."""
        return bool(self.floors[0].floor)

    @property
    def results(self) -> list[ItemResult]:
        """The results of all items."""
        return [result for floor in self.floors for result in floor.results]

    @property
    def uncertain(self) -> list[ItemResult]:
        """The results that tell what becomes of objects like the item."""
        return [result for result in self.results if result.uncertain is not None]

    @property
    def solids(self) -> list[ItemResult]:
        """The results that tell what becomes of the item in three dimensions."""
        return [result for result in self.results if result.solid is not None]

    @property
    def recordings(self) -> int:
        """How many independent recordings the motions come from; of floors, the fewest."""
        return min(floor.recordings for floor in self.floors)

    @property
    def pairs(self) -> int:
        """By how many motions with both components solids were shaken; of floors, the fewest.

        Floors where everything was shaken in a plane do not count; 0 where all are such.
        """
        return min((floor.pairs for floor in self.floors if floor.pairs), default=0)

    def at_level(self, number: int) -> LevelSummary:
        """What happens at one of the levels."""
        falls = [(each.item.quantity, each.levels[number].fall.value) for each in self.results]
        return LevelSummary(
            sum(quantity * share for quantity, share in falls),
            sum(share > ACCEPTED_FALLS for _, share in falls),
        )

    @property
    def sources(self) -> str:
        """What the independent motions are: recordings, or artificial motions."""
        artificial = all(floor.artificial for floor in self.floors)
        return "artificial motions" if artificial else "recordings"

    def ranked(self, floor: FloorAssessment | None = None) -> list[ItemResult]:
        """The results of a floor, or of all, in the order in which to look at them."""
        return ranked(floor.results if floor else self.results, self.weights)

    @property
    def table(self) -> pd.DataFrame:
        """One row per item; units are in the columns' names."""
        return table_of(
            [(floor.floor, floor.results) for floor in self.floors],
            self.weights,
            [level.name for level in self.levels],
        )

    def __repr__(self) -> str:
        worst = max(self.results, key=lambda result: result.overturns.value)
        pieces = sum(floor.pieces for floor in self.floors)
        return (
            f"Assessment({len(self.results)} items, {pieces} pieces, {self.model!r}, tilt "
            f"{degrees(self.tilt):.3g}°; {worst.item.name!r} falls in "
            f"{100 * worst.overturns.value:.0f} % of the simulations)"
        )

    def _repr_html_(self) -> str:
        """For notebooks: the table."""
        return self.table.to_html(float_format=lambda value: f"{value:.3g}")


def worst_of(found: Mapping[str, Assessment]) -> Assessment:
    """Of each object what was found in the building in which it falls most often.

    Args:
        found: the same items in several buildings, by what these are called.
    """
    every = list(found.values())
    floors = []
    for alike in zip(*(each.floors for each in every), strict=True):
        results = [
            max(same, key=lambda each: each.governing_share.value)
            for same in zip(*(floor.results for floor in alike), strict=True)
        ]
        smallest = min(floor.smallest_pga for floor in alike)
        largest = max(floor.largest_pga for floor in alike)
        floors.append(
            replace(alike[0], results=results, smallest_pga=smallest, largest_pga=largest)
        )
    return replace(every[0], floors=floors, tried=tuple(found))
