"""How often a year the objects of an inventory fall, each on its floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.building import Building
from shaketable.fragility.intensities import GEOMETRIC_MEAN
from shaketable.hazard.curve import Hazard
from shaketable.hazard.functions import ObjectFunction, functions_by_building, object_functions
from shaketable.hazard.rates import YEARS, AnnualRate, rate_of, warn_of_tails
from shaketable.inventory import Item
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectRate(ObjectFunction):
    """How often one object falls in one direction.

    Attributes:
        found: its rate.
    """

    found: AnnualRate


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectRates:
    """The rates of all objects of an inventory that stand free.

    Attributes:
        rates: in the order of the inventory, of some objects in two directions.
        hazard: of the site.
        motions: how many, of each floor.
        components: of which the levels of the functions are.
    """

    rates: tuple[ObjectRate, ...]
    hazard: Hazard
    motions: int
    components: str

    def of_objects(self) -> dict[int, ObjectRate]:
        """Of each object by its number the direction in which it falls more often.

        The object's rate lies between this rate and the sum over both directions. A direction in
        which every simulation overturns has no rate, and is the worse one.
        """

        def worse(one: ObjectRate) -> tuple[bool, float]:
            return one.curve.always, float(np.nan_to_num(one.found.rate, nan=-1.0))

        found: dict[int, ObjectRate] = {}
        for one in self.rates:
            before = found.get(one.number)
            if before is None or worse(one) > worse(before):
                found[one.number] = one
        return found

    def ranked(self) -> list[ObjectRate]:
        """Objects with a rate, the one with the most falls first."""
        known = [one for one in self.of_objects().values() if np.isfinite(one.found.rate)]
        return sorted(known, key=lambda one: -one.item.quantity * one.found.rate)

    def expected(self, years: float = 1.0) -> float:
        """How many pieces fall in so many years, on average; what has no function is left out."""
        return float(sum(one.item.quantity * one.found.rate * years for one in self.ranked()))

    def table(self, years: float = YEARS) -> pd.DataFrame:
        """A row for each object and direction."""
        import pandas as pd

        rows = []
        for one in self.rates:
            low, high = one.found.interval
            chance = one.found.probability_interval(years)
            rows.append({
                "number": one.number,
                "row": one.item.row,
                "name": one.item.name,
                "building": one.item.building,
                "floor": one.item.floor,
                "location": one.item.location,
                "quantity": one.item.quantity,
                "direction": one.direction,
                "median": one.curve.median,
                "beta": one.curve.beta,
                "measure": one.curve.measure.name,
                "unit": one.curve.measure.unit,
                "annual_rate": one.found.rate,
                "annual_rate_low": low,
                "annual_rate_high": high,
                "years_between": 1.0 / one.found.rate if one.found.rate > 0.0 else np.inf,
                f"probability_in_{years:g}_years": one.found.probability(years),
                f"probability_in_{years:g}_years_low": chance[0],
                f"probability_in_{years:g}_years_high": chance[1],
                "share_below_curve": one.found.below,
                "share_above_curve": one.found.above,
                "problem": one.curve.problem or one.curve.caution,
            })  # fmt: skip
        return pd.DataFrame(rows)


def object_rates(
    items: Sequence[Item],
    shaking: Sequence[Motion] | Building,
    hazard: Hazard,
    *,
    houses: Mapping[str, Path] | None = None,
    tilt: float = 0.0,
    components: str = GEOMETRIC_MEAN,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> ObjectRates:
    """How often a year each object of an inventory falls.

    On a floor the fragility function is that of the ground's measure, through the motions of the
    floor: the hazard is of the ground.

    Args:
        items: objects; those that are anchored are left out.
        shaking: motions of the ground, or a building whose floors' motions were computed from
            those of the ground.
        hazard: of the site.
        houses: files of buildings by their name in the inventory, beside motions of the ground.
        components: of which the curve's levels are: the geometric mean of both horizontal
            components, as ground-motion models and the curves made of them tell it (RotD50 is near
            to it), or "own", any one of them.
        tilt, model, draws, seed, progress, threads: as for `fragility`.

    Raises:
        InputError: no object that stands free, a building with recorded floors, a floor that it
            does not have, or what `fragility` and `annual_rate` say.
    """
    options: dict[str, Any] = {
        "tilt": tilt, "components": components, "model": model, "draws": draws, "seed": seed,
        "progress": progress, "threads": threads,
    }  # fmt: skip
    if houses and not isinstance(shaking, Building):
        functions = functions_by_building(
            items, shaking, hazard.measure.name, houses=houses, **options
        )
    else:
        functions = object_functions(items, shaking, hazard.measure.name, **options)
    # objects of one kind share a curve
    of_curve = {
        curve: rate_of(curve, hazard) for curve in dict.fromkeys(one.curve for one in functions)
    }
    rates = tuple(
        ObjectRate(
            number=one.number, item=one.item, direction=one.direction, curve=one.curve,
            floor=one.floor, found=of_curve[one.curve],
        )
        for one in functions
    )  # fmt: skip
    motions = shaking.in_components().ground if isinstance(shaking, Building) else shaking
    found = ObjectRates(rates=rates, hazard=hazard, motions=len(motions), components=components)
    warn_of_tails([one.found for one in found.ranked()], hazard)
    return found
