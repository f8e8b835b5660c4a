"""`shaketable room`: a room's plan, and what falls where in it."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.console import say, say_line
from shaketable.cli.examples import epilog
from shaketable.cli.option_groups import settings_of, with_groups
from shaketable.cli.options import ContactOptions, LanguageName, Overwrite, language_of
from shaketable.cli.room_options import (
    InventoryFile,
    RoomAsked,
    RoomEarthquakeOptions,
    RoomShakingOptions,
)
from shaketable.errors import InputError, SimulationError, joined, named, printable
from shaketable.extras import require
from shaketable.language import speaking, tell
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.report.run_log import RunLog
from shaketable.units import degrees

room = typer.Typer(
    no_args_is_help=True,
    epilog=epilog("room"),
    help="Simulate all objects of a room: what falls where, whom it hits, which ways out close.",
)

File = Annotated[
    Path, typer.Argument(help="TOML file of a room: outline, doors, places and things.")
]


@room.command(epilog=epilog("room"))
def check(
    file: File,
    inventory: InventoryFile = None,
    out: Annotated[
        Path | None, typer.Option(help="Picture of the plan, with its faults. [FILE.png]")
    ] = None,
) -> None:
    """Draw the plan of a room and mark its faults."""
    require("rooms", "shaketable room")
    from shaketable.drawing.files import require_picture, save
    from shaketable.inventory import read_inventory
    from shaketable.plot.room import plot_room
    from shaketable.report.words.numbers import counted
    from shaketable.rooms import faults_of, read_room
    from shaketable.rooms.furnish import furnished

    picture = out or file.with_suffix(".png")
    require_picture(picture)
    described = read_room(file, check=False)
    if inventory is not None:
        described = furnished(described, read_inventory(inventory), inventory)
    faults = faults_of(described)
    save(plot_room(described, faults=faults), picture)
    say(f"plan: {picture}")
    if faults:
        raise InputError(
            joined([f"{file}, {printable(each.where)}: {printable(each.text)}" for each in faults])
        )
    counts = {"thing": described.things, "place": described.places, "door": described.doors}
    told = ", ".join(counted(len(each), name) for name, each in counts.items())
    say_line(f"{described.name}: {told}; nothing is wrong with the plan")


@room.command(epilog=epilog("room"))
@with_groups
def assess(
    *,
    file: File,
    shaking: RoomShakingOptions,
    earthquake: RoomEarthquakeOptions,
    contact_options: ContactOptions,
    language: LanguageName = "en",
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("room"),
    overwrite: Overwrite = False,
) -> None:
    """Simulate a room: what falls where, whom it hits, and which ways out close.

    One motion shakes all things together, each beside the walls that it may touch.
    """
    settings = settings_of(locals())
    with speaking(language_of(language)):
        asked, run_log = _begun(file, shaking, earthquake, out, overwrite)
        from shaketable.report.room import write_room
        from shaketable.report.words.room import shares
        from shaketable.rooms import assess_room

        scale, model = shaking.scale, contact_options.contact()
        found = assess_room(asked.room, asked.motions, scale=scale, model=model)
        run = asked.run(settings, scale, run_log)
        write_room(found, run, out, description=asked.description, scale=scale, overwrite=overwrite)
        _tell(shares(found), out)


@room.command(epilog=epilog("room"))
@with_groups
def design(
    *,
    file: File,
    shaking: RoomShakingOptions,
    earthquake: RoomEarthquakeOptions,
    contact_options: ContactOptions,
    language: LanguageName = "en",
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("room-design"),
    overwrite: Overwrite = False,
) -> None:
    """Try every single change of a room and the best pairs, and rank them by what they prevent.

    Each thing is strapped, locked, put on pads, made lower, turned, and moved by half a metre.
    """
    settings = settings_of(locals())
    with speaking(language_of(language)):
        asked, run_log = _begun(file, shaking, earthquake, out, overwrite)
        from shaketable.report.room import write_room
        from shaketable.report.words.room import savings
        from shaketable.rooms import design_room

        scale, model = shaking.scale, contact_options.contact()
        found = design_room(asked.room, asked.motions, scale=scale, model=model)
        write_room(
            found.as_it_is, asked.run(settings, scale, run_log), out, design=found,
            description=asked.description, scale=scale, overwrite=overwrite,
        )  # fmt: skip
        _tell(savings(asked.room.name, found), out)


def _begun(
    file: Path,
    shaking: RoomShakingOptions,
    earthquake: RoomEarthquakeOptions,
    out: Path,
    overwrite: bool,
) -> tuple[RoomAsked, RunLog]:
    """The room and its motions, once it is known that the results can be written."""
    require("rooms", "shaketable room")
    from shaketable.report.results_folder import require_folder

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    return shaking.read(file, earthquake), run_log


def _tell(lines: list[str], out: Path) -> None:
    from shaketable.report.results_folder import PAGE

    for line in lines:
        say_line(line)
    say(tell("page: {path}", path=out / PAGE))


@room.command(epilog=epilog("room"))
@with_groups
def survey(
    *,
    files: Annotated[list[Path], typer.Argument(help="TOML files of rooms.")],
    shaking: RoomShakingOptions,
    earthquake: RoomEarthquakeOptions,
    contact_options: ContactOptions,
    closed: Annotated[
        float,
        typer.Option(
            help="List rooms whose way out closes in more than this many of 100 shakings."
        ),
    ] = 10.0,
    pages: Annotated[
        int,
        typer.Option(min=0, help="Number of rooms that get a page of their own, the worst first."),
    ] = 20,
    store: Annotated[
        str | None,
        typer.Option(
            help="Folder, or URL that fsspec knows, that keeps each room that is done: the same "
            "command goes on where it was stopped. [none]"
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            help="Address of a Dask scheduler, such as tcp://10.0.0.1:8786, with --store. [none]"
        ),
    ] = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Start again and discard what the store holds.")
    ] = False,
    language: LanguageName = "en",
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("room-survey"),
    overwrite: Overwrite = False,
) -> None:
    """Simulate many rooms, each on its floor, and rank them by closed ways out and people hit.

    With --store what is done is kept, and --scheduler shares the rooms out among the workers of a
    cluster.
    """
    settings = settings_of(locals())
    if not 0.0 <= closed <= 100.0:
        raise InputError(f"--closed: of 100, from 0 to 100, found {closed:g}")
    if store is None and (scheduler is not None or fresh):
        given = "--scheduler" if scheduler is not None else "--fresh"
        raise InputError(f"{given}: needs --store, where rooms that are done are kept")
    with speaking(language_of(language)):
        require("rooms", "shaketable room")
        from shaketable.campaign.room_survey import survey_rooms
        from shaketable.report.results_folder import require_folder
        from shaketable.report.room_survey import write_survey
        from shaketable.report.words.room import closing

        run_log = RunLog()
        require_folder(out, overwrite, run_log)
        asked = shaking.read_all(files, earthquake)
        client = None
        if scheduler is not None:
            from shaketable.campaign.cluster import connect

            client = connect(scheduler)
        try:
            found = survey_rooms(
                [each.room for each in asked], _of_floors(asked), scale=shaking.scale,
                model=contact_options.contact(), store=store, client=client, fresh=fresh,
            )  # fmt: skip
        except KeyboardInterrupt:
            if store is None:
                raise
            raise SimulationError(
                f"{store}: stopped; the same command{', without --fresh,' if fresh else ''} goes on"
            ) from None
        finally:
            if client is not None:
                client.close()
        first = asked[0].run(settings, shaking.scale, run_log)
        run = {**first, "rooms": [each.source() for each in asked]}
        del run["room"]
        write_survey(
            found, run, out, limit=closed / 100, scale=shaking.scale, pages_of=pages,
            descriptions={each.room.name: each.description for each in asked}, overwrite=overwrite,
        )  # fmt: skip
        _tell(closing(found, closed / 100), out)


def _of_floors(asked: list[RoomAsked]) -> dict[str, list[Motion]] | list[Motion]:
    """The motions of each floor; those of the ground where no building is given."""
    if asked[0].building is None:
        return asked[0].motions
    return {each.room.floor: each.motions for each in asked}


@room.command(epilog=epilog("room"))
@with_groups
def film(
    *,
    file: File,
    shaking: RoomShakingOptions,
    earthquake: RoomEarthquakeOptions,
    contact_options: ContactOptions,
    motion: Annotated[
        str | None,
        typer.Option(help="Name of the motion. [the one under which most things fall]"),
    ] = None,
    reverse: Annotated[
        bool, typer.Option("--reverse", help="Change the signs of that motion.")
    ] = False,
    out: Annotated[
        Path, typer.Option(help="Film, .gif or .mp4, or .glb: a scene for viewers.")
    ] = Path("room.gif"),
) -> None:
    """Write a film of one shaking of a room, in perspective and from above, or a scene.

    Where north is not known the first component of a motion that is named goes along +x.
    """
    require("rooms", "shaketable room")
    from shaketable.drawing.files import SCENE, require_film_or_scene
    from shaketable.plot.room_film import animate_room
    from shaketable.plot.room_gltf import write_room_gltf
    from shaketable.rooms import assess_room, shake_once

    require_film_or_scene(out)
    if reverse and motion is None:
        raise InputError("--reverse: is of the motion that --motion names")
    asked = shaking.read(file, earthquake)
    model, along, friction = contact_options.contact(), None, None
    if motion is None:
        found = assess_room(asked.room, asked.motions, scale=shaking.scale, model=model)
        worst = found.worst
        motion, reverse, along = worst.motion, worst.reversed, worst.along
        friction = None if worst.friction == found.friction else worst.friction
    known = {each.name: each for each in asked.motions}
    if motion not in known:
        raise InputError(
            f"--motion: no motion is called {motion!r}; there are {named(list(known), 10)}"
        )
    wanted = known[motion].scaled(shaking.scale)
    shaken = shake_once(
        asked.room, wanted.reversed() if reverse else wanted, along=along, model=model,
        friction=friction,
    )  # fmt: skip
    if out.suffix.lower() == SCENE:
        write_room_gltf(shaken, out)
    else:
        animate_room(shaken, out, progress=True)
    falls = [each for each in shaken.things if each.response.outcome is not Outcome.STANDING]
    turned = " reversed," if reverse else ""
    rough = f", friction {friction:g}" if friction is not None and isfinite(friction) else ""
    say_line(
        f"{asked.room.name}: {motion},{turned} its first component {degrees(shaken.along):.0f}° "
        f"from +x toward +y{rough}; {len(falls)} of {len(shaken.things)} things fall"
    )
    say(f"film: {out}")
