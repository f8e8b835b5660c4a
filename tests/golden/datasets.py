"""Datasets, runs and answers of the page: small cases of every kind, well-conditioned."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
import xarray as xr

from shaketable import Body, General, Motion, Rocking, Solid, Support, simulate, simulate_each
from shaketable.simulate import simulate_many
from shaketable.web import space, work
from shaketable.web.questions import Many, ManyInSpace, Pulse, Shake, ShakeInSpace, Thing, Upright

EVERY = 40  # samples of a history that are told
BODIES = [
    Body.rectangle(0.3, 1.2, name="cabinet"),
    Body.rectangle(0.25, 1.8, eccentricity=0.4, name="shelf"),
    Body(base=0.2, cg_height=0.4, left=0.1, gyration_radius=0.3),
]
SOLIDS = [
    Solid.box(0.3, 0.5, 1.2, name="box"),
    Solid.cylinder(0.25, 1.0, name="drum"),
    Solid.on_feet([(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)], 1.0, name="cart",
                  castors=(True, True, False, False), rolling_resistance=0.01),
]  # fmt: skip
ROCKING = (Rocking(), Rocking(restitution=0.8, restitution_factor=0.95))
GENERAL = (
    General(static_friction=0.5),
    General(static_friction=0.25, kinetic_friction=0.2, normal_restitution=0.2),
)


def motions() -> list[Motion]:
    """Two pulses that decay, in three components, of which the second overturns some."""
    time = 0.01 * np.arange(300)
    return [
        Motion(
            size * np.sin(rate * time) * np.exp(-1.5 * time),
            0.01,
            vertical=0.3 * size * np.sin(3.0 * rate * time) * np.exp(-2.0 * time),
            transverse=0.4 * size * np.cos(0.7 * rate * time) * np.exp(-1.5 * time),
            name=name,
        )
        for name, size, rate in (("weak", 3.5, 9.0), ("strong", 7.0, 5.0))
    ]


def told(value: Any) -> Any:
    """A result as JSON writes it: every number of it, and of histories some samples."""
    if isinstance(value, xr.Dataset):
        return {
            "sizes": dict(value.sizes),
            "attributes": told(value.attrs),
            **{
                str(name): {
                    "over": list(each.dims),
                    "type": each.dtype.kind,
                    "attributes": told(each.attrs),
                    "values": each.values.ravel().tolist(),
                }
                for name, each in {**value.coords, **value.data_vars}.items()
            },
        }
    if isinstance(value, np.ndarray):
        return {"shape": list(value.shape), "values": told(value[::EVERY].tolist())}
    if isinstance(value, dict):
        return {str(key): told(each) for key, each in value.items()}
    if isinstance(value, list | tuple) and not hasattr(value, "_fields"):
        return [told(each) for each in value]
    if isinstance(value, float | int | str | bool | None):
        return value
    return repr(value)


def _fields(run: object) -> dict[str, Any]:
    return {name: told(each) for name, each in vars(run).items()}


def _many(bodies: list[Any], models: tuple[Any, ...], **given: Any) -> list[xr.Dataset]:
    return [
        simulate_many(bodies, motions(), model=model, progress=False, **given) for model in models
    ]


def _planar(models: tuple[Any, ...]) -> dict[str, Any]:
    tilts = np.radians([0.0, 2.0])
    one, other = motions()
    each = simulate_each(
        BODIES, [one, other, other], tilts=[0.0, 0.02, -0.01], scales=[1.0, 0.8, 1.1],
        model=models[0], progress=False,
    )  # fmt: skip
    return {
        "many": _many(BODIES, models, tilts=tilts, scales=[0.7, 1.0]),
        "each": each,
        "one": [
            _fields(simulate(body, other, Support(tilt=0.02), model=models[0])) for body in BODIES
        ],
    }


def rocking() -> dict[str, Any]:
    return _planar(ROCKING)


def general() -> dict[str, Any]:
    return _planar(GENERAL)


def solids() -> dict[str, Any]:
    turns = np.radians([0.0, 30.0])
    one, other = motions()
    each = simulate_each(
        SOLIDS, [one, other, other], tilts=[0.0, 0.02, 0.0], orientations=[0.0, 0.3, 0.6],
        model=GENERAL[0], progress=False,
    )  # fmt: skip
    return {
        "many": _many(SOLIDS, GENERAL, tilts=[0.0, 0.03], orientations=turns, azimuth=0.5),
        "each": each,
        "one": [_fields(simulate(solid, other, model=GENERAL[0])) for solid in SOLIDS],
    }


def page() -> dict[str, Any]:
    """What the page's interface answers."""
    pulse, weak = Pulse(period_s=0.8, peak_g=0.3), Pulse(period_s=0.5, peak_g=0.25)
    shelf = Thing(base_m=0.32, height_m=1.8, friction=0.5)
    drum = Upright(shape="cylinder", base_m=0.3, height_m=1.2)
    answers = {
        "simulate": work.shake(Shake(thing=shelf, shaking=pulse)),
        "many": work.many(Many(thing=shelf)),
        "space/simulate": space.shake(ShakeInSpace(thing=drum, shaking=weak)),
        "space/many": space.many(ManyInSpace(thing=drum, scale=0.3, curve=False)),
    }
    return {name: _thinned(answer.model_dump()) for name, answer in answers.items()}


def _thinned(value: Any) -> Any:
    """Of the pictures of a film some."""
    if isinstance(value, dict):
        return {key: _thinned(each) for key, each in value.items()}
    if isinstance(value, list) and len(value) > EVERY:
        return {"length": len(value), "values": [_thinned(each) for each in value[::EVERY]]}
    return value


CASES: dict[str, Callable[[], dict[str, Any]]] = {
    "rocking": rocking,
    "general": general,
    "solids": solids,
    "page": page,
}


def lines(place: str, value: Any) -> Iterator[str]:
    """A line for each thing that is no room for others: where it is, and what."""
    parts: Iterable[tuple[object, Any]] = ()
    if isinstance(value, dict):
        parts = value.items()
    elif isinstance(value, list) and any(isinstance(each, dict) for each in value):
        parts = enumerate(value)
    else:
        yield f"{place}: {json.dumps(value, ensure_ascii=False)}"
    for key, each in parts:
        yield from lines(f"{place}.{key}".removeprefix("."), each)


def written(name: str) -> str:
    """A case as text."""
    return "\n".join(lines("", told(CASES[name]())))
