"""`shaketable hazard`: how often a year the objects of an inventory fall at a site."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.cli.console import say
from shaketable.cli.earthquake_options import Buildings
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import (
    ContactOptions,
    ListOptions,
    Overwrite,
    TiltDeg,
)
from shaketable.cli.shaking import MotionOptions
from shaketable.errors import InputError, quoted
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog, plain
from shaketable.units import radians

if TYPE_CHECKING:
    from shaketable.hazard.exceedance import Correlation

Curve = Annotated[
    Path,
    typer.Argument(
        help="Hazard curve of the ground: OpenQuake's CSV, CSV or JSON of the USGS, or a table of "
        "two columns, such as 'PGV [cm/s], annual rate'."
    ),
]
Measure = Annotated[
    str | None, typer.Option(help="PGA, PGV, SA(1.0): where the curve's file has several.")
]
CurveUnits = Annotated[
    str | None, typer.Option(help="Unit of the curve's levels, where its file does not state it.")
]
Site = Annotated[
    str | None,
    typer.Option(help="Longitude,latitude [degrees], where the file has curves of several sites."),
]


def hazard(
    *,
    curve: Curve,
    inventory: Annotated[Path, typer.Argument(help="Table of objects, as for assess.")],
    out: Annotated[Path, typer.Option(help="Folder for the page, tables and figures.")],
    measure: Measure = None,
    curve_units: CurveUnits = None,
    site: Site = None,
    exposure_years: Annotated[
        float | None,
        typer.Option(
            help="Exposure time [years] of the probabilities of a table, where its header "
            "does not state it."
        ),
    ] = None,
    one_component: Annotated[
        bool,
        typer.Option(
            "--one-component",
            help="The curve is of an arbitrary component, not of the geometric mean of both "
            "components.",
        ),
    ] = False,
    building: Buildings = None,
    years: Annotated[float, typer.Option(help="Years for which probabilities are given.")] = 50.0,
    motion_options: MotionOptions,
    list_options: ListOptions,
    tilt_deg: TiltDeg = 0.0,
    contact_options: ContactOptions,
    export: Annotated[
        str | None,
        typer.Option(
            help="openquake: a job that runs, with exposure, functions and hazard; pelicun: its "
            "library with quantities and costs; or both with a comma."
        ),
    ] = None,
    correlation: Annotated[
        str | None,
        typer.Option(
            help="Correlation of ln of what pieces withstand, between alike pieces and between "
            "different kinds, with a comma; for the losses of all together. [1,0.7]"
        ),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")] = 0,
    overwrite: Overwrite = False,
) -> None:
    """Compute how often a year objects fall at a site, from its hazard curve.

    Each object's fragility function is integrated over the curve: once in how many years, how
    likely in fifty, from which shaking, and which object to restrain first.
    """
    settings = {name: value for name, value in settings_of(locals()).items() if name != "overwrite"}
    from shaketable.building import read_building
    from shaketable.fragility.intensities import GEOMETRIC_MEAN, OWN
    from shaketable.hazard import read_hazard
    from shaketable.hazard.functions import house_files
    from shaketable.hazard.jobs import JOBS, require_measure, write_jobs
    from shaketable.hazard.objects import object_rates
    from shaketable.hazard.totals import loss_totals
    from shaketable.inventory import read_inventory
    from shaketable.report.hazard import write_hazard
    from shaketable.report.results_folder import require_folder
    from shaketable.report.run_log import sha256
    from shaketable.report.words.hazard import of_inventory, of_totals

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    jobs = [part.strip() for part in (export or "").split(",") if part.strip()]
    for name in jobs:
        if name not in JOBS:
            raise InputError(f"--export: unknown {quoted(name)}; accepted: {', '.join(JOBS)}")
    together = _correlation(correlation)
    if not 0.0 < years < float("inf"):
        raise InputError(f"--years must be above 0, got {years:g}")
    contact = contact_options.contact()
    of_site = read_hazard(curve, measure=measure, units=curve_units, site=site_of(site),
                          exposure=exposure_years)  # fmt: skip
    require_measure(of_site.measure, jobs)
    items = read_inventory(inventory, **list_options.as_list)
    houses = house_files(building or [], items, own_motions=motion_options.motions is None)
    only = houses.get("")  # the one building of an inventory that names none
    shaking = motion_options.load(() if only else (DEFAULT_SUITE,))
    ground = shaking.motions if shaking else []
    found = object_rates(
        items, read_building(only, ground, progress=True) if only else ground, of_site,
        houses=houses, tilt=radians(tilt_deg), components=OWN if one_component else GEOMETRIC_MEAN,
        model=contact, seed=seed, progress=True,
    )  # fmt: skip
    run = {
        **run_log.entries(),
        "hazard": {"path": str(curve), "sha256": sha256(curve)},
        "inventory": {"path": str(inventory), "sha256": sha256(inventory)},
        "motions": shaking and shaking.entries(),
        "buildings": {
            name: {"path": str(path), "sha256": sha256(path)} for name, path in houses.items()
        },
        "settings": {name: plain(value) for name, value in settings.items()},
    }
    some = any(not one.curve.problem for one in found.of_objects().values())
    totals = loss_totals(found, correlation=together, seed=seed) if some else None
    write_hazard(
        found, totals, years, run, out, overwrite=overwrite,
        exports=(lambda fresh: write_jobs(found, fresh, jobs)) if jobs and some else None,
    )  # fmt: skip
    if jobs and not some:
        say("no object has a fragility function: no job was written")
    for sentence in [*of_inventory(found, years), *(of_totals(totals) if totals else [])]:
        say(sentence)
    say(f"page: {out / 'index.html'}; rates.csv and levels.csv beside it")


def _correlation(text: str | None) -> Correlation | None:
    """Correlations of "1,0.7"."""
    from shaketable.hazard.exceedance import Correlation

    if text is None:
        return None
    try:
        alike, kinds = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"--correlation: two numbers with a comma, got {quoted(text)}") from None
    return Correlation(alike, kinds)


def site_of(text: str | None) -> tuple[float, float] | None:
    """Longitude and latitude of "8.5,47.4"."""
    if text is None:
        return None
    try:
        lon, lat = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"--site: longitude,latitude in degrees, got {quoted(text)}") from None
    if not (-180.0 <= lon <= 360.0 and -90.0 <= lat <= 90.0):
        raise InputError(f"--site: longitude,latitude in degrees, got {quoted(text)}")
    return lon, lat
