"""A body's parameters from its shake-table tests, and what they say of other motions."""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.calibration.groups import copies
from shaketable.calibration.likelihood import (
    FEWEST_MEMBERS,
    USUAL,
    Fitted,
    Setting,
    counted,
    cross_validate,
    folds_of,
    in_effect,
    log_likelihood,
    places,
    weigh,
)
from shaketable.calibration.prior import PARAMETERS, BodyEnsemble, Prior, Range
from shaketable.calibration.shake_tests import ShakeTest
from shaketable.calibration.shaking import chances, shake
from shaketable.errors import InputError, quoted
from shaketable.models import Model
from shaketable.progress import Progress
from shaketable.resampling import interval, recordings_of, resamples
from shaketable.units import STANDARD_GRAVITY

log = logging.getLogger(__name__)

MEMBERS = 4096
FOLDS = 10
FEWEST_GROUPS = 3  # for a choice by cross-validation
AT_AN_END = 0.1  # of a range of the prior, near one end
MOST_AT_AN_END = 0.3  # of the weight: with more, the range may end too early
STRONGEST = 10.0  # g: no shake table makes more
ALL_ALIKE = 0.999  # of the members in effect, from which on no test tells them apart
DRAWS = 200  # of the bootstrap
TAILS = (0.025, 0.5, 0.975)


@dataclass(frozen=True, kw_only=True, eq=False)
class Predicted:
    """Probabilities of falls, arrays of shape (test,).

    Attributes:
        probability: from all tests of the calibration.
        low, high: its interval by a bootstrap over the recordings of those tests, with the setting
            that was chosen; NaN with fewer than FEWEST_GROUPS recordings.
    """

    probability: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Calibration:
    """An ensemble of bodies with the weights that tests give them.

    Attributes:
        prior: the ranges that the bodies came from.
        ensemble: the bodies.
        tests: on which the weights rest.
        group: the number of each test's recording, from 0, shape (test,).
        fold: the number of each test's fold in the cross-validation, from 0, shape (test,).
        setting: the noise on motions, the error rate and the memory that the weights depend on.
        fitted: the cross-validation that chose them; None if there were too few recordings.
        fallen: which member fell in which test, under which factor, as `shake` gives it.
        model: what the bodies may do.
        seed: of the ensemble, the folds and the bootstrap.
    """

    prior: Prior
    ensemble: BodyEnsemble
    tests: Sequence[ShakeTest]
    group: NDArray[np.intp]
    fold: NDArray[np.intp]
    setting: Setting
    fitted: Fitted | None
    fallen: NDArray[np.bool_]
    model: Model | str | None
    seed: int

    @property
    def fell(self) -> NDArray[np.bool_]:
        """Whether the body fell, shape (test,)."""
        return np.array([test.fell for test in self.tests], np.bool_)

    @property
    def logs(self) -> NDArray[np.float64]:
        """The logarithm of each test's likelihood, shape (member, test)."""
        chance = chances(self.fallen, self.setting.noise)
        return log_likelihood(chance, self.fell, self.setting.error)

    @property
    def weights(self) -> NDArray[np.float64]:
        """Of the members, over the whole of the tests, which sum to 1, shape (member,)."""
        order = places(order_of(self.tests), order_of(self.tests))
        return np.asarray(weigh(self.logs, counted(order, order, self.setting.memory)).mean(axis=1))

    def quantiles(self, parameter: str) -> tuple[float, float, float]:
        """The 2.5 %, 50 % and 97.5 % quantiles of a parameter."""
        values = self.ensemble.of(parameter)
        order = np.argsort(values)
        below = np.cumsum(self.weights[order])
        at = np.searchsorted(below, TAILS).clip(max=values.size - 1)
        low, middle, high = values[order][at].tolist()
        return low, middle, high

    def predict(
        self,
        tests: Sequence[ShakeTest],
        *,
        progress: Progress = True,
        threads: int | None = None,
    ) -> Predicted:
        """The probability that the body falls in each of other tests.

        A test without a place in the order is predicted as if it were made at any time of those
        that the weights rest on.

        Args:
            tests: with their motions and scales; outcomes are not looked at.
            progress, threads: as for `simulate_many`.
        """
        fallen = shake(self.ensemble, tests, model=self.model, progress=progress, threads=threads)
        chance = chances(fallen, self.setting.noise)
        known = order_of(self.tests)
        logs, order, there = self.logs, places(known, known), places(known, order_of(tests))
        placed = ~np.isnan(there)
        near = counted(order, there[placed], self.setting.memory)
        anytime = counted(order, order, self.setting.memory)
        if math.isinf(self.setting.memory):
            placed, near, anytime = np.zeros_like(placed), near[:, :0], anytime[:, :1]
        draws = resamples(int(self.group.max()) + 1, DRAWS, self.seed)[:, self.group]
        found = np.empty((len(draws), len(tests)))
        for k, often in enumerate(draws):
            drawn = logs * often
            mean = weigh(drawn, anytime).mean(axis=1)
            found[k, ~placed] = mean @ chance[:, ~placed]
            found[k, placed] = np.einsum("mt,mt->t", weigh(drawn, near), chance[:, placed])
        low, high = interval(found[1:])
        if int(self.group.max()) + 1 < FEWEST_GROUPS:
            low, high = np.full_like(low, np.nan), np.full_like(high, np.nan)
        return Predicted(probability=found[0], low=low, high=high)


def calibrate(
    prior: Prior,
    tests: Sequence[ShakeTest],
    *,
    model: Model | str | None = None,
    members: int = MEMBERS,
    folds: int = FOLDS,
    seed: int = 0,
    progress: Progress = True,
    threads: int | None = None,
) -> Calibration:
    """Weigh an ensemble of bodies by how well each predicts shake-table tests.

    The noise on the motions and the error rate are chosen by cross-validation over whole
    recordings: tests of one record at several levels are in one fold.

    Args:
        prior: the ranges of the body's parameters.
        tests: at least one; every one says whether the body fell. Their polarity counts: the
            motion's positive direction is the body's +x.
        model, progress, threads: as for `simulate_many`.
        members: of the ensemble.
        folds: of the cross-validation.
        seed: of the ensemble, the folds and the bootstrap.

    Raises:
        InputError: no tests, one whose outcome is not known, some that name their records and some
            that do not, or fewer than FEWEST_GROUPS folds.
    """
    if not tests:
        raise InputError("no tests to calibrate with")
    if folds < FEWEST_GROUPS:
        raise InputError(f"folds must be {FEWEST_GROUPS} or more, got {folds!r}")
    for test in tests:
        if test.fell is None:
            raise InputError(f"test {test.name!r} does not say whether the body fell")
    group = groups_of(tests)
    fold = folds_of(group, folds, seed)
    ensemble = prior.sample(members, seed)
    fallen = shake(ensemble, tests, model=model, progress=progress, threads=threads)
    fell = np.array([test.fell for test in tests], np.bool_)
    groups = int(group.max()) + 1
    fitted = None
    if groups >= FEWEST_GROUPS:
        fitted = cross_validate(fallen, fell, fold, order_of(tests))
    else:
        log.warning(
            "%d tests of %d recordings are too few to choose the noise and the error rate: usual "
            "ones are taken (%g and %g), and nothing tells how good the predictions are",
            len(tests),
            groups,
            USUAL.noise,
            USUAL.error,
        )
    found = Calibration(
        prior=prior,
        ensemble=ensemble,
        tests=list(tests),
        group=group,
        fold=fold,
        setting=fitted.setting if fitted else USUAL,
        fitted=fitted,
        fallen=fallen,
        model=model,
        seed=seed,
    )
    if fell.all() or not fell.any():
        log.warning(
            "the body fell in %s of the %d tests: they tell on which side of the limit it lies, "
            "and not where; add tests with the other outcome",
            "all" if fell.all() else "none",
            len(tests),
        )
    elif fitted and fitted.brier[fitted.setting] > fell.mean() * (1.0 - fell.mean()):
        log.warning(
            "no body of the prior explains the tests: its predictions are worse than the bare "
            "share that falls; look at the unit of the motions, the scales and the sizes"
        )
    if not all(test.record for test in tests):
        log.warning(
            "no records are named: only motions that are nearly scaled copies were kept in one "
            "fold; where others were made from one record, too, the scores are too good"
        )
    for test in tests:
        peak = test.scale * test.motion.peak_ground_acceleration / STANDARD_GRAVITY
        if peak > STRONGEST:
            log.warning(
                "test %s: a scale of %g makes a peak of %.3g g; is it a share in per cent, or is "
                "the motion in another unit?",
                quoted(test.name),
                test.scale,
                peak,
            )
            break
    effective = float(in_effect(found.weights))
    if effective > ALL_ALIKE * members:
        log.warning(
            "the tests tell nothing of the body: every body of the prior explains them alike; look "
            "at the sizes, the unit of the motions and the scales"
        )
    if effective < FEWEST_MEMBERS:
        log.warning(
            "the weights rest on %.1f of %d members in effect: take more members, or a narrower "
            "prior about %s",
            effective,
            members,
            ", ".join(
                f"{name} {found.quantiles(name)[1]:.3g}{f' {p.unit}' if p.unit else ''}"
                for name, p in PARAMETERS.items()
            ),
        )
    _warn_of_ends(found)
    return found


def _warn_of_ends(found: Calibration) -> None:
    """Warn of parameters whose weight lies near an end of their range."""
    weights = found.weights
    for name in PARAMETERS:
        ends: Range = getattr(found.prior, name)
        if ends.low == ends.high:
            continue
        values = found.ensemble.of(name)
        low, high = ends.at(np.array([AT_AN_END, 1.0 - AT_AN_END]))
        for near, end in ((values <= low, ends.low), (values >= high, ends.high)):
            beyond = name != "restitution_factor" or end < 1.0  # no impact leaves more than all
            if beyond and (share := float(weights[near].sum())) > MOST_AT_AN_END:
                log.warning(
                    "%s: %.0f %% of the weight lie at the end of its range, %g; if it may lie "
                    "beyond, widen it%s",
                    name,
                    100 * share,
                    end,
                    _wider(name, found.prior, end),
                )


def _wider(name: str, prior: Prior, end: float) -> str:
    """How to widen a range by a quarter on one side, if a body can be beyond it."""
    ends: Range = getattr(prior, name)
    beyond = float(ends.at(np.array([-0.25 if end == ends.low else 1.25]))[0])
    low, high = (beyond, ends.high) if end == ends.low else (ends.low, beyond)
    try:
        replace(prior, **{name: Range(low, high, ends.distribution)})
    except InputError:
        return ""
    line = f"{name},{low:.3g},{high:.3g},{ends.distribution}"
    return f" in a table for --prior: 'parameter,low,high,distribution', then as in '{line}'"


def order_of(tests: Sequence[ShakeTest]) -> NDArray[np.float64]:
    """The place of each test in the order in which they were made; NaN where it is not known."""
    return np.array([math.nan if test.order is None else test.order for test in tests])


def groups_of(tests: Sequence[ShakeTest]) -> NDArray[np.intp]:
    """The number of each test's recording, from 0: by its record, or else by its motion.

    Motions that name their event and station belong to that recording, others to those that are
    nearly scaled copies of them.
    """
    named = [test.record for test in tests]
    if all(named):
        order = {name: number for number, name in enumerate(sorted(set(named)))}
        return np.array([order[name] for name in named], np.intp)
    if any(named):
        without = next(test.name for test in tests if not test.record)
        raise InputError(f"test {without!r} names no record, others do; name all of them, or none")
    motions = [test.motion for test in tests]
    if all(motion.origin and motion.origin.event and motion.origin.station for motion in motions):
        return recordings_of(motions)
    return copies(motions)
