"""A building whose floors were recorded, paired by the directions of its instruments."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from shaketable.building.building import MOST_NAMED, Building
from shaketable.errors import InputError, joined, named, refused
from shaketable.language import tell
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.progress import Progress
from shaketable.records import suite
from shaketable.records.pairs import couples_on_floor, joined_pair
from shaketable.records.suites import files_of, info_of


def building(path: Path, name: str, described: Mapping[str, Any], progress: Progress) -> Building:
    """A building of recorded floors, as its file describes it.

    Raises:
        InputError: all faults at once.
    """
    floors: dict[str, list[Motion]] = {}
    faults = []
    table = described["floors"]
    if not isinstance(table, dict) or not table:
        raise refused(path, tell("a table of labels and files is needed"), column="floors")
    for label, given in table.items():
        try:
            floors[label] = in_pairs(
                [_of_building(each, name) for each in _floor_at(path, given, described, progress)]
            )
        except InputError as error:
            faults.append(f"{path}, floor {label!r}: {error}")
            continue
        if not floors[label]:
            faults.append(f"{path}, floor {label!r}: no horizontal motion")
    if faults:
        raise InputError(joined(faults))
    files = [
        file for given in table.values() for each in _paths(given) for file in files_at(path, each)
    ]
    return Building(name=name, floors=floors, told=tell("recorded floor motions"), files=files)


def _of_building(motion: Motion, name: str) -> Motion:
    """The motion of an instrument of a building; all of one earthquake are one recording."""
    origin = motion.origin
    if origin is None or origin.station.strip() or not origin.event.strip():
        return motion
    return replace(motion, origin=replace(origin, station=name))


def in_pairs(motions: Sequence[Motion]) -> list[Motion]:
    """The channels of a floor, each with every one at a right angle to it, or by itself.

    A channel to the left of several makes a pair with each of them: they are a few metres apart,
    and a floor moves as a whole.
    """
    couples = couples_on_floor(motions)
    paired = {k for couple in couples for k in couple}
    alone = [motion for k, motion in enumerate(motions) if k not in paired]
    return [joined_pair(motions[one], motions[other]) for one, other in couples] + alone


def _paths(given: Any) -> list[Any]:
    """The paths of a floor, by direction or not."""
    return list(given.values()) if isinstance(given, dict) else [given]


def _floor_at(
    path: Path, given: object, described: Mapping[str, Any], progress: Progress
) -> list[Motion]:
    """The motions of a floor, facing as its table of directions says."""
    if not isinstance(given, dict):
        return motions_at(path, given, described, progress)
    motions = [
        _facing(motion, told)
        for told, paths in given.items()
        for motion in motions_at(path, paths, described, progress)
    ]
    files = [motion.origin.file for motion in motions if motion.origin]
    twice = [file for file in dict.fromkeys(files) if file and files.count(file) > 1]
    if twice:
        raise InputError(
            tell(
                "give one file for one direction; named twice, or with several components: {names}",
                names=named(twice, MOST_NAMED),
            )
        )
    return motions


def _facing(motion: Motion, told: str) -> Motion:
    """The motion with the direction that the building's file tells.

    Raises:
        InputError: no direction, or another one than the record's own.
    """
    try:
        azimuth = float(told)
    except ValueError:
        azimuth = math.nan
    if not 0.0 <= azimuth <= 360.0:
        raise InputError(
            tell(
                "{found!r}: expected a direction from 0 to 360 degrees clockwise from north",
                found=told,
            )
        )
    origin = motion.origin or Origin()
    azimuth %= 360.0  # north is 360 in many records
    if origin.azimuth is not None and origin.azimuth % 360.0 != azimuth:
        raise InputError(
            tell(
                "{motion}: the record says {recorded:g}° clockwise from north, the building's file "
                "{azimuth:g}°",
                motion=motion.name,
                recorded=origin.azimuth,
                azimuth=azimuth,
            )
        )
    return replace(motion, origin=replace(origin, azimuth=azimuth))


def files_at(path: Path, given: str | list[str]) -> list[Path]:
    names = [given] if isinstance(given, str) else given
    return [
        file
        for each in names
        for file in files_of(each if info_of(each) else str(path.parent / each))
    ]


def motions_at(
    path: Path, given: object, described: Mapping[str, Any], progress: Progress
) -> list[Motion]:
    """The motions of suites, folders and files, relative to the building's file."""
    names = [given] if isinstance(given, str) else given
    if not isinstance(names, list) or not all(isinstance(each, str) for each in names):
        raise InputError(tell("expected a path or a list of paths, found {given!r}", given=given))
    twice = [each for each in dict.fromkeys(names) if names.count(each) > 1]
    if twice:
        raise InputError(
            tell("{name!r} is named {count} times", name=twice[0], count=names.count(twice[0]))
        )
    motions: list[Motion] = []
    for each in names:
        where = each if info_of(each) else path.parent / each
        motions += suite(
            where,
            units=described.get("units"),
            time_step=described.get("time_step_s"),
            progress=progress,
        )
    return motions
