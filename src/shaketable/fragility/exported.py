"""What the exports share: which functions can be written, under which names and in which units."""

from __future__ import annotations

import logging
import re
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np

from shaketable.errors import InputError, named
from shaketable.fragility.curve import GROUND, Curve
from shaketable.fragility.intensities import OWN
from shaketable.fragility.limit_states import LimitState
from shaketable.fragility.shown import MeasureUnit
from shaketable.models import Model
from shaketable.signal import Measure
from shaketable.surroundings import Surroundings, told_surroundings
from shaketable.units import degrees

log = logging.getLogger(__name__)

MOST_NAMED = 5
SEEN = (0.01, 0.99)  # probabilities between which functions of one body must not cross


class Exported(Protocol):
    """What is exported: a `Fragility`."""

    @property
    def curves(self) -> tuple[Curve, ...]: ...
    @property
    def bodies(self) -> tuple[str, ...]: ...
    @property
    def states(self) -> tuple[LimitState, ...]: ...
    @property
    def measure(self) -> Measure: ...
    @property
    def method(self) -> str: ...
    @property
    def model(self) -> Model: ...
    @property
    def motions(self) -> int: ...
    @property
    def tilt(self) -> float: ...
    @property
    def components(self) -> str: ...
    @property
    def surroundings(self) -> tuple[Surroundings | None, ...]: ...
    @property
    def through_building(self) -> bool: ...


class Functions(NamedTuple):
    """The functions of one body, from the mildest state to the worst."""

    identifier: str
    body: str
    curves: tuple[Curve, ...]


def identifier_of(text: str) -> str:
    """A name of letters, digits, dots and underscores, which every reader takes."""
    plain = text.replace("α", "alpha").replace("°", "deg")
    return re.sub(r"[^A-Za-z0-9.]+", "_", plain).strip("_.") or "body"


def word_of(text: str) -> str:
    """A name of letters, digits and underscores alone."""
    return identifier_of(text).replace(".", "_")


def functions_of(fragility: Exported) -> list[Functions]:
    """The functions of every body that has them for all states; the others are told.

    Raises:
        InputError: no body has.
    """
    count = len(fragility.states)
    found, left_out, taken = [], [], set[str]()
    for k, body in enumerate(fragility.bodies):
        curves = fragility.curves[k * count : (k + 1) * count]
        if any(curve.problem for curve in curves):
            left_out.append(body)
            continue
        ordered = tuple(sorted(curves, key=lambda curve: curve.median))
        _warn_of_crossing(body, ordered)
        name = identifier_of(body)
        while name in taken:
            name += "_"
        taken.add(name)
        found.append(Functions(name, body, ordered))
    if left_out:
        log.warning(
            "%d of %d bodies are not exported, as a state of theirs has no fit: %s",
            len(left_out),
            len(fragility.bodies),
            named(left_out, MOST_NAMED),
        )
    if not found:
        reasons = dict.fromkeys(curve.problem for curve in fragility.curves if curve.problem)
        raise InputError(f"nothing can be exported: {named(list(reasons), MOST_NAMED)}")
    return found


def _warn_of_crossing(body: str, curves: Sequence[Curve]) -> None:
    """Tell where a worse state would be more likely than a milder one."""
    for milder, worse in pairwise(curves):
        levels = worse.median * np.exp(worse.beta * np.linspace(-2.5, 2.5, 101))
        mild, bad = milder.probability(levels), worse.probability(levels)
        seen = (bad > SEEN[0]) & (mild < SEEN[1])
        if (seen & (bad > mild + 1e-6)).any():
            log.warning(
                "%s: the functions of %s and %s cross, as they were fitted each by itself; readers "
                "take the worse state as never more likely than the milder one",
                body,
                milder.state.name,
                worse.state.name,
            )


def unit_of(measure: Measure, units: dict[str, MeasureUnit], reader: str) -> MeasureUnit:
    """The reader's unit of a measure.

    Raises:
        InputError: the reader knows no such measure.
    """
    kind = measure.name.split("(")[0]
    if kind not in units:
        raise InputError(f"{reader} knows no measure {measure.name}; it takes {', '.join(units)}")
    return units[kind]


def demand_of(fragility: Exported) -> str:
    """Of which motion the measure is, in words."""
    components = (
        "one horizontal direction"
        if fragility.components == OWN
        else f"both horizontal directions, by their {fragility.components}"
    )
    place = fragility.curves[0].place
    under = "the ground" if place == GROUND else f"{place}, under the body"
    under += (
        ", with the body on a floor of a building above it" if fragility.through_building else ""
    )
    tilted = f", on a support tilted by {degrees(fragility.tilt):.3g}°" if fragility.tilt else ""
    held = told_surroundings(fragility.surroundings)
    held = f", surrounded by {held}" if held else ""
    return f"of {components} of {under}{tilted}{held}"
