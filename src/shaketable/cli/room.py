"""`shaketable room`: a room's plan, and what falls where in it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from shaketable.cli.console import say
from shaketable.cli.examples import epilog
from shaketable.cli.option_groups import settings_of, with_groups
from shaketable.cli.options import ContactOptions, Overwrite, Scale
from shaketable.cli.shaking import MotionOptions, ShakingAsked
from shaketable.errors import InputError, joined, named
from shaketable.extras import require
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.rooms import Room

room = typer.Typer(
    no_args_is_help=True,
    epilog=epilog("room"),
    help="What falls where in a room, whom it hits, and whether the ways out stay free.",
)

File = Annotated[
    Path, typer.Argument(help="TOML file of a room: outline, doors, places and things.")
]
Building = Annotated[
    Path | None, typer.Option(help="TOML file of the building in which the room is.")
]
Floor = Annotated[str | None, typer.Option(help="Label of its floor in it. [that of FILE]")]
MOST_TOLD = 12  # changes
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
    from shaketable.report.words.numbers import counted
    from shaketable.rooms import faults_of, read_room

    picture = out or file.with_suffix(".png")
    require_picture(picture)
    described = read_room(file, check=False)
    faults = faults_of(described)
    save(plot_room(described, faults=faults), picture)
    say(f"plan: {picture}")
    if faults:
        raise InputError(joined([f"{file}, {each.where}: {each.text}" for each in faults]))
    counts = {"thing": described.things, "place": described.places, "door": described.doors}
    told = ", ".join(counted(len(each), name) for name, each in counts.items())
    say(f"{described.name}: {told}; nothing is wrong with the plan")


@room.command(epilog=epilog("room"))
@with_groups
def assess(
    *,
    file: File,
    motion_options: MotionOptions,
    building: Building = None,
    floor: Floor = None,
    scale: Scale = 1.0,
    contact_options: ContactOptions,
    out: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("room"),
    overwrite: Overwrite = False,
) -> None:
    """Shake a room: what falls where, whom it hits, and which ways out stay free.

    One motion shakes all things together, each beside the walls that it may touch.
    """
    settings = settings_of(locals())
    asked = _Asked.of(file, motion_options, building, floor, out, overwrite)
    from shaketable.report.results_folder import PAGE
    from shaketable.report.room import write_room
    from shaketable.report.words.numbers import counted, with_interval
    from shaketable.report.words.room import not_known
    from shaketable.rooms import assess_room

    described = asked.room
    found = assess_room(described, asked.motions, scale=scale, model=contact_options.contact())
    run = asked.run(settings, scale)
    write_room(found, run, out, description=asked.description, scale=scale, overwrite=overwrite)
    say(
        f"{described.name}: {found.runs:,} shakings by "
        f"{counted(found.recordings, 'independent recording')}; of 100, with 95 % intervals:"
    )
    for each in found.things:
        say(f"  {each.name} falls in {with_interval(each.falls)}")
    for place in found.places:
        say(f"  something falls on {place.place.name} in {with_interval(place.hit)}")
    for way in found.ways:
        to = way.exit or "any exit"
        before = "" if way.open_before else "; it is closed before anything is shaken"
        say(f"  the way from {way.place} to {to} is closed in {with_interval(way.closed)}{before}")
    for line in not_known(found):
        say(f"  {line}")
    say(f"page: {out / PAGE}")


@room.command(epilog=epilog("room"))
@with_groups
def design(
    *,
    file: File,
    motion_options: MotionOptions,
    building: Building = None,
    floor: Floor = None,
    scale: Scale = 1.0,
    contact_options: ContactOptions,
    out: Annotated[Path, typer.Option(help="Folder for the tables.")] = Path("room-design"),
    overwrite: Overwrite = False,
) -> None:
    """Try every single change of a room, and tell which saves most; then the best pair.

    Each thing is strapped, locked, put on pads, made lower, turned, and moved by half a metre.
    """
    settings = settings_of(locals())
    asked = _Asked.of(file, motion_options, building, floor, out, overwrite)
    from shaketable.report.results_folder import write_folder
    from shaketable.report.room import design_tables
    from shaketable.report.words import room as room_words
    from shaketable.report.words.numbers import counted, with_interval
    from shaketable.rooms import design_room

    found = design_room(asked.room, asked.motions, scale=scale, model=contact_options.contact())
    tables = design_tables(found)
    write_folder(out, asked.run(settings, scale), overwrite=overwrite, tables=tables)
    now = found.now
    say(
        f"{asked.room.name}: {found.runs:,} shakings by "
        f"{counted(found.recordings, 'independent recording')}; of 100, something falls on a place "
        f"in {with_interval(now.hit)}, and somebody is shut in in {with_interval(now.shut_in)}; on "
        f"an average {now.people:.2f} people are hit or shut in"
    )
    say(f"What each of {len(found.singles)} changes saves, alone:")
    for each in found.singles[:MOST_TOLD]:
        say(f"  {each.saves:+.2f} people  {room_words.tried(each)}")
    if len(found.singles) > MOST_TOLD:
        say(f"  ... and {len(found.singles) - MOST_TOLD} more in {out / 'changes.csv'}")
    if found.pairs:
        best = found.pairs[0]
        say(f"The best pair, {best.saves:+.2f} people:")
        for change in best.changes:
            say(f"  {change.thing}: {room_words.change(change)}")
    say(f"tables: {out}")


class _Asked(NamedTuple):
    """A room and the motions that shake it, as they were asked for."""

    file: Path
    room: Room
    building: Path | None
    shaking: ShakingAsked | None
    motions: list[Motion]
    description: str
    run_log: RunLog

    @classmethod
    def of(
        cls,
        file: Path,
        motion_options: MotionOptions,
        building: Path | None,
        floor: str | None,
        out: Path,
        overwrite: bool,
    ) -> _Asked:
        """Read the room, the motions and the building, once it is known that `out` can be written.

        Raises:
            InputError: what is wrong with them.
        """
        require("rooms", "shaketable room")
        from shaketable.building import read_building
        from shaketable.report.results_folder import require_folder
        from shaketable.rooms import read_room

        run_log = RunLog()
        require_folder(out, overwrite, run_log)
        described = read_room(file)
        shaking = motion_options.load(() if building else (DEFAULT_SUITE,))
        if shaking is not None:
            shaking = shaking.in_pairs()
        motions = shaking.motions if shaking else []
        description = shaking.description if shaking else ""
        if building is None and floor is not None:
            raise InputError("--floor: is for --building")
        if building is not None:
            label = described.floor if floor is None else floor
            house = read_building(building, motions, progress=True)
            if label not in house.floors:
                known = named(list(house.floors), 10)
                raise InputError(
                    f"--floor: {house.name} has no floor {label!r}; it has {known}. Give --floor, "
                    "or floor in the room's file"
                )
            motions = list(house.floors[label])
            description = f"floor {label} of {house.name}"
        return cls(file, described, building, shaking, motions, description, run_log)

    def run(self, settings: Mapping[str, object], scale: float) -> dict[str, object]:
        """What makes the run repeatable."""
        from shaketable.report.run_log import sha256

        names = {"names": [motion.name for motion in self.motions]}
        place = self.building
        return {
            **self.run_log.entries(),
            "room": {"path": str(self.file), "sha256": sha256(self.file)},
            "building": place and {"path": str(place), "sha256": sha256(place)},
            "motions": self.shaking.entries(scale) if self.shaking else names,
            "settings": {name: settings[name] for name in sorted(settings.keys() - ELSEWHERE)},
        }
