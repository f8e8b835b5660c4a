"""`shaketable simulate`: one object under one motion."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any

import typer

from shaketable.body import Body
from shaketable.cli.options import (
    Eccentricity,
    HeightM,
    KineticFriction,
    ModelName,
    ModelWord,
    NormalRestitution,
    RestitutionFactor,
    Scale,
    StaticFriction,
    TiltDeg,
    TimeStep,
    Units,
    WidthM,
    model_from,
    warn_of_sizes,
)
from shaketable.cli.tell import say
from shaketable.errors import InputError
from shaketable.outcome import outcome_name
from shaketable.records import read_motion
from shaketable.response import Response
from shaketable.simulate import simulate as simulate_one
from shaketable.support import Support
from shaketable.units import radians

NOTHING = 1e-6  # m: a smaller slip or lift counts as none


def simulate(
    width_m: WidthM,
    height_m: HeightM,
    record: Annotated[Path, typer.Option(help="Record of the horizontal acceleration.")],
    component: Annotated[
        str | None,
        typer.Option(help="Which horizontal component of the record: code, azimuth, channel 3."),
    ] = None,
    vertical: Annotated[
        str | None,
        typer.Option(
            help="Record of the vertical acceleration; auto: from the same file, or beside it."
        ),
    ] = None,
    scale: Scale = 1.0,
    tilt_deg: TiltDeg = 0.0,
    eccentricity: Eccentricity = 0.5,
    model: ModelName = ModelWord.ROCKING,
    static_friction: StaticFriction = None,
    kinetic_friction: KineticFriction = None,
    normal_restitution: NormalRestitution = 0.0,
    restitution_factor: RestitutionFactor = 1.0,
    units: Units = None,
    time_step_s: TimeStep = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
    plot: Annotated[Path | None, typer.Option(help="Write a picture of the history.")] = None,
    animate: Annotated[Path | None, typer.Option(help="Write a film: .gif or .mp4.")] = None,
) -> None:
    """One rectangular object under one recorded motion."""
    from shaketable import plot as pictures

    if plot is not None:
        pictures.require_picture(plot)
    if animate is not None:
        pictures.require_film(animate)
    for picture in (plot, animate):
        if picture is not None and picture.resolve() == record.resolve():
            raise InputError(f"{picture}: is the record; give the picture another name")
    support = Support(tilt=radians(tilt_deg))
    contact = model_from(
        model, static_friction, kinetic_friction, normal_restitution, restitution_factor
    )
    body = Body.rectangle(
        width_m, height_m, eccentricity=eccentricity, name=f"{width_m:g} m × {height_m:g} m"
    )
    warn_of_sizes(width_m, height_m)
    motion = read_motion(
        record,
        component=component,
        vertical=vertical,
        units=units,
        time_step=time_step_s,
    )
    response = simulate_one(body, motion.scaled(scale), support, model=contact)
    if plot is not None:
        pictures.save(response.plot()[0], plot)
    if animate is not None:
        response.animate(animate)
    if as_json:
        say(json.dumps(_summary(response)))
    else:
        say(f"{body.name} under {motion.name}: {_sentence(response)}")


def _summary(response: Response) -> dict[str, Any]:
    fell = not math.isnan(response.overturning_time)
    summary: dict[str, Any] = {
        "outcome": response.outcome.name.lower(),
        "overturning_time_s": response.overturning_time if fell else None,
        "peak_rotation_rad": response.peak_rotation,
        "impacts": response.impacts,
    }
    if response.model.slides:
        summary |= {
            "slip_m": float(response.slip[-1]),
            "peak_slip_m": response.peak_slip,
            "max_lift_m": response.max_lift,
            "phases": [
                {"start_s": float(start), "phase": phase.name.lower()}
                for start, phase in zip(response.phase_times, response.phases, strict=True)
            ],
        }
    return summary


def _sentence(response: Response) -> str:
    """What happened, in words."""
    peak = math.degrees(response.peak_rotation)
    if not math.isnan(response.overturning_time):
        way = outcome_name(response.outcome, response.support.tilt)
        when = response.overturning_time
        said = f"overturns {way} at {when:.3f} s, after {response.impacts} impacts"
    else:
        rocks = f"rocks by at most {peak:.3g}°, with {response.impacts} impacts"
        said = f"stands; it {rocks if response.peak_rotation > 0.0 else 'does not rock'}"
    if response.peak_slip > NOTHING:
        end = float(response.slip[-1])
        said += f"; it slides by up to {1e3 * response.peak_slip:.3g} mm"
        if math.isnan(response.overturning_time):
            side = "+x" if end > 0 else "-x"
            where = f"{1e3 * abs(end):.3g} mm toward {side}" if abs(end) > NOTHING else "in place"
            said += f" and ends {where}"
    if response.max_lift > NOTHING:
        said += f"; it jumps by up to {1e3 * response.max_lift:.3g} mm"
    return said
