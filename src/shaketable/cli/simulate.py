"""`shaketable simulate`: one object under one motion."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.options import (
    AzimuthDeg,
    ContactOfShapeOptions,
    ContourFrictionM,
    DepthM,
    DrillingFrictionM,
    Eccentricity,
    HeightM,
    OrientationDeg,
    ReadingOptions,
    RollingFrictionM,
    Scale,
    ShapeName,
    TiltDeg,
    WidthM,
    warn_of_sizes,
)
from shaketable.cli.response_summary import sentence_of, summary_of
from shaketable.cli.shaking import DEFAULT_MOTION, motion_of
from shaketable.cli.solids import Losses, require_plane, solid_from
from shaketable.cli.surroundings import SurroundingOptions
from shaketable.errors import InputError
from shaketable.response import Response
from shaketable.simulate import simulate as simulate_one
from shaketable.support import Support
from shaketable.units import radians


def simulate(
    *,
    width_m: WidthM,
    height_m: HeightM,
    record: Annotated[
        str,
        typer.Option(
            help="Record of the horizontal acceleration: a file, or the name of a motion of the "
            "suites."
        ),
    ] = DEFAULT_MOTION,
    component: Annotated[
        str | None,
        typer.Option(help="Horizontal component of the record: a code, an azimuth, or channel 3."),
    ] = None,
    vertical: Annotated[
        str | None,
        typer.Option(
            help="Record of the vertical acceleration; auto: from the same file, or beside it."
        ),
    ] = None,
    components: Annotated[
        int | None,
        typer.Option(
            help="1: one horizontal component; 2: both, by their azimuths; 3: the vertical one, "
            "too. [1, or in three dimensions 2]"
        ),
    ] = None,
    scale: Scale = 1.0,
    depth_m: DepthM = None,
    shape: ShapeName = None,
    orientation_deg: OrientationDeg = None,
    rolling_friction_m: RollingFrictionM = None,
    contour_friction_m: ContourFrictionM = None,
    drilling_friction_m: DrillingFrictionM = None,
    tilt_deg: TiltDeg = 0.0,
    azimuth_deg: AzimuthDeg = None,
    eccentricity: Eccentricity = 0.5,
    contact_options: ContactOfShapeOptions,
    surrounding: SurroundingOptions,
    reading: ReadingOptions,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
    plot: Annotated[Path | None, typer.Option(help="Write a picture of the history.")] = None,
    animate: Annotated[
        Path | None,
        typer.Option(
            help="Write a film: .gif or .mp4; in three dimensions also .glb, a scene for viewers."
        ),
    ] = None,
) -> None:
    """Simulate one object under one motion: a rectangle in a plane, a box or a cylinder."""
    from shaketable import plot as pictures

    losses = Losses(rolling_friction_m, contour_friction_m, drilling_friction_m)
    solid = solid_from(width_m, depth_m, height_m, shape, eccentricity, losses)
    if solid is not None and surrounding.mass_kg is not None:
        solid = replace(solid, mass=surrounding.mass_kg)
    if plot is not None:
        pictures.require_picture(plot)
    if animate is not None:
        (pictures.require_film if solid is None else pictures.require_film_or_scene)(animate)
    for picture in (plot, animate):
        if picture is not None and picture.resolve() == Path(record).resolve():
            raise InputError(f"{picture}: is the record; give the picture another name")
    if solid is None:
        require_plane({"--azimuth-deg": azimuth_deg, "--orientation-deg": orientation_deg})
    contact = contact_options.contact(solid is not None)
    warn_of_sizes(width_m, height_m)
    motion = motion_of(
        record,
        component=component,
        components=(1 if solid is None else 2) if components is None else components,
        vertical=vertical,
        units=reading.units,
        time_step=reading.time_step_s,
    ).scaled(scale)
    response: Response
    name = f"{width_m:g} m × {height_m:g} m" if solid is None else solid.name
    if solid is None:
        body = Body.rectangle(
            width_m, height_m, eccentricity=eccentricity, name=name, mass=surrounding.mass_kg
        )
        response = simulate_one(
            body,
            motion,
            Support(tilt=radians(tilt_deg)),
            model=contact,
            surroundings=surrounding.around(body, vertical=contact.slides),
        )
    else:
        support = Support(
            tilt=radians(tilt_deg), azimuth=radians(180.0 if azimuth_deg is None else azimuth_deg)
        )
        turned = radians(orientation_deg or 0.0)
        response = simulate_one(
            solid,
            motion,
            support,
            model=contact,
            orientation=turned,
            surroundings=surrounding.around(solid, turned),
        )
    if plot is not None:
        pictures.save(response.plot()[0], plot)
    if animate is not None:
        response.animate(animate)
    if as_json:
        say(json.dumps(summary_of(response)))
    else:
        say(f"{name} under {motion.name}: {sentence_of(response)}")
