"""Bodies, what holds them, models, items and their results as JSON and back, without a loss."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from enum import Enum
from inspect import getmro
from typing import Any

import numpy as np

from shaketable.assess import ItemResult, ProfileResult, results
from shaketable.assess.carried import Kick
from shaketable.assess.profiles import Direction, Profile
from shaketable.assess.shares import Quartiles, Share
from shaketable.body import Body
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.models import General, Rocking
from shaketable.solid import Solid
from shaketable.surroundings import Edge, Pad, Strap, Surroundings, Wall
from shaketable.tilting import TiltCurves

#: Everything that a store keeps as JSON; nothing else is read.
KINDS: dict[str, type] = {
    kind.__name__: kind
    for kind in (
        Body, Solid, Edge, Pad, Strap, Surroundings, Wall, Rocking, General, Item, Castors,
        BaseShape, Direction, Profile, TiltCurves, Quartiles, Share,
        ItemResult, ProfileResult, Kick, results.AnchorForce, results.CriterionResult,
        results.FloorRatios,
        results.FrictionResult, results.LevelResult, results.Mitigation, results.MitigationKind,
        results.Sides, results.Sliding, results.SolidResult, results.StrapForce,
        results.SurroundedResult, results.UncertainResult,
    )
}  # fmt: skip

#: Fields that came later: without them what is kept is what it was before.
LATER = (
    "mass",
    "height",
    "edge",
    "pad",
    "surroundings",
    "cost",
)  # of a Solid the height is never None


def to_json(value: Any) -> Any:
    """A value as lists, texts and numbers; Python writes a double so that it is read as it was."""
    if isinstance(value, Enum):
        return {"": type(value).__name__, "value": value.value}
    if dataclasses.is_dataclass(value):
        # of a user's own subclass what it shares with the known one
        kind = next((one for one in getmro(type(value)) if one.__name__ in KINDS), type(value))
        names = [field.name for field in dataclasses.fields(kind)]
        names = [name for name in names if name not in LATER or getattr(value, name) is not None]
        return {"": kind.__name__, **{name: to_json(getattr(value, name)) for name in names}}
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        told = {name: to_json(getattr(value, name)) for name in value._fields}
        return {"": type(value).__name__, **told}
    if isinstance(value, np.ndarray):
        return {"": "array", "kind": value.dtype.str, "values": value.tolist()}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return {"": "mapping", "entries": [[key, to_json(each)] for key, each in value.items()]}
    if isinstance(value, (list, tuple)):
        return {"": type(value).__name__, "entries": [to_json(each) for each in value]}
    return value


def from_json(told: Any, kinds: Mapping[str, type] = KINDS) -> Any:
    """What `to_json` was given.

    Args:
        told: parsed JSON.
        kinds: of what may be in it, by their names.

    Raises:
        KeyError, TypeError, ValueError: something else.
    """
    if not isinstance(told, dict):
        return told
    name = told[""]
    if name == "array":
        return np.array(told["values"], dtype=told["kind"])
    if name == "mapping":
        return {key: from_json(each, kinds) for key, each in told["entries"]}
    if name in ("list", "tuple"):
        entries = [from_json(each, kinds) for each in told["entries"]]
        return entries if name == "list" else tuple(entries)
    kind = kinds[name]
    if issubclass(kind, Enum):
        return kind(told["value"])
    return kind(**{key: from_json(each, kinds) for key, each in told.items() if key})
