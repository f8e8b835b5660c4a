"""`shaketable room`: a room's plan, and what falls where in it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.console import say
from shaketable.cli.examples import epilog
from shaketable.cli.option_groups import settings_of, with_groups
from shaketable.cli.options import ContactOptions, Overwrite, Scale
from shaketable.cli.shaking import MotionOptions
from shaketable.errors import InputError, joined, named
from shaketable.extras import require
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog

room = typer.Typer(
    no_args_is_help=True,
    epilog=epilog("room"),
    help="What falls where in a room, whom it hits, and whether the ways out stay free.",
)

File = Annotated[
    Path, typer.Argument(help="TOML file of a room: outline, doors, places and things.")
]
ELSEWHERE = {"file", "motions", "building", "out", "overwrite"}


@room.command(epilog=epilog("room"))
def check(
    file: File,
    out: Annotated[
        Path | None, typer.Option(help="Picture of the plan, with its faults. [FILE.png]")
    ] = None,
) -> None:
    """Draw the plan of a room, with all that is wrong with it."""
    require("rooms", "shaketable room")
    from shaketable.drawing.files import require_picture, save
    from shaketable.plot.room import plot_room
    from shaketable.rooms import faults_of, read_room

    picture = out or file.with_suffix(".png")
    require_picture(picture)
    described = read_room(file, check=False)
    faults = faults_of(described)
    save(plot_room(described, faults=faults), picture)
    say(f"plan: {picture}")
    if faults:
        raise InputError(joined([f"{file}, {each.where}: {each.text}" for each in faults]))
    say(
        f"{described.name}: {len(described.things)} things, {len(described.places)} places and "
        f"{len(described.doors)} doors; nothing is wrong with the plan"
    )


@room.command(epilog=epilog("room"))
@with_groups
def assess(
    *,
    file: File,
    motion_options: MotionOptions,
    building: Annotated[
        Path | None, typer.Option(help="TOML file of the building in which the room is.")
    ] = None,
    floor: Annotated[
        str | None, typer.Option(help="Label of the room's floor in it. [that of FILE]")
    ] = None,
    scale: Scale = 1.0,
    contact_options: ContactOptions,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("room"),
    overwrite: Overwrite = False,
) -> None:
    """Shake a room: what falls where, whom it hits, and which ways out stay free.

    One motion shakes all things together, each beside the walls that it may touch.
    """
    settings = settings_of(locals())
    require("rooms", "shaketable room")
    from shaketable.building import read_building
    from shaketable.report.results_folder import PAGE, require_folder
    from shaketable.report.room import in_hundred, write_room
    from shaketable.report.run_log import sha256
    from shaketable.rooms import assess_room, read_room

    run_log = RunLog()
    contact = contact_options.contact()
    require_folder(out, overwrite, run_log)
    described = read_room(file)
    shaking = motion_options.load(() if building else (DEFAULT_SUITE,))
    if shaking is not None:
        shaking = shaking.in_pairs()
    motions = shaking.motions if shaking else []
    label = described.floor if floor is None else floor
    description = shaking.description if shaking else ""
    if building is None and floor is not None:
        raise InputError("--floor: is for --building")
    if building is not None:
        house = read_building(building, motions, progress=True)
        if label not in house.floors:
            known = named(list(house.floors), 10)
            raise InputError(
                f"--floor: {house.name} has no floor {label!r}; it has {known}. Give --floor, or "
                "floor in the room's file"
            )
        motions = list(house.floors[label])
        description = f"floor {label} of {house.name}"
    found = assess_room(described, motions, scale=scale, model=contact)
    run = {
        **run_log.entries(),
        "room": {"path": str(file), "sha256": sha256(file)},
        "building": building and {"path": str(building), "sha256": sha256(building)},
        "motions": shaking.entries(scale) if shaking else {"names": list(found.motions)},
        "settings": {name: settings[name] for name in sorted(settings.keys() - ELSEWHERE)},
    }
    write_room(found, run, out, description=description, scale=scale, overwrite=overwrite)
    say(
        f"{described.name}: {found.runs:,} shakings by {found.recordings} independent recordings; "
        "of 100, with 95 % intervals:"
    )
    for each in found.things:
        say(f"  {each.name} falls in {in_hundred(each.falls)}")
    for place in found.places:
        say(f"  something falls on {place.place.name} in {in_hundred(place.hit)}")
    for way in found.ways:
        to = way.exit or "any exit"
        before = "" if way.open_before else "; it is closed before anything is shaken"
        say(f"  the way from {way.place} to {to} is closed in {in_hundred(way.closed)}{before}")
    for name, reason in found.left_out:
        say(f"  {name}: {reason}; it is not simulated, and not known to be safe")
    say(f"page: {out / PAGE}")
