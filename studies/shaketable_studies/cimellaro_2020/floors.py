"""The floors that the study shakes: those of linear stand-ins, and a recorded building's.

The records of the paper's three buildings are not at hand. In their place are linear shear
buildings with as many storeys, each driven by both components of a recorded motion that is scaled
to the peak ground accelerations of table 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from shaketable.building import Building, read_building
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.records import suite
from shaketable.synthesis import ShearBuilding, floor_motions
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.cimellaro_2020.printed import TABLE_1

#: Of the paper's buildings: number in table 1, first period [s], and the recorded ground motion.
STAND_INS = (
    (3, 0.6, ("LOMAP/CAP000", "LOMAP/CAP090")),
    (4, 0.75, ("SUPERST/B-POE270", "SUPERST/B-POE360")),
    (5, 0.75, ("LOMAP/G03000", "LOMAP/G03090")),
)
DAMPING = 0.05


class Channel(NamedTuple):
    """A floor's motion in one direction.

    Attributes:
        building, name: what to call the building and the channel.
        storey: from 1; 0 is the ground; -1 if unknown.
        motion: absolute acceleration.
    """

    building: str
    name: str
    storey: int
    motion: Motion


def stand_ins() -> list[Channel]:
    """Floors of the three linear stand-ins, in two directions."""
    recorded = {motion.name: motion for motion in suite("fema-p695")}
    channels = []
    for number, period, names in STAND_INS:
        printed = TABLE_1[number - 1]
        building = f"stand-in for ID {number:03d}, {printed.storeys} storeys"
        peaks = (printed.pga_transverse_g, printed.pga_longitudinal_g)
        for way, name, pga_g in zip(("across", "along"), names, peaks, strict=True):
            ground = recorded[name]
            scale = pga_g * STANDARD_GRAVITY / ground.peak_ground_acceleration
            shear = ShearBuilding(
                storeys=printed.storeys, first_period=period, damping=DAMPING, name=building
            )
            for storey, motion in enumerate(floor_motions(shear, ground.scaled(scale)), 1):
                channels.append(Channel(building, f"floor {storey} {way}", storey, motion))
    return channels


def channels_of(building: str, motions: Sequence[Motion]) -> list[Channel]:
    """The channels of a recorded building; which floors they are on is not known.

    Raises:
        InputError: no motions, or one that does not move.
    """
    if not motions:
        raise InputError(f"{building}: no floor motions")
    still = [motion.name for motion in motions if motion.peak_ground_acceleration == 0.0]
    if still:
        raise InputError(f"{building}: {', '.join(still)}: does not move")
    return [Channel(building, motion.name, -1, motion) for motion in motions]


def channels_in(building: Building) -> list[Channel]:
    """The channels of a building whose floors are known; the lowest is its ground, 0."""
    return [
        Channel(building.name, motion.name, storey, motion)
        for storey, motions in enumerate(building.floors.values())
        for motion in motions
    ]


def recorded_channels(
    building: Path, units: str | None = None, time_step: float | None = None
) -> list[Channel]:
    """The channels of a recorded building: a TOML file as for `read_building`, or a folder.

    Args:
        building: the file or folder.
        units, time_step: for records in a folder that do not state them.

    Raises:
        InputError: no such folder, and what cannot be read.
    """
    if building.suffix.lower() == ".toml":
        return channels_in(read_building(building, progress=True))
    if not building.is_dir():
        raise InputError(f"--building: {building}: there is no such folder or TOML file")
    motions = suite(building, units=units, time_step=time_step, progress=True)
    return channels_of(building.name, motions)
