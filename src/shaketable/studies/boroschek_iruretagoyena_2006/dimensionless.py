"""SCOR in dimensionless terms, for bodies that are larger than the paper's.

SCOR's c1 = 0.1136 b/h - 0.0283 r + 0.0279 falls to zero for large bodies, and knows nothing of the
motion. What decides which way a body falls is its tilt over its slenderness, β/α, and how hard it
is pushed, x = p PGV/(g tan α), the velocity over the one that overturns it in a pulse. Here

    P(downhill) = 1/2 + c2 tanh(β/(α c)) ,   c = k x^m

with k, m and c2 fitted by maximum likelihood to which way each fall goes, and judged on events that
they were not fitted to.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import C1, SCOR, controlled_rate
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.resampling import recordings_of
from shaketable.signal import peaks
from shaketable.simulate import simulate_many
from shaketable.studies.boroschek_iruretagoyena_2006.printed import TABLE_1
from shaketable.units import STANDARD_GRAVITY

LARGER = ((0.4, 2.0), (0.5, 2.0), (0.5, 2.5), (0.6, 3.0), (0.75, 3.0))  # m: half diagonals to 1.5 m
SCALES = (1.0, 2.0)
TILTS = np.radians(np.arange(0.5, 7.01, 1.0))
START = (0.4, -0.3, 0.48)
SMALLEST = 1e-3  # rad: SCOR's c1 of bodies for which it has none
PRINTED, ANEW, GENERAL = "SCOR as printed", "dimensionless", "GCOR as printed"


class Falls(NamedTuple):
    """Falls, alike ones counted together, arrays of shape (n,)."""

    slenderness: NDArray[np.float64]
    half_diagonal: NDArray[np.float64]
    tilt: NDArray[np.float64]
    push: NDArray[np.float64]  # x
    downhill: NDArray[np.int64]
    uphill: NDArray[np.int64]
    event: NDArray[np.intp]


class Curve(NamedTuple):
    """Scores by bodies' size, and the curve fitted to all events."""

    scores: pd.DataFrame
    curve: pd.DataFrame


def simulations(motions: int) -> int:
    """How many simulations `falls_of` runs."""
    return int((len(TABLE_1) + len(LARGER)) * TILTS.size * len(SCALES) * 2 * motions)


def falls_of(
    motions: Sequence[Motion], event: NDArray[np.intp], done: Callable[[int], None]
) -> Falls:
    """Every body on every tilt under every motion; `event` is each recording's."""
    sizes = [(size.width, size.height) for size in TABLE_1] + list(LARGER)
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
    return Falls(
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


def chance(falls: Falls, terms: Sequence[float]) -> NDArray[np.float64]:
    """P(downhill) with k, m and c2."""
    k, m, c2 = terms
    return np.asarray(0.5 + c2 * np.tanh(falls.tilt / (falls.slenderness * k * falls.push**m)))


def fit(falls: Falls) -> tuple[float, float, float]:
    """k, m and c2 of largest likelihood."""
    from scipy.optimize import minimize

    def loss(terms: NDArray[np.float64]) -> float:
        p = np.clip(chance(falls, terms.tolist()), 1e-9, 1.0 - 1e-9)
        return -float((falls.downhill * np.log(p) + falls.uphill * np.log1p(-p)).sum())

    found = minimize(loss, START, method="L-BFGS-B", bounds=((1e-3, 10.0), (-3.0, 3.0), (0.1, 0.5)))
    return float(found.x[0]), float(found.x[1]), float(found.x[2])


def cross_validated(
    motions: Sequence[Motion], event: NDArray[np.intp], done: Callable[[int], None]
) -> Curve:
    """Brier scores of three curves, for the paper's bodies and for larger ones.

    The dimensionless curve predicts each event from the others; the printed ones are as they are.
    """
    falls = falls_of(motions, event, done)
    ratio = np.tan(falls.slenderness)
    c1 = SCOR.width_ratio * ratio + SCOR.size * falls.half_diagonal + SCOR.constant
    chances = {
        GENERAL: controlled_rate(falls.tilt, C1),
        PRINTED: controlled_rate(falls.tilt, np.maximum(c1, SMALLEST)),
        ANEW: np.full(falls.tilt.size, np.nan),
    }
    for one in np.unique(falls.event):
        here = falls.event == one
        terms = fit(Falls(*(each[~here] for each in falls)))
        chances[ANEW][here] = chance(Falls(*(each[here] for each in falls)), terms)
    largest = max(float(np.hypot(s.width, s.height)) / 2 for s in TABLE_1)
    larger = falls.half_diagonal > largest + 1e-9
    count = falls.downhill + falls.uphill
    rows = []
    for bodies, here in (("table I", ~larger), ("larger", larger)):
        for name, p in chances.items():
            squares = falls.downhill * (1.0 - p) ** 2 + falls.uphill * p**2
            mean = float((p * count)[here].sum() / count[here].sum())
            rows.append(
                {
                    "bodies": bodies,
                    "curve": name,
                    "brier": float(squares[here].sum() / count[here].sum()),
                    "mean_predicted": mean,
                    "mean_found": float(falls.downhill[here].sum() / count[here].sum()),
                    "falls": int(count[here].sum()),
                    "events": int(np.unique(falls.event[here]).size),
                }
            )
    terms = fit(falls)
    curve = pd.DataFrame({"term": ("k", "m", "c2"), "value": terms})
    return Curve(scores=pd.DataFrame(rows), curve=curve)
