"""Bodies weighed by tests: a body that is known is found again, and what is told is honest."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, simulate
from shaketable.calibration import (
    Calibration,
    Prior,
    Range,
    ShakeTest,
    calibrate,
    scores,
)
from shaketable.calibration.calibrate import groups_of
from shaketable.calibration.likelihood import (
    FORGOTTEN,
    Setting,
    counted,
    cross_validate,
    folds_of,
    log_likelihood,
    places,
    weigh,
)
from shaketable.calibration.rivals import PENALTY, logistic, rival_predictions
from shaketable.calibration.shaking import FACTORS, chances, weights_of

TRUE = Body.rectangle(0.2, 1.0, restitution_factor=0.9)
PRIOR = Prior(
    slenderness=Range(0.1, 0.4, "log-uniform"),
    half_diagonal=Range(0.3, 0.9, "log-uniform"),
    cg_offset=Range(-0.05, 0.05),
    restitution_factor=Range(0.7, 1.0),
)


@pytest.fixture(scope="module")
def known(p695: list[Motion]) -> list[ShakeTest]:
    """48 tests of a body that is known: 12 recordings at four levels."""
    tests = []
    for motion in p695[::8][:12]:
        for scale in (0.4, 0.8, 1.2, 1.8):
            fell = bool(simulate(TRUE, motion.scaled(scale)).outcome)
            name = f"{len(tests)}"
            tests.append(
                ShakeTest(
                    name=name,
                    motion=motion,
                    scale=scale,
                    fell=fell,
                    record=motion.name,
                    order=float(name),
                )
            )
    assert 10 < sum(bool(test.fell) for test in tests) < 38  # else nothing is to be learnt
    return tests


@pytest.fixture(scope="module")
def found(known: list[ShakeTest]) -> Calibration:
    return calibrate(PRIOR, known, members=512, progress=False)


def test_a_known_body_is_found_again(found: Calibration) -> None:
    """The true slenderness lies in the interval, which is half as wide as the prior or less."""
    low, _, high = found.quantiles("slenderness")
    assert low < math.atan2(0.2, 1.0) < high
    assert math.log(high / low) < 0.5 * math.log(0.4 / 0.1)


def test_predictions_of_other_motions(found: Calibration, p695: list[Motion]) -> None:
    """Of tests that it has not seen it knows far more than the share that falls.

    A Brier score of 0.1 is between the perfect 0 and the 0.2 or more of the bare share.
    """
    others = [
        ShakeTest(name=f"o{k}", motion=motion, scale=scale)
        for k, motion in enumerate(p695[4::16])
        for scale in (0.5, 1.5)
    ]
    fell = [bool(simulate(TRUE, test.motion.scaled(test.scale)).outcome) for test in others]
    result = found.predict(others, progress=False)
    assert scores(result.probability, fell).brier < 0.1 < np.var(fell)
    assert (result.low <= result.probability + 1e-9).all()
    assert (result.high >= result.probability - 1e-9).all()


def test_the_place_in_the_order_matters_only_if_there_is_a_memory(
    found: Calibration, known: list[ShakeTest]
) -> None:
    some = [replace(test, name=f"again {test.name}") for test in known[:6]]
    for memory, alike in ((math.inf, True), (30.0, False)):
        one = replace(found, setting=found.setting._replace(memory=memory, noise=0.2))
        there = one.predict(some, progress=False).probability
        anywhere = one.predict(
            [replace(test, order=None) for test in some], progress=False
        ).probability
        assert np.allclose(there, anywhere, rtol=0, atol=1e-12) == alike


def test_cross_validation_never_sees_what_it_predicts(
    found: Calibration, known: list[ShakeTest]
) -> None:
    """Other outcomes in a fold change the predictions of the other folds only."""
    order = np.arange(len(known), dtype=float)
    before = cross_validate(found.fallen, found.fell, found.fold, order)
    here = found.fold == 3
    changed = np.where(here, ~found.fell, found.fell)
    after = cross_validate(found.fallen, changed, found.fold, order)
    assert (before.predicted[here] == after.predicted[here]).all()
    assert (before.predicted[~here] != after.predicted[~here]).any()


def test_recordings_stay_in_one_fold(found: Calibration) -> None:
    for group in range(int(found.group.max()) + 1):
        assert np.unique(found.fold[found.group == group]).size == 1
    assert found.group.max() + 1 == 12
    assert folds_of(np.array([0, 0, 1, 2]), 10, 0).max() == 2


def test_the_rivals_are_told_beside_it(found: Calibration) -> None:
    """One run of the true body is always right here; the bare share is no better than a guess."""
    rivals = rival_predictions(found, TRUE)
    best = scores(rivals["the body as measured, one run"], found.fell)
    assert best.share_right == 1.0
    assert found.fitted is not None
    own = scores(found.fitted.predicted, found.fell)
    assert own.brier < scores(rivals["the share that falls"], found.fell).brier / 2


def test_logistic_regression_is_scikit_learns() -> None:
    """To 1e-4, as its solver ends at a gradient of 1e-6 here, in chances that the penalty moves."""
    from sklearn.linear_model import LogisticRegression
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler

    rng = np.random.default_rng(5)
    for noise in (0.0, 1.0):  # without noise nothing but the penalty bounds the slopes
        known = rng.normal([2.0, -1.0], [0.5, 0.2], (60, 2))
        fell = known @ [1.0, 3.0] + noise * rng.normal(size=60) > -1.0
        wanted = rng.normal([2.0, -1.0], [0.5, 0.2], (20, 2))
        model = LogisticRegression(C=PENALTY, tol=1e-6, max_iter=10_000)
        line = make_pipeline(StandardScaler(), model).fit(known, fell)
        told = logistic(known, fell, wanted)
        assert told == pytest.approx(line.predict_proba(wanted)[:, 1], abs=1e-4)
        assert logistic(np.ones((60, 2)), fell, wanted) == pytest.approx(fell.mean(), abs=1e-6)
    assert logistic(known, fell | True, wanted).tolist() == [1.0] * 20


def test_log_likelihood_by_hand() -> None:
    """A member that falls with 0.75: with ε = 0.1 a fall has 0.1 + 0.8·0.75 = 0.7, none 0.3."""
    logs = log_likelihood(np.array([[0.75, 0.75]]), np.array([True, False]), 0.1)
    assert np.exp(logs) == pytest.approx(np.array([[0.7, 0.3]]))


def test_weights_by_hand() -> None:
    """Two members, one test: likelihoods 0.8 and 0.2; a test that counts half: √0.8 and √0.2."""
    logs = np.log([[0.8], [0.2]])
    assert weigh(logs, np.array([[1.0]]))[:, 0] == pytest.approx([0.8, 0.2])
    half = np.sqrt([0.8, 0.2])
    assert weigh(logs, np.array([[0.5]]))[:, 0] == pytest.approx(half / half.sum())


def test_places_are_counted_in_tests() -> None:
    """Numbers with gaps, or dates: what counts is how many tests lie between."""
    order = np.array([1001.0, 3001.0, 2001.0])
    assert places(order, order).tolist() == [0.0, 2.0, 1.0]
    assert places(order, np.array([2500.0, 1.0])).tolist() == [2.0, 0.0]
    assert np.isnan(places(order, np.array([math.nan]))).all()


def test_old_tests_count_less() -> None:
    count = counted(np.array([0.0, 100.0]), np.array([0.0]), 100.0)
    assert count[:, 0] == pytest.approx([1.0, FORGOTTEN + (1 - FORGOTTEN) / math.e])
    assert (counted(np.array([0.0, math.nan]), np.array([0.0]), math.inf) == 1.0).all()


@pytest.mark.parametrize("outcome", [True, False])
def test_one_outcome_alone_tells_no_limit(
    known: list[ShakeTest], caplog: pytest.LogCaptureFixture, outcome: bool
) -> None:
    tests = [replace(test, fell=outcome) for test in known]
    calibrate(PRIOR, tests, members=64, progress=False)
    assert f"fell in {'all' if outcome else 'none'} of the 48 tests" in caplog.text


def test_a_body_that_cannot_explain_the_tests_is_told(
    known: list[ShakeTest], caplog: pytest.LogCaptureFixture
) -> None:
    """Motions in the wrong unit: a tenth of what they were."""
    weak = [replace(test, scale=0.1 * test.scale) for test in known]
    calibrate(PRIOR, weak, members=128, progress=False)
    assert "no body of the prior explains the tests" in caplog.text


def test_the_order_of_the_rows_does_not_matter(found: Calibration, known: list[ShakeTest]) -> None:
    again = calibrate(PRIOR, known[::-1], members=512, progress=False)
    assert again.setting == found.setting
    assert again.fitted is not None
    assert found.fitted is not None
    # sums in another order differ by round-off
    assert again.fitted.predicted[::-1] == pytest.approx(found.fitted.predicted, abs=1e-9)


@pytest.mark.parametrize("noise", [0.1, 0.2])
def test_the_factors_stand_for_a_normal_variable(noise: float) -> None:
    """Mean 0 by symmetry; seven factors that end at ±0.45 keep the deviation to 6 %."""
    weights = weights_of(noise)
    assert weights @ FACTORS == pytest.approx(0.0, abs=1e-12)
    assert math.sqrt(weights @ FACTORS**2) == pytest.approx(noise, rel=0.06)


def test_without_noise_only_the_motion_itself_counts() -> None:
    fallen = np.zeros((1, 1, FACTORS.size), np.bool_)
    fallen[0, 0, 4:] = True
    assert chances(fallen, 0.0)[0, 0] == 0.0
    assert 0.0 < chances(fallen, 0.1)[0, 0] < 0.5


def test_few_recordings_are_told(p695: list[Motion], caplog: pytest.LogCaptureFixture) -> None:
    tests = [
        ShakeTest(name="a", motion=p695[0], fell=True, record="one"),
        ShakeTest(name="b", motion=p695[0], scale=0.1, fell=False, record="one"),
    ]
    few = calibrate(PRIOR, tests, members=64, progress=False)
    assert few.fitted is None
    assert few.setting == Setting(0.2, 0.2)
    assert "too few to choose" in caplog.text


def test_an_end_of_the_prior_is_told(
    known: list[ShakeTest], caplog: pytest.LogCaptureFixture
) -> None:
    narrow = replace(
        PRIOR,
        slenderness=Range(0.3, 0.6),
        half_diagonal=Range(0.51, 0.51),
        restitution_factor=Range(0.9, 1.0),
    )
    calibrate(narrow, known, members=256, progress=False)
    assert re.search(
        r"slenderness: \d+ % of the weight lie at the end of its range, 0.3; "
        r".*'slenderness,0.225,0.6,uniform'",
        caplog.text,
    )
    assert "restitution_factor: " not in caplog.text  # it cannot be above 1


def test_what_cannot_be_calibrated(known: list[ShakeTest]) -> None:
    with pytest.raises(InputError, match="folds must be 3 or more"):
        calibrate(PRIOR, known, folds=2)
    with pytest.raises(InputError, match="no tests"):
        calibrate(PRIOR, [])
    with pytest.raises(InputError, match="does not say whether the body fell"):
        calibrate(PRIOR, [replace(known[0], fell=None)])
    with pytest.raises(InputError, match="names no record"):
        calibrate(PRIOR, [known[0], replace(known[1], record="")])
    with pytest.raises(InputError, match="scale"):
        replace(known[0], scale=0.0)


def test_tests_that_tell_nothing_and_scales_in_per_cent_are_told(
    known: list[ShakeTest], caplog: pytest.LogCaptureFixture
) -> None:
    """Bodies 1,000 times too large never rock; no table shakes with 40 g."""
    huge = Prior(slenderness=Range(0.2, 0.5), half_diagonal=Range(500.0, 600.0))
    standing = [replace(test, fell=False) for test in known]
    calibrate(huge, standing, members=64, progress=False)
    assert "the tests tell nothing of the body" in caplog.text
    strong = [replace(test, scale=100.0) for test in known]
    calibrate(PRIOR, strong, members=64, progress=False)
    assert re.search(r"a scale of 100 makes a peak of \d+(\.\d)? g; is it a share", caplog.text)


def test_components_of_one_recording_stay_together(p695: list[Motion]) -> None:
    """Without records, motions that name their event and station are grouped by them."""
    tests = [ShakeTest(name=motion.name, motion=motion, fell=False) for motion in p695[:44]]
    assert groups_of(tests).max() + 1 == 22
