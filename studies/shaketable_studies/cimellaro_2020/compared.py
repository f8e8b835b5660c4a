"""A risk surface that knows size and velocity, beside the published ones.

Furniture of many sizes under the recorded motions of FEMA P-695 at several scales: which model
predicts best what falls? Every model that is fitted here is judged on recordings that it was not
fitted to. FEMA P-58's fragilities (peak floor velocity, log-standard deviation 0.5) cover only a
few pieces of furniture, and are judged on these.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004, shaketable_2026
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.resampling import ends, ratio, recordings_of, resamples
from shaketable.signal import peaks
from shaketable.simulate import simulate_many

HEIGHTS = (0.5, 1.0, 1.8, 3.0)  # m
RATIOS = (0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40, 0.45)  # B/H
SCALES = (0.3, 0.6, 1.0, 1.5)
FOLDS = 10
#: FEMA P-58: depth and height [m] of furniture, and the median peak floor velocity [m/s].
FEMA = {
    (0.321, 0.737): 0.724,
    (0.321, 1.041): 0.493,
    (0.321, 1.422): 0.361,
    (0.321, 1.803): 0.290,
    (0.321, 2.064): 0.251,
    (0.381, 0.610): 1.229,
    (0.381, 1.321): 0.498,
    (0.472, 1.334): 0.688,
    (0.472, 1.721): 0.526,
}
FEMA_BETA = 0.5
KANEKO, KANEKO_REFIT = "Kaneko & Hayashi", "Kaneko & Hayashi, ζ fitted"
CIMELLARO, FEMA_NAME = "Cimellaro, eq. 9", "FEMA P-58"
LOGISTIC, BOOSTED = "logistic in the smaller demand", "boosted, monotone in both demands"


@dataclass(frozen=True, eq=False)
class Samples:
    """Every body under every motion at every scale, in flat arrays.

    Falls are counted over both directions of a motion, 0 to 2.
    """

    width: NDArray[np.float64]
    height: NDArray[np.float64]
    pfa: NDArray[np.float64]
    pfv: NDArray[np.float64]
    recording: NDArray[np.intp]
    falls: NDArray[np.int64]

    @property
    def measures(self) -> shaketable_2026.Measures:
        inertia = np.hypot(self.width, self.height) / np.sqrt(12.0)
        return shaketable_2026.measures(
            self.width, 0.5, self.height / 2, inertia, self.pfa, self.pfv
        )


class Comparison(NamedTuple):
    """Tables: scores and calibration of every model, ζ fitted anew, the logistic surface, FEMA's.

    `worse` is eq. 9's Brier score less Kaneko and Hayashi's on the grid, and its interval.
    """

    scores: pd.DataFrame
    calibration: pd.DataFrame
    deviations: pd.DataFrame
    rule: pd.DataFrame
    fema: pd.DataFrame
    worse: tuple[float, float, float]


def trials(
    sizes: Sequence[tuple[float, float]], motions: Sequence[Motion], done: Callable[[int], None]
) -> Samples:
    """Simulate rectangles of those widths and heights [m]."""
    bodies = [Body.rectangle(width, height) for width, height in sizes]
    runs = simulate_many(bodies, motions, scales=SCALES, progress=done)
    outcome = runs.outcome.isel(tilt=0).transpose("body", "motion", "scale", "polarity").values
    falls = (outcome != Outcome.STANDING).sum(axis=3)
    body, motion, scale = (index.ravel() for index in np.indices(falls.shape))
    found = [peaks(one) for one in motions]
    factor = np.array(SCALES)[scale]
    return Samples(
        width=np.array([size[0] for size in sizes])[body],
        height=np.array([size[1] for size in sizes])[body],
        pfa=factor * np.array([one.acceleration for one in found])[motion],
        pfv=factor * np.array([one.velocity for one in found])[motion],
        recording=recordings_of(motions)[motion],
        falls=falls.ravel(),
    )


def simulations(motions: int) -> int:
    """How many simulations `compare` runs."""
    return 2 * motions * len(SCALES) * (len(HEIGHTS) * len(RATIOS) + len(FEMA))


def compare(motions: Sequence[Motion], done: Callable[[int], None]) -> Comparison:
    """Every model on the grid of sizes and on FEMA P-58's furniture."""
    grid = trials([(h * ratio, h) for h in HEIGHTS for ratio in RATIOS], motions, done)
    furniture = trials(list(FEMA), motions, done)
    zeta = fitted_deviations(grid)
    scores, calibrations = [], []
    held_out = _held_out(grid, furniture)
    for where, cases in (("grid of sizes", grid), ("FEMA P-58 furniture", furniture)):
        chances = _published(cases)
        if cases is furniture:
            chances[FEMA_NAME] = _fema(cases)
        chances |= {name: each[cases is furniture] for name, each in held_out.items()}
        for name, chance in chances.items():
            scores.append({"model": name, "bodies": where, **_scored(chance, cases.falls)})
            calibrations.append(_calibration(chance, cases.falls).assign(model=name, bodies=where))
    deviations = pd.DataFrame(
        {
            "deviation": ["zeta_a", "zeta_v"],
            "default": [kaneko_hayashi_2004.ZETA_A, kaneko_hayashi_2004.ZETA_V],
            "fitted": zeta,
        }
    )
    return Comparison(
        scores=pd.DataFrame(scores),
        calibration=pd.concat(calibrations, ignore_index=True),
        deviations=deviations,
        rule=fitted_rule(grid),
        fema=fema_medians(furniture),
        worse=_worse(grid),
    )


def fema_medians(furniture: Samples) -> pd.DataFrame:
    """FEMA P-58's median velocities beside Kaneko and Hayashi's V50 and those of our falls.

    Ours are lognormal fragilities of the peak velocity, of largest likelihood, of all that shook
    the piece at any scale.
    """
    from scipy.optimize import minimize
    from scipy.special import log_ndtr

    rows = []
    for (width, height), printed in FEMA.items():
        here = (furniture.width == width) & (furniture.height == height)
        x, falls = np.log(furniture.pfv[here]), furniture.falls[here]

        def loss(
            p: NDArray[np.float64],
            x: NDArray[np.float64] = x,
            falls: NDArray[np.int64] = falls,
        ) -> float:
            z = (x - p[0]) / np.exp(p[1])
            return -float((falls * log_ndtr(z) + (2 - falls) * log_ndtr(-z)).sum())

        found = minimize(loss, (np.log(printed), np.log(FEMA_BETA)), method="Nelder-Mead")
        typical = float(kaneko_hayashi_2004.median_velocity(width, height))
        rows.append(
            {
                "depth_m": width,
                "height_m": height,
                "fema_median_m_s": printed,
                "fema_beta": FEMA_BETA,
                "kaneko_hayashi_v50_m_s": typical,
                "fema_over_v50": printed / typical,
                "our_median_m_s": float(np.exp(found.x[0])),
                "our_beta": float(np.exp(found.x[1])),
                "ours_over_fema": float(np.exp(found.x[0])) / printed,
                "falls": int(falls.sum()),
            }
        )
    return pd.DataFrame(rows)


def _worse(cases: Samples) -> tuple[float, float, float]:
    """Eq. 9's Brier score less Kaneko and Hayashi's, with a bootstrap over recordings."""
    chances = _published(cases)
    share = cases.falls / 2.0
    squares = {
        name: share * (1 - chance) ** 2 + (1 - share) * chance**2
        for name, chance in chances.items()
    }
    groups = int(cases.recording.max()) + 1
    off = np.bincount(cases.recording, squares[CIMELLARO] - squares[KANEKO], groups)
    count = np.bincount(cases.recording, minlength=groups)
    draws = ratio(off, count, resamples(groups))
    return float(draws[0]), *ends(draws[1:])


def fitted_deviations(
    cases: Samples, chosen: NDArray[np.bool_] | None = None
) -> tuple[float, float]:
    """Maximum-likelihood ζ_A and ζ_V, each from the cases of its branch, all or only the chosen."""
    from scipy.optimize import minimize_scalar
    from scipy.special import log_ndtr

    a, v = kaneko_hayashi_2004.demands(cases.width, cases.height, cases.pfa, cases.pfv)
    found = []
    taken = np.ones(a.size, np.bool_) if chosen is None else chosen
    for demand, here in ((a, taken & (a <= v)), (v, taken & (a > v))):
        z, falls = demand[here], cases.falls[here]

        def loss(
            zeta: float, z: NDArray[np.float64] = z, falls: NDArray[np.int64] = falls
        ) -> float:
            likely = falls * log_ndtr(z / zeta) + (2 - falls) * log_ndtr(-z / zeta)
            return -float(likely.sum())

        found.append(float(minimize_scalar(loss, bounds=(0.05, 2.0), method="bounded").x))
    return found[0], found[1]


def _published(cases: Samples) -> dict[str, NDArray[np.float64]]:
    sizes = (cases.width, cases.height, cases.pfa, cases.pfv)
    return {
        KANEKO: kaneko_hayashi_2004.overturning_ratio(*sizes),
        CIMELLARO: cimellaro_2020.overturning_ratio(cases.width / cases.height, cases.pfa),
    }


def _fema(cases: Samples) -> NDArray[np.float64]:
    """Lognormal fragilities of the peak floor velocity."""
    from scipy.special import ndtr

    medians = np.array(
        [FEMA[width, height] for width, height in zip(cases.width, cases.height, strict=True)]
    )
    return np.asarray(ndtr(np.log(cases.pfv / medians) / FEMA_BETA))


def _held_out(
    grid: Samples, furniture: Samples
) -> dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Chances for both sets, by models that were fitted to the grid under other recordings."""
    from sklearn.ensemble import HistGradientBoostingClassifier
    from sklearn.linear_model import LogisticRegression
    from sklearn.model_selection import GroupKFold
    from threadpoolctl import threadpool_limits

    sets = (grid, furniture)
    models: dict[str, tuple[int, Callable[[], Any]]] = {  # how many of the demands they take
        LOGISTIC: (1, partial(LogisticRegression, C=1e6, max_iter=1000)),
        BOOSTED: (
            2,
            partial(
                HistGradientBoostingClassifier, monotonic_cst=[1, 1], max_iter=80, random_state=0
            ),
        ),
    }
    found = {
        name: (np.zeros(grid.falls.size), np.zeros(furniture.falls.size))
        for name in (KANEKO_REFIT, *models)
    }
    moves = [cases.measures.acceleration > 1.0 for cases in sets]
    demands = [_demands(cases) for cases in sets]
    folds = GroupKFold(min(FOLDS, np.unique(grid.recording).size))
    for train, _ in folds.split(demands[0], groups=grid.recording):
        train = train[moves[0][train]]
        weights = np.concatenate([grid.falls[train], 2 - grid.falls[train]])
        twice = np.concatenate([demands[0][train]] * 2)
        fell = np.repeat([1, 0], train.size)
        known = np.unique(grid.recording[train])
        zeta = fitted_deviations(grid, np.isin(grid.recording, known))
        for k, cases in enumerate(sets):
            test = ~np.isin(cases.recording, known)
            found[KANEKO_REFIT][k][test] = kaneko_hayashi_2004.overturning_ratio(
                *(each[test] for each in (cases.width, cases.height, cases.pfa, cases.pfv)),
                zeta_a=zeta[0],
                zeta_v=zeta[1],
            )
        for name, (taken, build) in models.items():
            model = build()
            counts = weights > 0
            with threadpool_limits(1):  # OpenMP's threads wait for each other where cores are busy
                model.fit(twice[counts, :taken], fell[counts], sample_weight=weights[counts])
            for k, cases in enumerate(sets):
                test = moves[k] & ~np.isin(cases.recording, known)
                if test.any():
                    found[name][k][test] = model.predict_proba(demands[k][test, :taken])[:, 1]
    return found


def _demands(cases: Samples) -> NDArray[np.float64]:
    """The smaller and the larger of ln(PFA/A50) and ln(PFV/V50), as Kaneko and Hayashi use them."""
    a, v = kaneko_hayashi_2004.demands(cases.width, cases.height, cases.pfa, cases.pfv)
    return np.stack([np.minimum(a, v), np.maximum(a, v)], axis=1)


def fitted_rule(cases: Samples) -> pd.DataFrame:
    """The logistic surface fitted to all recordings: P = 1/(1 + e^-x), x the sum of the terms.

    The larger demand adds nothing: its coefficient is a hundredth of the smaller one's.
    """
    from sklearn.linear_model import LogisticRegression

    moves = cases.measures.acceleration > 1.0
    x, falls = _demands(cases)[moves, :1], cases.falls[moves]
    weights = np.concatenate([falls, 2 - falls])
    model = LogisticRegression(C=1e6, max_iter=1000)
    model.fit(
        np.concatenate([x, x])[weights > 0],
        np.repeat([1, 0], falls.size)[weights > 0],
        sample_weight=weights[weights > 0],
    )
    terms = ("constant", "smaller demand")
    return pd.DataFrame({"term": terms, "coefficient": [*model.intercept_, *model.coef_[0]]})


def _scored(chance: NDArray[np.float64], falls: NDArray[np.int64]) -> dict[str, float]:
    """Brier score, logarithmic loss (chances kept off 0 and 1 by 0.001) and area under the ROC."""
    from sklearn.metrics import roc_auc_score

    share = falls / 2.0
    kept = np.clip(chance, 1e-3, 1.0 - 1e-3)
    brier = np.mean(share * (1 - chance) ** 2 + (1 - share) * chance**2)
    loss = -np.mean(share * np.log(kept) + (1 - share) * np.log(1 - kept))
    area = roc_auc_score(
        np.repeat([1, 0], falls.size),
        np.tile(chance, 2),
        sample_weight=np.concatenate([falls, 2 - falls]),
    )
    return {"brier": float(brier), "log_loss": float(loss), "area_under_roc": float(area)}


def _calibration(chance: NDArray[np.float64], falls: NDArray[np.int64]) -> pd.DataFrame:
    """Mean chance and share that fell, in tenths of the chance."""
    cell = np.minimum((10 * chance).astype(np.intp), 9)
    rows = []
    for k in range(10):
        here = cell == k
        if here.any():
            rows.append(
                {
                    "mean_chance": float(chance[here].mean()),
                    "fell": float(falls[here].mean() / 2),
                    "simulations": 2 * int(here.sum()),
                }
            )
    return pd.DataFrame(rows)
