"""A room, and the motions that shake it, as a command is given them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from shaketable.cli.options import Scale
from shaketable.cli.shaking import MotionOptions, ShakingAsked
from shaketable.errors import InputError, named
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
ELSEWHERE = {"file", "motions", "building", "out", "overwrite"}  # of what is told by itself


@dataclass(frozen=True)
class RoomShakingOptions(MotionOptions):
    """By what a room is shaken: motions, or those of a floor of a building."""

    building: Building = None
    floor: Floor = None
    scale: Scale = 1.0

    def read(self, file: Path) -> RoomAsked:
        """The room of a file, and its motions.

        Raises:
            InputError: what is wrong with them.
        """
        require("rooms", "shaketable room")
        from shaketable.building import read_building
        from shaketable.rooms import read_room

        room = read_room(file)
        shaking = self.load(() if self.building else (DEFAULT_SUITE,))
        if shaking is not None:
            shaking = shaking.in_pairs()
        motions = shaking.motions if shaking else []
        description = shaking.description if shaking else ""
        if self.building is None and self.floor is not None:
            raise InputError("--floor: is for --building")
        if self.building is not None:
            label = room.floor if self.floor is None else self.floor
            house = read_building(self.building, motions, progress=True)
            if label not in house.floors:
                known = named(list(house.floors), 10)
                raise InputError(
                    f"--floor: {house.name} has no floor {label!r}; it has {known}. Give --floor, "
                    "or floor in the room's file"
                )
            motions = list(house.floors[label])
            description = f"floor {label} of {house.name}"
        return RoomAsked(file, room, self.building, shaking, motions, description)


class RoomAsked(NamedTuple):
    """A room and the motions that shake it, as they were asked for."""

    file: Path
    room: Room
    building: Path | None
    shaking: ShakingAsked | None
    motions: list[Motion]
    description: str

    def run(
        self, settings: Mapping[str, object], scale: float, run_log: RunLog
    ) -> dict[str, object]:
        """What makes the run repeatable."""
        from shaketable.report.run_log import sha256

        names = {"names": [motion.name for motion in self.motions]}
        place = self.building
        return {
            **run_log.entries(),
            "room": {"path": str(self.file), "sha256": sha256(self.file)},
            "building": place and {"path": str(place), "sha256": sha256(place)},
            "motions": self.shaking.entries(scale) if self.shaking else names,
            "settings": {name: settings[name] for name in sorted(settings.keys() - ELSEWHERE)},
        }
