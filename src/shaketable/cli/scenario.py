"""`shaketable scenario`: what falls of an inventory in one earthquake."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from shaketable.cli.console import say
from shaketable.cli.earthquake_options import Buildings, EarthquakeOptions, MapFile, MapSigma
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import (
    ContactOptions,
    ListOptions,
    Overwrite,
    ReadingOptions,
    TiltDeg,
)
from shaketable.cli.shaking import Motions, load_motions
from shaketable.errors import InputError, named
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog, plain
from shaketable.units import radians

if TYPE_CHECKING:
    from shaketable.building import Building
    from shaketable.hazard import Scenario, ShakeMap
    from shaketable.hazard.earthquake import Location, Shaken
    from shaketable.motion import Motion

log = logging.getLogger(__name__)

MOST_NAMED = 10

ARTIFICIAL, RECORDED = 128, 20  # motions that are simulated
MOST_SIMULATED = 20  # places of a map; of more of them only functions are asked


def scenario(
    *,
    inventory: Annotated[
        Path,
        typer.Argument(
            help="Table of objects, as for assess; with building, latitude and longitude for a "
            "map of shaking."
        ),
    ],
    out: Annotated[Path, typer.Option(help="Folder for the report and the tables.")],
    earthquake: EarthquakeOptions,
    shakemap: MapFile = None,
    map_sigma: MapSigma = None,
    measure: Annotated[
        str, typer.Option(help="Measure of the fragility functions: PGA, PGV or SA(1.0).")
    ] = "PGV",
    number: Annotated[
        int | None,
        typer.Option(
            min=2, help="How many motions of the earthquake are simulated. [128; recorded: 20]"
        ),
    ] = None,
    recorded: Annotated[
        bool,
        typer.Option(
            "--recorded",
            help="Simulate those of --motions whose spectra are nearest to the earthquake's, "
            "scaled, in place of artificial motions.",
        ),
    ] = False,
    building: Buildings = None,
    motions: Motions = None,
    tilt_deg: TiltDeg = 0.0,
    contact_options: ContactOptions,
    reading: ReadingOptions,
    list_options: ListOptions,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the motions and of the bootstrap.")] = 0,
    overwrite: Overwrite = False,
) -> None:
    """Estimate what falls in an earthquake of a magnitude and distance, or of a ShakeMap.

    Motions of the earthquake are simulated, as `assess` does it, and fragility functions from
    recorded motions (--motions) tell the same without simulating it; the report has both, side by
    side. Of a map with more than 20 places only functions are asked.
    """
    settings = {name: value for name, value in settings_of(locals()).items() if name != "overwrite"}
    from rich.console import Console

    from shaketable.assess import assess as assess_items
    from shaketable.assess.earthquake import compared
    from shaketable.hazard import read_shakemap
    from shaketable.hazard.earthquake import (
        located,
        object_chances,
        shaken_house,
        shaken_places,
    )
    from shaketable.hazard.functions import house_files
    from shaketable.inventory import read_inventory
    from shaketable.report.assessment_folder import write_results
    from shaketable.report.earthquake import Quake, write_quake
    from shaketable.report.results_folder import require_folder
    from shaketable.report.terminal import print_assessment
    from shaketable.report.words.earthquake import lead
    from shaketable.signal import measure_named

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    known = measure_named(measure)
    contact = contact_options.contact()
    quake: Scenario | ShakeMap
    choose: Callable[[Mapping[Location, Shaken], Sequence[Motion]], _Chosen]
    if shakemap is None and map_sigma is not None:
        raise InputError("--map-sigma: is for --shakemap")
    if shakemap is None:
        quake = earthquake.scenario()
        number = number or (RECORDED if recorded else ARTIFICIAL)
        choose = partial(_of_scenario, quake, number, recorded, seed)
    elif needless := [
        *earthquake.given,
        *(["--number"] if number is not None else []),
        *(["--recorded"] if recorded else []),
    ]:
        raise InputError(f"--shakemap: leave out {' and '.join(needless)}; a map needs none")
    else:
        quake = read_shakemap(shakemap, assumed_sigma=map_sigma)
        choose = partial(_of_map, known.name, seed)
    items = located(read_inventory(inventory, **list_options.as_list))
    if held := [item.name for item in items if item.surroundings and item.loose]:
        log.warning(
            "walls, straps, pads and edges of the list are not simulated here: %s stand alone, and "
            "their shares are of objects that nothing holds",
            named(held, MOST_NAMED),
        )
    # what is compared with simulations in which nothing holds them; these know that something does
    alone = [replace(item, surroundings=None) for item in items]
    places = shaken_places(items, quake, known.name)
    houses = house_files(building or [], items)
    shaking = load_motions(motions or [DEFAULT_SUITE], False, reading)
    chosen = choose(places, shaking.motions)
    chances = object_chances(
        alone, places, shaking.motions, known.name, houses=houses, tilt=radians(tilt_deg),
        model=contact, seed=seed, progress=True,
    )  # fmt: skip
    standing, house, result = items, None, None
    if chosen.ground:
        here: Sequence[Motion] | Building = next(iter(chosen.ground.values()))
        if len(chosen.ground) > 1 or houses:
            standing, house = shaken_house(items, chosen.ground, houses, quake.name)
            here = house
        result = assess_items(standing, here, tilt=radians(tilt_deg), model=contact, planar=True)
    found = compared(
        quake.name, known, chances, places, assessment=result, ground=chosen.ground,
    )  # fmt: skip
    shown = Quake(found=found, source=quake, **chosen.shown)
    files = {"inventory": inventory, "shakemap": shakemap}
    run = {
        **run_log.entries(),
        **{name: path and _file(path) for name, path in files.items()},
        "motions": {**shaking.entries(), "description": f"{quake.name}: {chosen.told}"},
        "buildings": {name: _file(path) for name, path in houses.items()},
        "scaling": "",
        "settings": {
            "vertical": False,
            **{name: plain(value) for name, value in settings.items()},
        },
    }
    if result is None:
        write_quake(shown, run, out, overwrite=overwrite)
    else:
        write_results(result, run, out, building=house, quake=shown, overwrite=overwrite)
        print_assessment(result, Console(), out, f"{quake.name}: {chosen.told}")
    for sentence in lead(found, quake):
        say(sentence)
    say(f"report: {out / 'report.html'}; scenario.csv and buildings.csv beside it")


class _Chosen(NamedTuple):
    """The motions of the ground that are simulated at each place; none where that is too many."""

    ground: dict[Location, Sequence[Motion]]
    told: str
    shown: dict[str, Any]


def _of_scenario(
    quake: Scenario,
    number: int,
    recorded: bool,
    seed: int,
    places: Mapping[Location, Shaken],
    motions: Sequence[Motion],
) -> _Chosen:
    """Artificial motions of an earthquake, or those that were recorded and are nearest to it."""
    from shaketable.hazard import artificial_motions, ln_spectra_of, select_motions, target_of

    target = target_of(quake)
    if recorded:
        selection = select_motions(motions, target, number, seed=seed, progress=True)
        found: Sequence[Motion] = selection.motions
        told = f"{number} recorded motions, selected and scaled"
    else:
        found = artificial_motions(quake, number, seed=seed, progress=True)
        told = f"{number} artificial motions"
    shown = {"target": target, "ln_spectra": ln_spectra_of(found, target.periods)}
    return _Chosen(dict.fromkeys(places, found), told, shown)


def _of_map(
    measure: str, seed: int, places: Mapping[Location, Shaken], motions: Sequence[Motion]
) -> _Chosen:
    """Recorded motions, scaled to the shaking of each place."""
    from shaketable.hazard.earthquake import motions_of_map

    if len(places) > MOST_SIMULATED:
        return _Chosen({}, f"nothing is simulated at {len(places):,} places", {})
    found = motions_of_map(motions, measure, places, seed=seed)
    told = f"{len(motions)} recorded motions, scaled to the map's {measure}"
    return _Chosen(dict(found), told, {})


def _file(path: Path) -> dict[str, str]:
    from shaketable.report.run_log import sha256

    return {"path": str(path), "sha256": sha256(path)}
