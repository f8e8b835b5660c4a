"""A calibration as files: a page with its figures, the bodies with their weights, predictions."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.calibration import (
    PARAMETERS,
    Calibration,
    Predicted,
    Scores,
    ShakeTest,
    brier_difference,
    scores,
)
from shaketable.calibration.likelihood import in_effect
from shaketable.calibration.prior import LOG_UNIFORM, Range
from shaketable.calibration.rivals import AFTERWARDS, CORNER
from shaketable.errors import named
from shaketable.report.calibration_figures import figures
from shaketable.report.html import pages
from shaketable.report.results_folder import Picture, write_folder
from shaketable.report.words.numbers import counted

FEWEST_JUDGED = 10  # tests by which predictions are judged
#: Probability below which, or below whose opposite, a test is as good as decided.
DECIDED_PROBABILITY = 0.05
MOST_OPEN = 5  # open tests that are named
#: Shares of the prior's width that are left where the tests tell a parameter: clearly, hardly.
CLEAR_WIDTH, FAINT_WIDTH = 0.6, 0.9
RELIABLE = 2.0  # |z| of Spiegelhalter's test below which nothing speaks against probabilities
MOST_ROWS = 40


def write_calibration(
    calibration: Calibration,
    rivals: Mapping[str, NDArray[np.float64]],
    predicted: tuple[Sequence[ShakeTest], Predicted] | None,
    run: Mapping[str, object],
    folder: Path,
    *,
    overwrite: bool = False,
) -> None:
    """Write all the files of a calibration, or none.

    Args:
        calibration: what was found.
        rivals: probabilities by other ways, as `rival_predictions` gives them.
        predicted: other tests and their probabilities, if there are any.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
    """
    posterior = pd.DataFrame(calibration.ensemble.values, columns=columns_of_parameters())
    posterior["weight"] = calibration.weights
    tables = {"posterior": posterior.sort_values("weight", ascending=False)}
    if calibration.fitted is not None:
        tables["crossvalidation"] = _cross_validation(calibration)
    if predicted is not None:
        tables["predictions"] = predictions_table(*predicted)
    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables=tables,
        pictures=(Picture(*each) for each in figures(calibration, rivals)),
        page=lambda pictures: render(calibration, rivals, predicted, run, pictures),
    )


def columns_of_parameters() -> list[str]:
    """Names of the parameters, with their units."""
    return [f"{name}_{p.unit}" if p.unit else name for name, p in PARAMETERS.items()]


def predictions_table(tests: Sequence[ShakeTest], predicted: Predicted) -> pd.DataFrame:
    """A row for each test: its probability, the interval, and what was seen if it is known."""
    table = pd.DataFrame(
        {
            "test": [test.name for test in tests],
            "probability": predicted.probability,
            "low": predicted.low,
            "high": predicted.high,
            **_of_tests(tests),
        }
    )
    if any(test.fell is not None for test in tests):
        table["fell"] = [_seen(test) for test in tests]
    return table


def _cross_validation(calibration: Calibration) -> pd.DataFrame:
    assert calibration.fitted is not None
    return pd.DataFrame(
        {
            "test": [test.name for test in calibration.tests],
            **_of_tests(calibration.tests),
            "group": calibration.group,
            "fold": calibration.fold,
            "probability": calibration.fitted.predicted,
            "fell": [_seen(test) for test in calibration.tests],
        }
    )


def _of_tests(tests: Sequence[ShakeTest]) -> dict[str, list[str] | list[float]]:
    """What the table said of the tests: the motion's file, its factor and its record."""
    return {
        "motion": [test.motion_name or test.motion.name for test in tests],
        "scale": [test.scale for test in tests],
        "record": [test.record for test in tests],
    }


def _seen(test: ShakeTest) -> str:
    return {True: "yes", False: "no", None: ""}[test.fell]


def render(
    calibration: Calibration,
    rivals: Mapping[str, NDArray[np.float64]],
    predicted: tuple[Sequence[ShakeTest], Predicted] | None,
    run: Mapping[str, object],
    pictures: Sequence[Mapping[str, str]],
) -> str:
    """The page of a calibration; arguments as for `write_calibration`."""
    rows = [] if predicted is None else predictions_table(*predicted).to_dict("records")
    return (
        pages()
        .get_template("calibration.html.j2")
        .render(
            title="A body calibrated by its shake-table tests",
            lead=lead(calibration, rivals, predicted),
            messages=run.get("messages", ()),
            not_considered=NOT_CONSIDERED,
            ways=_ways(calibration, rivals),
            ways_told=WAYS,
            untested="There were too few recordings for a cross-validation: nothing tells how good "
            "the probabilities are.",
            parameters=_parameters(calibration),
            predictions=[_prediction(row) for row in rows[:MOST_ROWS]],
            predicted_count=len(rows),
            predictions_told=PREDICTIONS,
            pictures=pictures,
            method=method(calibration),
            run=run,
        )
    )


NOT_CONSIDERED = (
    "The body is planar and rigid, on a rigid support, under one horizontal component: it does not "
    "twist, roll or slide, and the table's other components, its pitch "
    "and neighbouring bodies do nothing. A prediction holds for motions like those of the tests, "
    "for the same body placed in the same way."
)
WAYS = (
    "Each test is predicted from the other folds of the cross-validation; all tests of one "
    "recording are in one fold. The share right counts the more likely outcome. The Brier score is "
    "the mean square of probability minus outcome (Brier 1950): 0 is perfect, 0.25 is a coin; "
    "beside it stands by how much it is worse than this ensemble's, with the 95 % interval of a "
    "bootstrap over the recordings: only where both ends are above 0 is the ensemble surely "
    "better. z is "
    "Spiegelhalter's (1986): beyond 2 the probabilities are too bold, beyond −2 too shy. The last "
    "line has seen the tests: it is what no prediction from a peak acceleration alone can exceed. "
    f"Peak velocities are taken above {CORNER:g} Hz."
)
PREDICTIONS = (
    "The interval is that of a bootstrap over the recordings of the tests, with the noise, the "
    "error rate and the memory that were chosen: it tells how much the weights would change with "
    "others."
)


def lead(
    calibration: Calibration,
    rivals: Mapping[str, NDArray[np.float64]],
    predicted: tuple[Sequence[ShakeTest], Predicted] | None,
) -> list[str]:
    """The findings in sentences; arguments as for `write_calibration`."""
    fell, groups = calibration.fell, int(calibration.group.max()) + 1
    grouped = "by the records that the table names" if calibration.tests[0].record else GROUPED
    found = [
        f"The body fell in {int(fell.sum())} of {counted(fell.size, 'test')}, made from "
        f"{counted(groups, 'recording')} ({grouped})."
    ]
    if calibration.fitted is not None:
        found.append(
            "Each predicted without its own recording, "
            + judged(scores(calibration.fitted.predicted, fell))
        )
        found += beside(calibration, rivals)
    if predicted is not None:
        others, result = predicted
        known = [test.fell is not None for test in others]
        if any(known):
            seen = [bool(test.fell) for test in others if test.fell is not None]
            of_known = scores(result.probability[np.array(known)], seen)
            found.append(
                f"Of {counted(len(others), 'other test')} {len(seen)} "
                f"{'tells' if len(seen) == 1 else 'tell'} what was seen: "
                + (
                    judged(of_known)
                    if len(seen) >= FEWEST_JUDGED
                    else f"fewer than {FEWEST_JUDGED} judge nothing."
                )
            )
        found.append(foreseen(others, result.probability))
    return found


def foreseen(tests: Sequence[ShakeTest], probability: NDArray[np.float64]) -> str:
    """How many of the tests are decided, and which are open."""
    stands, falls = (
        int((probability < DECIDED_PROBABILITY).sum()),
        int((probability > 1.0 - DECIDED_PROBABILITY).sum()),
    )
    undecided = np.flatnonzero(
        (probability >= DECIDED_PROBABILITY) & (probability <= 1.0 - DECIDED_PROBABILITY)
    )
    told = (
        f"Of {counted(len(tests), 'test')} to predict the probability of a fall is below "
        f"{100 * DECIDED_PROBABILITY:g} % in {stands} and above "
        f"{100 * (1.0 - DECIDED_PROBABILITY):g} % in {falls}"
    )
    if not undecided.size:
        return f"{told}."
    nearest = undecided[np.argsort(np.abs(probability[undecided] - 0.5), kind="stable")]
    which = named([f"{tests[k].name} {probability[k]:.2f}" for k in nearest], MOST_OPEN)
    return f"{told}; {undecided.size} {'is' if undecided.size == 1 else 'are'} open ({which})."


GROUPED = (
    "as no records are named, motions that are nearly scaled copies of each other are taken for one"
)


def judged(found: Scores) -> str:
    """Scores as the end of a sentence."""
    reliable = "the probabilities are all 0, 1 or a half"
    if math.isfinite(found.spiegelhalter):
        reliable = (
            "nothing speaks against the probabilities"
            if abs(found.spiegelhalter) < RELIABLE
            else "the probabilities are too bold"
            if found.spiegelhalter > 0.0
            else "the probabilities are too shy"
        )
        reliable += f" (Spiegelhalter's z = {found.spiegelhalter:.2f})"
    return (
        f"the likelier outcome was seen in {100 * found.share_right:.1f} % of {found.tests} tests; "
        f"Brier score {found.brier:.3f}; {reliable}."
    )


def beside(calibration: Calibration, rivals: Mapping[str, NDArray[np.float64]]) -> list[str]:
    """Which of the other ways the ensemble surely beats."""
    assert calibration.fitted is not None
    surely: dict[bool, list[str]] = {True: [], False: []}
    for name, probability in rivals.items():
        if name == AFTERWARDS:
            continue
        _, low, _ = brier_difference(
            calibration.fitted.predicted, probability, calibration.fell, calibration.group
        )
        surely[low > 0.0].append(name)
    told = [f"surely better than {joined_by_or(surely[True])}"] if surely[True] else []
    told += [f"not surely better than {joined_by_or(surely[False])}"] if surely[False] else []
    return [f"By these tests the ensemble is {', and '.join(told)}."] if told else []


def joined_by_or(names: Sequence[str]) -> str:
    """ "a", "a or b", "a, b or c"."""
    return " or ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def _ways(
    calibration: Calibration, rivals: Mapping[str, NDArray[np.float64]]
) -> list[dict[str, str]]:
    if calibration.fitted is None:
        return []
    ways = {"this ensemble": calibration.fitted.predicted, **rivals}
    rows: list[dict[str, str]] = []
    for name, probability in ways.items():
        found = scores(probability, calibration.fell)
        z = found.spiegelhalter
        worse = ""
        if rows:
            off, low, high = brier_difference(
                calibration.fitted.predicted, probability, calibration.fell, calibration.group
            )
            worse = f"{off:+.3f} ({low:+.3f} to {high:+.3f})"
        rows.append(
            {
                "name": name,
                "right": f"{100 * found.share_right:.1f} %",
                "brier": f"{found.brier:.3f}",
                "worse": worse or "–",
                "z": f"{z:.2f}" if math.isfinite(z) else "–",
            }
        )
    return rows


def _parameters(calibration: Calibration) -> list[dict[str, str]]:
    rows = []
    for name, parameter in PARAMETERS.items():
        low, middle, high = calibration.quantiles(name)
        unit = f" [{parameter.unit}]" if parameter.unit else ""
        rows.append(
            {
                "name": f"{name.replace('_', ' ')}{unit}",
                "prior": str(getattr(calibration.prior, name)),
                "low": f"{low:.3g}",
                "middle": f"{middle:.3g}",
                "high": f"{high:.3g}",
                "narrowed": _narrowed(calibration, name),
                "meaning": parameter.meaning,
            }
        )
    return rows


def _narrowed(calibration: Calibration, name: str) -> str:
    """How much narrower a parameter's range has become by the tests."""
    prior: Range = getattr(calibration.prior, name)
    if prior.low == prior.high:
        return "fixed"
    low, _, high = calibration.quantiles(name)
    least, most = prior.at(np.array([0.025, 0.975]))
    if prior.distribution == LOG_UNIFORM:
        left = math.log(high / low) / math.log(most / least)
    else:
        left = (high - low) / (most - least)
    return "clearly" if left < CLEAR_WIDTH else "hardly" if left > FAINT_WIDTH else "somewhat"


def _prediction(row: Mapping[Hashable, Any]) -> dict[str, str]:
    return {
        "test": str(row["test"]),
        "motion": f"{row['motion']} × {row['scale']:g}",
        "probability": _in_digits(row["probability"]),
        "interval": "–"
        if math.isnan(row["low"])
        else f"{_in_digits(row['low'])} to {_in_digits(row['high'])}",
        "seen": {"yes": "fell", "no": "stood"}.get(str(row.get("fell", "")), "–"),
    }


def _in_digits(probability: float) -> str:
    """Two digits; what is not quite 0 or 1 is not told as if it were."""
    if 0.0 < probability < 0.005:
        return "<0.01"
    return ">0.99" if 0.995 < probability < 1.0 else f"{probability:.2f}"


def method(calibration: Calibration) -> list[str]:
    """How it was done, in paragraphs."""
    setting = calibration.setting
    chosen = "chosen by cross-validation" if calibration.fitted else "usual values"
    memory = (
        "All tests count alike, whenever they were made."
        if math.isinf(setting.memory)
        else "Cross-validation finds that a test tells more about those made at about the same "
        f"time: the weight of an outcome falls to 0.1, with a memory of {setting.memory:g} tests."
    )
    members = calibration.weights.size
    return [
        f"An ensemble of {members:,} bodies, spread evenly over the ranges of the prior by Sobol's "
        "sequence, is simulated in every test, under the motion and under weaker and stronger "
        "ones, by up to a factor of 1.6. A body that falls where the real one fell, and stands "
        "where it stood, gets more weight.",
        f"The noise on the motions ({100 * setting.noise:g} %, the standard deviation of their "
        f"logarithm) and the error rate ({setting.error:g}, the probability that a test ends "
        f"otherwise than the model says) are {chosen}. {memory} The weights are worth "
        f"{float(in_effect(calibration.weights)):.0f} bodies of equal weight.",
        "The probability of a fall is the weighted share of the bodies that fall; the error "
        "rate is in the weights, not in the share: 0.00 means that no body of the ensemble falls. "
        "Theory, section "
        "10, has the formulas.",
    ]
