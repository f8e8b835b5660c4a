"""A campaign's bodies and motions in its store, where workers and readers find them."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any

import numpy as np

from shaketable.body import Body
from shaketable.campaign.fingerprint import body_hash
from shaketable.campaign.motions import StoredMotions, save_motions
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.errors import SimulationError
from shaketable.lazy_motions import heads_of
from shaketable.models import NAMES, Model
from shaketable.simulate.ensemble import Ensemble
from shaketable.solid import Solid

PLAN = "campaign/plan.json"
FORMAT = 2


def save(plan: Plan, made: dict[str, Any], objects: Objects) -> None:
    """Write a plan, with the hashes of all that it depends on; the plan itself comes last."""
    ensemble = plan.ensemble
    save_motions(ensemble.motions, objects)
    objects.put_json(
        PLAN,
        {
            "format": FORMAT,
            "fingerprint": made,
            "class": ensemble.kind.body.__name__,
            "bodies": [_told_of_body(body) for body in ensemble.bodies],
            "azimuth": ensemble.azimuth,
            "orientations": ensemble.orientations.tolist(),
            "motions": [head.as_dict() for head in heads_of(ensemble.motions)],
            "model": told_of_model(ensemble.model),
            "tilts": ensemble.tilts.tolist(),
            "scales": ensemble.scales.tolist(),
            "polarities": ensemble.polarities.tolist(),
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
    if told.get("format", FORMAT) != FORMAT:
        raise SimulationError(
            f"{objects.place}: the campaign was begun by another version of shaketable (its format "
            f"is {told['format']}, this version reads {FORMAT}); begin it anew"
        )
    try:
        ensemble = _ensemble(objects, told)
        if [body_hash(body) for body in ensemble.bodies] != told["fingerprint"]["bodies"]:
            raise ValueError("its bodies are not those that it was begun with")
        return Plan(
            ensemble=ensemble,
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


def _ensemble(objects: Objects, told: dict[str, Any]) -> Ensemble:
    model = load_model(told["model"])
    body = {kind.__name__: kind for kind in (Body, Solid)}[told["class"]]
    axes = ("tilts", "scales", "polarities", "orientations")
    return Ensemble(
        bodies=[body(**each) for each in told["bodies"]],
        motions=StoredMotions(objects, told["motions"], told["fingerprint"]["motions"]),
        model=model,
        azimuth=told["azimuth"],
        **{name: np.array(told[name]) for name in axes},
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
