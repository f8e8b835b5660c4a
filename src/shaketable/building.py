"""A building: the motions of its floors, recorded or computed from those of the ground.

A TOML file describes it, either by recorded floor motions (files or folders, relative to it),

    name = "Hospital wing B"
    units = "g"                       # and time_step_s, where the files do not say
    [floors]                          # from the lowest to the highest
    ground = "records/ground"
    2 = ["records/chan_7.txt", "records/chan_8.txt"]
    roof = "records/roof"

where a floor may also be a table of the directions in which its instruments stand, in degrees
clockwise from north, for files that do not say it,

    [floors.roof]
    2 = ["records/chan_1.txt", "records/chan_3.txt"]
    92 = "records/chan_4.txt"

or by a linear shear building, whose floors go from "0", the ground, to its number of storeys:

    name = "Office"
    storeys = 6
    first_period_s = 0.65
    damping = 0.05
    motions = ["fema-p695-far-field"]  # of the ground: suites, folders, files

or, where less is known of it, by the profile of floor accelerations of ASCE 7-22, of which all but
the storeys may be left out:

    name = "Surgery"
    storeys = 4
    profile = "ASCE 7-22"
    first_period_s = 0.5
    response_modification = 8        # R, with overstrength (Omega_0) and importance (I_e)
    overstrength = 3
    importance = 1.5
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from shaketable.errors import InputError, joined, named, refused
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.progress import Progress
from shaketable.records import suite
from shaketable.records.suites import files_of, info_of
from shaketable.signal import IntensityMeasure
from shaketable.synthesis import FloorProfile, ShearBuilding, floor_motions, profile_motions
from shaketable.toml_file import TomlFile

_Floors = Callable[[Motion], list[Motion]]  # those above the ground, from its motion

MOST_NAMED = 10  # motions in an error
RECORDED = {"name", "units", "time_step_s", "floors"}
SHEAR = {"name", "storeys", "first_period_s", "damping", "motions", "units", "time_step_s"}
FACTORS = ("response_modification", "overstrength", "importance")
PROFILE = (SHEAR - {"damping"}) | {"profile", *FACTORS}
PROFILES = ("ASCE 7-22",)

NUMBER = (int, float)
KINDS: dict[str, type | tuple[type, ...]] = {
    "name": str,
    "units": str,
    "time_step_s": NUMBER,
    "first_period_s": NUMBER,
    "damping": NUMBER,
    "storeys": int,
    "profile": str,
    **dict.fromkeys(FACTORS, NUMBER),
    "floors": object,
    "motions": object,
}


@dataclass(frozen=True, kw_only=True, eq=False)
class Building:
    """Floors and their motions.

    Attributes:
        name: what to call it.
        floors: motions of each floor by its label, from the lowest to the highest.
        told: where the motions come from, in words.
        files: what they were read from.
        computed: whether motion k of every floor comes from motion k of the ground, the lowest.
    """

    name: str
    floors: Mapping[str, Sequence[Motion]]
    told: str
    files: Sequence[Path] = ()
    computed: bool = False

    @property
    def ground(self) -> Sequence[Motion]:
        """The motions of its lowest floor."""
        return next(iter(self.floors.values()))

    def scaled_to(self, measure: IntensityMeasure) -> Building:
        """The building with every motion of its lowest floor scaled to 1 of a measure.

        The other floors are scaled with it: motion by motion where they were computed, otherwise
        earthquake by earthquake, so that the largest component of the lowest floor has it.

        Raises:
            InputError: several recorded motions of the ground of which one does not name its
                earthquake, or a floor's motion of an earthquake that the ground did not record.
        """
        ground = self.ground
        factors = [measure.factor(motion) for motion in ground]
        if self.computed:
            floors = {
                label: [m.scaled(f) for m, f in zip(motions, factors, strict=True)]
                for label, motions in self.floors.items()
            }
            return replace(self, floors=floors)
        nameless = [
            motion.name or "one without a name" for motion in ground if not _event_of(motion)
        ]
        if len(ground) > 1 and nameless:
            raise InputError(
                f"{self.name}: cannot be scaled to a level of the ground, as these of its motions "
                f"do not name their earthquake: {named(nameless, MOST_NAMED)}"
            )
        by_event: dict[str, float] = {}
        for motion, factor in zip(ground, factors, strict=True):
            event = _event_of(motion)
            by_event[event] = min(by_event.get(event, math.inf), factor)
        lost = [
            f"{label}: {motion.name}"
            for label, motions in self.floors.items()
            for motion in motions
            if _event_of(motion) not in by_event
        ]
        if lost:
            raise InputError(
                f"{self.name}: cannot be scaled to a level of the ground, as its lowest floor did "
                f"not record the earthquakes of {named(lost, MOST_NAMED)}"
            )
        floors = {
            label: [motion.scaled(by_event[_event_of(motion)]) for motion in motions]
            for label, motions in self.floors.items()
        }
        return replace(self, floors=floors)


def _event_of(motion: Motion) -> str:
    return motion.origin.event.strip() if motion.origin else ""


def read_building(
    path: str | Path, ground: Sequence[Motion] = (), *, progress: Progress = False
) -> Building:
    """The building that a TOML file describes.

    Args:
        path: of the file.
        ground: motions of the ground for a shear building, in place of the file's own.
        progress: whether to draw a bar while folders are read.

    Raises:
        InputError: a file that cannot be read, keys that are missing or unknown, or a floor
            without a motion; all faults at once.
    """
    path = Path(path)
    told = TomlFile(path)
    described = told.table
    name = str(described.get("name", path.stem))
    if "floors" in described:
        _require_keys(told, RECORDED)
        if ground:
            raise refused(path, "has recorded floors; leave out --motions")
        return _recorded(path, name, described, progress)
    if "profile" in described:
        _require_keys(told, PROFILE)
        return _computed(path, name, described, ground, progress, _profile)
    _require_keys(told, SHEAR)
    missing = [key for key in ("storeys", "first_period_s") if key not in described]
    if missing:
        raise refused(
            path,
            f"give recorded motions in a table [floors], or {' and '.join(missing)}, "
            f"or profile = {PROFILES[0]!r} and storeys",
        )
    return _computed(path, name, described, ground, progress, _shear)


class Overview(NamedTuple):
    """What a building's file says before anything is computed.

    Attributes:
        name: of the building; that of the file, if it does not say.
        recorded: whether its floors are recorded.
        own_motions: whether it names motions of its ground.
    """

    name: str
    recorded: bool
    own_motions: bool


def overview(path: str | Path) -> Overview:
    """What a building's file says.

    Raises:
        InputError: a file that cannot be read.
    """
    told = TomlFile(Path(path)).table
    return Overview(str(told.get("name", Path(path).stem)), "floors" in told, "motions" in told)


def _in_words(given: str | list[str]) -> str:
    """Names of suites, folders and files as they are printed."""
    return given if isinstance(given, str) else ", ".join(given)


def _require_keys(told: TomlFile, accepted: set[str]) -> None:
    told.accept({key: KINDS[key] for key in sorted(accepted)})
    told.require()


def _recorded(path: Path, name: str, described: Mapping[str, Any], progress: Progress) -> Building:
    floors: dict[str, list[Motion]] = {}
    faults = []
    table = described["floors"]
    if not isinstance(table, dict) or not table:
        raise refused(path, "a table of labels and files is needed", column="floors")
    for label, given in table.items():
        try:
            floors[label] = _floor_at(path, given, described, progress)
        except InputError as error:
            faults.append(f"{path}, floor {label!r}: {error}")
            continue
        if not floors[label]:
            faults.append(f"{path}, floor {label!r}: no horizontal motion")
    if faults:
        raise InputError(joined(faults))
    files = [
        file for given in table.values() for each in _paths(given) for file in _files_at(path, each)
    ]
    return Building(name=name, floors=floors, told="recorded floor motions", files=files)


def _paths(given: Any) -> list[Any]:
    """The paths of a floor, by direction or not."""
    return list(given.values()) if isinstance(given, dict) else [given]


def _floor_at(
    path: Path, given: object, described: Mapping[str, Any], progress: Progress
) -> list[Motion]:
    """The motions of a floor, facing as its table of directions says."""
    if not isinstance(given, dict):
        return _motions_at(path, given, described, progress)
    motions = [
        _facing(motion, told)
        for told, paths in given.items()
        for motion in _motions_at(path, paths, described, progress)
    ]
    files = [motion.origin.file for motion in motions if motion.origin]
    twice = [file for file in dict.fromkeys(files) if file and files.count(file) > 1]
    if twice:
        raise InputError(
            f"give one file for one direction; named twice, or with several components: "
            f"{named(twice, MOST_NAMED)}"
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
            f"{told!r}: expected a direction from 0 to 360 degrees clockwise from north"
        )
    origin = motion.origin or Origin()
    azimuth %= 360.0  # north is 360 in many records
    if origin.azimuth is not None and origin.azimuth % 360.0 != azimuth:
        raise InputError(
            f"{motion.name}: the record says {origin.azimuth:g}° clockwise from north, the "
            f"building's file {azimuth:g}°"
        )
    return replace(motion, origin=replace(origin, azimuth=azimuth))


def _files_at(path: Path, given: str | list[str]) -> list[Path]:
    names = [given] if isinstance(given, str) else given
    return [
        file
        for each in names
        for file in files_of(each if info_of(each) else str(path.parent / each))
    ]


def _motions_at(
    path: Path, given: object, described: Mapping[str, Any], progress: Progress
) -> list[Motion]:
    """The motions of suites, folders and files, relative to the building's file."""
    names = [given] if isinstance(given, str) else given
    if not isinstance(names, list) or not all(isinstance(each, str) for each in names):
        raise InputError(f"expected a path or a list of paths, found {given!r}")
    twice = [each for each in dict.fromkeys(names) if names.count(each) > 1]
    if twice:
        raise InputError(f"{twice[0]!r} is named {names.count(twice[0])} times")
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


def _shear(name: str, described: Mapping[str, Any]) -> tuple[_Floors, str]:
    """The floors above the ground of a shear building, and what it is in words."""
    building = ShearBuilding(
        storeys=described["storeys"],
        first_period=described["first_period_s"],
        damping=described.get("damping", 0.05),
        name=name,
    )
    told = (
        f"linear shear building of {building.storeys} storeys, first period "
        f"{building.first_period:g} s, damping {building.damping:g}"
    )
    return partial(floor_motions, building), told


def _profile(name: str, described: Mapping[str, Any]) -> tuple[_Floors, str]:
    """The floors above the ground by a code's profile, and what it is in words."""
    if described["profile"] not in PROFILES:
        raise InputError(
            f"profile: accepted is {', '.join(PROFILES)}, found {described['profile']!r}"
        )
    if "storeys" not in described:
        raise InputError("a profile needs storeys")
    profile = FloorProfile(
        storeys=described["storeys"],
        period=described.get("first_period_s"),
        name=name,
        **{key: described[key] for key in FACTORS if key in described},
    )
    told = (
        f"building of {profile.storeys} storeys by the profile of ASCE 7-22, whose roof is shaken "
        f"{profile.factors()[-1]:.2f} times as strongly as the ground, at the same periods"
    )
    return partial(profile_motions, profile), told


def _computed(
    path: Path,
    name: str,
    described: Mapping[str, Any],
    ground: Sequence[Motion],
    progress: Progress,
    kind: Callable[[str, Mapping[str, Any]], tuple[_Floors, str]],
) -> Building:
    """A building whose floors' motions are computed from those of its ground."""
    try:
        above, told = kind(name, described)
    except (InputError, TypeError) as error:
        raise refused(path, f"{error}") from None
    motions = list(ground)
    if not motions and "motions" in described:
        try:
            motions = _motions_at(path, described["motions"], described, progress)
        except InputError as error:
            raise refused(path, str(error), column="motions") from None
    if not motions:
        raise refused(path, "no ground motions: give motions = [...] or --motions")
    floors: dict[str, list[Motion]] = {str(k): [] for k in range(described["storeys"] + 1)}
    for motion in motions:
        for k, floor in enumerate([motion, *above(motion)]):
            floors[str(k)].append(floor)
    files = [] if ground or "motions" not in described else _files_at(path, described["motions"])
    under = "" if ground else f", under {_in_words(described['motions'])}"
    return Building(name=name, floors=floors, told=f"{told}{under}", files=files, computed=True)
