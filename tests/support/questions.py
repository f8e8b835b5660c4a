"""Questions that anybody may ask of the page, at random, with every number often at its ends."""

from __future__ import annotations

import math
from typing import Any, get_args

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from shaketable.records.plausible import LOUDEST
from shaketable.records.text import STEPS
from shaketable.web import shaking
from shaketable.web.limits import MOST_SAMPLES, MOST_SECONDS
from shaketable.web.questions import (
    Beside,
    LookAtMotion,
    Many,
    ManyInSpace,
    Pulse,
    Recording,
    Shake,
    ShakeInSpace,
    SuiteName,
    Thing,
    Uploaded,
    Upright,
)

Rng = np.random.Generator
TINY = 1e-9  # of a number that must be above 0


def question(rng: Rng) -> Any:
    """One of the questions about one object, all of whose fields are accepted."""
    kind = rng.choice([Shake, Many, ShakeInSpace, ManyInSpace, LookAtMotion])
    given: dict[str, Any] = {}
    for name in kind.model_fields:
        if name == "thing":
            given[name] = thing(rng, Upright if kind in (ShakeInSpace, ManyInSpace) else Thing)
        elif name == "shaking":
            given[name] = motion(rng)
        elif name == "suite":
            given[name] = str(rng.choice(get_args(SuiteName)))
        elif name == "scale":
            given[name] = float(rng.choice([0.0, 20.0, rng.uniform(0.1, 3.0)]))
        else:
            given[name] = bool(rng.integers(2))
    if isinstance(given.get("shaking"), Uploaded):
        peak = max(map(abs, given["shaking"].acceleration))
        given["scale"] = min(given["scale"], 0.999999 * LOUDEST / peak)
    return kind(**given)


BASES = ("base_m", "depth_m", "width_m")


def thing(rng: Rng, kind: type[BaseModel]) -> BaseModel:
    """A thing or an upright."""
    given: dict[str, Any] = {
        name: number(rng, field)
        for name, field in kind.model_fields.items()
        if name not in ("shape", *BASES, "friction", "beside")
    }
    sizes = ["base_m"]
    if kind is Upright:
        given["shape"] = str(rng.choice(["box", "cylinder"]))
        sizes = ["depth_m", "width_m"] if given["shape"] == "box" else sizes
    least, most = given["height_m"] / 199.0, min(20.0, 199.0 * given["height_m"])
    for name in sizes:
        given[name] = float(np.clip(number(rng, Thing.model_fields["base_m"]), least, most))
    given["friction"] = None if rng.random() < 0.2 else number(rng, kind.model_fields["friction"])
    given["tilt_deg"] = 0.0 if rng.random() < 0.7 else given["tilt_deg"]
    if kind is Upright:
        if given["shape"] == "box":
            given["contour_friction_mm"] = 0.0
        for name in ("rolling_friction_mm", "contour_friction_mm"):
            given[name] = min(given[name], 100.0 * min(given[size] for size in sizes))
    given["beside"] = None if rng.random() < 0.5 else beside(rng, lip=kind is Thing)
    return kind(**given)


def beside(rng: Rng, *, lip: bool) -> Beside:
    """What stands beside a thing; a lip where there is an edge, seen from the side."""
    given: dict[str, Any] = {
        name: number(rng, field)
        for name, field in Beside.model_fields.items()
        if name in ("lip_mm", "strap_stiffness_kn_m") or rng.random() < 0.5
    }
    if not lip or given.get("edge_mm") is None:
        given["lip_mm"] = 0.0
    return Beside(**given)


def motion(rng: Rng) -> Any:
    """A recording, a pulse, or the longest and shortest records that are taken."""
    what = rng.integers(3)
    if what == 0:
        return Recording(name=str(rng.choice([one.name for one in shaking.motions()])))
    if what == 1:
        return Pulse(
            period_s=float(rng.choice([0.05, 0.5, 10.0])), peak_g=number_between(rng, 0.01, 5.0)
        )
    count = int(rng.choice([2, 3_000, MOST_SAMPLES]))
    longest = min(STEPS[1], MOST_SECONDS / count)
    strength = number_between(rng, 0.1, 900.0)
    series = np.round(strength * rng.uniform(-1.0, 1.0, count), 3)
    step = float(rng.choice([STEPS[0], 0.9 * longest]))
    return Uploaded(time_step_s=step, acceleration=series.tolist())


def number(rng: Rng, field: FieldInfo) -> float:
    """A number that a field takes."""
    return number_between(rng, *ends_of(field))


def ends_of(field: FieldInfo) -> tuple[float, float]:
    """The least and the largest number that a field takes."""
    low, high = -math.inf, math.inf
    for limit in limits(field):
        if isinstance(limit, (Ge, Gt)):
            low = float(limit.ge if isinstance(limit, Ge) else limit.gt + TINY)  # type: ignore[arg-type, operator]
        if isinstance(limit, (Le, Lt)):
            high = float(limit.le if isinstance(limit, Le) else limit.lt - TINY)  # type: ignore[arg-type, operator]
    return low, high


def number_between(rng: Rng, low: float, high: float) -> float:
    """Often one of the ends; between them evenly, or in its logarithm."""
    way = rng.integers(4)
    if way < 2:
        return low if way else high
    if way == 2 or low <= 0.0:
        return float(rng.uniform(low, high))
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def limits(field: FieldInfo) -> list[Any]:
    """Of a number, or of one that may be None."""
    found = list(field.metadata)
    for each in get_args(field.annotation):
        found += getattr(each, "__metadata__", ())
    return [one for item in found for one in getattr(item, "metadata", [item])]
