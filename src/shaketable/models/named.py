"""Models by their short words."""

from __future__ import annotations

from dataclasses import replace

from shaketable.errors import InputError
from shaketable.models.general import General
from shaketable.models.model import Model
from shaketable.models.rocking import Rocking

#: Each stands for a model with its default parameters.
NAMES: dict[str, type[Model]] = {kind.name: kind for kind in (Rocking, General)}


def with_friction(model: Model, friction: float) -> General:
    """The general model with a friction, static and kinetic, and a model's other parameters."""
    if isinstance(model, General):
        return replace(model, static_friction=friction, kinetic_friction=None)
    return General(static_friction=friction, restitution_factor=model.restitution_factor)


def model_of(model: Model | str | None) -> Model:
    """The model itself, the one that a short word stands for, or the rocking model for None.

    Raises:
        InputError: anything else.
    """
    if model is None:
        return Rocking()
    if isinstance(model, Model):
        return model
    if isinstance(model, str) and model in NAMES:
        return NAMES[model]()
    words = ", ".join(repr(name) for name in NAMES)
    kinds = ", ".join(f"{kind.__name__}(...)" for kind in NAMES.values())
    raise InputError(f"unknown model {model!r}; accepted: {words}, or one of {kinds}")
