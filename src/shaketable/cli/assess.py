"""`shaketable assess`: an inventory under a suite of motions."""

from __future__ import annotations

import logging
import re
from dataclasses import asdict, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.assess.leading import LEADING
from shaketable.cli.console import say
from shaketable.cli.hazard import Site, site_of
from shaketable.cli.levels import Levels, Scaling, SpectralLevels, TargetSpectrum, scaling_of
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import (
    ContactOptions,
    DownhillShare,
    LanguageName,
    ListOptions,
    Overwrite,
    Scale,
    language_of,
)
from shaketable.cli.shaking import MotionOptions, ShakingAsked
from shaketable.errors import InputError, named, quoted
from shaketable.extras import require
from shaketable.language import speaking, tell
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog
from shaketable.resampling import DRAWS
from shaketable.tilting import CONTROL
from shaketable.units import radians

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shaketable.assess import CastorFriction, MitigationKind, Premises, Walls, Weights
    from shaketable.building import Building
    from shaketable.inventory import Item

log = logging.getLogger(__name__)

#: Options that stand elsewhere in the run log, or only say where results go.
ELSEWHERE = {"inventory", "motions", "building", "hazard", "out", "overwrite"}
_NUMBER = re.compile(r"\d+(\.\d+)?", re.ASCII)


def assess(
    *,
    inventory: Annotated[
        Path | None,
        typer.Argument(
            help="Table of objects, as CSV, .xlsx or .ods: name, depth_m (front to back), width_m "
            "(side to side), height_m, ...; see `shaketable template`. [examples/hospital.csv]"
        ),
    ] = None,
    motion_options: MotionOptions,
    building: Annotated[
        Path | None,
        typer.Option(
            help="TOML file of a building: recorded floor motions, or storeys, period and "
            "damping; the inventory then has a column floor."
        ),
    ] = None,
    scale: Scale = 1.0,
    pga_levels: Levels = None,
    sa_levels: SpectralLevels = None,
    target_spectrum: TargetSpectrum = None,
    tilt_deg: Annotated[
        float,
        typer.Option(help="Present tilt of all supports, toward the front [degrees]."),
    ] = 0.0,
    downhill_share: DownhillShare = CONTROL,
    planar: Annotated[
        bool,
        typer.Option(
            "--planar",
            help="Simulate in one plane, one component at a time, with tilts, bases and "
            "frictions; for research.",
        ),
    ] = False,
    profile: Annotated[
        str,
        typer.Option(
            help="Where the objects stand, which chooses measures and words: hospital, "
            "laboratory, museum, office or home."
        ),
    ] = "hospital",
    try_: Annotated[
        str | None,
        typer.Option(
            "--try",
            help="Measures to simulate for every kind of object that falls, where it falls most: "
            "of strap, tether, lock, base, pad, lower, wall, turn, move and tilt, or all. [up to "
            "four for the ten kinds that come first]",
        ),
    ] = None,
    advise: Annotated[
        int | None,
        typer.Option(
            min=0, help=f"Number of kinds of object for which measures are simulated. [{LEADING}]"
        ),
    ] = None,
    wall: Annotated[
        str | None,
        typer.Option(
            help="Whether most things stand against a wall: yes puts one 10 mm behind what "
            "is not on castors, on furniture or near an edge; no puts none; each takes those of "
            "the column wall_gap_mm. [free; where a wall is tried as a measure, with the "
            "number against one beside it]"
        ),
    ] = None,
    contact_options: ContactOptions,
    rolling_resistance: Annotated[
        float | None, typer.Option(help="Friction of objects whose castors are free. [0.02]")
    ] = None,
    locked_friction: Annotated[
        float | None, typer.Option(help="Friction of objects whose castors are locked. [0.4]")
    ] = None,
    weights: Annotated[
        str | None,
        typer.Option(
            help="Weights that add to an object's priority of 1; objects are ranked by share "
            "of falls × priority. [critical=1,blocks_exit=3,people_nearby=3,must_not_fall=3]"
        ),
    ] = None,
    hazard: Annotated[
        Path | None,
        typer.Option(
            help="Hazard curve of the site: also gives each object's return period; see "
            "`shaketable hazard`."
        ),
    ] = None,
    site: Site = None,
    uncertainty: Annotated[
        bool,
        typer.Option(
            "--uncertainty",
            help="Also estimate the probability for objects of uncertain sizes and supports.",
        ),
    ] = False,
    list_options: ListOptions,
    language: LanguageName = "en",
    pdf: Annotated[
        bool,
        typer.Option(
            "--pdf", help="Write report.pdf too, by Chromium, Chrome, Edge or WeasyPrint."
        ),
    ] = False,
    docx: Annotated[
        bool,
        typer.Option(
            "--docx", help="Write its first part as report.docx too, with the extra docx."
        ),
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("assessment"),
    overwrite: Overwrite = False,
) -> None:
    """Simulate a list of objects under recorded earthquakes: what falls, which way, what to do.

    Every object whose depth and width are known is shaken in three dimensions, by both horizontal
    components at once, on the floor on which it stands; what would help is tried in the same way on
    those that come first.
    """
    settings = settings_of(locals())  # the options as they were given, for the run log
    with speaking(language_of(language)):
        from rich.console import Console

        from shaketable.assess import assess as assess_items
        from shaketable.building import building_of_structure, read_building
        from shaketable.hazard import read_hazard
        from shaketable.hazard.objects import object_rates
        from shaketable.hazard.rates import YEARS
        from shaketable.inventory import read_with_columns
        from shaketable.inventory.building_sheet import require_one_building
        from shaketable.report.assessment_folder import write_results
        from shaketable.report.print_pdf import require_printer
        from shaketable.report.results_folder import require_folder
        from shaketable.report.run_log import sha256
        from shaketable.report.terminal import print_assessment, print_columns
        from shaketable.report.words.hazard import of_inventory

        run_log = RunLog()
        contact = contact_options.contact()
        castors = _castors(rolling_resistance, locked_friction)
        where, kinds = _premises(profile), _kinds(try_)
        if kinds and planar:
            raise InputError("--try: simulates in three dimensions; leave out --planar")
        if advise and planar:
            raise InputError("--advise: simulates in three dimensions; leave out --planar")
        order = _weights(weights, where)
        scaling = scaling_of(pga_levels, sa_levels, target_spectrum, scale)
        require_folder(out, overwrite, run_log)
        if pdf:
            require_printer()
        if docx:
            require("docx", "--docx")
        if building is not None:
            _require_building(building)
        if hazard is not None:
            of_site = read_hazard(hazard, site=site_of(site))
        elif site is not None:
            raise InputError("--site: is for --hazard")
        path = inventory or example_inventory()
        table = read_with_columns(path, **list_options.as_list)
        walls = _walls(wall, table.items)
        print_columns(path, table, Console(stderr=True))
        shaking = motion_options.load(() if building else (DEFAULT_SUITE,))
        still = [item for item in table.items if item.support_length and not item.rolls]
        if not contact.slides and still:
            log.warning(
                "support_length_m is for sliding: without --model general nothing slides but what "
                "stands on castors"
            )
        edges = [item.name for item in table.items if item.surroundings and item.surroundings.edge]
        if not contact.slides and edges:
            log.warning(
                "edge_mm is mostly for sliding: without --model general nothing slides to its "
                "edge, but with the frictions that are tried: %s",
                named(edges, 10),
            )
        if building is not None or table.building:
            require_one_building(table.items)
        house = None
        if building is not None:
            if shaking is None and motion_options != MotionOptions():
                raise InputError(
                    "--vertical, --units and --time-step-s are for --motions: the building's file "
                    "gives units and time_step_s of its own"
                )
            house = read_building(building, shaking.motions if shaking else (), progress=True)
        elif table.building and shaking is not None:
            house = building_of_structure(path, table.building, shaking.motions)
        if shaking is not None and house is None and not planar:
            shaking = shaking.in_pairs()
        strongest, several = scale, []
        if scaling is not None:
            house, shaking = _scaled(scaling, house, shaking)
            strongest = scaling.levels[-1].scale  # the report is for that one
            several = scaling.levels if len(scaling.levels) > 1 else []
        result = assess_items(
            table.items,
            house or (shaking.motions if shaking else []),
            scale=strongest,
            levels=several,
            tilt=radians(tilt_deg),
            control=downhill_share,
            model=contact,
            castors=castors,
            weights=order,
            uncertainty=uncertainty,
            planar=planar,
            premises=where,
            mitigations=kinds,
            leading=LEADING if advise is None else advise,
            walls=walls,
        )
        yearly = None
        if hazard is not None:
            if house is not None and house.variants:
                log.warning(
                    "yearly rates are for the typical period of the building alone: in one of "
                    "another period objects may fall more often"
                )
            yearly = object_rates(
                table.items, house or (shaking.in_components().motions if shaking else []), of_site,
                tilt=radians(tilt_deg), model=contact, progress=True,
            )  # fmt: skip
        run = {
            **run_log.entries(),
            "hazard": hazard and {"path": str(hazard), "sha256": sha256(hazard)},
            "inventory": {
                "path": str(path),
                "sha256": sha256(path),
                "items": len(table.items),
                "not_assessed": table.not_assessed,
                "said_in": table.said_in
                and {"path": str(table.said_in), "sha256": sha256(table.said_in)},
            },
            "motions": _motions_entry(shaking, house, strongest),
            "building": {"path": str(building), "sha256": sha256(building)}
            if building
            else table.building,
            "scaling": scaling.told(house, planar) if scaling else "",
            "settings": {
                **{name: settings[name] for name in sorted(settings.keys() - ELSEWHERE)},
                "target_spectrum": target_spectrum
                and {"path": str(target_spectrum), "sha256": sha256(target_spectrum)},
                "weights": asdict(order),
                "castors": asdict(castors),
                "draws": DRAWS,
            },
        }
        write_results(
            result, run, out, building=house, rates=yearly, overwrite=overwrite, pdf=pdf, docx=docx
        )
        at = f", scaled to {scaling.levels[-1].name}" if scaling else ""
        print_assessment(result, Console(), out, f"{run['motions']['description']}{at}")
        for sentence in of_inventory(yearly, YEARS) if yearly else ():
            say(sentence)
        say(tell("report: {page}", page=out / "report.html"))


def _scaled(
    scaling: Scaling, house: Building | None, shaking: ShakingAsked | None
) -> tuple[Building | None, ShakingAsked | None]:
    """The building, or the motions where there is none, scaled to 1 of a measure."""
    if house is not None:
        return house.scaled_to(scaling.measure), shaking
    return None, shaking and shaking.scaled_to(scaling.measure)


def _premises(name: str) -> Premises:
    from shaketable.assess.mitigation import premises_of

    try:
        return premises_of(name.strip().lower())
    except InputError as error:
        raise InputError(f"--profile: {error}") from None


def _kinds(text: str | None) -> list[MitigationKind]:
    from shaketable.assess.mitigation import kinds_of

    if text is None:
        return []
    try:
        return kinds_of([part.strip().lower() for part in text.split(",")])
    except InputError as error:
        raise InputError(f"--try: {error}") from None


def _walls(given: str | None, items: Sequence[Item]) -> Walls:
    from shaketable.assess.walls import walls_of

    try:
        return walls_of(given and given.strip().lower(), items)
    except InputError as error:
        raise InputError(f"--wall: {error}") from None


def _castors(rolling_resistance: float | None, locked_friction: float | None) -> CastorFriction:
    from shaketable.assess import CastorFriction

    given = {"free": rolling_resistance, "locked": locked_friction}
    return CastorFriction(**{name: value for name, value in given.items() if value is not None})


def _require_building(path: Path) -> None:
    """InputError, before anything else is read, for what cannot be a building's file."""
    from shaketable.inputs import read_file

    try:
        read_file(path)
    except InputError as error:
        raise InputError(
            f"--building: {error}; it takes the TOML file of a building, such as "
            "examples/clinic.toml"
        ) from None


def _motions_entry(
    shaking: ShakingAsked | None, house: Building | None, scale: float
) -> dict[str, Any]:
    """What the run log tells about the motions."""
    from shaketable.report.run_log import sha256
    from shaketable.report.words.numbers import counted

    if house is None:
        assert shaking is not None
        told, found = shaking.entries(scale), shaking.motions
        many = counted(len(found), "motion")
        if all(each.transverse is not None for each in found):
            many = tell("{motions} with both horizontal components", motions=many)
        return {**told, "description": f"{many} ({told['description']})"}
    under = tell(", under {motions}", motions=shaking.description) if shaking else ""
    own = [{"name": str(file), "sha256": sha256(file)} for file in house.files]
    floors = house.in_components().floors
    return {
        "count": sum(len(motions) for motions in floors.values()),
        "sources": own,
        **(shaking.entries(scale) if shaking else {}),
        "description": f"{house.name}: {house.told}{under}",
        "floors": {label: [m.name for m in motions] for label, motions in floors.items()},
    }


def _weights(text: str | None, where: Premises) -> Weights:
    """The weights in "critical=2,blocks_exit=0"; those that are not named are the premises'."""
    from shaketable.assess import Weights

    names = [field.name for field in fields(Weights)]
    chosen: dict[str, float] = {}
    for part in text.split(",") if text else []:
        name, _, value = (each.strip().lower() for each in part.partition("="))
        if name not in names or not _NUMBER.fullmatch(value):
            raise InputError(
                f"--weights: found {quoted(part)}; expected name=number, with one of "
                f"{', '.join(names)} and a number from 0 on"
            )
        chosen[name] = float(value)
    return replace(where.weights, **chosen)


def example_inventory() -> Path:
    """The inventory that comes with the package, installed or in its source tree."""
    package = Path(__file__).resolve().parent.parent
    folders = [package, package.parent.parent]
    return next(
        path for folder in folders if (path := folder / "examples" / "hospital.csv").exists()
    )
