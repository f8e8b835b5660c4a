"""The study from motions to tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import uplift_acceleration
from shaketable.errors import InputError
from shaketable.models import General, Model, Rocking
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import events_of, interval, nested_resamples, recordings_of
from shaketable.simulate import count_by_recording, simulate_many
from shaketable.study import Study, records_in_words, table_of
from shaketable.tilting import TiltCounts, downhill_share
from shaketable_studies.boroschek_iruretagoyena_2006 import beyond, dimensionless, tables
from shaketable_studies.boroschek_iruretagoyena_2006.claims import ClaimInputs, claims
from shaketable_studies.boroschek_iruretagoyena_2006.experiment import Experiment, simulate_tests
from shaketable_studies.boroschek_iruretagoyena_2006.fits import body_mean, fit_curves
from shaketable_studies.boroschek_iruretagoyena_2006.printed import (
    TABLE_1,
    TABLE_5,
    TABLE_6,
    TEST_TILTS,
    TILTS,
)
from shaketable_studies.boroschek_iruretagoyena_2006.uplift import uplift_table

#: The paper's two models; friction is high, as in the paper, so that nothing slides.
MODELS: dict[str, Model] = {"rocking": Rocking(), "general": General(static_friction=2.0)}


def run(
    motions: Sequence[Motion],
    *,
    description: str = "",
    models: Sequence[str] = ("rocking",),
    seed: int = 0,
    progress: Progress = True,
) -> Study:
    """Do the paper's study with `motions` in place of its records.

    Args:
        motions: at least one; each counts in both directions.
        description: what to call them.
        models: "rocking", "general" or both; curves are fitted to the first.
        seed: of the bootstrap over recordings.
        progress: as for simulate_many.

    Raises:
        InputError: no motions, an unknown model, or too few falls to fit anything to.
    """
    if not motions or not models:
        raise InputError("the study needs at least one motion and one model")
    models = tuple(dict.fromkeys(models))
    for model in models:
        if model not in MODELS:
            raise InputError(f"unknown model {model!r}; accepted: {', '.join(MODELS)}")
    bodies = [size.body for size in TABLE_1]
    counted = np.array([[counts(motion, body) for motion in motions] for body in bodies])
    recording = recordings_of(motions)
    runs, experiment = _simulate(bodies, motions, models, progress)
    outcomes = {
        model: TiltCounts.of(TILTS, count_by_recording(each, recording, counted))
        for model, each in runs.items()
    }
    everything = count_by_recording(runs[models[0]], recording)
    first = outcomes[models[0]]
    events = events_of(motions)
    weights = nested_resamples(events, seed=seed)
    shares = {model: downhill_share(each, weights) for model, each in outcomes.items()}
    fits = fit_curves(TILTS, shares[models[0]], TABLE_1)
    errors = tables.table_3(shares[models[0]][0], fits)
    apart = None
    if len(models) > 1:
        apart = float(np.nanmax(np.abs(shares[models[0]][0] - shares[models[1]][0])))
    falls = weights @ everything.falls.sum(axis=0).T
    said = records_in_words(len(motions), first.recordings, description, int(events.max()) + 1)
    vertical = _verticals(bodies, motions, shares[models[0]], weights, models[0], counted, progress)
    total = beyond.simulations(len(motions)) + dimensionless.simulations(len(motions))
    with meter("what the paper leaves open", total, progress) as done:
        open_questions = beyond.variations(motions, weights, done)
        directions = dimensionless.cross_validated(motions, events, done, seed)
    judged = claims(
        ClaimInputs(
            shares=shares[models[0]],
            falls=falls,
            fits=fits,
            errors=errors,
            apart=apart,
            vertical=vertical,
            experiment=tables.table_6(experiment),
        )
    )
    drawn = nested_resamples(events_of([one.motion for one in experiment.chosen]), seed=seed)
    return Study(
        records=said,
        tables={
            "table_1": tables.table_1(counted),
            "table_2": tables.table_2(fits),
            "table_3": errors,
            "table_5": tables.table_5(experiment.counts),
            "table_6": tables.table_6(experiment),
            "fits": tables.fit_table(fits),
            "fit_errors": tables.fit_errors(shares[models[0]][0], fits),
            "curves": tables.curves(fits),
            "rates": tables.rates(outcomes, weights),
            "mean_rates": tables.mean_rates(shares),
            "figure_02": uplift_table(),
            "figure_13": tables.figure_13(experiment, drawn),
            "verticals": vertical_table(vertical),
            "open_questions": open_questions,
            "open_tilts": beyond.tilts_for_95(open_questions),
            "dimensionless": directions.scores,
            "dimensionless_curve": directions.curve,
            "claims": table_of(judged, said),
        },
        inputs={"models": {model: repr(MODELS[model]) for model in models}},
    )


def _verticals(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    shares: NDArray[np.float64],
    weights: NDArray[np.float64],
    model: str,
    counted: NDArray[np.bool_],
    progress: Progress,
) -> NDArray[np.float64] | None:
    """Mean shares with and without the verticals, (2, k, t); None where there are none.

    The motions that count are the same in both.
    """
    if all(motion.vertical is None for motion in motions):
        return None
    level = [replace(motion, vertical=None, vertical_origin=None) for motion in motions]
    runs = simulate_many(bodies, level, tilts=TILTS, model=MODELS[model], progress=progress)
    counts_without = TiltCounts.of(TILTS, count_by_recording(runs, recordings_of(motions), counted))
    return np.stack([body_mean(shares), body_mean(downhill_share(counts_without, weights))])


def vertical_table(vertical: NDArray[np.float64] | None) -> pd.DataFrame:
    """The mean share downhill with and without verticals, and the difference; empty if none."""
    columns = ["tilt_deg", "with_verticals", "without", "difference", "low", "high"]
    if vertical is None:
        return pd.DataFrame(columns=columns)
    off = vertical[0] - vertical[1]
    low, high = interval(off[1:])
    values = (np.degrees(TILTS), vertical[0, 0], vertical[1, 0], off[0], low, high)
    return pd.DataFrame(dict(zip(columns, values, strict=True)))


def _simulate(
    bodies: Sequence[Body], motions: Sequence[Motion], models: Sequence[str], progress: Progress
) -> tuple[dict[str, xr.Dataset], Experiment]:
    """All bodies on all tilts by every model, and the tests on the shaking table."""
    each = 2 * len(motions) * len(bodies) * TILTS.size
    tests = 2 * len(TABLE_5) * (len(motions) + 2 * len(TABLE_6) * TEST_TILTS.size)
    with meter("study", len(models) * each + tests, progress) as done:
        runs = {
            model: simulate_many(bodies, motions, tilts=TILTS, model=MODELS[model], progress=done)
            for model in models
        }
        return runs, simulate_tests(motions, done)


def counts(motion: Motion, body: Body) -> bool:
    """Whether a motion lifts a body off a level support, in either direction (eq. 1)."""
    vertical = 0.0 if motion.vertical is None else motion.vertical
    limit = uplift_acceleration(body, 0.0, vertical)[0]
    return bool((np.abs(motion.horizontal) > limit).any())
