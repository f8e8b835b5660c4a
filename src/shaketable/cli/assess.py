"""`shaketable assess`: an inventory under a suite of motions."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from shaketable.cli.levels import Levels, SpectralLevels, TargetSpectrum, scaling_of
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
from shaketable.errors import InputError, quoted
from shaketable.resampling import DRAWS
from shaketable.tilting import CONTROL
from shaketable.units import radians

if TYPE_CHECKING:
    from shaketable.assess import Weights
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
    levels: Levels = None,
    sa: SpectralLevels = None,
    spectrum: TargetSpectrum = None,
    tilt_deg: TiltDeg = 0.0,
    control: Control = CONTROL,
    model: ModelName = ModelWord.ROCKING,
    static_friction: StaticFriction = None,
    kinetic_friction: KineticFriction = None,
    normal_restitution: NormalRestitution = 0.0,
    restitution_factor: RestitutionFactor = 1.0,
    rolling_resistance: Annotated[
        float, typer.Option(help="Friction of objects whose castors are free.")
    ] = 0.02,
    locked_friction: Annotated[
        float, typer.Option(help="Friction of objects whose castors are locked.")
    ] = 0.4,
    weights: Annotated[
        str | None,
        typer.Option(
            help="What counts in the order of objects, added to 1 and multiplied by the share "
            "that falls. [critical=1,blocks_exit=3,people_nearby=3,must_not_fall=3]"
        ),
    ] = None,
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
    """Who falls in a room or a building, which way, and what to do.

    Every object of an inventory is shaken by all motions, front to back and side to side.
    """
    from rich.console import Console

    from shaketable.assess import CastorFriction
    from shaketable.assess import assess as assess_items
    from shaketable.building import read_building
    from shaketable.inventory import read_table
    from shaketable.outputs import require_writable
    from shaketable.report.folder import FILES, sha256, write_results
    from shaketable.report.terminal import print_assessment, print_columns

    run_log = RunLog()
    contact = model_from(
        model, static_friction, kinetic_friction, normal_restitution, restitution_factor
    )
    castors = CastorFriction(rolling_resistance, locked_friction)
    order = _weights(weights)
    scaling = scaling_of(levels, sa, spectrum, scale, building=building is not None)
    require_writable(out, overwrite, FILES)
    if building is not None:
        _require_building(building)
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
    if scaling is not None and house is not None:
        house = house.scaled_to(scaling.intensity)
    elif scaling is not None and shaking is not None:
        shaking = shaking.scaled_to(scaling.intensity)
    several = scaling.levels if scaling and len(scaling.levels) > 1 else []
    strongest = scaling.levels[-1].scale if scaling else scale  # the report is for that one
    result = assess_items(
        items,
        house or (shaking.motions if shaking else []),
        scale=strongest,
        levels=several,
        tilt=radians(tilt_deg),
        control=control,
        model=contact,
        castors=castors,
        weights=order,
    )
    run = {
        **run_log.entries(),
        "inventory": {"path": str(path), "sha256": sha256(path), "items": len(items)},
        "motions": _told(shaking, house, strongest),
        "building": building and {"path": str(building), "sha256": sha256(building)},
        "scaling": scaling.told if scaling else "",
        "settings": {
            "scale": scale,
            "levels": levels,
            "sa": sa,
            "spectrum": spectrum and {"path": str(spectrum), "sha256": sha256(spectrum)},
            "weights": order._asdict(),
            "rolling_resistance": rolling_resistance,
            "locked_friction": locked_friction,
            "accept_sizes": accept_sizes,
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
    print_assessment(result, Console(), out)
    say(f"report: {out / 'report.html'}")


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


def _weights(text: str | None) -> Weights:
    """The weights in "critical=2,blocks_exit=0"; those that are not named keep their values."""
    from shaketable.assess import Weights

    chosen: dict[str, float] = {}
    for part in text.split(",") if text else []:
        name, _, value = part.partition("=")
        name = name.strip().lower()
        try:
            chosen[name] = float(value)
        except ValueError:
            chosen[name] = -1.0
        if name not in Weights._fields or not 0.0 <= chosen[name] < 1e6:
            raise InputError(
                f"--weights: found {quoted(part)}; expected name=number, with one of "
                f"{', '.join(Weights._fields)} and a number from 0 on"
            )
    return Weights(**chosen)


def example_inventory() -> Path:
    """The inventory that comes with the package, installed or in its source tree."""
    package = Path(__file__).resolve().parent.parent
    folders = [package, package.parent.parent]
    return next(
        path for folder in folders if (path := folder / "examples" / "hospital.csv").exists()
    )
