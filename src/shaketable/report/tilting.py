"""A designed tilt in words, and as a record for programs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C2,
    outside_of_scor,
    slide_acceleration,
    uplift_acceleration,
)
from shaketable.report.words import counted, in_hundred, tilt_interval
from shaketable.support import Support
from shaketable.tilting import FEWEST_FALLS, SLIDES, TiltDesign, TiltEffect, shim_height
from shaketable.units import STANDARD_GRAVITY, degrees


def wanted_lines(design: TiltDesign) -> list[str]:
    """The tilt by the two curves and by simulation."""
    wanted = f"{100 * design.control:g} %"
    low, high = (degrees(end) for end in design.curves.tilt_interval)
    if math.isfinite(design.curves.tilt):
        simulated = (
            f"{degrees(design.curves.tilt):.1f}° ({tilt_interval(low, high)}, 95 % interval)"
        )
    elif math.isinf(design.curves.tilt):
        simulated = f"none up to {degrees(design.curves.tilts[-1]):g}°"
    else:
        simulated = f"too few falls to tell: at least {FEWEST_FALLS} are needed"
    return [
        f"Tilt from which on {wanted} of the falls of {design.body.name or 'the body'} go downhill",
        f"  GCOR, any body           {_curve(design.gcor_tilt)}",
        f"  SCOR, a body like this   {_curve(design.scor_tilt)}",
        f"  simulated                {simulated}, {counted(design.motions, 'motion')} of "
        f"{counted(design.recordings, 'recording')} in both directions",
    ]


def _curve(tilt: float) -> str:
    if math.isnan(tilt):
        return "no curve: its c1 is not positive for a body so large"
    if math.isinf(tilt):
        return f"none: the curve ends at {100 * (0.5 + C2):g} %"
    return f"{degrees(tilt):.1f}°"


def warnings_of(body: Body) -> list[str]:
    """What the curves were not made for."""
    faults = outside_of_scor(body.width, 2 * body.cg_height)
    if not math.isclose(body.left, body.width / 2):
        faults.append("its centre of gravity is off centre, which neither curve knows")
    return [f"SCOR is a fit to other bodies: {'; '.join(faults)}"] if faults else []


def level_lines(level: TiltEffect) -> list[str]:
    """What happens without a tilt."""
    share = "" if math.isnan(level.control) else f", {100 * level.control:.0f} % of them downhill"
    return [
        "On a level support",
        _falls(level) + share,
        *_sliding(level),
    ]


def effect_lines(effect: TiltEffect, lengths: dict[str, float]) -> list[str]:
    """What a tilt does; `lengths` [m] by what they are of are raised by so much."""
    raised = ", ".join(
        f"{1000 * shim_height(length, effect.tilt):.0f} mm over {name} of {length:g} m"
        for name, length in lengths.items()
    )
    lines = [f"On a support tilted by {degrees(effect.tilt):.1f}° (raised by {raised})"]
    if math.isnan(effect.control):
        lines.append(
            f"  downhill                 too few falls to tell: {effect.falls} of "
            f"{effect.simulations} simulations"
        )
    else:
        lines.append(
            f"  downhill                 {100 * effect.control:.0f} % of {effect.falls} falls "
            f"(binomial {_range(effect.control_binomial)}, over recordings "
            f"{_range(effect.control_interval)})"
        )
    lines.append(
        f"    by the curves          GCOR {100 * effect.gcor:.0f} %, SCOR "
        + ("none" if math.isnan(effect.scor) else f"{100 * effect.scor:.0f} %")
    )
    lines.append(_falls(effect) + _likelier(effect))
    return lines + _sliding(effect)


def _falls(effect: TiltEffect) -> str:
    if effect.falls == 0:
        return f"  falls                    in none of {effect.simulations} simulations"
    return (
        f"  falls                    {in_hundred(effect.fall_share)} of 100 shakings "
        f"({_range(effect.fall_share_interval)})"
    )


def _sliding(effect: TiltEffect) -> list[str]:
    if math.isnan(effect.slides_share):
        return []
    return [
        f"  slides                   {in_hundred(effect.slides_share)} of 100 shakings: stays "
        f"upright and slides more than {100 * SLIDES:g} cm"
    ]


def _likelier(effect: TiltEffect) -> str:
    if effect.tilt == 0.0 or not math.isfinite(effect.likelier):
        return ""
    low, high = effect.likelier_interval
    upper = f"to {high:.2f}" if math.isfinite(high) else "and more"
    return f", {effect.likelier:.2f} times as often as without a tilt ({low:.2f} {upper})"


def _range(ends: Sequence[float]) -> str:
    return f"{100 * ends[0]:.0f} to {100 * ends[1]:.0f} %"


def friction_lines(body: Body, tilts: Sequence[float], support: Support) -> list[str]:
    """When it slides: on its own, and before it rocks (eqs. 1, 3 and 4)."""
    needed = max(math.tan(body.slenderness_left), math.tan(body.slenderness_right))
    lines = [
        "Friction",
        f"  rocks, not slides        where static friction is above {needed:.2f}, tilted or not",
    ]
    for tilt in tilts:
        if tilt > 0.0:
            lines.append(
                f"  stays by itself          at {degrees(tilt):.1f}° where it is above "
                f"{math.tan(tilt):.2f}"
            )
    if math.isfinite(support.static_friction):
        for tilt in [0.0, *(t for t in tilts if t > 0.0)]:
            slides = float(slide_acceleration(support.static_friction, tilt)[0])
            rocks = float(uplift_acceleration(body, tilt)[0])
            first = "slides" if slides < rocks else "rocks"
            lines.append(
                f"  with {support.static_friction:<5g}               at {degrees(tilt):.1f}° it "
                f"{first} downhill first, from {min(slides, rocks) / STANDARD_GRAVITY:.2f} g on"
            )
    return lines


def as_record(
    design: TiltDesign | None,
    level: TiltEffect,
    effects: Sequence[TiltEffect],
    lengths: dict[str, float],
) -> dict[str, Any]:
    """All of it in plain numbers: tilts in degrees, lengths in metres, null for none."""
    record: dict[str, Any] = {
        "level": _effect_record(level, lengths),
        "effects": [_effect_record(effect, lengths) for effect in effects],
    }
    if design is not None:
        record |= {
            "control": design.control,
            "motions": design.motions,
            "recordings": design.recordings,
            "tilt_deg": _number(degrees(design.curves.tilt)),
            "tilt_interval_deg": [_number(degrees(end)) for end in design.curves.tilt_interval],
            "gcor_tilt_deg": _number(degrees(design.gcor_tilt)),
            "scor_tilt_deg": _number(degrees(design.scor_tilt)),
        }
    return record


def _effect_record(effect: TiltEffect, lengths: dict[str, float]) -> dict[str, Any]:
    plain = {
        key: [_number(end) for end in value] if isinstance(value, tuple) else _number(value)
        for key, value in asdict(effect).items()
        if key != "tilt"
    }
    raised = {name: shim_height(length, effect.tilt) for name, length in lengths.items()}
    return {"tilt_deg": degrees(effect.tilt), "raised_m": raised, **plain}


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
