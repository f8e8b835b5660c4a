"""Checks of the input before anything is simulated."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, joined
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.units import degrees

log = logging.getLogger(__name__)

T = TypeVar("T", Body, Motion)

_HOW = {
    Body: "a Body, such as Body.rectangle(0.3, 1.8)",
    Motion: "a Motion: read one with read_motion(path), take a suite(name), or make one from "
    "an array with Motion(array, time_step)",
}


def listed(name: str, values: object, kind: type[T]) -> list[T]:
    """The values as a list of bodies or motions.

    Raises:
        InputError: one object instead of a list, a path, an array, or another kind of object.
    """
    word = kind.__name__.lower()
    if isinstance(values, kind):
        raise InputError(f"{name}= takes a list: for one {word} write {name}=[{word}]")
    if isinstance(values, (str, Path, np.ndarray)) or not isinstance(values, Iterable):
        raise InputError(f"{name}= takes a list, each entry {_HOW[kind]}; got {_told(values)}")
    found = list(values)
    for index, value in enumerate(found):
        if not isinstance(value, kind):
            raise InputError(f"{name}[{index}] must be {_HOW[kind]}; got {_told(value)}")
    if not found:
        raise InputError(f"{name}= is empty; at least one {word} is needed")
    return found


def require_kind(name: str, value: object, kind: type[T]) -> None:
    """InputError unless the value is one body or one motion."""
    if not isinstance(value, kind):
        raise InputError(f"{name} must be {_HOW[kind]}; got {_told(value)}")


def _told(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    if isinstance(value, (str, Path)):
        return f"the path {str(value)!r}"
    return f"an object of type {type(value).__name__}"


def require_stable(bodies: Sequence[Body], tilt: float) -> None:
    """InputError naming each body that falls by itself on a tilt [rad]."""
    faults = []
    for index, body in enumerate(bodies):
        low, high = body.standing_range
        if not low < tilt < high:
            limit, arm = (high, "left") if tilt > 0.0 else (low, "right")
            faults.append(
                f"body {body.name or index}: falls by itself on a support tilted by "
                f"{degrees(tilt):.4g}°; it stands below {degrees(abs(limit)):.4g}° = "
                f"atan({arm} / cg_height)"
            )
    if faults:
        raise InputError(joined(faults))


def warn(model: Model, tilts: Iterable[float]) -> None:
    """Log the model's warnings about tilts [rad], those of the steepest one first."""
    steepest = max(tilts, key=abs)
    for sentence in model.warnings(steepest):
        log.warning("%s", sentence)


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """One or more finite numbers, (n,).

    Raises:
        InputError: anything else.
    """
    try:
        given = list(values) if isinstance(values, Iterable) else values
        found = np.atleast_1d(np.asarray(given, np.float64))
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}= must be numbers: {error}") from None
    if found.ndim != 1 or found.size == 0 or not np.isfinite(found).all():
        raise InputError(f"{name}= must be one or more finite numbers, got {values!r:.100}")
    return found


def require_polarities(values: NDArray[np.float64]) -> None:
    """InputError unless each is 1 or -1."""
    if not np.isin(values, (1.0, -1.0)).all():
        raise InputError(f"polarities= must be 1 or -1, got {sorted(set(values.tolist()))}")
