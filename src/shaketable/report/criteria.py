"""What the criteria say about a body, in words and as a record for programs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from shaketable.body import Body
from shaketable.criteria import (
    boroschek_romo_2004,
    cimellaro_2020,
    shaketable_2026,
    shaketable_2026_floors,
)
from shaketable.criteria.boroschek_romo_2004 import energy_kept, friction_needed
from shaketable.criteria.ishiyama_1982 import overturning_acceleration
from shaketable.criteria.kaneko_hayashi_2004 import overturning_ratio, risk_class
from shaketable.criteria.shenton_1996 import shape_of
from shaketable.criteria.verdict import Verdict
from shaketable.report.words.numbers import percent
from shaketable.units import STANDARD_GRAVITY

SIDES = {1: "right (+x)", -1: "left (-x)"}


def verdict_lines(verdicts: Sequence[Verdict]) -> list[str]:
    """Each verdict with its margin, reference and range."""
    lines = []
    for verdict in verdicts:
        margin = "no motion" if math.isinf(verdict.margin) else f"margin {verdict.margin:.2f}"
        lines += [
            f"{verdict.criterion} ({margin})",
            f"  {verdict.sentence}",
            f"  {verdict.reference}; for {verdict.range}",
        ]
        if verdict.beyond:
            lines.append(f"  outside of that: {verdict.beyond}")
    return lines


def body_lines(body: Body, pga: float, least_weight: float | None) -> list[str]:
    """What does not depend on the velocity: uplift, the friction that rocking needs, impacts.

    Args:
        body: on a level support.
        pga: [m/s²].
        least_weight: smallest g + a_y of the motion [m/s²], None if its vertical is not known.
    """
    lines = ["The body (Boroschek & Romo 2004, eqs. 25, 26 and 38)"]
    for direction in (1,) if math.isclose(body.left, body.right) else (1, -1):
        numbers = body_numbers(body, pga, direction)
        toward = "" if math.isclose(body.left, body.right) else f" to the {SIDES[direction]}"
        said = (
            f"  rocks{toward} from {numbers['uplift_g']:.3g} g on, without slipping where static "
            f"friction is above {numbers['friction_as_it_begins']:.3g}"
        )
        if numbers["friction_at_pga"] is not None:
            said += f", under a jolt of the PGA above {numbers['friction_at_pga']:.3g}"
        lines.append(said)
    kept = float(energy_kept(body.left, body.right, body.cg_height, body.gyration_radius))
    lines.append(f"  keeps {100 * kept:.3g} % of its energy at an impact")
    if least_weight is not None:
        flies = "may lose contact" if least_weight < 0.0 else "keeps contact at rest"
        least = least_weight / STANDARD_GRAVITY
        lines.append(
            f"  {flies}: the smallest g + a_y is {least:.3g} g (Boroschek & Iruretagoyena 2006, "
            "eq. 11)"
        )
    return lines


def demand_lines(friction: float | None) -> list[str]:
    """The friction that rocking asked for under a record, None if there was none."""
    if friction is None:
        return []
    if friction == 0.0:
        return ["  does not rock under this record, as simulated"]
    return [
        f"  as simulated under this record, rocks without sliding where static friction is above "
        f"{friction:.2g} throughout (eq. 20)"
    ]


def floor_lines(base: float, height: float, pga: float, pgv: float) -> list[str]:
    """The share of rectangles of these full sizes [m] that falls, by the formulas for floors."""
    numbers = floor_numbers(base, height, pga, pgv)
    ratio, ours, risk = (numbers[name] for name in ("kaneko_hayashi", "shaketable", "cimellaro"))
    lines = [
        "Share that overturns, if these are a floor's peaks",
        f"  {percent(ratio)} ({risk_class(ratio)} risk) by Kaneko & Hayashi 2004; the standard "
        "deviations are ours",
        f"  {percent(ours)} ({risk_class(ours)} risk) by the curve fitted here to their demands",
        f"  {percent(risk)} ({risk_class(risk)} risk) by Cimellaro et al. 2020, eq. 9",
    ]
    for name, doubts in (("the curve", "shaketable_doubts"), ("eq. 9", "cimellaro_doubts")):
        lines += [f"  outside of the range of {name}: {reason}" for reason in numbers[doubts]]
    return lines


def floor_numbers(base: float, height: float, pga: float, pgv: float) -> dict[str, Any]:
    """The ratios in [0, 1], and reasons to doubt the last two."""
    return {
        "kaneko_hayashi": float(overturning_ratio(base, height, pga, pgv)),
        "shaketable": float(shaketable_2026_floors.overturning_ratio(base, height, pga, pgv)),
        "shaketable_doubts": shaketable_2026_floors.out_of_range(base, height),
        "cimellaro": float(cimellaro_2020.overturning_ratio(base / height, pga)),
        "cimellaro_doubts": cimellaro_2020.out_of_range(base / height, pga),
    }


def bottom_line(
    body: Body, pga: float, pgv: float, height: float, verdicts: Sequence[Verdict]
) -> list[str]:
    """What to believe of all that was printed, and why.

    Args:
        body: on a level support.
        pga: [m/s²].
        pgv: [m/s].
        height: full height [m].
        verdicts: of `verdicts`.
    """
    return ["Bottom line", *(f"  {line}" for line in _bottom(body, pga, pgv, height, verdicts))]


def _bottom(
    body: Body, pga: float, pgv: float, height: float, verdicts: Sequence[Verdict]
) -> list[str]:
    said = {verdict.criterion: verdict for verdict in verdicts}
    rule, known = said[shaketable_2026.NAME], said[boroschek_romo_2004.KNOWN_NAME]
    lifts = min(
        float(overturning_acceleration(arm, body.cg_height)) for arm in (body.left, body.right)
    )
    if pga < lifts:
        return [
            f"It does not begin to rock: that takes {lifts / STANDARD_GRAVITY:.3g} g. Believe that "
            "before any number above: it is the balance of forces, and no fit. It may slide, and "
            "where a vertical motion takes its weight it rocks earlier."
        ]
    floor = percent(float(overturning_ratio(body.base, height, pga, pgv)))
    then = (
        f"If these are peaks of a floor of a building, believe Kaneko & Hayashi's {floor} instead: "
        "the verdicts above were made for ground motions, and eq. 9 of Cimellaro et al. knows "
        "neither the size nor the velocity."
    )
    plane = (
        "All of this is for a rectangle that is shaken in one plane. Do not believe it of what is "
        "round, nearly square or on feet, which falls more often in three dimensions: shaketable "
        "assess and shaketable tilt simulate that, and tell which way and how far."
    )
    if not rule.beyond:
        other = "agree" if known.overturns == rule.overturns else "differ, as they are no chance"
        return [
            plane,
            f"By the fitted rule it {rule.sentence}. Believe that chance if these are peaks of the "
            "ground: of all numbers above it alone takes size, eccentricity, acceleration and "
            "velocity together, and it was checked on recordings that it was not fitted to. "
            f"Boroschek & Romo's conditions {other}; Housner's margin is for even odds, so that "
            "above 1 many still fall.",
            then,
        ]
    if known.beyond:
        return ["No criterion was made for such a body: believe none of them, and simulate it."]
    return [
        plane,
        f"By Boroschek & Romo's conditions it {known.sentence}. Believe them if these are peaks of "
        f"the ground: the fitted rule lies outside of its range here ({rule.beyond}). They hardly "
        "ever overlook a fall, and call in danger much that stands.",
        then,
    ]


def body_numbers(body: Body, pga: float, direction: int) -> dict[str, float | None]:
    """Uplift acceleration [g] toward a side, +1 or -1, and the friction that rocking needs there.

    The friction under a jolt of the PGA is None if that does not lift the corner.
    """
    gamma, kappa = shape_of(body, direction)
    arm = body.right if direction > 0 else body.left
    uplift = float(overturning_acceleration(arm, body.cg_height))
    jolt = float(friction_needed(pga / STANDARD_GRAVITY, gamma, kappa)) if pga >= uplift else None
    return {
        "uplift_g": uplift / STANDARD_GRAVITY,
        "friction_as_it_begins": 1.0 / gamma,
        "friction_at_pga": jolt,
    }


def as_record(body: Body, pga: float, pgv: float, verdicts: Sequence[Verdict]) -> dict[str, Any]:
    """Everything in plain numbers; null for an infinite margin."""
    return {
        "pga_m_s2": pga,
        "pgv_m_s": pgv,
        "verdicts": [
            {
                **verdict._asdict(),
                "margin": verdict.margin if math.isfinite(verdict.margin) else None,
            }
            for verdict in verdicts
        ],
        "right": body_numbers(body, pga, 1),
        "left": body_numbers(body, pga, -1),
        "energy_kept": float(
            energy_kept(body.left, body.right, body.cg_height, body.gyration_radius)
        ),
        "floor": floor_numbers(body.base, 2 * body.cg_height, pga, pgv),
    }
