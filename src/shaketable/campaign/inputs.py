"""A campaign's bodies and motions in its store, where workers and readers find them."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any

import numpy as np

from shaketable.body import Body
from shaketable.campaign.fingerprint import body_hash, told_of_solids
from shaketable.campaign.motions import StoredMotions, save_motions
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.errors import SimulationError
from shaketable.lazy_motions import heads_of
from shaketable.models import NAMES, Model
from shaketable.simulate.product import Product
from shaketable.simulate.products import AnyProduct
from shaketable.simulate.solid_product import SolidProduct
from shaketable.solid import Solid

PLAN = "campaign/plan.json"


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
            "motions": [head.as_dict() for head in heads_of(product.motions)],
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
    """The plan that a store holds. Its motions are read, and looked at, as they are needed.

    Args:
        objects: of the store.
        told: what stands in PLAN.

    Raises:
        SimulationError: something of it is missing or damaged.
    """
    try:
        product = _product(objects, told)
        if [body_hash(body) for body in product.bodies] != told["fingerprint"]["bodies"]:
            raise ValueError("its bodies are not those that it was begun with")
        return Plan(
            product=product,
            keep=told["keep"],
            recordings=told["recordings"],
            device=told["device"],
            bodies_per_block=told["bodies_per_block"],
            motion_parts=tuple((first, end) for first, end in told["motion_parts"]),
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise SimulationError(
            f"{objects.place}: the campaign's plan is damaged ({error})"
        ) from None


def _product(objects: Objects, told: dict[str, Any]) -> AnyProduct:
    parts: dict[str, Any] = {
        "motions": StoredMotions(objects, told["motions"], told["fingerprint"]["motions"]),
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


def told_of_model(model: Model) -> dict[str, Any]:
    """A model's name and parameters."""
    names = [each.name for each in fields(model)]  # type: ignore[arg-type]
    return {"name": model.name, **{name: _plain(getattr(model, name)) for name in names}}


def load_model(told: dict[str, Any]) -> Model:
    """The model that `told_of_model` was given."""
    parameters = dict(told)
    return NAMES[parameters.pop("name")](**parameters)
