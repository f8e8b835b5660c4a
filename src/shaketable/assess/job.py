"""The main job: an inventory under a suite of motions; who falls, which way, and what to do."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from shaketable.assess.assessment import Assessment, CastorFriction, FloorAssessment, Level
from shaketable.assess.bases import BASE_GRID, FINER_BASES
from shaketable.assess.criteria import peaks_of
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.place import Place, Settings, results_of
from shaketable.assess.profiles import profiles_of
from shaketable.assess.ranking import Weights
from shaketable.assess.results import ItemResult
from shaketable.assess.solids import ShakingInSpace, model_of_solids
from shaketable.assess.straps import TRIED
from shaketable.assess.uncertainty import MEMBERS, uncertain_results
from shaketable.building import Building
from shaketable.compile_ahead import compile_ahead
from shaketable.errors import InputError, joined, named, require_number
from shaketable.inventory import Item
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
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
    motions: Sequence[Motion] | Building,
    *,
    scale: float = 1.0,
    levels: Sequence[Level] = (),
    tilt: float = 0.0,
    control: float = CONTROL,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    weights: Weights | None = None,
    uncertainty: bool = False,
    pairs: Sequence[Motion] = (),
    progress: Progress = True,
) -> Assessment:
    """Who overturns, which way, and what would help; who slides or rolls, and how far.

    Every motion counts twice, with its horizontal component as recorded and reversed. An object
    whose depth and width are known is simulated front to back and side to side; the direction in
    which it fares worse leads. With `pairs` it is also simulated in three dimensions.

    Args:
        items: the inventory; in a building each item has the label of its floor. Items that are
            anchored are listed and not simulated.
        motions: horizontal ones, with or without a vertical component; or a building with those
            of its floors.
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
        pairs: motions with both horizontal components, such as `suite(name, pairs=True)` gives,
            by which objects of known depth and width are also shaken as solids, turned in several
            ways to them; those with one component are left out. Empty for the quick, planar way.
            Of a building they are motions of its ground, its lowest floor: what stands higher is
            shaken as a solid on the ground, and no class or order is better than there.

    Raises:
        InputError: no items or motions, values out of range, an item that falls by itself, or one
            without a floor in a building; pairs with a model that solids do not know.
    """
    items = listed("items", items, Item, _ITEM)
    require_control(control)
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
    settings = Settings(tilt, control, [level.scale for level in levels], castors)
    both = [motion for motion in pairs if motion.transverse is not None]
    held = [item.name for item in loose.values() if item.surroundings]
    if held and not both:
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
    space = _space(both, scale, model, settings)
    planar = ("move_one",) if model.slides else ("rock_many", "rock_one")
    compile_ahead(
        ("move_many", *planar, *(("move_solid",) if space else ())), progress=progress is True
    )
    lowest = next(iter(motions.floors)) if isinstance(motions, Building) else ""
    floors = [
        _assess_floor(
            label,
            here,
            ShakingSet(there, scale, model),
            settings,
            space and space._replace(on_ground=label != lowest),
            uncertainty,
            progress,
        )
        for label, here, there in _places(loose, motions)
    ]
    return Assessment(
        floors=floors,
        control=control,
        tilt=tilt,
        scale=scale,
        model=model,
        levels=tuple(levels),
        castors=castors,
        weights=weights or Weights(),
        pairs=len(both),
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


def _space(
    pairs: Sequence[Motion], scale: float, model: Model, settings: Settings
) -> ShakingInSpace | None:
    """How objects are shaken in three dimensions; None where they are not."""
    if not pairs:
        return None
    shaking = ShakingSet(pairs, scale, _model_in_space(model))
    return ShakingInSpace(shaking, settings.tilt, settings.castors)


def _model_in_space(model: Model) -> Model:
    """The model of solids that goes with a planar one; InputError where there is none."""
    general = model_of_solids(model)
    if general is None:
        raise InputError(
            f"pairs= is not for {model!r}: solids know General(...) and Rocking() without "
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


def _assess_floor(
    label: str,
    numbered: Mapping[int, Item],
    trial: ShakingSet,
    settings: Settings,
    space: ShakingInSpace | None,
    uncertainty: bool,
    progress: Progress,
) -> FloorAssessment:
    """The items of one place under its motions."""
    place = Place(
        trial, settings, resamples(int(trial.recording.max()) + 1), peaks_of(trial), space
    )
    each = 2 * len(trial.motions)
    per_item = each * (
        2 * (1 + len(settings.levels)) + len(FRICTIONS) + TILTS.size + BASE_GRID.size + FINER_BASES
    )
    per_item += each * MEMBERS if uncertainty else 0
    in_space = 2 * len(space.trial.motions) * TURNS if space else 0
    per_item += in_space * (1 + len(settings.levels) + len(FRICTIONS) + len(TRIED) / 2)
    items = list(numbered.values())
    results: list[ItemResult] = []
    with meter("assessing", int(len(items) * per_item), progress) as done:
        # simulations of some items at a time, so that those of all need not be kept
        for some in pieces(len(items), each * TILTS.size):
            found = results_of(items[some], place, done)
            results += _with_uncertainty(found, trial, done) if uncertainty else found
    return FloorAssessment(
        floor=label,
        results=[
            replace(result, number=number) for number, result in zip(numbered, results, strict=True)
        ],
        motions=tuple(motion.name for motion in trial.motions),
        recordings=int(trial.recording.max()) + 1,
        smallest_pga=float(place.peaks[0].min()),
        largest_pga=float(place.peaks[0].max()),
        artificial=all(_is_artificial(motion) for motion in trial.motions),
    )


def _is_artificial(motion: Motion) -> bool:
    """Whether a motion was made, as its origin says first of all."""
    steps = motion.origin.processing if motion.origin else ()
    return bool(steps) and steps[0].startswith("artificial")


def _with_uncertainty(
    results: Sequence[ItemResult], trial: ShakingSet, done: Callable[[int], None]
) -> list[ItemResult]:
    """The results with what becomes of objects like each, in its worse direction."""
    chosen = [
        k for k, result in enumerate(results) if not (result.item.rolls or result.item.surroundings)
    ]
    found = uncertain_results([results[k].profile for k in chosen], trial, done) if chosen else []
    known = dict(zip(chosen, found, strict=True))
    return [replace(result, uncertain=known.get(k)) for k, result in enumerate(results)]
