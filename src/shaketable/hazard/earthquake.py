"""What falls of an inventory in one earthquake, building by building.

The earthquake is one of a magnitude at a distance, whose shaking all buildings share, or a
ShakeMap, which has a shaking for each. Objects have fragility functions of the ground's measure,
on floors through the motions of their building.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.building import Building, read_building
from shaketable.errors import InputError, named, quoted
from shaketable.hazard.falls import FallProbability, fall_probability
from shaketable.hazard.functions import ObjectFunction, functions_by_building
from shaketable.hazard.ground_motion import Scenario
from shaketable.hazard.shakemap import ShakeMap
from shaketable.inventory import Item
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS
from shaketable.signal import measure_named

MOST_NAMED = 10


class Location(NamedTuple):
    """A building, or one site without a name.

    Attributes:
        building: its name, "" if the inventory gives none.
        site: longitude and latitude [degrees], None where the inventory gives none.
    """

    building: str
    site: tuple[float, float] | None

    @property
    def name(self) -> str:
        if self.building or self.site is None:
            return self.building
        return f"{self.site[1]:.10g}, {self.site[0]:.10g}"


class Shaken(NamedTuple):
    """How strongly a place is shaken: ln of the measure [SI] is normal."""

    mean: float
    sigma: float


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectChance(ObjectFunction):
    """How likely one object falls in the earthquake, in one direction, by its fragility function.

    Attributes:
        place: where it stands.
        shaken: how strongly that is shaken.
        chance: the probability of a fall, NaN where it has no function.
    """

    place: Location
    shaken: Shaken
    chance: FallProbability


def place_of(item: Item) -> Location:
    """The building of an object, or its site."""
    return Location(item.building, item.site)


def located(items: Sequence[Item]) -> list[Item]:
    """The objects, with the site of their building where only others in it say it.

    Raises:
        InputError: a building at several sites.
    """
    sites: dict[str, set[tuple[float, float]]] = {}
    for item in items:
        if item.building and item.site is not None:
            sites.setdefault(item.building, set()).add(item.site)
    torn = [name for name, found in sites.items() if len(found) > 1]
    if torn:
        raise InputError(
            f"the building {quoted(torn[0])} has {len(sites[torn[0]])} different latitudes and "
            "longitudes: give all its objects the same"
        )
    return [
        replace(item, site=next(iter(sites[item.building])))
        if item.site is None and item.building in sites
        else item
        for item in items
    ]


def shaken_places(
    items: Sequence[Item], quake: Scenario | ShakeMap, measure: str
) -> dict[Location, Shaken]:
    """The places of what stands free, with their shaking, in the order of the inventory.

    Raises:
        InputError: a map, and an object without latitude and longitude; a site off the map, a
            measure that it does not have.
    """
    standing = [item for item in items if item.loose]
    places = list(dict.fromkeys(place_of(item) for item in standing))
    if isinstance(quake, Scenario):
        mean, sigma = quake.of(measure)
        return dict.fromkeys(places, Shaken(float(mean), float(sigma)))
    nowhere = [item.name for item in standing if item.site is None]
    if nowhere:
        raise InputError(
            f"{len(nowhere)} of {len(standing)} objects have no latitude and longitude, which a "
            f"ShakeMap needs: {named(nowhere, MOST_NAMED)}"
        )
    lon, lat = np.array([place.site for place in places]).T
    means, sigmas = quake.of(measure, lon, lat)
    return {
        place: Shaken(float(m), float(s)) for place, m, s in zip(places, means, sigmas, strict=True)
    }


def object_chances(
    items: Sequence[Item],
    places: Mapping[Location, Shaken],
    motions: Sequence[Motion],
    measure: str,
    *,
    houses: Mapping[str, Path] | None = None,
    tilt: float = 0.0,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> list[ObjectChance]:
    """How likely each object falls in the earthquake, by fragility functions.

    Args:
        items: objects; those that are anchored are left out.
        places: of all of them, as `shaken_places` gives them.
        motions: recorded, of the ground, from which the functions are found.
        measure: of the ground.
        houses: files of buildings by name; what has none stands on the ground.
        tilt, model, draws, seed, progress, threads: as for `fragility`.

    Raises:
        InputError: a building with recorded floors, a floor that it does not have, or what
            `fragility` says.
    """
    functions = functions_by_building(
        items, motions, measure, houses=houses or {}, tilt=tilt, model=model, draws=draws,
        seed=seed, progress=progress, threads=threads,
    )  # fmt: skip
    return [_chance(one, places[place_of(one.item)]) for one in functions]


def _chance(one: ObjectFunction, shaken: Shaken) -> ObjectChance:
    return ObjectChance(
        number=one.number, item=one.item, direction=one.direction, curve=one.curve,
        floor=one.floor, place=place_of(one.item), shaken=shaken,
        chance=fall_probability(one.curve, *shaken),
    )  # fmt: skip


def shaken_house(
    items: Sequence[Item],
    ground: Mapping[Location, Sequence[Motion]],
    houses: Mapping[str, Path],
    name: str,
) -> tuple[list[Item], Building]:
    """All places as one building whose floors are those of every building.

    Args:
        items: objects.
        ground: motions of the ground of each place.
        houses: files of buildings by name; what has none stands on the ground.
        name: what to call it all.

    Returns:
        The objects in their order with the label of their floor there, and the building.

    Raises:
        InputError: a building with recorded floors, or a floor that it does not have.
    """
    floors: dict[str, Sequence[Motion]] = {}
    labels: dict[tuple[Location, str], str] = {}
    told = []
    first = next(iter(ground.values()))
    alike = all(motions is first for motions in ground.values())
    for place, motions in ground.items():
        if place.building not in houses:
            own = "" if alike else place.name
            label = f"{own}, ground level" if own else "ground level"
            floors[label] = motions
            labels[place, ""] = label
            continue
        house = read_building(houses[place.building], motions)
        told.append(f"{house.name}: {house.told}")
        for floor, there in house.floors.items():
            label = f"{place.name}, floor {floor}" if place.name else floor
            floors[label] = there
            labels[place, floor] = label
    moved = []
    for item in items:
        if not item.loose:
            moved.append(item)
            continue
        place = place_of(item)
        floor = item.floor if place.building in houses else ""
        if (place, floor) not in labels:
            known = [label for where, label in labels if where == place]
            raise InputError(
                f"{houses[place.building]}: has no floor {quoted(item.floor)}, on which "
                f"{quoted(item.name)} stands; give it one of its floors in a column 'floor': "
                f"{named(known, 20)}"
            )
        moved.append(replace(item, floor=labels[place, floor]))
    return moved, Building(name=name, floors=floors, told="; ".join(told) or "the ground alone")


def motions_of_map(
    motions: Sequence[Motion],
    measure: str,
    places: Mapping[Location, Shaken],
    *,
    seed: int = 0,
) -> dict[Location, list[Motion]]:
    """Recorded motions scaled to what a map tells of each place.

    Of a motion with both horizontal components the larger one is scaled to it, as maps tell it
    (ShakeMap's grid.xml is of the larger of two components).

    The levels of the motions at a place are spread as the map's uncertainty says: they are the
    middles of equally likely parts of its distribution, in an order that is drawn, and the same for
    all places.

    Args:
        motions: recorded, of the ground.
        measure: of the map.
        places: with their shaking.
        seed: of the order.
    """
    from scipy.special import ndtri

    from shaketable.signal.intensity import Record

    known = measure_named(measure)
    values = []
    for motion in motions:
        parts = [known.of(Record(m.horizontal, m.time_step)) for m in motion.components()]
        if not all(part > 0.0 for part in parts):
            raise InputError(f"the motion {motion.name!r} is at rest")
        values.append(max(parts))
    order = np.random.default_rng(seed).permutation(len(motions))
    above: NDArray[np.float64] = ndtri((order + 0.5) / len(motions))
    return {
        place: [
            motion.scaled(float(np.exp(mean + sigma * z) / value))
            for motion, z, value in zip(motions, above, values, strict=True)
        ]
        for place, (mean, sigma) in places.items()
    }
