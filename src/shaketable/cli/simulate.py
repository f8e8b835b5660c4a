"""`shaketable simulate`: one object under one motion."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.object_options import ObjectOptions, require_plane
from shaketable.cli.options import (
    AzimuthDeg,
    ContactOfShapeOptions,
    OrientationDeg,
    ReadingOptions,
    Scale,
    TiltDeg,
)
from shaketable.cli.response_summary import sentence_of, summary_of
from shaketable.cli.shaking import DEFAULT_MOTION, motion_of
from shaketable.cli.surroundings import SurroundingOptions
from shaketable.errors import InputError
from shaketable.response import Response
from shaketable.simulate import simulate as simulate_one
from shaketable.solid import Solid
from shaketable.support import Support
from shaketable.units import radians


def simulate(
    *,
    thing: ObjectOptions,
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
    orientation_deg: OrientationDeg = None,
    tilt_deg: TiltDeg = 0.0,
    azimuth_deg: AzimuthDeg = None,
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

    body = thing.object(surrounding.mass_kg)
    in_space = isinstance(body, Solid)
    if plot is not None:
        pictures.require_picture(plot)
    if animate is not None:
        (pictures.require_film_or_scene if in_space else pictures.require_film)(animate)
    for picture in (plot, animate):
        if picture is not None and picture.resolve() == Path(record).resolve():
            raise InputError(f"{picture}: is the record; give the picture another name")
    if not in_space:
        require_plane({"--azimuth-deg": azimuth_deg, "--orientation-deg": orientation_deg})
    if azimuth_deg is not None and tilt_deg == 0.0:
        raise InputError("--azimuth-deg: of a tilted support; give --tilt-deg, or leave it out")
    contact = contact_options.contact(in_space)
    motion = motion_of(
        record,
        component=component,
        components=(2 if in_space else 1) if components is None else components,
        vertical=vertical,
        units=reading.units,
        time_step=reading.time_step_s,
    ).scaled(scale)
    response: Response
    if isinstance(body, Body):
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
            body,
            motion,
            support,
            model=contact,
            orientation=turned,
            surroundings=surrounding.around(body, turned),
        )
    if plot is not None:
        pictures.save(response.plot()[0], plot)
    if animate is not None:
        response.animate(animate)
    if as_json:
        say(json.dumps(summary_of(response)))
    else:
        say(f"{body.name} under {motion.name}: {sentence_of(response)}")
