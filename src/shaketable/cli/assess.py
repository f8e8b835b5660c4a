"""`shaketable assess`: an inventory under a suite of motions."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.cli.options import (
    Control,
    KineticFriction,
    ModelName,
    ModelWord,
    NormalRestitution,
    RestitutionFactor,
    Scale,
    StaticFriction,
    TiltDeg,
    TimeStep,
    Units,
    model_from,
)
from shaketable.cli.run_log import RunLog
from shaketable.cli.shaking import DEFAULT_SUITE, Motions, Shaking, Vertical, gather
from shaketable.cli.tell import say
from shaketable.errors import InputError
from shaketable.resampling import DRAWS
from shaketable.tilting import CONTROL
from shaketable.units import radians

if TYPE_CHECKING:
    from shaketable.building import Building

log = logging.getLogger(__name__)


def assess(
    inventory: Annotated[
        Path | None,
        typer.Argument(
            help="Table of objects, as CSV, .xlsx or .ods: name, depth_m (front to back), width_m "
            "(side to side), height_m, ...; see `shaketable template`. [examples/hospital.csv]"
        ),
    ] = None,
    motions: Motions = None,
    building: Annotated[
        Path | None,
        typer.Option(
            help="TOML file of a building: recorded floor motions, or storeys, period and "
            "damping; the inventory then has a column floor."
        ),
    ] = None,
    vertical: Vertical = False,
    scale: Scale = 1.0,
    tilt_deg: TiltDeg = 0.0,
    control: Control = CONTROL,
    model: ModelName = ModelWord.ROCKING,
    static_friction: StaticFriction = None,
    kinetic_friction: KineticFriction = None,
    normal_restitution: NormalRestitution = 0.0,
    restitution_factor: RestitutionFactor = 1.0,
    units: Units = None,
    time_step_s: TimeStep = None,
    accept_sizes: Annotated[
        bool,
        typer.Option("--accept-sizes", help="Accept objects smaller or larger than furniture."),
    ] = False,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("assessment"),
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
    ] = False,
) -> None:
    """Who falls, which way, and what to do: an inventory under a suite of motions."""
    from rich.console import Console

    from shaketable.assess import assess as assess_items
    from shaketable.building import read_building
    from shaketable.inventory import read_table
    from shaketable.outputs import require_writable
    from shaketable.report.folder import FILES, sha256, write_results
    from shaketable.report.terminal import print_columns, print_table

    run_log = RunLog()
    contact = model_from(
        model, static_friction, kinetic_friction, normal_restitution, restitution_factor
    )
    require_writable(out, overwrite, FILES)
    path = inventory or example_inventory()
    inventory_read = read_table(path, accept_sizes=accept_sizes)
    items = inventory_read.items
    print_columns(path, inventory_read, Console(stderr=True))
    given = motions or ([] if building else [DEFAULT_SUITE])
    shaking = gather(given, vertical, units, time_step_s) if given else None
    if not contact.slides and any(item.support_length for item in items):
        log.warning("support_length_m is for sliding: nothing slides without --model general")
    if building is None and any(item.floor for item in items):
        log.warning("floor is for --building: without it everything stands on the ground")
    house = None
    if building is not None:
        if shaking is None and (vertical or units or time_step_s):
            raise InputError(
                "--vertical, --units and --time-step-s are for --motions: the building's file "
                "gives units and time_step_s of its own"
            )
        house = read_building(building, shaking.motions if shaking else (), progress=True)
    shaken = house or (shaking.motions if shaking else [])
    result = assess_items(
        items, shaken, scale=scale, tilt=radians(tilt_deg), control=control, model=contact
    )
    run = {
        **run_log.entries(),
        "inventory": {"path": str(path), "sha256": sha256(path), "items": len(items)},
        "motions": _told(shaking, house, scale),
        "building": building and {"path": str(building), "sha256": sha256(building)},
        "settings": {
            "scale": scale,
            "tilt_deg": tilt_deg,
            "control": control,
            "draws": DRAWS,
            "model": model.value,
            "static_friction": static_friction,
            "kinetic_friction": kinetic_friction,
            "normal_restitution": normal_restitution,
            "restitution_factor": restitution_factor,
            "vertical": vertical,
            "units": units,
            "time_step_s": time_step_s,
        },
    }
    write_results(result, run, out, building=house, overwrite=overwrite)
    print_table(result, Console())
    say(f"report: {out / 'report.html'}")


def _told(shaking: Shaking | None, house: Building | None, scale: float) -> dict[str, Any]:
    """What the run log tells about the motions."""
    from shaketable.report.folder import sha256

    if house is None:
        assert shaking is not None
        told = shaking.entries(scale)
        return {**told, "description": f"{told['count']} motions ({told['description']})"}
    under = f" under {shaking.description}" if shaking else ""
    own = [{"name": str(file), "sha256": sha256(file)} for file in house.files]
    return {
        "count": sum(len(motions) for motions in house.floors.values()),
        "sources": own,
        **(shaking.entries(scale) if shaking else {}),
        "description": f"{house.name}: {house.told}{under}",
        "floors": {label: [m.name for m in motions] for label, motions in house.floors.items()},
    }


def example_inventory() -> Path:
    """The inventory that comes with the package, installed or in its source tree."""
    package = Path(__file__).resolve().parent.parent
    folders = [package, package.parent.parent]
    return next(
        path for folder in folders if (path := folder / "examples" / "hospital.csv").exists()
    )
