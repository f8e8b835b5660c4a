"""SCOR in dimensionless terms, for bodies that are larger than the paper's.

SCOR's c1 = 0.1136 b/h - 0.0283 r + 0.0279 falls to zero for large bodies, and knows nothing of the
motion. What decides which way a body falls is its tilt over its slenderness, β/α, and how hard it
is pushed, x = p PGV/(g tan α), the velocity over the one that overturns it in a pulse. Here

    P(downhill) = 1/2 + c2 tanh(β/(α c)) ,   c = k x^m

with k, m and c2 fitted by maximum likelihood to which way each fall goes, and judged on events that
they were not fitted to. GCOR and SCOR are fitted anew in the same way, with the same
events left out, and to tell the form from what the motion says, SCOR with x, c1 times x^m, and this
curve without it, m = 0.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import C1, C2, SCOR, controlled_rate
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.resampling import ends, ratio, recordings_of, resamples
from shaketable.signal import peaks
from shaketable.simulate import simulate_many
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.boroschek_iruretagoyena_2006.printed import TABLE_1

LARGER = ((0.4, 2.0), (0.5, 2.0), (0.5, 2.5), (0.6, 3.0), (0.75, 3.0))  # m: half diagonals to 1.5 m
SCALES = (1.0, 2.0)
TILTS = np.radians(np.arange(0.5, 7.01, 1.0))
SMALLEST = 1e-3  # rad: SCOR's c1 of bodies for which it has none
ANEW = "dimensionless"


class FallsByGroup(NamedTuple):
    """Falls, alike ones counted together, arrays of shape (n,)."""

    slenderness: NDArray[np.float64]
    half_diagonal: NDArray[np.float64]
    tilt: NDArray[np.float64]
    push: NDArray[np.float64]  # x
    downhill: NDArray[np.int64]
    uphill: NDArray[np.int64]
    event: NDArray[np.intp]


class SizeCurve(NamedTuple):
    """Scores by bodies' size, and the curve fitted to all events."""

    scores: pd.DataFrame
    curve: pd.DataFrame


def simulations(motions: int) -> int:
    """How many simulations `falls_of` runs."""
    return int((len(TABLE_1) + len(LARGER)) * TILTS.size * len(SCALES) * 2 * motions)


def falls_of(
    motions: Sequence[Motion], event: NDArray[np.intp], done: Callable[[int], None]
) -> FallsByGroup:
    """Every body on every tilt under every motion; `event` is each recording's."""
    sizes = [(size.base, size.height) for size in TABLE_1] + list(LARGER)
    bodies = [Body.rectangle(*size) for size in sizes]
    runs = simulate_many(bodies, motions, tilts=TILTS, scales=SCALES, progress=done)
    outcome = runs.outcome.transpose("body", "motion", "tilt", "scale", "polarity").values
    down, up = ((outcome == which).sum(axis=-1) for which in (Outcome.DOWNHILL, Outcome.UPHILL))
    body, motion, tilt, scale = (index.ravel() for index in np.indices(down.shape))
    alpha = np.array([one.slenderness_left for one in bodies])
    r = np.array([float(np.hypot(*size)) / 2 for size in sizes])
    p = np.sqrt(3.0 * STANDARD_GRAVITY / (4.0 * r))
    pgv = np.array([peaks(one).velocity for one in motions])
    push = (
        p[body] * pgv[motion] * np.array(SCALES)[scale] / (STANDARD_GRAVITY * np.tan(alpha[body]))
    )
    fell = (down + up).ravel() > 0
    return FallsByGroup(
        *(
            each[fell]
            for each in (
                alpha[body],
                r[body],
                TILTS[tilt],
                push,
                down.ravel(),
                up.ravel(),
                event[recordings_of(motions)][motion],
            )
        )
    )


Terms = Sequence[float]


class FittedModel(NamedTuple):
    """A curve with terms to be fitted.

    Attributes:
        chance: P(downhill) of falls with its terms.
        start, bounds: of the search for the terms; the last one is c2.
    """

    chance: Callable[[FallsByGroup, Terms], NDArray[np.float64]]
    start: Terms
    bounds: Sequence[tuple[float, float]]


def general_curve(falls: FallsByGroup, terms: Terms) -> NDArray[np.float64]:
    """P(downhill) with c1 and c2."""
    return controlled_rate(falls.tilt, terms[0], terms[1])


def specific_curve(falls: FallsByGroup, terms: Terms) -> NDArray[np.float64]:
    """P(downhill) with the three terms of c1, and c2."""
    return specific_with_motion(falls, (*terms[:3], 0.0, terms[3]))


def specific_with_motion(falls: FallsByGroup, terms: Terms) -> NDArray[np.float64]:
    """P(downhill) with the three terms of c1, its power m of the motion's x, and c2."""
    by_width, by_size, constant, m, c2 = terms
    c1 = by_width * np.tan(falls.slenderness) + by_size * falls.half_diagonal + constant
    return controlled_rate(falls.tilt, np.maximum(c1, SMALLEST) * falls.push**m, c2)


def dimensionless(falls: FallsByGroup, terms: Terms) -> NDArray[np.float64]:
    """P(downhill) with k, m and c2."""
    k, m, c2 = terms
    return np.asarray(0.5 + c2 * np.tanh(falls.tilt / (falls.slenderness * k * falls.push**m)))


def without_motion(falls: FallsByGroup, terms: Terms) -> NDArray[np.float64]:
    """P(downhill) with k and c2 alone."""
    return dimensionless(falls, (terms[0], 0.0, terms[1]))


C2_BOUNDS = (0.1, 0.5)
C1_BOUNDS = ((-1.0, 1.0), (-1.0, 1.0), (-1.0, 1.0))
SCOR_PRINTED = (SCOR.width_ratio, SCOR.size, SCOR.constant, C2)
MODELS = {
    "GCOR fitted anew": FittedModel(general_curve, (C1, C2), ((SMALLEST, 1.0), C2_BOUNDS)),
    "SCOR fitted anew": FittedModel(specific_curve, SCOR_PRINTED, (*C1_BOUNDS, C2_BOUNDS)),
    "SCOR with the motion": FittedModel(
        specific_with_motion,
        (*SCOR_PRINTED[:3], 0.0, C2),
        (*C1_BOUNDS, (-3.0, 3.0), C2_BOUNDS),
    ),
    "dimensionless, without the motion": FittedModel(
        without_motion, (0.4, 0.48), ((1e-3, 10.0), C2_BOUNDS)
    ),
    ANEW: FittedModel(dimensionless, (0.4, -0.3, 0.48), ((1e-3, 10.0), (-3.0, 3.0), C2_BOUNDS)),
}


def fit(model: FittedModel, falls: FallsByGroup) -> list[float]:
    """The terms of largest likelihood."""
    from scipy.optimize import minimize

    def loss(terms: NDArray[np.float64]) -> float:
        p = np.clip(model.chance(falls, terms.tolist()), 1e-9, 1.0 - 1e-9)
        return -float((falls.downhill * np.log(p) + falls.uphill * np.log1p(-p)).mean())

    found = minimize(loss, model.start, method="L-BFGS-B", bounds=model.bounds)
    return [float(term) for term in found.x]


def left_out(model: FittedModel, falls: FallsByGroup) -> NDArray[np.float64]:
    """P(downhill) of every fall by terms that were fitted without its event."""
    chances = np.full(falls.tilt.size, np.nan)
    for one in np.unique(falls.event):
        here = falls.event == one
        terms = fit(model, FallsByGroup(*(each[~here] for each in falls)))
        chances[here] = model.chance(FallsByGroup(*(each[here] for each in falls)), terms)
    return chances


def cross_validated(
    motions: Sequence[Motion], event: NDArray[np.intp], done: Callable[[int], None], seed: int = 0
) -> SizeCurve:
    """Brier scores of the curves, for the paper's bodies and for larger ones.

    GCOR and SCOR are judged as printed, and every curve fitted to the other events than those that
    it predicts. By how much each is worse than the dimensionless one has the interval of a
    bootstrap over events.
    """
    falls = falls_of(motions, event, done)
    chances = {
        "GCOR as printed": general_curve(falls, (C1, C2)),
        "SCOR as printed": specific_curve(falls, SCOR_PRINTED),
        **{name: left_out(model, falls) for name, model in MODELS.items()},
    }
    largest = max(float(np.hypot(s.base, s.height)) / 2 for s in TABLE_1)
    larger = falls.half_diagonal > largest + 1e-9
    count = falls.downhill + falls.uphill
    squares = {
        name: falls.downhill * (1.0 - p) ** 2 + falls.uphill * p**2 for name, p in chances.items()
    }
    rows = []
    for bodies, here in (("table I", ~larger), ("larger", larger)):
        number = count[here].sum()
        by_event = np.bincount(falls.event[here], count[here])
        weights = resamples(by_event.size, seed=seed)
        for name, p in chances.items():
            worse = (squares[name] - squares[ANEW])[here]
            drawn = ratio(np.bincount(falls.event[here], worse), by_event, weights)
            low, high = ends(drawn[1:])
            rows.append(
                {
                    "bodies": bodies,
                    "curve": name,
                    "brier": float(squares[name][here].sum() / number),
                    "worse": float(drawn[0]),
                    "worse_low": low,
                    "worse_high": high,
                    "mean_predicted": float((p * count)[here].sum() / number),
                    "mean_found": float(falls.downhill[here].sum() / number),
                    "falls": int(number),
                    "events": int(np.unique(falls.event[here]).size),
                }
            )
    terms = fit(MODELS[ANEW], falls)
    curve = pd.DataFrame({"term": ("k", "m", "c2"), "value": terms})
    return SizeCurve(scores=pd.DataFrame(rows), curve=curve)
