"""A room, and the motions that shake it, as a command is given them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from shaketable.cli.options import Scale
from shaketable.cli.shaking import MotionOptions, ShakingAsked
from shaketable.errors import Fault, InputError, named, refusal
from shaketable.extras import require
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.rooms import Room

Building = Annotated[
    Path | None, typer.Option(help="TOML file of the building in which the room is.")
]
Floor = Annotated[str | None, typer.Option(help="Label of its floor in it. [that of FILE]")]
InventoryFile = Annotated[
    Path | None,
    typer.Option(
        help="List with things of rooms: rows whose location is a room's name, with x_m and y_m in "
        "its plan."
    ),
]
ELSEWHERE = {
    "file",
    "files",
    "motions",
    "building",
    "inventory",
    "out",
    "overwrite",
}  # of what is told by itself


@dataclass(frozen=True)
class RoomShakingOptions(MotionOptions):
    """By what a room is shaken: motions, or those of a floor of a building."""

    building: Building = None
    floor: Floor = None
    scale: Scale = 1.0
    inventory: InventoryFile = None

    def read(self, file: Path) -> RoomAsked:
        """The room of a file, and its motions.

        Raises:
            InputError: what is wrong with them.
        """
        (asked,) = self.read_all([file])
        return asked

    def read_all(self, files: Sequence[Path]) -> list[RoomAsked]:
        """Some rooms, each with the motions of its floor.

        Raises:
            InputError: what is wrong with them.
        """
        require("rooms", "shaketable room")
        from shaketable.building import read_building
        from shaketable.inventory import read_inventory
        from shaketable.rooms import Room, read_room
        from shaketable.rooms.furnish import furnished
        from shaketable.rooms.prepared import require_sound

        items = read_inventory(self.inventory) if self.inventory else []
        rooms, faults = list[Room](), list[Fault]()
        for file in files:
            try:
                room = read_room(file)
                if self.inventory:
                    room = furnished(room, items, self.inventory)
                    require_sound(room)
                rooms.append(room)
            except InputError as error:
                faults += error.listed
        if faults:
            raise refusal(faults)
        shaking = self.load(() if self.building else (DEFAULT_SUITE,))
        if shaking is not None:
            shaking = shaking.in_pairs()
        motions = shaking.motions if shaking else []
        if self.building is None:
            if self.floor is not None:
                raise InputError("--floor: is for --building")
            assert shaking is not None
            told = shaking.description
            return [
                RoomAsked(file, room, None, self.inventory, shaking, motions, told)
                for file, room in zip(files, rooms, strict=True)
            ]
        house = read_building(self.building, motions, progress=True)
        asked = []
        for file, room in zip(files, rooms, strict=True):
            label = room.floor if self.floor is None else self.floor
            if label not in house.floors:
                known = named(list(house.floors), 10)
                raise InputError(
                    f"{file}, --floor: {house.name} has no floor {label!r}; it has {known}. Give "
                    "--floor, or floor in the room's file"
                )
            told = f"floor {label} of {house.name}"
            of_floor = list(house.floors[label])
            here = replace(room, floor=label)
            asked.append(
                RoomAsked(file, here, self.building, self.inventory, shaking, of_floor, told)
            )
        return asked


class RoomAsked(NamedTuple):
    """A room and the motions that shake it, as they were asked for."""

    file: Path
    room: Room
    building: Path | None
    inventory: Path | None
    shaking: ShakingAsked | None
    motions: list[Motion]
    description: str

    def source(self) -> dict[str, object]:
        """The file of the room."""
        from shaketable.report.run_log import sha256

        return {"path": str(self.file), "sha256": sha256(self.file)}

    def run(
        self, settings: Mapping[str, object], scale: float, run_log: RunLog
    ) -> dict[str, object]:
        """What makes the run repeatable."""
        from shaketable.report.run_log import sha256

        names = {"names": [motion.name for motion in self.motions]}
        beside = {"building": self.building, "inventory": self.inventory}
        return {
            **run_log.entries(),
            "room": self.source(),
            **{
                name: path and {"path": str(path), "sha256": sha256(path)}
                for name, path in beside.items()
            },
            "motions": self.shaking.entries(scale) if self.shaking else names,
            "settings": {name: settings[name] for name in sorted(settings.keys() - ELSEWHERE)},
        }
