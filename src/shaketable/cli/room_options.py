"""A room, and the motions that shake it, as a command is given them."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from shaketable.cli.earthquake_options import (
    EarthquakeOptions,
    MapFile,
    MapSigma,
    scales_of,
)
from shaketable.cli.options import Scale
from shaketable.cli.shaking import MotionOptions, ShakingAsked
from shaketable.errors import Fault, InputError, named, refusal
from shaketable.extras import require
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.rooms import Room

log = logging.getLogger(__name__)

Building = Annotated[
    Path | None, typer.Option(help="TOML file of the building in which the room is.")
]
Floor = Annotated[str | None, typer.Option(help="Label of its floor in it. [that of FILE]")]
InventoryFile = Annotated[
    Path | None,
    typer.Option(
        help="List of objects with x_m and y_m; rows whose location is the room's name are used."
    ),
]
ELSEWHERE = {
    "file",
    "files",
    "motions",
    "building",
    "inventory",
    "shakemap",
    "out",
    "overwrite",
}  # of what is told by itself


RECORDED = 20  # recordings of an earthquake
FAR_OFF = 25.0  # %: of a median spectrum beside that of the earthquake


@dataclass(frozen=True, kw_only=True)
class RoomEarthquakeOptions(EarthquakeOptions):
    """Which earthquake shakes rooms: by recordings, selected and scaled."""

    shakemap: MapFile = None
    map_sigma: MapSigma = None
    measure: Annotated[
        str | None, typer.Option(help="Measure of the map: PGA, PGV or SA(1.0). [PGV]")
    ] = None
    latitude: Annotated[
        float | None, typer.Option(help="Of the building on the map [degrees].")
    ] = None
    longitude: Annotated[
        float | None, typer.Option(help="Of the building on the map [degrees].")
    ] = None
    number: Annotated[
        int | None,
        typer.Option(min=2, help="Recordings of an earthquake of a magnitude. [20]"),
    ] = None
    scales: Annotated[
        str | None,
        typer.Option(
            help="Smallest and largest factor on a recording of an earthquake of a magnitude. "
            "[0.25,4]"
        ),
    ] = None
    seed: Annotated[
        int | None, typer.Option(min=0, help="Seed of the choice and of the levels. [0]")
    ] = None

    def motions(self, shaking: ShakingAsked) -> ShakingAsked:
        """The recordings of the earthquake, with both components; all, where none is asked for.

        Raises:
            InputError: options that do not go together, or what the earthquake's models, its map or
                the selection say.
        """
        if not self.given:
            return shaking
        if self.shakemap is None:
            if found := self._named("map_sigma", "measure", "latitude", "longitude"):
                raise InputError(f"{found}: is for --shakemap")
            return self._of_scenario(shaking)
        if found := self._named(
            *(field.name for field in fields(EarthquakeOptions)), "number", "scales"
        ):
            raise InputError(f"--shakemap: leave out {found}; a map needs none")
        return self._of_map(self.shakemap, shaking)

    def _named(self, *names: str) -> str:
        """Those of some options that are given."""
        given = [name for name in names if getattr(self, name) is not None]
        return " and ".join(f"--{name.replace('_', '-')}" for name in given)

    def _of_scenario(self, shaking: ShakingAsked) -> ShakingAsked:
        from shaketable.hazard import select_motions, target_of
        from shaketable.hazard.selection import SCALES

        quake = self.scenario()
        number = self.number or RECORDED
        found = select_motions(
            shaking.motions, target_of(quake), number,
            scales=scales_of(self.scales) if self.scales is not None else SCALES,
            seed=self.seed or 0, progress=True,
        )  # fmt: skip
        median, spread = (100.0 * math.expm1(each) for each in found.departures())
        told = (
            f"{quake.name}: {number} recordings, selected and scaled; their median spectrum is off "
            f"by up to {median:.0f} %, and their spread by up to {spread:.0f} %"
        )
        if median > FAR_OFF:
            log.warning(
                "%s: the median spectrum of the recordings is off by up to %.0f %%: more, or more "
                "alike, in --motions would be nearer", quake.name, median,
            )  # fmt: skip
        return replace(shaking, motions=list(found.motions), description=told, names=())

    def _of_map(self, path: Path, shaking: ShakingAsked) -> ShakingAsked:
        from shaketable.hazard import read_shakemap
        from shaketable.hazard.earthquake import Location, Shaken, motions_of_map

        if self.latitude is None or self.longitude is None:
            missing = "--latitude" if self.latitude is None else "--longitude"
            raise InputError(f"{missing}: is needed; the map tells each site another shaking")
        quake = read_shakemap(path, assumed_sigma=self.map_sigma)
        here = Location("", (self.longitude, self.latitude))
        mean, sigma = quake.of(self.measure or "PGV", self.longitude, self.latitude)
        places = {here: Shaken(float(mean), float(sigma))}
        found = motions_of_map(shaking.motions, self.measure or "PGV", places, seed=self.seed or 0)
        told = (
            f"{quake.name} at {here.name}: {len(found[here])} recordings, scaled to the map's "
            f"{self.measure or 'PGV'}"
        )
        return replace(shaking, motions=found[here], description=told, names=())


@dataclass(frozen=True)
class RoomShakingOptions(MotionOptions):
    """By what a room is shaken: motions, or those of a floor of a building."""

    building: Building = None
    floor: Floor = None
    scale: Scale = 1.0
    inventory: InventoryFile = None

    def read(self, file: Path, earthquake: RoomEarthquakeOptions) -> RoomAsked:
        """The room of a file, and its motions.

        Raises:
            InputError: what is wrong with them.
        """
        (asked,) = self.read_all([file], earthquake)
        return asked

    def read_all(self, files: Sequence[Path], earthquake: RoomEarthquakeOptions) -> list[RoomAsked]:
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
        if earthquake.given and self.scale != 1.0:
            raise InputError("--scale: the earthquake tells how strong the shaking is")
        shaking = self.load(() if self.building and not earthquake.given else (DEFAULT_SUITE,))
        if shaking is not None:
            shaking = earthquake.motions(shaking.in_pairs())
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
        try:
            house = read_building(self.building, motions, progress=True)
        except InputError as error:
            if earthquake.given:
                raise InputError(f"{error}; an earthquake shakes its ground") from None
            raise
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
            if earthquake.given and shaking is not None:
                told = f"{told}; {shaking.description}"
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
        shakemap = settings.get("shakemap")
        assert shakemap is None or isinstance(shakemap, Path)
        beside = {"building": self.building, "inventory": self.inventory, "shakemap": shakemap}
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
