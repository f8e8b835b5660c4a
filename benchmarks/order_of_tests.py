"""`python -m benchmarks.order_of_tests tests.csv --motions DIR`: what a calibration rests on.

Cross-validation may ask for a memory of tests: those made at about the same time count more. If
the order of the tests is of no use, the probabilities are as good when it is shuffled. Tests that
follow one another may be alike in more than time, in their motions for one: that the order is of
use does not say why. Beside that the tests of a fifth of the recordings are predicted from the
others, calibrated alone: one more split of the same tests, not a blind prediction.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np

from shaketable.calibration import (
    Calibration,
    Prior,
    Scores,
    ShakeTest,
    calibrate,
    ordered_by_number,
    read_tests,
    scores,
)
from shaketable.calibration.calibrate import order_of
from shaketable.calibration.likelihood import cross_validate

SHUFFLES = 9
FOLDS_OUT = 5  # of which one is held out


def _told(name: str, found: Scores) -> str:
    return (
        f"{name}: {100 * found.share_right:.1f} % right, Brier {found.brier:.4f}, "
        f"z {found.spiegelhalter:+.2f}, {found.tests} tests"
    )


def shuffled(found: Calibration, seed: int) -> Scores:
    """Scores of the cross-validation with the tests in another order."""
    order = np.random.default_rng(seed).permutation(order_of(found.tests))
    fitted = cross_validate(found.fallen, found.fell, found.fold, order)
    return scores(fitted.predicted, found.fell)


def held_out(tests: list[ShakeTest], group: np.ndarray, seed: int) -> Scores:
    """Scores of the tests of a fifth of the recordings, predicted from the others."""
    number = int(group.max()) + 1
    if number < FOLDS_OUT:
        raise SystemExit(f"{number} recordings are too few to hold a fifth of them out")
    chosen = np.random.default_rng(seed).permutation(number)[: number // FOLDS_OUT]
    out = np.isin(group, chosen)
    known = [test for test, away in zip(tests, out, strict=True) if not away]
    others = [test for test, away in zip(tests, out, strict=True) if away]
    blind = [replace(test, fell=None) for test in others]
    predicted = calibrate(Prior(), known, progress=False).predict(blind, progress=False)
    return scores(predicted.probability, [bool(test.fell) for test in others])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tests", type=Path)
    parser.add_argument("--motions", type=Path, required=True)
    parser.add_argument("--units")
    parser.add_argument("--shuffles", type=int, default=SHUFFLES)
    given = parser.parse_args()
    tests, _ = ordered_by_number(read_tests(given.tests, given.motions, units=given.units))
    found = calibrate(Prior(), tests, progress=False)
    if found.fitted is None:
        raise SystemExit("too few recordings for a cross-validation")
    print(_told("in their order", scores(found.fitted.predicted, found.fell)))
    if np.isnan(order_of(tests)).any():
        print("the order of the tests is not known: nothing to shuffle")
    else:
        for seed in range(given.shuffles):
            print(_told(f"shuffled {seed + 1}", shuffled(found, seed)))
    for seed in range(3):
        print(_told(f"a fifth held out, draw {seed + 1}", held_out(tests, found.group, seed)))


if __name__ == "__main__":
    main()
