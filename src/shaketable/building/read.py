"""The file of a building: the motions of its floors, recorded or computed from the ground's.

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

or, where its period is not known, by its structure, of which the typical period follows; `assess`
tries those that are usual, and the worst leads,

    name = "Clinic"
    storeys = 3
    structure = "concrete frame"     # or steel frame, braced steel frame, concrete walls, masonry,
    storey_height_m = 3.2            # timber

or by the profile of floor accelerations of ASCE 7-22, of which all but
the storeys may be left out:

    name = "Surgery"
    storeys = 4
    profile = "ASCE 7-22"
    first_period_s = 0.5
    response_modification = 8        # R, with overstrength (Omega_0) and importance (I_e)
    overstrength = 3
    importance = 1.5

Both take the two horizontal directions, each component through the building in its own. A shear
building is alike in both, unless period_ratio tells how many times as long its first period is
across its x direction, or first_period_y_s that period itself. Where x_direction_deg tells the
direction of its x, clockwise from north, recordings of known directions are turned to it; otherwise
their first component goes along x. One whose floors twist has

    plan_m = [30, 15]                # along x and y
    eccentricity = [0.1, 0]          # of the centre of stiffness, in shares of the plan
    torsional_ratio = 1.2            # of the torsional over the lateral frequency

and things stand at the corner that moves most, the one farthest from the centre of stiffness.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from shaketable.building import computed, recorded
from shaketable.building.building import Building
from shaketable.errors import refused
from shaketable.language import tell
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.toml_file import TomlFile

Kinds = dict[str, type | tuple[type, ...]]

NUMBER = (int, float)
_COMPUTED: Kinds = {
    "name": str,
    "storeys": int,
    "first_period_s": NUMBER,
    "motions": object,
    "units": str,
    "time_step_s": NUMBER,
    "x_direction_deg": NUMBER,
}
RECORDED: Kinds = {"floors": object, "name": str, "time_step_s": NUMBER, "units": str}
SHEAR: Kinds = {
    **_COMPUTED,
    "damping": NUMBER,
    "period_ratio": NUMBER,
    "first_period_y_s": NUMBER,
    "plan_m": list,
    "eccentricity": list,
    "torsional_ratio": NUMBER,
}
STRUCTURE: Kinds = {
    **{key: kind for key, kind in _COMPUTED.items() if key != "first_period_s"},
    "structure": str,
    "storey_height_m": NUMBER,
    "damping": NUMBER,
}
PROFILE: Kinds = {**_COMPUTED, "profile": str, **dict.fromkeys(computed.FACTORS, NUMBER)}


def read_building(
    path: str | Path, ground: Sequence[Motion] = (), *, progress: Progress = False
) -> Building:
    """Read a building from a TOML file.

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
            raise refused(path, tell("has recorded floors; leave out --motions"))
        return recorded.building(path, name, described, progress)
    if "profile" in described:
        _require_keys(told, PROFILE)
        return computed.building(path, name, described, ground, progress, computed.by_profile)
    if "structure" in described:
        _require_keys(told, STRUCTURE)
        if "storeys" not in described:
            raise refused(path, tell("a structure needs storeys"))
        return computed.of_structure(path, name, described, ground, progress)
    _require_keys(told, SHEAR)
    missing = [key for key in ("storeys", "first_period_s") if key not in described]
    if missing:
        raise refused(
            path,
            tell(
                "give recorded motions in a table [floors], or {accepted}, or structure and "
                "storeys, or profile = {profiles!r} and storeys",
                accepted=" and ".join(missing),
                profiles=computed.PROFILES[0],
            ),
        )
    return computed.building(path, name, described, ground, progress, computed.by_shear)


def building_of_structure(
    path: Path, described: Mapping[str, object], ground: Sequence[Motion]
) -> Building:
    """A building of which structure and storeys are known, as a list's sheet says them.

    Args:
        path: of the list, for what is wrong.
        described: name, storeys, structure, storey_height_m.
        ground: motions of the ground.

    Raises:
        InputError: values out of range.
    """
    name = str(described.get("name", path.stem))
    return computed.of_structure(path, name, described, ground, False)


class Overview(NamedTuple):
    """The contents of a building's file before anything is computed.

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


def _require_keys(told: TomlFile, accepted: Mapping[str, type | tuple[type, ...]]) -> None:
    told.accept({key: accepted[key] for key in sorted(accepted)})
    told.require()
