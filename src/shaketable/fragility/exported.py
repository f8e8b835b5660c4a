"""What is exported: functions under names that every reader takes, in words and in its units."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, named
from shaketable.fragility.curve import GROUND, Curve
from shaketable.fragility.intensities import OWN
from shaketable.fragility.limit_states import OVERTURNS, LimitState
from shaketable.fragility.lognormal import probability
from shaketable.fragility.shown import MeasureUnit
from shaketable.models import Model
from shaketable.signal import Measure
from shaketable.surroundings import Surroundings, told_surroundings
from shaketable.units import degrees

log = logging.getLogger(__name__)

MOST_NAMED = 5
SEEN = (0.01, 0.99)  # probabilities between which functions of one body must not cross


class Fitted(Protocol):
    """What planar functions are exported from: a `Fragility`."""

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


@dataclass(frozen=True)
class Function:
    """A lognormal function as readers take it.

    Attributes:
        state: what is reached.
        median: θ [SI].
        beta: the standard deviation of the logarithm, of all that it holds.
        caution: what is weak about it; "" if nothing is.
        sides: the share of the falls to each side, in words; empty where one is not told.
    """

    state: LimitState
    median: float
    beta: float
    caution: str = ""
    sides: Mapping[str, float] = field(default_factory=dict)

    def probability(self, levels: ArrayLike) -> NDArray[np.float64]:
        """That the state is reached at levels [SI]."""
        return probability(
            np.asarray(levels, np.float64), np.array(self.median), np.array(self.beta)
        )


@dataclass(frozen=True)
class Functions:
    """The functions of one body or thing, from the mildest state to the worst.

    Attributes:
        identifier: a name that every reader takes.
        name: what it is called.
        about: what it is and where it stands, in a sentence or some.
        curves: the functions.
    """

    identifier: str
    name: str
    about: str
    curves: tuple[Function, ...]


@dataclass(frozen=True, kw_only=True)
class Export:
    """All that is written for a reader.

    Attributes:
        functions: of each body or thing.
        measure: of the motion.
        place: whose motion that is: GROUND, or a floor.
        through_building: whether the building is in the functions of the ground's measure.
        description: what a reader should know of them.
        title: what they are called.
    """

    functions: tuple[Functions, ...]
    measure: Measure
    place: str = GROUND
    through_building: bool = False
    description: str = ""
    title: str = "shaketable"

    def require_ground(self, other: str) -> None:
        """InputError where the measure is that of a floor's motion, and `other` of the ground's."""
        if self.place != GROUND:
            raise InputError(
                f"the fragility function is of {self.measure.name} on {self.place}, {other} of "
                "that of the ground: give the ground's motions to fragility(..., ground=...)"
            )


def identifier_of(text: str) -> str:
    """A name of letters, digits, dots and underscores, which every reader takes."""
    plain = text.replace("α", "alpha").replace("°", "deg")
    return re.sub(r"[^A-Za-z0-9.]+", "_", plain).strip("_.") or "body"


def word_of(text: str) -> str:
    """A name of letters, digits and underscores alone."""
    return identifier_of(text).replace(".", "_")


def export_of(fragility: Fitted) -> Export:
    """What is exported of fragility functions of planar bodies; what has none is told.

    Raises:
        InputError: no body has functions of all states.
    """
    count = len(fragility.states)
    found: dict[str, list[Function]] = {}
    about, left_out = {}, []
    for k, name in enumerate(fragility.bodies):
        curves = fragility.curves[k * count : (k + 1) * count]
        if any(curve.problem for curve in curves):
            left_out.append(name)
            continue
        body = curves[0].body
        assert isinstance(body, Body)
        about[name] = (
            f"Base {body.base:.4g} m in the plane of the shaking, centre of gravity at "
            f"{body.cg_height:.4g} m. The demand is {demand_of(fragility)}."
        )
        found[name] = [
            Function(curve.state, curve.median, curve.beta, curve.caution, _sides(curve))
            for curve in curves
        ]
    if not found:
        reasons = dict.fromkeys(curve.problem for curve in fragility.curves if curve.problem)
        raise InputError(f"nothing can be exported: {named(list(reasons), MOST_NAMED)}")
    warn_of_left_out(left_out, len(fragility.bodies))
    return Export(
        functions=tuple(ordered(found, about)),
        measure=fragility.measure,
        place=fragility.curves[0].place,
        through_building=fragility.through_building,
        description=description_of(fragility),
    )


def ordered(
    functions: Mapping[str, Sequence[Function]], about: Mapping[str, str]
) -> Iterable[Functions]:
    """The functions of each name, the mildest first, under identifiers that differ."""
    taken = set[str]()
    for name, curves in functions.items():
        by_severity = tuple(sorted(curves, key=lambda curve: curve.median))
        _warn_of_crossing(name, by_severity)
        identifier = identifier_of(name)
        while identifier in taken:
            identifier += "_"
        taken.add(identifier)
        yield Functions(identifier, name, about[name], by_severity)


def warn_of_left_out(names: Sequence[str], count: int) -> None:
    """Tell which of so many have no functions of all states."""
    if names:
        log.warning(
            "%d of %d bodies are not exported, as a state of theirs has no fit: %s",
            len(names),
            count,
            named(names, MOST_NAMED),
        )


def _sides(curve: Curve) -> dict[str, float]:
    """The shares of falls to each side, where both are there; they sum to 1 in six digits."""
    if curve.state.kind != OVERTURNS or not 0.0 < curve.downhill < 1.0:
        return {}
    share = round(curve.downhill, 6)
    if not 0.0 < share < 1.0:
        return {}
    return {"downhill, toward -x": share, "uphill, toward +x": 1.0 - share}


def _warn_of_crossing(body: str, curves: Sequence[Function]) -> None:
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


def description_of(fragility: Fitted) -> str:
    """What a reader should know of the functions."""
    curve = fragility.curves[0]
    cautions = "".join(
        f"; {each}" for each in dict.fromkeys(c.caution for c in fragility.curves if c.caution)
    )
    more = f"; β with {curve.more_beta:g} for what is not known" if curve.more_beta else ""
    return (
        f"Unanchored rigid bodies under {fragility.motions} motions of {curve.recordings} "
        f"recordings of {curve.events} earthquakes, by {fragility.method}; {fragility.model!r}; "
        f"{fragility.measure.name} in {{unit}}, {demand_of(fragility)}{more}{cautions}"
    )


def demand_of(fragility: Fitted) -> str:
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
