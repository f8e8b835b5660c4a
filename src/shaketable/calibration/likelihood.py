"""Weights of bodies from outcomes of tests, and the choice of what the weights depend on.

A member whose body falls in a test with the probability p gives an outcome that was seen the
likelihood (1 - ε) q + ε (1 - q), with q = p for a fall and 1 - p for none: with the probability ε,
the error rate, a test ends otherwise than the model, whatever its parameters. Rocking is chaotic,
and a planar body is a model: with ε near 0 the few members that are right by luck in one more test
would take all the weight.

A body is not quite the same in every test: it is placed anew, its corners wear. Where the tests'
order is known, a test may therefore tell more about those that were made at about the same time, if
cross-validation finds that it does: its
logarithm counts with the weight 0.1 + 0.9 exp(-d/m), where d is how many tests lie between them and
m the memory, in tests.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.calibration.shaking import chances

NOISES = (0.0, 0.1, 0.2)
ERRORS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.4)
MEMORIES = (math.inf, 100.0, 30.0)  # tests
FORGOTTEN = 0.1  # the weight of a test that was made long before or after
FEWEST_MEMBERS = 10.0  # in effect: with fewer, the ensemble is too coarse for its tests


class Setting(NamedTuple):
    """What the weights depend on besides the tests."""

    noise: float  # standard deviation of the logarithm of the factor on a motion
    error: float  # ε
    memory: float = math.inf  # m


#: Where there are too few recordings to choose: what tests on granite asked for.
USUAL = Setting(noise=0.2, error=0.2)


def log_likelihood(
    chance: NDArray[np.float64], fell: NDArray[np.bool_], error: float
) -> NDArray[np.float64]:
    """The logarithm of each test's likelihood, shape (member, test)."""
    seen = np.where(fell, chance, 1.0 - chance)
    return np.log(error + (1.0 - 2.0 * error) * seen)


def places(order: NDArray[np.float64], there: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where others stand among the tests, counted in tests, from 0; NaN where that is not known.

    Args:
        order: of the tests, in any unit, such as a number or a date; NaN where it is not known.
        there: the same of the others.
    """
    known = np.sort(order[~np.isnan(order)])
    found = np.searchsorted(known, there, "left").astype(np.float64)
    return np.where(np.isnan(there), np.nan, found)


def counted(
    order: NDArray[np.float64], there: NDArray[np.float64], memory: float
) -> NDArray[np.float64]:
    """How much each test counts for others, shape (test, other).

    Args:
        order: of each test, in tests; NaN where it is not known.
        there: the same of the others.
        memory: in tests.
    """
    if math.isinf(memory):
        return np.ones((order.size, there.size))
    near = np.exp(-np.abs(order[:, None] - there) / memory)
    return FORGOTTEN + (1.0 - FORGOTTEN) * near


def weigh(logs: NDArray[np.float64], count: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights of the members, which sum to 1 for each other test, shape (member, other).

    Args:
        logs: of the tests' likelihoods, (member, test).
        count: how much each test counts, (test, other).
    """
    sums = logs @ count
    weights = np.exp(sums - sums.max(axis=0))
    return np.asarray(weights / weights.sum(axis=0))


def in_effect(weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """1/Σw² over the members: how many of equal weight would be worth as much. Kish (1965)."""
    return np.asarray(1.0 / np.square(weights).sum(axis=0))


class Fitted(NamedTuple):
    """What cross-validation finds.

    Attributes:
        setting: the one with the smallest Brier score over all folds, of those with at least
            FEWEST_MEMBERS in effect for nine of ten tests.
        brier: of every setting, {setting: score}.
        predicted: the probability of a fall in each test, with the weights and the setting that
            the other folds choose, shape (test,).
    """

    setting: Setting
    brier: dict[Setting, float]
    predicted: NDArray[np.float64]


def settings_for(order: NDArray[np.float64]) -> list[Setting]:
    """The settings to choose from; without the tests' order all of them count alike."""
    memories = MEMORIES[:1] if np.isnan(order).any() else MEMORIES
    return [Setting(n, e, m) for n in NOISES for e in ERRORS for m in memories]


def cross_validate(
    fallen: NDArray[np.bool_],
    fell: NDArray[np.bool_],
    fold: NDArray[np.intp],
    order: NDArray[np.float64],
    settings: Iterable[Setting] | None = None,
) -> Fitted:
    """Choose a setting, and predict every test from the other folds.

    The predictions are nested: the setting with which a fold is predicted is chosen without it.

    Args:
        fallen: as `shake` gives it, (member, test, factor).
        fell: what was seen, (test,).
        fold: of each test, from 0 to at least 2, (test,).
        order: in which the tests were made, (test,); NaN where that is not known.
        settings: those to choose from; `settings_for` the order by default.
    """
    settings = list(settings or settings_for(order))
    folds = range(int(fold.max()) + 1)
    apart = fold[:, None] != fold
    squares = np.zeros((len(settings), len(folds)))  # of what the other folds say without one
    outer = np.zeros((len(settings), fold.size))
    members = np.zeros((len(settings), fold.size))
    order = places(order, order)
    for s, setting in enumerate(settings):
        chance = chances(fallen, setting.noise)
        logs = log_likelihood(chance, fell, setting.error)
        count = np.where(apart, counted(order, order, setting.memory), 0.0)
        weights = weigh(logs, count)
        members[s] = in_effect(weights)
        outer[s] = np.einsum("mt,mt->t", weights, chance)
        for k in folds:
            others = fold != k
            inner = weigh(logs[:, others], count[np.ix_(others, others)])
            found = np.einsum("mt,mt->t", inner, chance[:, others])
            squares[s, k] = np.square(found - fell[others]).sum()
    # the members in effect for a fold's tests depend on the outcomes of the other folds only
    in_fold = np.array([_low(members[:, fold == k]) for k in folds]).T
    best = np.where(_usable(in_fold), squares, np.inf).argmin(axis=0)
    brier = np.square(outer - fell).mean(axis=1)
    usable = _usable(_low(members))
    return Fitted(
        setting=settings[int(np.where(usable, brier, np.inf).argmin())],
        brier=dict(zip(settings, brier.tolist(), strict=True)),
        predicted=outer[best[fold], np.arange(fold.size)],
    )


def _low(members: NDArray[np.float64]) -> NDArray[np.float64]:
    """What nine of ten tests have at least, (setting, test) to (setting,)."""
    return np.asarray(np.quantile(members, 0.1, axis=1))


def _usable(members: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether a setting has enough members in effect, or the most if none has, (setting, ...)."""
    return np.asarray(members >= np.minimum(FEWEST_MEMBERS, members.max(axis=0)))


def folds_of(group: NDArray[np.intp], most: int, seed: int) -> NDArray[np.intp]:
    """A fold for each test, whole groups in one fold, shape (test,).

    Args:
        group: of each test, from 0.
        most: folds; as many as groups where there are fewer.
        seed: of the shuffling of groups.
    """
    groups = int(group.max()) + 1
    place = np.empty(groups, np.intp)
    place[np.random.default_rng(seed).permutation(groups)] = np.arange(groups) % min(most, groups)
    return place[group]
