"""`shaketable tilt`: the tilt that chooses the side on which an object falls."""

from __future__ import annotations

import json
import logging
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.console import say
from shaketable.cli.object_options import ObjectOptions, require_plane
from shaketable.cli.options import (
    ContactOfShapeOptions,
    Scale,
)
from shaketable.cli.shaking import MotionOptions
from shaketable.errors import InputError, require_positive
from shaketable.motion import Motion
from shaketable.records import DEFAULT_SUITE
from shaketable.records.pairs import pairs_among
from shaketable.solid import Solid
from shaketable.tilting import CONTROL, TiltDesign, TiltEffect
from shaketable.units import radians

log = logging.getLogger(__name__)


def tilt(
    *,
    thing: ObjectOptions,
    downhill_share: Annotated[
        float | None,
        typer.Option(
            help="Wanted share of the falls that go downhill; asks for the tilt. "
            f"[{CONTROL} without --tilt-deg]"
        ),
    ] = None,
    tilt_deg: Annotated[
        float | None, typer.Option(help="A tilt [degrees]; asks for the share that it gives.")
    ] = None,
    shelf_depth_m: Annotated[
        float | None, typer.Option(help="Depth of the shelf [m], for the height of its wedge.")
    ] = None,
    azimuth_deg: Annotated[
        float | None,
        typer.Option(
            help="Which way the support is tilted, seen from the object: downhill from its +x "
            "toward its +y [degrees], in three dimensions. [180: to its front]"
        ),
    ] = None,
    motion_options: MotionOptions,
    building: Annotated[
        Path | None,
        typer.Option(
            help="TOML file of a building: the tilt on each of its floors, under its recorded "
            "floor motions or as a linear shear building under --motions."
        ),
    ] = None,
    scale: Scale = 1.0,
    contact_options: ContactOfShapeOptions,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the bootstrap.")] = 0,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
    plot: Annotated[
        Path | None, typer.Option(help="Write a picture, with --downhill-share.")
    ] = None,
) -> None:
    """Find the tilt of a support that sends an object's falls to one side.

    A tilted object falls more often; that is told as well.

    By the curves GCOR and SCOR of Boroschek and Iruretagoyena (2006) and by simulation. The base
    is measured along the tilt: from the front of a shelf to its back. With --depth-m and --width-m,
    or --shape cylinder, the object is simulated in three dimensions, under both horizontal
    components at once.
    """
    from shaketable import plot as pictures
    from shaketable.report import tilting as words
    from shaketable.tilting import design_tilt, tilt_effect
    from shaketable.tilting.design import stand_of

    if downhill_share is None and tilt_deg is None:
        downhill_share = CONTROL
    if plot is not None:
        if downhill_share is None:
            raise InputError(
                "--plot: draws the tilt for a wanted share; give --downhill-share as well"
            )
        pictures.require_picture(plot)
    if building is not None and plot is not None:
        raise InputError("--plot: draws one support; leave --building out")
    body = thing.object()
    in_space = isinstance(body, Solid)
    if not in_space:
        require_plane({"--azimuth-deg": azimuth_deg})
    elif building is not None:
        raise InputError("--building: its floors have one component; give --base-m alone")
    lengths = {"base": 0.0}  # of its section, once it is known
    if shelf_depth_m is not None:
        require_positive("--shelf-depth-m", shelf_depth_m)
        lengths["shelf"] = shelf_depth_m
    contact = contact_options.contact(in_space)
    azimuth = radians(180.0 if azimuth_deg is None else azimuth_deg)
    floors, description = _floors(building, motion_options, in_space)
    section = stand_of(body, next(iter(floors.values())), azimuth, scale, contact).body
    lengths["base"] = section.base
    found = []
    designs: dict[str, TiltDesign | None] = {}
    at_given: dict[str, TiltEffect | None] = {}
    for floor, shaking in floors.items():
        shaken = partial(
            tilt_effect, body, shaking, azimuth=azimuth, scale=scale, model=contact, seed=seed
        )
        asked = None if tilt_deg is None else shaken(radians(tilt_deg))
        design = None
        if downhill_share is not None:
            design = design_tilt(
                body, shaking, control=downhill_share, azimuth=azimuth, scale=scale, model=contact,
                seed=seed,
            )  # fmt: skip
        level = design.level if design else shaken(0.0)
        designs[floor], at_given[floor] = design, asked
        warnings = words.warnings_of(section, design, not in_space)
        for warning in warnings:
            log.warning("%s", warning)  # the same on every floor, and told once
        if design is not None and plot is not None:
            pictures.save(pictures.plot_tilt(design)[0], plot)
        if as_json:
            found.append(
                {"floor": floor, **words.as_record(design, level, asked, lengths, warnings)}
            )
            continue
        designed = design.effect if design else None
        effects = [effect for effect in (designed, asked) if effect is not None]
        if floor:
            say(f"Floor {floor}" if not found else f"\nFloor {floor}")
        found.append({})
        say("\n".join(words.tilt_lines(section, contact, design, level, effects, lengths)))
    if len(floors) > 1 and not as_json:
        say("\n" + "\n".join(words.building_lines(designs, at_given)))
    if as_json:
        settings = {
            **thing.settings,
            "azimuth_deg": azimuth_deg,
            "motions": description,
            "building": building and str(building),
            "vertical": motion_options.vertical,
            "scale": scale,
            **asdict(contact_options),
            "model": contact_options.word(in_space).value,
            "seed": seed,
        }
        if building is None:
            found[0].pop("floor")
            say(json.dumps({"settings": settings, **found[0]}))
        else:
            say(json.dumps({"settings": settings, "floors": found}))


def _floors(
    building: Path | None,
    given: MotionOptions,
    in_pairs: bool,
) -> tuple[dict[str, list[Motion]], str]:
    """The motions of each floor, by its name, and what to call them; "" is the ground alone.

    Motions in pairs are those of which both components are known, or all if there is none.
    """
    from shaketable.building import read_building

    shaking = given.load(() if building else (DEFAULT_SUITE,))
    if building is None:
        assert shaking is not None
        if in_pairs:
            return {"": pairs_among(shaking.motions) or shaking.motions}, shaking.description
        return {"": shaking.motions}, shaking.description
    house = read_building(building, shaking.motions if shaking else (), progress=True)
    if in_pairs:
        floors = {
            label: [motion for motion in found if motion.transverse is not None] or list(found)
            for label, found in house.floors.items()
        }
    else:
        floors = {label: list(found) for label, found in house.in_components().floors.items()}
    return floors, f"{house.name}: {house.told}"
