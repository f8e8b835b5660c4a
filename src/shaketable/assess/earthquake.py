"""Falls in one earthquake by simulation, beside those by fragility functions, and why they differ.

A fragility function knows one measure of the shaking. Between the share of the simulated motions
that overturn an object and the probability by its function stands a third number, the mean of the
function over the measures of the simulated motions: it differs from the probability as far as those
motions are not as strong as the earthquake is said to be, and from the share as far as the measure
does not tell what a motion does.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.assessment import Assessment
from shaketable.assess.shares import Share
from shaketable.hazard.earthquake import Location, ObjectChance, Shaken
from shaketable.hazard.falls import probabilities
from shaketable.hazard.spatial import Fall, total_falls
from shaketable.motion import Motion
from shaketable.signal import Measure
from shaketable.signal.intensity import Record

if TYPE_CHECKING:
    import pandas as pd


class ObjectFall(NamedTuple):
    """One object in one direction.

    Attributes:
        chance: by its fragility function.
        simulated: share of the simulated motions that overturn it; None where none were simulated.
        through: mean of its function over the measures of those motions; NaN likewise.
    """

    chance: ObjectChance
    simulated: Share | None
    through: float

    @property
    def weight(self) -> tuple[float, float]:
        """What orders directions and objects: the simulated share, then the probability.

        -1 stands for what is not known.
        """
        chance = self.chance.chance.value
        return (
            self.simulated.value if self.simulated else -1.0,
            chance if chance == chance else -1.0,
        )

    @property
    def falls(self) -> float:
        """How many of its pieces fall on average: simulated, or by its function; NaN if neither."""
        if self.simulated:
            return self.chance.item.quantity * self.simulated.value
        return self.chance.item.quantity * self.chance.chance.value


class Totals(NamedTuple):
    """How many pieces fall on average, of those with both numbers where both are there.

    Attributes:
        pieces: of which this is told.
        simulated, through, by_function: falls; NaN where nothing was simulated.
        by_chance: how far the simulated ones may be off by the number of motions, 95 %, if all
            objects fall or stand together; NaN likewise.
    """

    pieces: int
    simulated: float
    through: float
    by_function: float
    by_chance: float


@dataclass(frozen=True, kw_only=True, eq=False)
class EarthquakeFalls:
    """What falls of an inventory in one earthquake.

    Attributes:
        name: of the earthquake.
        measure: of the ground, of which the functions are.
        falls: of all objects that stand free, of some in two directions.
        places: with their shaking.
    """

    name: str
    measure: Measure
    falls: Sequence[ObjectFall]
    places: Mapping[Location, Shaken]

    @cached_property
    def leading(self) -> tuple[ObjectFall, ...]:
        """Of each object the direction in which it falls more often, in the inventory's order."""
        found: dict[int, ObjectFall] = {}
        for one in self.falls:
            before = found.get(one.chance.number)
            if before is None or one.weight > before.weight:
                found[one.chance.number] = one
        return tuple(found.values())

    def ranked(self) -> list[ObjectFall]:
        """Objects, the one of which most pieces fall first."""
        return sorted(
            self.leading, key=lambda one: (np.isnan(one.falls), -one.falls, -one.weight[1])
        )

    def without_function(self) -> list[ObjectFall]:
        """Objects without a fragility function, as they never fall, or always do."""
        return [one for one in self.leading if np.isnan(one.chance.chance.value)]

    def totals(self) -> Totals:
        """How many pieces fall in all; what has no function is left out."""
        rows = [
            (
                one.chance.item.quantity,
                one.simulated.value if one.simulated else np.nan,
                one.through,
                one.chance.chance.value,
                (one.simulated.high - one.simulated.low) / 2.0 if one.simulated else np.nan,
            )
            for one in self.leading
            if np.isfinite(one.chance.chance.value)
        ]
        if not rows:
            return Totals(0, np.nan, np.nan, np.nan, np.nan)
        table = np.array(rows)
        return Totals(int(table[:, 0].sum()), *(table[:, 0] @ table[:, 1:]).tolist())

    @cached_property
    def interval(self) -> tuple[float, float]:
        """The 95 % range of how many pieces fall in all by their functions.

        Over earthquakes of the same median shaking, which depart from it everywhere together.
        """
        numbers = {place: k for k, place in enumerate(self.places)}
        falls = [
            Fall(numbers[one.chance.place], one.chance.item.quantity, one.chance.curve.median,
                 one.chance.curve.beta)
            for one in self.leading if np.isfinite(one.chance.chance.value)
        ]  # fmt: skip
        if not falls:
            return np.nan, np.nan
        return total_falls(
            falls, list(self.places.values()), [place.site for place in self.places],
            self.measure.name,
        )  # fmt: skip

    def table(self) -> pd.DataFrame:
        """A row for each object and direction, in SI."""
        import pandas as pd

        rows = []
        for one in self.falls:
            chance, item = one.chance, one.chance.item
            share = one.simulated or Share(np.nan, np.nan, np.nan)
            lon, lat = chance.place.site or (np.nan, np.nan)
            rows.append({
                "number": chance.number,
                "row": item.row,
                "name": item.name,
                "building": item.building,
                "floor": item.floor,
                "location": item.location,
                "latitude": lat,
                "longitude": lon,
                "quantity": item.quantity,
                "direction": chance.direction,
                "simulated_share": share.value,
                "simulated_share_low": share.low,
                "simulated_share_high": share.high,
                "fall_probability": chance.chance.value,
                "fall_probability_low": chance.chance.low,
                "fall_probability_high": chance.chance.high,
                "function_over_simulated_motions": one.through,
                "median": chance.curve.median,
                "beta": chance.curve.beta,
                "measure": self.measure.name,
                "unit": self.measure.unit,
                "shaking_median": np.exp(chance.shaken.mean),
                "shaking_sigma": chance.shaken.sigma,
                "problem": chance.curve.problem or chance.curve.caution,
            })  # fmt: skip
        return pd.DataFrame(rows)

    def place_table(self) -> pd.DataFrame:
        """A row for each building or site, in SI."""
        import pandas as pd

        sums: dict[Location, NDArray[np.float64]] = {}
        for one in self.leading:
            value = one.chance.chance.value
            known = np.isfinite(value)
            row = np.array([
                one.chance.item.quantity,
                one.chance.item.quantity if known else 0,
                one.chance.item.quantity * value if known else 0.0,
                one.chance.item.quantity * one.simulated.value if one.simulated else np.nan,
            ])  # fmt: skip
            sums[one.chance.place] = sums.get(one.chance.place, np.zeros(4)) + row
        rows = []
        for place, shaken in self.places.items():
            pieces, told, falls, simulated = sums.get(place, np.zeros(4)).tolist()
            lon, lat = place.site or (np.nan, np.nan)
            rows.append({
                "building": place.building, "latitude": lat, "longitude": lon,
                "measure": self.measure.name, "unit": self.measure.unit,
                "shaking_median": np.exp(shaken.mean), "shaking_sigma": shaken.sigma,
                "pieces": int(pieces), "pieces_with_function": int(told),
                "expected_falls": falls if told or not pieces else np.nan,
                "expected_falls_simulated": simulated,
            })  # fmt: skip
        return pd.DataFrame(rows)


def compared(
    name: str,
    measure: Measure,
    chances: Sequence[ObjectChance],
    places: Mapping[Location, Shaken],
    *,
    assessment: Assessment | None = None,
    ground: Mapping[Location, Sequence[Motion]] | None = None,
) -> EarthquakeFalls:
    """Falls by fragility functions, beside those of an assessment of the same objects.

    Args:
        name: of the earthquake.
        measure: of the ground.
        chances: by functions.
        places: with their shaking.
        assessment: of the same items under the earthquake's motions; None where nothing was
            simulated.
        ground: the motions of the ground that were simulated at each place.
    """
    shares = {} if assessment is None else _shares(assessment)
    levels: dict[tuple[Motion, ...], NDArray[np.float64]] = {}
    falls = []
    for one in chances:
        share = shares.get((one.number, str(one.direction)))
        through = np.nan
        if share is not None and ground is not None and np.isfinite(one.chance.value):
            motions = tuple(ground[one.place])
            if motions not in levels:
                levels[motions] = np.log(
                    [measure.of(Record(m.horizontal, m.time_step)) for m in motions]
                )
            seen = probabilities(one.curve.median, one.curve.beta, levels[motions], 0.0)
            through = float(seen.mean())
        falls.append(ObjectFall(one, share, through))
    return EarthquakeFalls(name=name, measure=measure, falls=falls, places=places)


def _shares(assessment: Assessment) -> dict[tuple[int, str], Share]:
    """The simulated shares by number and direction."""
    return {
        (result.number, str(side.profile.direction)): side.fall
        for result in assessment.results
        for side in (result, result.other)
        if side is not None
    }
