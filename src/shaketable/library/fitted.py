"""Lognormal functions of a case's limit states, with β of motions, of the object and of the model.

The probability that a state is reached at an intensity x is Φ(ln(x/θ)/β): a probit regression on
ln x (Baker 2015). β holds what motions differ by and what was drawn of the object and the model.
`effects` tells how much of it was drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from shaketable.fragility.curve import GROUND, Curve
from shaketable.fragility.exported import word_of
from shaketable.fragility.limit_states import HELD_UP, OVERTURNS, REACHES, LimitState
from shaketable.fragility.lognormal import Points, fit_many, probability
from shaketable.library.case import Case
from shaketable.library.draws import Draws, draws_of
from shaketable.library.effects import Effects, effects_of, no_effects
from shaketable.library.measures import LibraryMeasure, levels_of, measure_of
from shaketable.library.shaken import CaseRuns, motions_under
from shaketable.library.states import has_state, reached
from shaketable.motion import Motion
from shaketable.resampling import events_of, nested_resamples, recording_names, recordings_of

DRAWS = 200
#: What cross-validation with 263 shake-table tests of two granite specimens asks for as noise of
#: the motions' ln (docs/explanation/validation.md): what the equations do not know of real bodies.
TESTS = 0.20
#: Share of runs that were given up while the thing still moved, above which a caution says so.
MOVING = 0.02
#: Share that was held up alone at one factor, above which the function of overturning says so.
MOST_HELD_UP = 0.05
#: By how much a function may exceed that of a state that includes its own without a caution.
CROSSES = 0.05
#: Parts of the simulations in which shares are compared with a function, and by how much they may
#: differ before a caution says so: some three standard errors of a share of 48 recordings' draws.
BINS, DEPARTS = 8, 0.1
LEVELS = 60  # at which two functions are compared


@dataclass(frozen=True, kw_only=True, eq=False)
class LibraryFunction:
    """A function of a library.

    Attributes:
        case, state, measure: whose it is.
        curve: the function; its β is that of motions, object and model together.
        effects: of what was drawn on ln θ.
        simulations: how many it was fitted to.
        moving: share of them that were given up while the thing still moved.
        held_up: largest share at one factor that a wall or a strap alone held up at the end.
        departs: largest difference between the function and the share that reaches the state, in
            BINS parts of the simulations.
        strongest: share that reaches it at the largest factor on the motions.
        scaled: the median over the strongest of the motions as recorded.
        crosses: by how much the function of overturning exceeds that of overturning or being held
            up.
    """

    case: Case
    state: LimitState
    measure: LibraryMeasure
    curve: Curve
    effects: Effects
    simulations: int
    moving: float
    held_up: float
    departs: float
    strongest: float
    scaled: float
    crosses: float = 0.0

    @property
    def identifier(self) -> str:
        """Of its case and its state: a name that every reader takes."""
        return f"{self.case.name}.{word_of(self.state.name)}"

    @cached_property
    def problem(self) -> str:
        """Why there is no such function; "" where there is one."""
        return self.curve.problem

    @cached_property
    def caution(self) -> str:
        """What is weak about it; "" if nothing is."""
        if self.problem:
            return ""
        said = [self.curve.caution] if self.curve.caution else []
        if self.strongest < 0.5 and self.state.kind == REACHES:
            said.append(
                f"only {self.strongest:.0%} reach the state at the strongest shaking, and more "
                "need not do so at any level, as things fall to all sides: it is not lognormal"
            )
        elif self.strongest < 0.5:
            said.append(
                f"only {self.strongest:.0%} reach the state at the strongest shaking: the upper "
                "part of the curve is an extrapolation"
            )
        if self.departs > DEPARTS:
            said.append(
                f"the share of simulations that reach the state departs from the function by up to "
                f"{self.departs:.0%}: it is not lognormal"
            )
        if self.state.kind == OVERTURNS and self.held_up > MOST_HELD_UP:
            said.append(
                f"at one factor on the motions {self.held_up:.0%} of the simulations end held up "
                f"by the wall or the strap alone, and have not overturned: see {HELD_UP!r}"
            )
        if self.crosses > CROSSES:
            said.append(
                f"it is up to {self.crosses:.0%} below the function of {OVERTURNS!r}, which it "
                "includes: take the larger of both"
            )
        if self.scaled > 1.0:
            said.append(
                f"the median is {self.scaled:.1f} times the strongest motion as recorded: it rests "
                "on scaled motions"
            )
        if self.moving > MOVING:
            said.append(
                f"{self.moving:.0%} of the simulations were given up while the thing still moved"
            )
        return "; ".join(said)


class Shaking:
    """The motions of a library, with what is computed from them once."""

    def __init__(self, ground: Sequence[Motion], draws: int = DRAWS, seed: int = 0) -> None:
        """The motions of the ground, and how many draws of a bootstrap over their earthquakes."""
        self.ground = ground
        self.recording = recordings_of(ground)
        self.event = events_of(ground, self.recording)
        self.names = recording_names(ground)
        self.weights = nested_resamples(self.event, draws, seed)
        self._levels: dict[tuple[str, str], NDArray[np.float64]] = {}

    def levels(self, case: Case, measure: LibraryMeasure) -> NDArray[np.float64]:
        """A measure of each motion, of the ground or of a case's floor [SI], (motion,)."""
        place = case.stand.name if measure.of_floor else GROUND
        key = measure.measure.name, place
        if key not in self._levels:
            motions = motions_under(case, self.ground) if measure.of_floor else self.ground
            self._levels[key] = levels_of(measure.measure, motions)
        return self._levels[key]


def functions_of_case(
    case: Case,
    runs: CaseRuns,
    shaking: Shaking,
    *,
    states: Sequence[LimitState],
    measures: Sequence[str],
    seed: int = 0,
) -> list[LibraryFunction]:
    """The functions of a case, of each of its states and measures.

    Args:
        case: which.
        runs: its simulations.
        shaking: the motions.
        states, measures: those of the library.
        seed: with which its things were drawn.
    """
    motions = len(shaking.ground)
    draws = draws_of(case, case.held.draws * motions, seed)
    found = []
    for name in measures:
        measure = measure_of(name)
        if measure.of_floor and case.stand.building is None:
            continue
        once = shaking.levels(case, measure)
        level = once[runs.draw % motions] * runs.scale ** (measure.measure.power or 1)
        of_measure = [
            _fitted(case, state, measure, level, runs, draws, shaking)
            for state in states
            if has_state(case, state)
        ]
        found += _crossed(of_measure, once, level)
    return found


def _crossed(
    functions: list[LibraryFunction], once: NDArray[np.float64], level: NDArray[np.float64]
) -> list[LibraryFunction]:
    """The functions of a case and measure, with how far they rest on scaled motions, and cross.

    Each state is fitted by itself, so that what overturns or is held up may seem rarer than what
    overturns.
    """
    found = [replace(one, scaled=one.curve.median / float(once.max())) for one in functions]
    by_kind = {one.state.kind: k for k, one in enumerate(found) if not one.problem}
    if OVERTURNS in by_kind and HELD_UP in by_kind:
        falls, either = (found[by_kind[kind]].curve for kind in (OVERTURNS, HELD_UP))
        levels = np.geomspace(level.min(), level.max(), LEVELS)
        more = float((falls.probability(levels) - either.probability(levels)).max())
        found[by_kind[HELD_UP]] = replace(found[by_kind[HELD_UP]], crosses=more)
    return found


def _fitted(
    case: Case,
    state: LimitState,
    measure: LibraryMeasure,
    level: NDArray[np.float64],
    runs: CaseRuns,
    draws: Draws,
    shaking: Shaking,
) -> LibraryFunction:
    """One function."""
    motions = len(shaking.ground)
    happened = reached(state, runs)
    points = Points(
        level, happened.astype(np.int64), np.ones(level.size, np.int64),
        shaking.recording[runs.draw % motions],
    )  # fmt: skip
    curve = Curve(
        body=draws.each[0].solid,
        state=state,
        measure=measure.measure,
        fits=fit_many(points, shaking.weights),
        data=points,
        falls=None,
        recording_names=shaking.names,
        event=shaking.event,
        place=f"floor {case.stand.floor}" if measure.of_floor else GROUND,
        more_beta=TESTS,
    )
    known = not curve.problem
    event = shaking.event[points.recording]
    return LibraryFunction(
        case=case,
        state=state,
        measure=measure,
        curve=curve,
        effects=effects_of(points, draws, runs.draw, event) if known else no_effects(draws),
        simulations=level.size,
        moving=float(runs.moving.mean()),
        held_up=max(
            float(runs.held_up[runs.scale == each].mean()) for each in np.unique(runs.scale)
        ),
        departs=_departure(curve, points) if known else np.nan,
        strongest=float(happened[runs.scale == runs.scale.max()].mean()),
        scaled=np.nan,
    )


def _departure(curve: Curve, points: Points) -> float:
    """The largest difference of shares and function, in parts of as many simulations each."""
    told = probability(points.intensity, curve.fits.median[:1], curve.fits.beta[:1])
    order = np.argsort(points.intensity, kind="stable")
    return max(
        abs(float(points.reached[some].mean() - told[some].mean()))
        for some in np.array_split(order, BINS)
    )
