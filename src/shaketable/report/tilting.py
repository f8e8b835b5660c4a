"""A designed tilt in words, and as a record for programs."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from shaketable.assess import Share
from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C2,
    outside_of_scor,
    slide_acceleration,
    uplift_acceleration,
)
from shaketable.models import Model
from shaketable.outcome import side_names
from shaketable.report.words.numbers import (
    counted,
    in_hundred,
    likely,
    limits_in_hundred,
    tilt_degrees,
    tilt_interval,
)
from shaketable.tilting import FEWEST_FALLS, SLIDES, TiltDesign, TiltEffect, shim_height
from shaketable.units import STANDARD_GRAVITY, degrees

ENOUGH = 1.0  # expected falls uphill: with fewer, control cannot be told


def tilt_lines(
    body: Body,
    model: Model,
    design: TiltDesign | None,
    level: TiltEffect,
    effects: Sequence[TiltEffect],
    lengths: Mapping[str, float],
) -> list[str]:
    """All that is known about a body's tilts, in lines.

    Args:
        body, model: what is shaken, and how it may move.
        design: the designed tilt, if one was asked for.
        level, effects: what happens without a tilt, and at the tilts of interest.
        lengths: length [m] of each thing that is raised, by its name.
    """
    lines = _wanted(design) if design else []
    lines += ["On a level support", _falls(level) + _split(level, body), *_sliding(level)]
    for effect in effects:
        lines += _effect(effect, lengths)
    return [*lines, *_friction(body, [effect.tilt for effect in effects], model)]


def _line(label: str, text: str) -> str:
    return f"  {label:<25}{text}"


def _wanted(design: TiltDesign) -> list[str]:
    """The tilt by the two curves and by simulation."""
    curves = design.curves
    if math.isfinite(curves.control_tilt):
        simulated = f"{tilt_degrees(curves.control_tilt)} ({tilt_interval(curves)})"
    elif curves.tilts.size == 1:
        simulated = "it does not stand on any tilt tried"
    elif math.isinf(curves.control_tilt):
        simulated = f"none up to {degrees(curves.tilts[-1]):g}°, a tilt does not choose the side"
    else:
        simulated = (
            f"too few falls to tell (at least {FEWEST_FALLS} at a tilt are needed): use stronger "
            "or more motions (--scale, --motions)"
        )
    falls_at = design.body.slenderness_left
    in_space = design.turns > 1
    gcor, scor = ("in a plane",) * 2 if in_space else ("any body", "by its size")
    return [
        f"Tilt from which on {100 * design.control:g} % of the falls of "
        f"{design.body.name or 'the body'} go downhill",
        _line(f"GCOR, {gcor}", _curve(design.gcor_tilt, falls_at)),
        _line(f"SCOR, {scor}", _curve(design.scor_tilt, falls_at) + _fitted_to(design.body)),
        _line(
            "simulated",
            f"{simulated}; {counted(design.motion_count, 'motion')} of "
            f"{counted(design.recording_count, 'recording')} in both directions{_turned(design)}",
        ),
    ]


def _turned(design: TiltDesign) -> str:
    return f", the object turned to them in {design.turns} ways" if design.turns > 1 else ""


def _fitted_to(body: Body) -> str:
    return "; fitted to other bodies" if outside_of_scor(body.base, 2 * body.cg_height) else ""


def building_lines(
    designs: Mapping[str, TiltDesign | None], asked: Mapping[str, TiltEffect | None]
) -> list[str]:
    """What holds on all floors of a building together, in lines.

    Args:
        designs: the designed tilt of each floor, if one was asked for.
        asked: what a given tilt does on each floor, if one was given.
    """
    lines = []
    wanted = {floor: design for floor, design in designs.items() if design is not None}
    tilts = {
        floor: design.curves.control_tilt
        for floor, design in wanted.items()
        if not math.isnan(design.curves.control_tilt)
    }
    if tilts:
        control = f"{100 * next(iter(wanted.values())).control:g} %"
        worst, best = max(tilts, key=tilts.__getitem__), min(tilts, key=tilts.__getitem__)
        told = (
            f"from {tilt_degrees(tilts[best])} (floor {best}) to {tilt_degrees(tilts[worst])} "
            f"(floor {worst}); take the steepest"
        )
        if math.isinf(tilts[worst]):
            none = [floor for floor, tilt in tilts.items() if math.isinf(tilt)]
            told = f"there is none on floor {', '.join(none)}"
        lines.append(_line(f"tilt for {control}", told))
    for what, shares in (
        ("downhill", _known(asked, lambda effect: effect.downhill_share)),
        ("falls", _known(asked, lambda effect: effect.fall_share)),
    ):
        if shares:
            low, high = min(shares, key=shares.__getitem__), max(shares, key=shares.__getitem__)
            lines.append(
                _line(
                    f"{what} at {tilt_degrees(next(one.tilt for one in asked.values() if one))}",
                    f"from {100 * shares[low]:.0f} % (floor {low}) to {100 * shares[high]:.0f} % "
                    f"(floor {high})",
                )
            )
    few = [
        floor
        for floor in designs
        if (designs[floor] is not None and floor not in tilts)
        or ((effect := asked[floor]) is not None and math.isnan(effect.downhill_share))
    ]
    if few:
        lines.append(_line("too few falls to tell", f"on floor {', '.join(few)}"))
    return ["All floors", *lines]


def _known(
    asked: Mapping[str, TiltEffect | None], share: Callable[[TiltEffect], float]
) -> dict[str, float]:
    """A share on every floor on which it is known."""
    found = {floor: share(effect) for floor, effect in asked.items() if effect is not None}
    return {floor: value for floor, value in found.items() if not math.isnan(value)}


def _curve(tilt: float, falls_at: float) -> str:
    if math.isnan(tilt):
        return "no curve: its c1 is not positive for a body so large"
    if math.isinf(tilt):
        return f"none: the curve ends at {100 * (0.5 + C2):g} %"
    itself = f", but it falls by itself at {degrees(falls_at):.1f}°" if tilt >= falls_at else ""
    return f"{degrees(tilt):.1f}°{itself}"


def warnings_of(body: Body, design: TiltDesign | None, in_plane: bool = True) -> list[str]:
    """What the curves were not made for, and what the simulations cannot show."""
    said = []
    if not in_plane:
        said.append(
            "GCOR and SCOR are for shaking across one pair of edges: in three dimensions go by "
            "the simulated tilt alone"
        )
    beyond = outside_of_scor(body.base, 2 * body.cg_height)
    effect = design.effect if design else None
    if design and effect and effect.falls * (1.0 - design.control) < ENOUGH:
        said.append(
            f"{effect.falls} falls cannot show {100 * design.control:g} %: that takes about "
            f"{ENOUGH / (1.0 - design.control):.0f}; use more motions"
        )
    if beyond and in_plane:
        said.append(
            f"SCOR was fitted to other bodies ({'; '.join(beyond)}): go by the simulated tilt"
        )
    if in_plane and not math.isclose(body.left, body.base / 2):
        said.append(
            "GCOR and SCOR take the centre of gravity to be in the middle: go by the simulated tilt"
        )
    return said


def _effect(effect: TiltEffect, lengths: Mapping[str, float]) -> list[str]:
    """What a tilt does."""
    raised = ", ".join(
        f"{1000 * shim_height(length, effect.tilt):.0f} mm over the {name} of {length:.3g} m"
        for name, length in lengths.items()
    )
    if math.isnan(effect.downhill_share):
        toward = f"too few falls to tell: {effect.falls} of {effect.simulations} simulations"
    else:
        low, high = effect.downhill_interval
        over = "" if low == high else f", over recordings {_range(effect.downhill_interval)}"
        toward = (
            f"{100 * effect.downhill_share:.0f} % of {effect.falls} falls (95 % interval: binomial "
            f"{_range(effect.downhill_binomial)}, the recordings with falls as experiments{over})"
        )
    specific = "none" if math.isnan(effect.scor) else f"{100 * effect.scor:.0f} %"
    return [
        f"On a support tilted by {tilt_degrees(effect.tilt)} (raised by {raised})",
        _line("downhill", toward),
        *_straight(effect),
        _line("  by the curves", f"GCOR {100 * effect.gcor:.0f} %, SCOR {specific}"),
        _falls(effect) + _likelier(effect),
        *_sliding(effect),
    ]


def _straight(effect: TiltEffect) -> list[str]:
    """How many falls of a solid go nearly straight downhill."""
    if math.isnan(effect.straight_share):
        return []
    return [_line("  within 45° of it", f"{100 * effect.straight_share:.0f} % of the falls")]


def _split(level: TiltEffect, body: Body) -> str:
    """To which side it falls on a level support, where nothing is downhill."""
    if math.isnan(level.downhill_share):
        return ""
    in_plane = math.isnan(level.straight_share)
    if body.left == body.right:
        sides = "to the left as to the right" if in_plane else (
            "to the side that the tilt would lower as to the other"
        )  # fmt: skip
        return f", by symmetry as many {sides}"
    if not in_plane:
        return f", {100 * level.downhill_share:.0f} % of them to the side that the tilt would lower"
    return f", {100 * level.downhill_share:.0f} % of them to the {side_names(0.0)[0]}"


def _falls(effect: TiltEffect) -> str:
    if effect.falls == 0:
        most = limits_in_hundred(Share(0.0, *effect.fall_share_interval))[1]
        none = f"in none of {counted(effect.simulations, 'simulation')}"
        return _line("falls", f"{none} (the true share is below {most} in 100)")
    often = Share(effect.fall_share, *effect.fall_share_interval)
    return _line("falls", f"in {in_hundred(often.value)} of 100 shakings ({likely(often)})")


def _likelier(effect: TiltEffect) -> str:
    if effect.tilt == 0.0 or not math.isfinite(effect.likelier):
        return ""
    low, high = effect.likelier_interval
    upper = f"to {high:.2f}" if math.isfinite(high) else "and more"
    return f", {effect.likelier:.2f} times as often as without a tilt ({low:.2f} {upper})"


def _sliding(effect: TiltEffect) -> list[str]:
    if math.isnan(effect.slides_share):
        return []
    often = in_hundred(effect.slides_share)
    far = f"{100 * SLIDES:g} cm"
    text = f"in {often} of 100 shakings it stays upright but is moved by more than {far}"
    return [_line("slides", text)]


def _range(ends: Sequence[float]) -> str:
    low, high = limits_in_hundred(Share(math.nan, ends[0], ends[1]))
    return f"{low} to {high} %"


def _friction(body: Body, tilts: Sequence[float], model: Model) -> list[str]:
    """When it slides: by itself, and before it rocks (Boroschek and Iruretagoyena
    2006, eqs. 1, 3 and 4)."""
    needed = max(math.tan(body.slenderness_left), math.tan(body.slenderness_right))
    tilted = [tilt for tilt in tilts if tilt > 0.0]
    rocks = (
        f"before it slides, tilted or not, where static friction is above {_up(needed)} and the "
        "motion grows slowly; under jolts it may do both"
    )
    lines = ["Friction", _line("begins to rock", rocks)]
    lines += [
        _line("stays by itself", f"at {tilt_degrees(tilt)} where it is above {_up(math.tan(tilt))}")
        for tilt in tilted
    ]
    if model.rest_limit < math.pi / 2:  # a friction that is known, and not infinite
        friction = math.tan(model.rest_limit)
        lines += [_first(body, tilt, friction) for tilt in [0.0, *tilted]]
    return lines


def _up(friction: float) -> str:
    """A friction, rounded up so that it is enough."""
    return f"{math.ceil(100 * friction) / 100:.2f}"


def _first(body: Body, tilt: float, friction: float) -> str:
    """Whether it slides or rocks downhill first."""
    slides = float(slide_acceleration(friction, tilt)[0])
    rocks = float(uplift_acceleration(body, tilt)[0])
    does = "slides" if slides < rocks else "rocks"
    return _line(
        f"with {friction:g}",
        f"at {tilt_degrees(tilt)} it {does} downhill first, from "
        f"{min(slides, rocks) / STANDARD_GRAVITY:.2f} g on",
    )


def as_record(
    design: TiltDesign | None,
    level: TiltEffect,
    asked: TiltEffect | None,
    lengths: Mapping[str, float],
    warnings: Sequence[str],
) -> dict[str, Any]:
    """Everything in plain numbers: tilts in degrees, lengths in metres, null for none."""
    record: dict[str, Any] = {"warnings": list(warnings), "level": _effect_record(level, lengths)}
    if design is not None:
        curves = design.curves
        record["designed"] = {
            "control": design.control,
            "motions": design.motion_count,
            "recordings": design.recording_count,
            "found": _found(curves.control_tilt),
            "tilt_deg": _number(degrees(curves.control_tilt)),
            "tilt_interval_deg": [_number(degrees(end)) for end in curves.control_tilt_interval],
            "steepest_tried_deg": degrees(curves.tilts[-1]),
            "gcor_tilt_deg": _number(degrees(design.gcor_tilt)),
            "scor_tilt_deg": _number(degrees(design.scor_tilt)),
            "effect": design.effect and _effect_record(design.effect, lengths),
        }
    if asked is not None:
        record["asked"] = _effect_record(asked, lengths)
    return record


def _found(tilt: float) -> str:
    if math.isfinite(tilt):
        return "yes"
    return "none does" if math.isinf(tilt) else "too few falls to tell"


def _effect_record(effect: TiltEffect, lengths: Mapping[str, float]) -> dict[str, Any]:
    plain = {
        key: [_number(end) for end in value] if isinstance(value, tuple) else _number(value)
        for key, value in asdict(effect).items()
        if key != "tilt"
    }
    raised = {name: shim_height(length, effect.tilt) for name, length in lengths.items()}
    return {"tilt_deg": degrees(effect.tilt), "raised_m": raised, **plain}


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
