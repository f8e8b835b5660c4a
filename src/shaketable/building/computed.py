"""A building whose floors' motions are computed from those of its ground, in both directions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from shaketable.building.building import MOST_NAMED, Building
from shaketable.building.recorded import files_at, motions_at
from shaketable.building.typical import SOURCE, STOREY_HEIGHT, VARIED, typical_period
from shaketable.errors import InputError, named, refused
from shaketable.language import tell, translated
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.records.pairs import joined_pairs
from shaketable.synthesis import (
    FloorProfile,
    ShearBuilding,
    TorsionalBuilding,
    corner_motions,
    floor_motions,
    profile_motions,
)

Floors = Callable[[Motion], list[Motion]]  # those above the ground, from its motion
Kind = Callable[[str, Mapping[str, Any]], tuple[Floors, str]]

FACTORS = ("response_modification", "overstrength", "importance")
PROFILES = ("ASCE 7-22",)
TWISTS = ("plan_m", "eccentricity", "torsional_ratio")


def building(
    path: Path,
    name: str,
    described: Mapping[str, Any],
    ground: Sequence[Motion],
    progress: Progress,
    kind: Kind,
) -> Building:
    """A building whose floors' motions are computed from those of its ground.

    Args:
        path: of its file.
        name: what to call it.
        described: what its file says.
        ground: motions of the ground in place of those that the file names.
        progress: whether to draw a bar while folders are read.
        kind: `by_shear` or `by_profile`.

    Raises:
        InputError: values out of range, or no motions of the ground.
    """
    try:
        above, told = kind(name, described)
    except (InputError, TypeError) as error:
        raise refused(path, str(error)) from None
    motions = list(ground)
    if not motions and "motions" in described:
        try:
            motions = motions_at(path, described["motions"], described, progress)
        except InputError as error:
            raise refused(path, str(error), column="motions") from None
    if not motions:
        raise refused(path, tell("no ground motions: give motions = [...] or --motions"))
    pairs = joined_pairs(motions)
    if (axis := described.get("x_direction_deg")) is not None:
        pairs = [along(motion, axis) for motion in pairs]
    floors: dict[str, list[Motion]] = {str(k): [] for k in range(described["storeys"] + 1)}
    for motion in pairs:
        try:
            shaken = [motion, *above(motion)]
        except InputError as error:
            raise refused(path, str(error)) from None
        for k, floor in enumerate(shaken):
            floors[str(k)].append(floor)
    files = [] if ground or "motions" not in described else files_at(path, described["motions"])
    under = "" if ground else tell(", under {motions}", motions=_in_words(described["motions"]))
    return Building(name=name, floors=floors, told=f"{told}{under}", files=files, computed=True)


def along(motion: Motion, axis: float) -> Motion:
    """A pair of components turned to the axes of a building.

    Args:
        motion: one without a transverse component, or of unknown direction, stays as it is.
        axis: direction of x, clockwise from north [degrees].
    """
    origin, across = motion.origin, motion.transverse_origin
    if motion.transverse is None or origin is None or origin.azimuth is None:
        return motion
    turned = motion.rotated(math.radians(axis - origin.azimuth))
    return replace(
        turned,
        origin=turned.origin and replace(turned.origin, azimuth=axis % 360.0),
        transverse_origin=across
        and turned.transverse_origin
        and replace(turned.transverse_origin, azimuth=(axis - 90.0) % 360.0),
    )


def by_shear(name: str, described: Mapping[str, Any]) -> tuple[Floors, str]:
    """The floors above the ground of a shear building, and what it is in words."""
    period = described["first_period_s"]
    across = described.get("first_period_y_s", period * described.get("period_ratio", 1.0))
    if {"first_period_y_s", "period_ratio"} <= described.keys():
        raise InputError(tell("first_period_y_s and period_ratio say the same: give one of them"))
    if any(key in described for key in TWISTS):
        return _twisting(name, described)
    both = [
        ShearBuilding(
            storeys=described["storeys"],
            first_period=each,
            damping=described.get("damping", 0.05),
            name=name,
        )
        for each in (period, across)
    ]
    shear = both[0]
    periods = tell("first period {period:g} s", period=period)
    if across != period:
        periods = tell(
            "first periods {along:g} s along x and {across:g} s across it",
            along=period,
            across=across,
        )
    told = tell(
        "linear shear building of {storeys} storeys, {periods}, damping {damping:g}",
        storeys=shear.storeys,
        periods=periods,
        damping=shear.damping,
    )
    return partial(floor_motions, shear, across=both[1]), told


def of_structure(
    path: Path,
    name: str,
    described: Mapping[str, Any],
    ground: Sequence[Motion],
    progress: Progress,
) -> Building:
    """A shear building of which only structure and height are known, with those that it may be.

    Args:
        path, name, described, ground, progress: as for `building`.

    Raises:
        InputError: likewise.
    """
    try:
        structure, storeys = described["structure"], described["storeys"]
        height = described.get("storey_height_m", STOREY_HEIGHT)
        typical = typical_period(structure, storeys, height)
    except InputError as error:
        raise refused(path, str(error)) from None
    rest = {key: value for key, value in described.items() if key != "structure"}
    variants = {}
    for share in VARIED:
        period = float(f"{share * typical:.3g}")
        given = {**rest, "first_period_s": period}
        variants[f"{period:.2g} s"] = building(path, name, given, ground, progress, by_shear)
    usual = variants[f"{float(f'{typical:.3g}'):.2g} s"]
    told = tell(
        "{structure}, whose first period is not known: {typical:.2g} s are typical ({source}), and "
        "{periods} are usual; {told}",
        structure=translated(structure),
        typical=typical,
        source=SOURCE,
        periods=", ".join(variants),
        told=usual.told,
    )
    return replace(usual, told=told, variants=variants)


def _twisting(name: str, described: Mapping[str, Any]) -> tuple[Floors, str]:
    """The floors above the ground of a building that sways and twists."""
    if "first_period_y_s" in described or "period_ratio" in described:
        raise InputError(tell("a building that twists has one first_period_s, that of sway"))
    lengths = {}
    for key, default in (("plan_m", None), ("eccentricity", [0.0, 0.0])):
        given = described.get(key, default)
        if not isinstance(given, list) or len(given) != 2:
            raise InputError(
                tell(
                    "{key}: expected two numbers, along x and y, found {given!r}",
                    key=key,
                    given=given,
                )
            )
        lengths[key] = (given[0], given[1])
    twisting = TorsionalBuilding(
        storeys=described["storeys"],
        first_period=described["first_period_s"],
        plan=lengths["plan_m"],
        eccentricity=lengths["eccentricity"],
        torsional_ratio=described.get("torsional_ratio", 1.2),
        damping=described.get("damping", 0.05),
        name=name,
    )
    e_x, e_y = twisting.eccentricity
    told = tell(
        "linear building of {storeys} storeys that twist, first period {period:g} s, damping "
        "{damping:g}, centre of stiffness {x:g} and {y:g} of the plan off its centre; at the "
        "corner farthest from that",
        storeys=twisting.storeys,
        period=twisting.first_period,
        damping=twisting.damping,
        x=e_x,
        y=e_y,
    )
    return partial(corner_motions, twisting), told


def by_profile(name: str, described: Mapping[str, Any]) -> tuple[Floors, str]:
    """The floors above the ground by a code's profile, and what it is in words."""
    if described["profile"] not in PROFILES:
        raise InputError(
            tell(
                "profile: accepted is {accepted}, found {found!r}",
                accepted=", ".join(PROFILES),
                found=described["profile"],
            )
        )
    if "storeys" not in described:
        raise InputError(tell("a profile needs storeys"))
    profile = FloorProfile(
        storeys=described["storeys"],
        period=described.get("first_period_s"),
        name=name,
        **{key: described[key] for key in FACTORS if key in described},
    )
    told = tell(
        "building of {storeys} storeys by the profile of ASCE 7-22, whose roof is shaken "
        "{factor:.2f} times as strongly as the ground, at the same periods",
        storeys=profile.storeys,
        factor=profile.factors()[-1],
    )
    return partial(profile_motions, profile), told


def _in_words(given: str | list[str]) -> str:
    """Names of suites, folders and files as they are printed."""
    return given if isinstance(given, str) else named(given, MOST_NAMED)
