"""The fragility functions of the objects of an inventory, of the ground's measure."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from shaketable.body import Body
from shaketable.building import Building, overview, read_building
from shaketable.errors import InputError, named, quoted, refused
from shaketable.fragility import Curve, fragility
from shaketable.fragility.intensities import OWN
from shaketable.inventory import Item
from shaketable.inventory.directions import Directed, directed
from shaketable.models import General, Model, Rocking, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS
from shaketable.surroundings import Surroundings

log = logging.getLogger(__name__)

MOST_NAMED = 10


@dataclass(frozen=True, kw_only=True, eq=False)
class ObjectFunction:
    """The fragility function of one object in one direction, of the ground's measure.

    Attributes:
        number: its place in the inventory, from 1.
        item: the object.
        direction: front to back, or side to side.
        curve: the function; that of the first of several objects that are alike.
        floor: whose motions it was found from, "" for the ground.
    """

    number: int
    item: Item
    direction: str
    curve: Curve
    floor: str = ""


def house_files(
    paths: Sequence[Path], items: Sequence[Item], *, own_motions: bool = False
) -> dict[str, Path]:
    """The files of buildings by the name that the inventory gives each.

    One file alone is that of an inventory that names no building.

    Args:
        paths: of the files.
        items: of the inventory.
        own_motions: whether motions that a file names are those that shake the building, where it
            is the only one.

    Raises:
        InputError: two files of one name, a file that no object names, or recorded floors.
    """
    files: dict[str, Path] = {}
    unused = []
    for path in paths:
        told = overview(path)
        if told.recorded:
            raise refused(
                path,
                "has recorded floors, whose motions are not those of another earthquake "
                "of the ground: give storeys with first_period_s, or with 'profile = \"ASCE "
                "7-22\"'",
            )
        if told.name in files:
            raise InputError(f"{path} and {files[told.name]} are both called {quoted(told.name)}")
        files[told.name] = path
        unused += [str(path)] if told.own_motions else []
    known = {item.building for item in items}
    only = len(files) == 1 and known == {""}
    if unused and not (only and own_motions):
        log.warning("motions that these files name are not used: %s", named(unused, MOST_NAMED))
    if only:
        return {"": next(iter(files.values()))}
    strange = [name for name in files if name not in known]
    if strange:
        there = named(sorted(known - {""}), 20) or "none"
        raise InputError(
            f"{files[strange[0]]}: no object of the inventory is in a building called "
            f"{quoted(strange[0])}; its column building has: {there}"
        )
    lost = sorted({item.building or item.name for item in items
                   if item.floor and item.building not in files})  # fmt: skip
    if lost:
        log.warning(
            "floor is for --building: without a file of their building these stand on the ground "
            "here, and fall more often on upper floors: %s",
            named(lost, MOST_NAMED),
        )
    return files


def functions_by_building(
    items: Sequence[Item],
    motions: Sequence[Motion],
    measure: str,
    *,
    houses: Mapping[str, Path],
    tilt: float = 0.0,
    components: str = OWN,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> list[ObjectFunction]:
    """The fragility functions of objects in several buildings, in the order of the inventory.

    Args:
        items, tilt, components, model, draws, seed, progress, threads: as for
            `object_functions`.
        motions: of the ground.
        measure: of the ground.
        houses: files of buildings by name; what has none stands on the ground.

    Raises:
        InputError: as for `object_functions`.
    """
    groups: dict[str | None, list[tuple[int, Item]]] = {}
    for number, item in enumerate(items, 1):
        if item.loose:
            own = item.building if item.building in houses else None
            groups.setdefault(own, []).append((number, item))
    if not groups:
        raise InputError("every object is anchored or hangs: nothing stands free")
    found: list[ObjectFunction] = []
    for name, here in groups.items():
        shaking = motions if name is None else read_building(houses[name], motions)
        functions = object_functions(
            [item for _, item in here], shaking, measure, tilt=tilt, components=components,
            model=model, draws=draws, seed=seed, progress=progress, threads=threads,
        )  # fmt: skip
        found += [replace(one, number=here[one.number - 1][0]) for one in functions]
    return sorted(found, key=lambda one: one.number)


def object_functions(
    items: Sequence[Item],
    shaking: Sequence[Motion] | Building,
    measure: str,
    *,
    tilt: float = 0.0,
    components: str = OWN,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> list[ObjectFunction]:
    """The fragility functions of objects over a measure of the ground, each on its floor.

    Walls, straps, pads and edges of an object that act in a direction are simulated in its plane.

    Args:
        items, shaking, tilt, components, model, draws, seed, progress, threads: as for
            `object_rates`.
        measure: of the ground.

    Raises:
        InputError: as for `object_rates`.
    """
    standing = [(number, item) for number, item in enumerate(items, 1) if item.loose]
    if not standing:
        raise InputError("every object is anchored or hangs: nothing stands free")
    rolling = sum(item.rolls for _, item in standing)
    if rolling:
        log.warning("%d objects on castors are taken as if they did not roll", rolling)
    places = _places(shaking, standing)
    ground = places[0][1]
    found: dict[tuple[int, str], ObjectFunction] = {}
    for label, motions in places:
        here = [(n, item) for n, item in standing if label is None or item.floor == label]
        if not here:
            continue
        ways = directed(here)
        curves: dict[tuple[Body, Surroundings | None], Curve] = {}
        for held in (False, True):
            alike: dict[tuple[Body, Surroundings | None], Directed] = {}
            for way in ways:
                if bool(way.surroundings) == held:
                    alike.setdefault(_alone(way), way)
            if not alike:
                continue
            around = [way.surroundings for way in alike.values()]
            functions = fragility(
                [way.body for way in alike.values()], motions, measure=measure, ground=ground,
                tilt=tilt, components=components, model=_surrounded(model) if held else model,
                surroundings=around if held else None, draws=draws, seed=seed, progress=progress,
                threads=threads,
            )  # fmt: skip
            curves |= zip(alike, functions.curves, strict=True)
        for way in ways:
            found[way.number, way.direction] = ObjectFunction(
                number=way.number,
                item=way.item,
                direction=way.direction,
                curve=curves[_alone(way)],
                floor=label or "",
            )
    return [found[key] for key in sorted(found)]


def _alone(way: Directed) -> tuple[Body, Surroundings | None]:
    """What decides a function: all but the name."""
    return replace(way.body, name=""), way.surroundings


def _surrounded(model: Model | str | None) -> Model:
    """The model among walls, straps and edges: the general one that does the same."""
    known = model_of(model)
    if isinstance(known, Rocking) and known.restitution is None:
        return General(restitution_factor=known.restitution_factor)
    return known


def _places(
    shaking: Sequence[Motion] | Building, standing: Sequence[tuple[int, Item]]
) -> list[tuple[str | None, Sequence[Motion]]]:
    """Floors and their motions, the ground first; one without a name where there are none."""
    if not isinstance(shaking, Building):
        return [(None, shaking)]
    if not shaking.computed:
        raise InputError(
            f"{shaking.name}: has recorded floors, whose motions are not those of the ground at "
            "other levels; the hazard is of the ground: give storeys with first_period_s, or with "
            'profile = "ASCE 7-22"'
        )
    strange = [item.floor for _, item in standing if item.floor not in shaking.floors]
    if strange:
        raise InputError(
            f"{shaking.name}: has no floor {quoted(strange[0])}; its floors are "
            f"{named(list(shaking.floors), 20)}"
        )
    return list(shaking.in_components().floors.items())
