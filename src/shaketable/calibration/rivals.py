"""Other ways to predict the tests, beside which a calibration is judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.calibration.calibrate import Calibration
from shaketable.calibration.shake_tests import ShakeTest
from shaketable.calibration.shaking import FACTORS
from shaketable.motion import Motion
from shaketable.signal import filtered, intensity_measures
from shaketable.simulate import fell, simulate_each

CORNER = 0.5  # Hz: below it, what an accelerometer integrates to is mostly its own drift
AFTERWARDS = "a threshold of PGA for each recording, known afterwards"
PENALTY = 1e3  # next to none, on standardised logarithms


def peak_measures(tests: Sequence[ShakeTest]) -> NDArray[np.float64]:
    """PGA [m/s²] and PGV/PGA [s] of each test, shape (test, 2); PGV without drift."""
    found: dict[Motion, tuple[float, float]] = {}
    for test in tests:
        if test.motion not in found:
            quick = filtered(test.motion, low=CORNER)
            pga = test.motion.peak_ground_acceleration
            found[test.motion] = (pga, float(intensity_measures(quick)["PGV"]) / pga)
    return np.array([(found[t.motion][0] * t.scale, found[t.motion][1]) for t in tests])


def rival_predictions(
    calibration: Calibration,
    nominal: Body | None,
    threads: int | None = None,
) -> Mapping[str, NDArray[np.float64]]:
    """Probabilities for every test by other ways, by what they are called, shape (test,).

    All but the last learn from the other folds only.

    Args:
        calibration: whose tests are predicted.
        nominal: the body as it was measured, if it was.
    """
    fell_there, fold = calibration.fell, calibration.fold
    alone = calibration.fallen[:, :, int(np.abs(FACTORS).argmin())]
    right = alone == fell_there
    measures = np.log(peak_measures(calibration.tests))
    found: dict[str, NDArray[np.float64]] = {
        "the share that falls": np.zeros(fold.size),
        "logistic regression on PGA and PGV/PGA": np.zeros(fold.size),
        "the best single body": np.zeros(fold.size),
    }
    for k in range(int(fold.max()) + 1):
        here, others = fold == k, fold != k
        found["the share that falls"][here] = fell_there[others].mean()
        found["logistic regression on PGA and PGV/PGA"][here] = logistic(
            measures[others], fell_there[others], measures[here]
        )
        best = int(right[:, others].mean(axis=1).argmax())
        found["the best single body"][here] = alone[best, here]
    if nominal is not None:
        runs = [
            simulate_each(nominal, test.motion, scales=test.scale, progress=False, threads=threads)
            for test in calibration.tests
        ]
        found["the body as measured, one run"] = np.array([float(fell(run).item()) for run in runs])
    found[AFTERWARDS] = _thresholds(measures[:, 0], fell_there, calibration.group)
    return found


def logistic(
    known: NDArray[np.float64], fell_there: NDArray[np.bool_], wanted: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Chances of a fall by a logistic regression on standardised measures, shape (wanted,).

    Hastie T., Tibshirani R. and Friedman J. (2009) The Elements of Statistical Learning,
    section 4.4; the slopes, not the constant, are penalised by half their squares over PENALTY.

    Args:
        known: measures of the tests that it learns from, shape (test, measure).
        fell_there: what they did.
        wanted: measures of those that it tells.
    """
    from scipy.optimize import minimize
    from scipy.special import expit, log_expit

    if fell_there.all() or not fell_there.any():
        return np.full(len(wanted), float(fell_there[0]))
    middle, width = known.mean(axis=0), known.std(axis=0)
    width[width == 0.0] = 1.0
    terms = np.column_stack([np.ones(len(known)), (known - middle) / width])
    sign = np.where(fell_there, 1.0, -1.0)
    weight = np.r_[0.0, np.full(known.shape[1], 1.0 / PENALTY)]

    def loss(line: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        x = sign * (terms @ line)
        value = 0.5 * weight @ line**2 - log_expit(x).sum()
        return value, weight * line - (sign * expit(-x)) @ terms

    line = minimize(loss, np.zeros(terms.shape[1]), jac=True, method="BFGS").x
    return np.asarray(expit(line[0] + (wanted - middle) / width @ line[1:]))


def _thresholds(
    measure: NDArray[np.float64], fell_there: NDArray[np.bool_], group: NDArray[np.intp]
) -> NDArray[np.float64]:
    """What the best threshold of each group would have said: it has seen the tests."""
    said = np.zeros(group.size)
    for one in range(int(group.max()) + 1):
        here = group == one
        cuts = np.concatenate([[-np.inf], np.sort(measure[here])])
        above = measure[here] > cuts[:, None]
        said[here] = above[(above == fell_there[here]).mean(axis=1).argmax()]
    return said
