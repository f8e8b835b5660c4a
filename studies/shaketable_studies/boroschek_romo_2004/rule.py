"""The rule of `criteria.shaketable_2026` fitted anew, and judged on what it was not fitted to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria.shaketable_2026 import FITTED, Coefficients
from shaketable.errors import InputError
from shaketable.resampling import interval
from shaketable_studies.boroschek_romo_2004.cases import Cases

FOLDS = 10
FITS = 100  # of the bootstrap: some 10 ms each
STRENGTH = 1e6  # inverse of the penalty: in effect there is none


@dataclass(frozen=True, eq=False)
class Rule:
    """The rule fitted to the cases.

    Attributes:
        coefficients: the fitted ones, then those of each draw, (1 + draws, 4).
        held_out: chance of each case by the fit that left its recording out, (body, motion).
    """

    coefficients: NDArray[np.float64]
    held_out: NDArray[np.float64]


def fit_rule(cases: Cases, weights: NDArray[np.float64]) -> Rule:
    """Logistic regression on the cases that rock; each fold holds whole recordings out.

    Args:
        weights: of what was observed and of draws, (k, recording); only some are used.

    Raises:
        InputError: fewer than two recordings, or only falls or only stands among what rocks.
    """
    from sklearn.model_selection import GroupKFold

    terms = cases.measures.terms()
    moves = cases.measures.acceleration > 1.0
    group = np.broadcast_to(cases.recording, moves.shape)[moves]
    x, falls = terms[moves], cases.falls[moves]
    if not (0 < falls.sum() < 2 * falls.size) or np.unique(group).size < 2:
        raise InputError(
            "the motions overturn none or all of the bodies that they rock, or are of one "
            "recording only: no rule can be fitted to them"
        )
    rows = [_fit(x, falls, each[group]) for each in weights[: 1 + FITS]]
    held_out = np.zeros(moves.shape)
    chances = np.empty(falls.size)
    folds = min(FOLDS, np.unique(group).size)
    for train, test in GroupKFold(folds).split(x, groups=group):
        fitted = _fit(x[train], falls[train], np.ones(train.size))
        if np.isnan(fitted).any():
            raise InputError(
                "without one of the recordings nothing falls, or nothing stands: too few of them "
                "to judge a rule by; use more motions"
            )
        chances[test] = 1.0 / (1.0 + np.exp(-(fitted[0] + x[test] @ fitted[1:])))
    held_out[moves] = chances
    return Rule(np.array(rows), held_out)


def _fit(
    x: NDArray[np.float64], falls: NDArray[np.int64], weight: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Constant and coefficients; every case counts for both directions of its motion."""
    from sklearn.linear_model import LogisticRegression

    twice = np.concatenate([x, x])
    fell = np.repeat([1, 0], len(x))
    weights = np.concatenate([falls * weight, (2 - falls) * weight])
    counts = weights > 0.0
    if np.unique(fell[counts]).size < 2:
        return np.full(1 + x.shape[1], np.nan)
    model = LogisticRegression(C=STRENGTH, max_iter=1000)
    model.fit(twice[counts], fell[counts], sample_weight=weights[counts])
    return np.concatenate([model.intercept_, model.coef_[0]])


def rule_table(rule: Rule) -> pd.DataFrame:
    """Its coefficients with their intervals, beside those of `criteria.shaketable_2026`."""
    low, high = interval(rule.coefficients[1:])
    return pd.DataFrame(
        {
            "coefficient": Coefficients._fields,
            "criteria_shaketable_2026": FITTED,
            "fitted": rule.coefficients[0],
            "fitted_low": low,
            "fitted_high": high,
        }
    )


def roc_tables(
    cases: Cases, scores: dict[str, NDArray[np.float64]]
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Receiver operating characteristics of each score, thinned, and the areas under them."""
    from sklearn.metrics import roc_auc_score, roc_curve

    fell = np.repeat([1, 0], cases.falls.size)
    weight = np.concatenate([cases.falls.ravel(), 2 - cases.falls.ravel()])
    curves, areas = [], []
    for name, score in scores.items():
        twice = np.tile(score.ravel(), 2)
        alarm, hit, _ = roc_curve(fell, twice, sample_weight=weight)
        at = np.unique(np.r_[np.searchsorted(alarm, np.linspace(0.0, 1.0, 201)), alarm.size - 1])
        at = at[at < alarm.size]
        curves.append(
            pd.DataFrame({"criterion": name, "false_alarm": alarm[at], "detected": hit[at]})
        )
        area = roc_auc_score(fell, twice, sample_weight=weight)
        areas.append({"criterion": name, "area_under_roc": area})
    return pd.concat(curves, ignore_index=True), pd.DataFrame(areas)
