"""Checks of the input before anything is simulated."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, joined
from shaketable.lazy_motions import Head, LazyMotions, heads_of
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.motion_file import in_temporary_file
from shaketable.solid import Solid
from shaketable.units import degrees

log = logging.getLogger(__name__)

T = TypeVar("T")

_HOW: dict[type, str] = {
    Solid: "a Solid, such as Solid.box(0.3, 0.8, 1.8), and not a planar Body beside it",
    Body: "a Body, such as Body.rectangle(0.3, 1.8)",
    Motion: "a Motion: read one with read_motion(path), take a suite(name), or make one from "
    "an array with Motion(array, time_step)",
}


def listed(name: str, values: object, kind: type[T], how: str = "") -> list[T]:
    """The values as a list of objects of one kind.

    Args:
        name: of the argument that they were given as.
        values: any object.
        kind: the class that each must have.
        how: what to say of an object of that class; known for bodies and motions.

    Raises:
        InputError: one object instead of a list, a path, an array, or another kind of object.
    """
    word, how = kind.__name__.lower(), how or _HOW[kind]
    if isinstance(values, kind):
        raise InputError(f"{name}= takes a list: for one {word} write {name}=[{word}]")
    if isinstance(values, (str, bytes, Path, np.ndarray)) or not isinstance(values, Iterable):
        raise InputError(f"{name}= takes a list, each entry {how}; got {_told(values)}")
    found = list(values)
    for index, value in enumerate(found):
        if not isinstance(value, kind):
            raise InputError(f"{name}[{index}] must be {how}; got {_told(value)}")
    if not found:
        raise InputError(f"{name}= is empty; at least one {word} is needed")
    return found


def motions_of(motions: Iterable[Motion]) -> Sequence[Motion]:
    """Motions as a list; lazy ones as they are; those of a generator in a temporary file.

    Raises:
        InputError: what `listed` says.
    """
    if isinstance(motions, Iterator):
        motions = in_temporary_file(motions)
    if isinstance(motions, LazyMotions) and len(motions):
        return motions
    return listed("motions", motions, Motion)


def require_kind(name: str, value: object, kind: type[Body] | type[Motion]) -> None:
    """InputError unless the value is one body or one motion."""
    if not isinstance(value, kind):
        raise InputError(f"{name} must be {_HOW[kind]}; got {_told(value)}")


def _told(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    if isinstance(value, (str, Path)):
        return f"the path {str(value)!r}"
    return f"an object of type {type(value).__name__}"


def stand(bodies: Sequence[Body], tilts: ArrayLike) -> NDArray[np.bool_]:
    """Whether each body stands by itself; arguments as for `require_stable`."""
    low, high = np.array([body.standing_range for body in bodies]).T
    tilt = np.asarray(tilts, np.float64)
    return np.asarray((low < tilt) & (tilt < high))


def require_stable(bodies: Sequence[Body], tilts: ArrayLike) -> None:
    """InputError naming each body that falls by itself on a tilt.

    Args:
        bodies: those that stand on supports.
        tilts: β [rad], one for all or one for each body.
    """
    tilt = np.broadcast_to(np.asarray(tilts, np.float64), len(bodies))
    low, high = np.array([body.standing_range for body in bodies]).T
    faults = []
    for index in np.flatnonzero(~stand(bodies, tilt)).tolist():
        limit, arm = (high, "left") if tilt[index] > 0.0 else (low, "right")
        faults.append(
            f"body {bodies[index].name or index}: falls by itself on a support tilted by "
            f"{degrees(tilt[index]):.4g}°; it stands below {degrees(abs(limit[index])):.4g}° = "
            f"atan({arm} / cg_height)"
        )
    if faults:
        raise InputError(joined(faults))


def warn(model: Model, tilts: Iterable[float], motions: Iterable[Motion]) -> None:
    """Log the model's warnings about tilts [rad], of the steepest one, and what motions lose."""
    across = sum(head.has_transverse for head in heads_of(motions))
    if across:
        log.warning(
            "the transverse components of %d motions are not felt: a planar body moves in one "
            "vertical plane",
            across,
        )
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


def unique_names(
    things: Sequence[Body] | Sequence[Solid] | Sequence[Motion] | Sequence[Head],
) -> list[str]:
    """Their names, with a number where two share one or one has none."""
    given = [thing.name for thing in things]
    if all(given) and len(set(given)) == len(given):
        return given
    return [f"{name or 'unnamed'} #{index}" for index, name in enumerate(given)]
