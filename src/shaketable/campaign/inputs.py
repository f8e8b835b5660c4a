"""A campaign's bodies and motions in its store, where workers and readers find them."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import asdict, fields
from typing import Any
from zipfile import BadZipFile

import numpy as np

from shaketable.body import Body
from shaketable.campaign.fingerprint import body_hash, motion_hash, told_of_solids
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.errors import SimulationError
from shaketable.models import NAMES, Model
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.simulate.product import Product
from shaketable.simulate.products import AnyProduct
from shaketable.simulate.solid_product import SolidProduct
from shaketable.solid import Solid

MOTIONS, PLAN = "campaign/motions.npz", "campaign/plan.json"


def save(plan: Plan, made: dict[str, Any], objects: Objects) -> None:
    """Write a plan, with the hashes of all that it depends on; the plan itself comes last."""
    product = plan.product
    save_motions(product.motions, objects)
    objects.put_json(
        PLAN,
        {
            "format": 1,
            "fingerprint": made,
            "bodies": [_told_of_body(body) for body in product.bodies],
            **told_of_solids(product),
            "motions": [told_of_motion(motion) for motion in product.motions],
            "model": told_of_model(product.model),
            "tilts": product.tilts.tolist(),
            "scales": product.scales.tolist(),
            "polarities": product.polarities.tolist(),
            "keep": plan.keep,
            "recordings": plan.recordings,
            "device": plan.device,
            "bodies_per_block": plan.bodies_per_block,
            "motion_parts": [list(part) for part in plan.motion_parts],
        },
    )


def load(objects: Objects, told: dict[str, Any]) -> Plan:
    """The plan that a store holds.

    Args:
        objects: of the store.
        told: what stands in PLAN.

    Raises:
        SimulationError: something of it is missing or damaged.
    """
    try:
        product = _product(objects, told)
        made = told["fingerprint"]
        for name, hashed in (
            ("bodies", [body_hash(body) for body in product.bodies]),
            ("motions", [motion_hash(motion) for motion in product.motions]),
        ):
            if hashed != made[name]:
                raise ValueError(f"its {name} are not those that it was begun with")
        return Plan(
            product=product,
            keep=told["keep"],
            recordings=told["recordings"],
            device=told["device"],
            bodies_per_block=told["bodies_per_block"],
            motion_parts=tuple((first, end) for first, end in told["motion_parts"]),
        )
    except (KeyError, TypeError, ValueError, OSError, EOFError, BadZipFile) as error:
        raise SimulationError(
            f"{objects.place}: the campaign's plan is damaged ({error})"
        ) from None


def _product(objects: Objects, told: dict[str, Any]) -> AnyProduct:
    parts: dict[str, Any] = {
        "motions": load_motions(objects, told["motions"]),
        "model": load_model(told["model"]),
        **{name: np.array(told[name]) for name in ("tilts", "scales", "polarities")},
    }
    if "orientations" not in told:
        return Product(bodies=[Body(**each) for each in told["bodies"]], **parts)
    return SolidProduct(
        bodies=[Solid(**each) for each in told["bodies"]],
        azimuth=told["azimuth"],
        orientations=np.array(told["orientations"]),
        **parts,
    )


def _told_of_body(body: Body | Solid) -> dict[str, Any]:
    if isinstance(body, Solid):
        return body.as_dict()
    told = asdict(body)
    return {name: _plain(value) for name, value in told.items()}


def _plain(value: Any) -> Any:
    """A number of NumPy's as one of Python's."""
    return value.item() if isinstance(value, np.generic) else value


def save_motions(motions: Sequence[Motion], objects: Objects) -> None:
    """Write the series of motions."""
    series: dict[str, Any] = {}
    for k, motion in enumerate(motions):
        series[f"h{k}"] = motion.horizontal
        if motion.vertical is not None:
            series[f"v{k}"] = motion.vertical
        if motion.transverse is not None:
            series[f"t{k}"] = motion.transverse
    file = io.BytesIO()
    np.savez(file, **series)
    objects.put(MOTIONS, file.getvalue())


def load_motions(objects: Objects, told: Sequence[dict[str, Any]]) -> list[Motion]:
    """The motions of a store.

    Args:
        objects: of the store.
        told: what `told_of_motion` said of each.

    Raises:
        KeyError, ValueError: missing or damaged.
    """
    content = objects.get(MOTIONS)
    if content is None:
        raise KeyError(MOTIONS)
    with np.load(io.BytesIO(content), allow_pickle=False) as series:
        return [_motion(k, each, series) for k, each in enumerate(told)]


def told_of_model(model: Model) -> dict[str, Any]:
    """A model's name and parameters."""
    names = [each.name for each in fields(model)]  # type: ignore[arg-type]
    return {"name": model.name, **{name: _plain(getattr(model, name)) for name in names}}


def load_model(told: dict[str, Any]) -> Model:
    """The model that `told_of_model` was given."""
    parameters = dict(told)
    return NAMES[parameters.pop("name")](**parameters)


def told_of_motion(motion: Motion) -> dict[str, Any]:
    """A motion without its series."""
    return {
        "name": motion.name,
        "time_step": float(motion.time_step),
        "origin": motion.origin and asdict(motion.origin),
        "vertical_origin": motion.vertical_origin and asdict(motion.vertical_origin),
        "transverse_origin": motion.transverse_origin and asdict(motion.transverse_origin),
    }


def _motion(k: int, told: dict[str, Any], series: Any) -> Motion:
    return Motion(
        series[f"h{k}"],
        told["time_step"],
        vertical=series.get(f"v{k}"),
        transverse=series.get(f"t{k}"),
        name=told["name"],
        origin=_origin(told["origin"]),
        vertical_origin=_origin(told["vertical_origin"]),
        transverse_origin=_origin(told.get("transverse_origin")),
    )


def _origin(told: dict[str, Any] | None) -> Origin | None:
    if told is None:
        return None
    steps: Sequence[str] = told["processing"]
    return Origin(**{**told, "processing": tuple(steps)})
