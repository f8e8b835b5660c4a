"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from shaketable.assess.alike import alike
from shaketable.assess.assessment import Assessment, FloorAssessment, Level
from shaketable.assess.bases import BASE_GRID, FINER_BASES
from shaketable.assess.castors import CastorFriction
from shaketable.assess.criteria import peaks_of
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.item_result import ItemResult
from shaketable.assess.mitigation import (
    LEADING,
    Premises,
    kinds_of,
    premises_of,
    trials_of,
    what_is_tried,
    with_mitigation,
)
from shaketable.assess.place import results_of
from shaketable.assess.plane import Plane
from shaketable.assess.profiles import profiles_of
from shaketable.assess.ranking import Weights, ranked
from shaketable.assess.results import MitigationKind, UncertainResult
from shaketable.assess.shaking import Shaking
from shaketable.assess.solids import ShakingInSpace, model_of_solids
from shaketable.assess.uncertainty import MEMBERS, uncertain_in_space, uncertain_results
from shaketable.building import Building
from shaketable.compile_ahead import compile_ahead
from shaketable.errors import InputError, joined, named, require_number
from shaketable.inventory import Castors, Item
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Done, Progress, duration, meter
from shaketable.records import DEFAULT_SUITE, suite
from shaketable.resampling import resamples
from shaketable.simulate import ShakingSet, listed, require_stable
from shaketable.simulate.shaking_set import require_scale
from shaketable.support import Support
from shaketable.tilting import CONTROL, TILTS, TURNS, pieces, require_control
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
    progress: Progress = True,
) -> Assessment:
    """Who overturns, which way, and what would help; who slides or rolls, and how far.

    Every motion counts twice, as recorded and reversed. Where motions have both horizontal
    components an object whose depth and width are known is simulated in three dimensions, turned in
    several ways to them, on the floor on which it stands: that decides. What else there is is
    simulated in a plane, by one component at a time, front to back and side to side if both sizes
    are known, and the worse of the two directions decides.

    Args:
        items: the inventory; in a building each item has the label of its floor. Items that are
            anchored are listed and not simulated.
        motions: such as `suite(name, pairs=True)` gives, of which those with one component are
            left out where enough have both; or a building with those of its floors. The default
            suite if None.
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
        mitigations: kinds that are tried on every object, with all their variants; if none, up to
            four on each of the kinds of object that lead the order.
        leading: how many those are; 0 for none.

    Raises:
        InputError: no items or motions, values out of range, an item that falls by itself, or one
            without a floor in a building; both components with a model that solids do not know.
    """
    if motions is None:
        motions = suite(DEFAULT_SUITE, pairs=True)
    items = listed("items", items, Item, _ITEM)
    require_control(control)
    house = premises_of(premises)
    kinds = kinds_of(mitigations)
    if house.itself:
        items = [replace(item, must_not_fall=True) for item in items]
    model, castors = model_of(model), castors or CastorFriction()
    anchored = [item for item in items if item.anchored]
    loose = {number: item for number, item in enumerate(items, 1) if not item.anchored}
    if not loose:
        raise InputError(
            "every object is anchored: there is nothing to shake; leave 'anchored' empty for those "
            "whose fall is to be simulated"
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
        label: _floor(there, planar, scale, tilt, control, levels, model, castors)
        for label, there in _shaken(places, motions).items()
    }
    in_space = any(floor.space for floor in shaken.values())
    held = [item.name for item in loose.values() if item.surroundings]
    if held and not in_space:
        log.warning(
            "walls, straps, pads and edges are simulated in three dimensions alone, which need "
            "pairs of horizontal components; here these stand alone: %s",
            named(held, MOST_NAMED),
        )
    if uncertainty and held:
        log.warning(
            "uncertain objects are simulated in a plane, without walls, straps, pads and edges; "
            "of these no probability is told: %s",
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
                replace(result, number=number) for number, result in zip(here, results, strict=True)
            ]
            found.append(shaken[label].as_found(label, numbered))
    seconds = (time.perf_counter() - begun) / max(1, total)
    weights = weights or house.weights
    if in_space and (leading or kinds):
        found = _with_advice(found, shaken, house, weights, kinds, leading, seconds, progress)
    return Assessment(
        floors=found,
        control=control,
        tilt=tilt,
        scale=scale,
        model=model,
        levels=tuple(levels),
        castors=castors,
        weights=weights,
        premises=house,
        pairs=min(len(shaken[label].motions.pairs) for label, _, _ in places),
        anchored=anchored,
    )


def require_assessable(
    items: Sequence[Item], scale: float, tilt: float, model: Model, in_space: bool = False
) -> None:
    """Raise what `assess` would, before any motion is read.

    Args:
        items: none of them anchored.
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
        _model_in_space(model)
    profiles = [profile for item in items for profile in profiles_of(item, tilt)]
    require_stable([each.body for each in profiles], [each.tilt for each in profiles])


def _shaken(
    places: Sequence[tuple[str, Mapping[int, Item], Sequence[Motion]]],
    motions: Sequence[Motion] | Building,
) -> dict[str, Sequence[Motion]]:
    """The motions of every floor with items and of the lowest, from that up."""
    found = {label: there for label, _, there in places}
    if isinstance(motions, Building):
        return {next(iter(motions.floors)): motions.ground} | found
    return found


def _floor(
    motions: Sequence[Motion],
    planar: bool,
    scale: float,
    tilt: float,
    control: float,
    levels: Sequence[Level],
    model: Model,
    castors: CastorFriction,
) -> _Floor:
    """How the objects of a floor are shaken; arguments as for `assess`."""
    shaking = Shaking.of(motions, planar)
    trial = ShakingSet(shaking.components, scale, model)
    plane = Plane(
        trial=trial,
        tilt=tilt,
        control=control,
        levels=[level.scale for level in levels],
        castors=castors,
        draws=resamples(int(trial.recording.max()) + 1),
        peaks=peaks_of(trial),
    )
    space = None
    if shaking.pairs:
        pairs = ShakingSet(shaking.pairs, scale, _model_in_space(model))
        space = ShakingInSpace(pairs, tilt, castors)
    return _Floor(shaking, plane, space)


def _model_in_space(model: Model) -> Model:
    """The model of solids that goes with a planar one; InputError where there is none."""
    general = model_of_solids(model)
    if general is None:
        raise InputError(
            f"{model!r} is for planar=True: solids know General(...) and Rocking() without "
            "restitution="
        )
    return general


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


class _Floor(NamedTuple):
    """How the objects of a floor are shaken."""

    motions: Shaking
    plane: Plane
    space: ShakingInSpace | None

    @property
    def recordings(self) -> int:
        return self.plane.recordings

    def planned(self, items: Sequence[Item], uncertainty: bool) -> int:
        """About how many simulations tell what becomes of items."""
        plane = 2 * len(self.plane.trial.motions)
        levels = 1 + len(self.plane.levels)
        flat = plane * (2 * levels + len(FRICTIONS) + TILTS.size + BASE_GRID.size + FINER_BASES)
        flat += plane * MEMBERS if uncertainty else 0
        total = 0
        for item in items:
            stood = self.space and self.space.stood(item)
            if not (self.space and stood):
                total += int(flat)
                continue
            ways = stood.ways(self.space.trial.motions)
            rough = 0.0 if item.castors is Castors.FREE else len(FRICTIONS) / ways.shape[2]
            total += int(ways.size * (levels + rough)) + 2 * plane
            total += plane // 2 * MEMBERS if uncertainty else 0
        return total

    def assessed(self, items: Sequence[Item], uncertainty: bool, done: Done) -> list[ItemResult]:
        """What becomes of items, some at a time, so that simulations of all need not be kept."""
        results: list[ItemResult] = []
        for some in pieces(len(items), 2 * len(self.plane.trial.motions) * TILTS.size):
            found = results_of(items[some], self.plane, self.space, done)
            results += self._with_uncertainty(found, done) if uncertainty else found
        return results

    def _with_uncertainty(self, results: Sequence[ItemResult], done: Done) -> list[ItemResult]:
        """The results with what becomes of objects like each; not of what rolls or is held."""
        chosen = [
            k for k, each in enumerate(results) if not (each.item.rolls or each.item.surroundings)
        ]
        flat = [k for k in chosen if results[k].solid is None]
        profiles = [results[k].profile for k in flat]
        known: dict[int, UncertainResult] = {}
        if flat:
            known |= zip(flat, uncertain_results(profiles, self.plane.trial, done), strict=True)
        if self.space is not None:
            solids = [k for k in chosen if results[k].solid is not None]
            items = [results[k].item for k in solids]
            found = uncertain_in_space(items, self.space, done)
            known |= zip(solids, found, strict=True)
        return [replace(result, uncertain=known.get(k)) for k, result in enumerate(results)]

    def as_found(self, label: str, results: Sequence[ItemResult]) -> FloorAssessment:
        """What was found on it."""
        motions = self.plane.trial.motions
        pga = self.plane.peaks[0]
        return FloorAssessment(
            floor=label,
            results=results,
            motions=tuple(motion.name for motion in self.motions.pairs or motions),
            recordings=self.recordings,
            smallest_pga=float(pga.min()),
            largest_pga=float(pga.max()),
            artificial=all(_is_artificial(motion) for motion in motions),
        )


def _is_artificial(motion: Motion) -> bool:
    """Whether a motion was made, as its origin says first of all."""
    steps = motion.origin.processing if motion.origin else ()
    return bool(steps) and steps[0].startswith("artificial")


def _with_advice(
    floors: Sequence[FloorAssessment],
    shaken: Mapping[str, _Floor],
    premises: Premises,
    weights: Weights,
    kinds: Sequence[MitigationKind],
    leading: int,
    seconds: float,
    progress: Progress,
) -> list[FloorAssessment]:
    """The floors with what measures leave of those that come first, each where it is worst.

    Args:
        floors: without.
        shaken: how, by floor, the lowest first.
        premises, weights: for the choice of measures, and of objects.
        kinds: of measures, for all objects; none for the usual ones of `leading` kinds of object.
        leading: kinds of object on which measures are tried.
        seconds: that a simulation took so far, to tell how long this may take.
        progress: as for `assess`.
    """
    at = {each.number: floor.floor for floor in floors for each in floor.results}
    every = ranked([each for floor in floors for each in floor.results], weights)
    chosen: dict[object, ItemResult] = {}
    for each in every:
        if each.solid is not None and each.governing_share.value > 0.0:
            chosen.setdefault(alike(each.item), each)
    some = list(chosen.values())[: None if kinds else leading]
    storeys = list(shaken)
    asked = [what_is_tried(each, premises, kinds, storeys) for each in some]
    if not any(asked):
        return list(floors)
    spaces = {label: (floor.plane, floor.space) for label, floor in shaken.items() if floor.space}
    one = 2 * max(len(space.trial.motions) for _, space in spaces.values()) * TURNS // 2
    total = one * sum(trials_of(kind, bool(kinds)) for row in asked for kind in row)
    title = f"trying what helps (about {duration(2.0 * seconds * total)})"
    with meter(title, total, progress) as done:
        found = with_mitigation(
            [(at[each.number], each) for each in some], asked, spaces, bool(kinds), done
        )
    known = {each.number: each for each in found}
    return [
        replace(floor, results=[known.get(each.number, each) for each in floor.results])
        for floor in floors
    ]
