"""`shaketable criteria`: what the simple criteria say about an object."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.levels import STRONGEST
from shaketable.cli.options import (
    BaseM,
    Eccentricity,
    HeightM,
    ReadingOptions,
    Scale,
    warn_of_sizes,
)
from shaketable.cli.shaking import require_used
from shaketable.errors import InputError, require_positive
from shaketable.records import read_motion
from shaketable.records.plausible import LOUDEST
from shaketable.units import CM, STANDARD_GRAVITY

FASTEST = 100.0  # m/s: no ground and no floor has moved a tenth as fast

log = logging.getLogger(__name__)


def criteria(
    *,
    base_m: BaseM,
    height_m: HeightM,
    pga_g: Annotated[float | None, typer.Option(help="Peak ground acceleration [g].")] = None,
    pgv_cm_s: Annotated[float | None, typer.Option(help="Peak ground velocity [cm/s].")] = None,
    record: Annotated[
        Path | None, typer.Option(help="Record to take both from, instead of giving them.")
    ] = None,
    component: Annotated[
        str | None,
        typer.Option(help="Horizontal component of the record: a code, an azimuth or channel 3."),
    ] = None,
    vertical: Annotated[
        str | None,
        typer.Option(help="File with its vertical component; auto: same file or one beside it."),
    ] = None,
    scale: Scale = 1.0,
    eccentricity: Eccentricity = 0.5,
    reading: ReadingOptions,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> None:
    """Evaluate published overturning criteria for one object and two peaks of a motion.

    A margin is the limit over the demand; above 1 the criterion says that the object stands. For
    records with a permanent displacement, the velocity is that of the corrected record.
    """
    from shaketable.criteria.overturning import verdicts
    from shaketable.demand import largest_demand
    from shaketable.report.criteria import (
        as_record,
        body_lines,
        bottom_line,
        demand_lines,
        floor_lines,
        verdict_lines,
    )
    from shaketable.signal import peaks
    from shaketable.simulate import simulate

    require_positive("--scale", scale)
    body = Body.rectangle(base_m, height_m, eccentricity=eccentricity)
    warn_of_sizes({"--base-m": base_m, "--height-m": height_m})
    least_weight, rocks_with = None, None
    if record is not None:
        if pga_g is not None or pgv_cm_s is not None:
            raise InputError("--record: gives the PGA and the PGV; leave out --pga-g, --pgv-cm-s")
        require_used([str(record)], **reading.as_read)
        motion = read_motion(
            record,
            component=component,
            vertical=vertical,
            **reading.as_read,
        ).scaled(scale)
        found = peaks(motion)
        pga, pgv = found.acceleration, found.velocity
        if motion.vertical is not None:
            least_weight = STANDARD_GRAVITY + float(motion.vertical.min())
        rocks_with = largest_demand(simulate(body, motion))
        source = f"{motion.name}{', baseline corrected' if found.corrected else ''}"
    else:
        given = {
            "--component": component, "--vertical": vertical, "--units": reading.units,
            "--time-step-s": reading.time_step_s,
        }  # fmt: skip
        of_record = [option for option, value in given.items() if value is not None]
        if of_record:
            raise InputError(f"{', '.join(of_record)}: for a --record; leave it out, or give one")
        if pga_g is None or pgv_cm_s is None:
            raise InputError("give both --pga-g and --pgv-cm-s, or a --record to take them from")
        pga, pgv = scale * pga_g * STANDARD_GRAVITY, scale * pgv_cm_s * CM
        for name, value, most, unit in (
            ("--pga-g", pga, LOUDEST, STANDARD_GRAVITY),
            ("--pgv-cm-s", pgv, FASTEST, CM),
        ):
            if not 0.0 <= value <= most:
                raise InputError(
                    f"{name} must be between 0 and {most / unit:g}, times --scale: no ground and "
                    f"no floor exceeds that; got {value / unit:g}"
                )
        if pga > STRONGEST:
            log.warning(
                "a PGA of %.3g g is stronger than any ground ever shook: is it in m/s²?",
                pga / STANDARD_GRAVITY,
            )
        source = "as given"
    said = verdicts(body, pga, pgv)
    if as_json:
        told = {"source": source, **as_record(body, pga, pgv, said)}
        if rocks_with is not None:
            told["friction_while_rocking"] = rocks_with
        say(json.dumps(told))
        return
    lines = [
        f"{base_m:g} m × {height_m:g} m, eccentricity {eccentricity:g}, under PGA "
        f"{pga / STANDARD_GRAVITY:.3g} g and PGV {pgv / CM:.3g} cm/s ({source})",
        *verdict_lines(said),
        *floor_lines(base_m, height_m, pga, pgv),
        *body_lines(body, pga, least_weight),
        *demand_lines(rocks_with),
        *bottom_line(body, pga, pgv, height_m, said),
    ]
    say("\n".join(lines))
