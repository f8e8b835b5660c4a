"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace

from shaketable.assess.advice import with_advice
from shaketable.assess.assessment import Assessment, Level, worst_of
from shaketable.assess.carried import kick_among
from shaketable.assess.castors import CastorFriction
from shaketable.assess.floor import floor_of, model_in_space
from shaketable.assess.mitigation import LEADING, Premises, kinds_of, premises_of
from shaketable.assess.profiles import profiles_of
from shaketable.assess.ranking import Weights
from shaketable.assess.results import MitigationKind
from shaketable.assess.walls import Walls, at_their_walls, walls_of
from shaketable.building import Building
from shaketable.compile_ahead import compile_ahead
from shaketable.errors import InputError, joined, named, require_number
from shaketable.inventory import Item
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records import DEFAULT_SUITE, is_packaged, suite
from shaketable.simulate import listed, require_stable
from shaketable.simulate.shaking_set import require_scale
from shaketable.support import Support
from shaketable.tilting import CONTROL, require_control
from shaketable.units import degrees

log = logging.getLogger(__name__)

MOST_NAMED = 10  # objects in an error

_ITEM = "an Item: read some with read_inventory(path), or make one with Item(body=..., height=...)"


def assess(
    items: Sequence[Item],
    motions: Sequence[Motion] | Building | None = None,
    *,
    scale: float = 1.0,
    levels: Sequence[Level] = (),
    tilt: float = 0.0,
    control: float = CONTROL,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    weights: Weights | None = None,
    uncertainty: bool = False,
    planar: bool = False,
    premises: Premises | str | None = None,
    mitigations: Sequence[MitigationKind | str] = (),
    leading: int = LEADING,
    walls: Walls | str | None = None,
    progress: Progress = True,
) -> Assessment:
    """Simulate a list of objects: which overturn, slide or roll, and which measures help.

    Every motion counts twice, as recorded and reversed. Where motions have both horizontal
    components an object whose depth and width are known is simulated in three dimensions, turned in
    several ways to them, on the floor on which it stands: that decides. What else there is is
    simulated in a plane, by one component at a time, front to back and side to side if both sizes
    are known, and the worse of the two directions decides.

    Args:
        items: the inventory; in a building each item has the label of its floor. Items that are
            anchored or hang are listed and not simulated.
        motions: such as `suite(name, pairs=True)` gives, of which those with one component are
            left out where enough have both; or a building with those of its floors, all of its
            variants, of which the worst leads for each object. The default suite if None.
        scale: factor on all motions.
        levels: other factors on all motions, for which falls alone are counted.
        tilt: β [rad] >= 0 of what the items stand on now, toward their fronts; what stands on
            castors, and the direction side to side, are taken as level.
        control: share of the falls that the wanted tilt sends downhill, in (0.5, 1).
        model, progress: as for simulate_many; only a model that slides tells how far things slide.
        castors: friction of what stands on castors, which slides or rolls in the general model.
        weights: what counts in the order of objects.
        uncertainty: whether to tell, beside the shares, the probability that objects like these
            fall, whose sizes and supports are not known exactly.
        planar: whether to simulate everything in a plane, the quick way, each component by itself.
        premises: where they stand, one of PREMISES or its name: which measures are tried first,
            and what counts in the order of objects unless `weights` says it.
        mitigations: kinds that are tried, with all their variants, on every kind of object that
            falls, where it falls most; if none, up to four on each of those that lead the order.
        leading: how many those are; 0 for none.
        walls: whether most things stand against a wall: "yes" puts one 10 mm behind all that
            have none and are not on castors, on furniture or near an edge, "no" none; "each" takes
            those that items give. If it is left out things stand free, unless items give walls, and
            where a wall is tried as a measure its share stands beside.

    Raises:
        InputError: no items or motions, values out of range, an item that falls by itself, or one
            without a floor in a building; both components with a model that solids do not know;
            `mitigations` where nothing is simulated in three dimensions.
    """
    if motions is None:
        motions = suite(DEFAULT_SUITE, pairs=True)
    if isinstance(motions, Building) and motions.variants:
        return worst_of(
            {
                name: assess(
                    items,
                    each,
                    scale=scale,
                    levels=levels,
                    tilt=tilt,
                    control=control,
                    model=model,
                    castors=castors,
                    weights=weights,
                    uncertainty=uncertainty,
                    planar=planar,
                    premises=premises,
                    mitigations=mitigations,
                    leading=leading,
                    walls=walls,
                    progress=progress,
                )
                for name, each in motions.variants.items()
            }
        )
    items = listed("items", items, Item, _ITEM)
    require_control(control)
    where = premises_of(premises)
    kinds = kinds_of(mitigations)
    answer = walls_of(walls, items)
    if answer is Walls.YES and planar:
        raise InputError(
            "things are put before walls in three dimensions alone: leave out planar, or answer no"
        )
    items = at_their_walls(items, answer)
    if where.itself:
        items = [replace(item, must_not_fall=True) for item in items]
    model, castors = model_of(model), castors or CastorFriction()
    anchored = [item for item in items if item.anchored]
    hanging = [item for item in items if item.hangs and not item.anchored]
    loose = {number: item for number, item in enumerate(items, 1) if item.loose}
    if not loose:
        raise InputError(
            "every object is anchored or hangs: there is nothing to shake; write no in a column "
            "'anchored' for those whose fall is to be simulated"
        )
    require_assessable(list(loose.values()), scale, tilt, model)
    rolling = [item.name for item in loose.values() if item.rolls]
    if tilt and rolling:
        log.warning(
            "what stands on castors is simulated on a level floor, not on a tilt of %.3g°, on "
            "which free castors may roll away by themselves: %s",
            degrees(tilt),
            named(rolling, MOST_NAMED),
        )
    places = _places(loose, motions)
    shaken = {
        label: floor_of(there, planar, scale, tilt, control, levels, model, castors)
        for label, there in _shaken(places, motions).items()
    }
    in_space = any(floor.space for floor in shaken.values())
    if kinds and not in_space:
        why = "planar=True" if planar else "both horizontal components of the motions"
        raise InputError(
            "mitigations are simulated in three dimensions alone; "
            f"{'leave out' if planar else 'they need'} {why}"
        )
    held = [item.name for item in loose.values() if item.surroundings]
    alone = [
        item.name
        for label, here, _ in places
        for item in here.values()
        if item.surroundings and not shaken[label].space
    ]
    if alone:
        log.warning(
            "walls, straps, pads and edges are simulated in three dimensions alone, which need "
            "pairs of horizontal components; here these stand alone: %s",
            named(alone, MOST_NAMED),
        )
    if uncertainty and held:
        log.warning(
            "uncertain objects are simulated without walls, straps, pads and edges; of these no "
            "probability is told: %s",
            named(held, MOST_NAMED),
        )
    kernels = ("move_one",) if model.slides else ("rock_many", "rock_one")
    compile_ahead(
        ("move_many", *kernels, *(("move_solid",) if in_space else ())), progress=progress is True
    )
    total = sum(
        shaken[label].planned(list(here.values()), uncertainty) for label, here, _ in places
    )
    found = []
    begun = time.perf_counter()
    with meter("assessing", total, progress) as done:
        for label, here, _ in places:
            results = shaken[label].assessed(list(here.values()), uncertainty, done)
            numbered = [
                replace(result, number=number, kick=kick_among(result.item, items))
                for number, result in zip(here, results, strict=True)
            ]
            found.append(shaken[label].as_found(label, numbered))
    seconds = (time.perf_counter() - begun) / max(1, total)
    weights = weights or where.weights
    if in_space and (leading or kinds):
        computed = isinstance(motions, Building) and motions.computed
        lowest = next(iter(shaken)) if computed else ""
        found = with_advice(
            found, shaken, lowest, where, weights, kinds, leading, seconds, progress
        )
    return Assessment(
        floors=found,
        control=control,
        tilt=tilt,
        scale=scale,
        model=model,
        levels=tuple(levels),
        castors=castors,
        weights=weights,
        premises=where,
        anchored=anchored,
        hanging=hanging,
        walls=answer,
        crustal=all(map(is_packaged, _motions_of(motions))),
        vertical=any(each.vertical is not None for each in _motions_of(motions)),
    )


def _motions_of(motions: Sequence[Motion] | Building) -> list[Motion]:
    """Those of the ground, of a building whose motions are computed, or all of its floors'."""
    if isinstance(motions, Building):
        floors = [each for there in motions.floors.values() for each in there]
        return list(motions.ground) if motions.computed else floors
    return list(motions)


def require_assessable(
    items: Sequence[Item], scale: float, tilt: float, model: Model, in_space: bool = False
) -> None:
    """Raise what `assess` would, before any motion is read.

    Args:
        items: those that are loose.
        scale, tilt, model: as for `assess`.
        in_space: whether they are assessed as solids, too.

    Raises:
        InputError: values out of range, an item that falls by itself, or a model that solids do
            not know.
    """
    require_number("tilt", tilt)
    if not tilt >= 0.0:
        raise InputError(f"the tilt must not be negative, got {degrees(tilt):.4g}°")
    Support(tilt=tilt)  # raises InputError for one that is too steep
    require_scale(scale)
    if in_space:
        model_in_space(model)
    profiles = [profile for item in items for profile in profiles_of(item, tilt)]
    require_stable([each.body for each in profiles], [each.tilt for each in profiles])


def _shaken(
    places: Sequence[tuple[str, Mapping[int, Item], Sequence[Motion]]],
    motions: Sequence[Motion] | Building,
) -> dict[str, Sequence[Motion]]:
    """The motions of every floor with items, and of one to which they may be moved, from that up.

    That is the lowest of a building whose floors are shaken by the same earthquakes.
    """
    found = {label: there for label, _, there in places}
    if isinstance(motions, Building) and motions.computed:
        return {next(iter(motions.floors)): motions.ground} | found
    return found


def _places(
    items: Mapping[int, Item], motions: Sequence[Motion] | Building
) -> list[tuple[str, Mapping[int, Item], Sequence[Motion]]]:
    """Label, items by their numbers, and motions of every floor with items, or the only place."""
    if not isinstance(motions, Building):
        return [("", items, motions)]
    lost: dict[str, list[str]] = {}
    for item in items.values():
        if item.floor not in motions.floors:
            lost.setdefault(item.floor, []).append(repr(item.name))
    faults = [
        f"{f'floor {label!r} is none of the building' if label else 'no floor is given'}: "
        + named(names, MOST_NAMED)
        for label, names in lost.items()
    ]
    if faults:
        floors = ", ".join(motions.floors)
        raise InputError(joined([*faults, f"{motions.name} has the floors {floors}: give each "
                                 "object one of them in a column 'floor'"]))  # fmt: skip
    return [
        (label, here, there)
        for label, there in motions.floors.items()
        if (here := {number: item for number, item in items.items() if item.floor == label})
    ]
