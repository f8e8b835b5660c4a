"""The study from motions to tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C1_OF_TABLE_2,
    SCOR,
    controlled_rate,
    curve_error,
    gcor,
    scor,
    uplift_acceleration,
)
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.recordings import interval, recordings_of, resamples
from shaketable.simulate import require_model
from shaketable.studies.boroschek_iruretagoyena_2006.claims import Found, claims
from shaketable.studies.boroschek_iruretagoyena_2006.experiment import Experiment, simulate_tests
from shaketable.studies.boroschek_iruretagoyena_2006.fits import (
    Fits,
    body_mean,
    departures,
    fit_curves,
)
from shaketable.studies.boroschek_iruretagoyena_2006.printed import (
    RECORDS,
    TABLE_1,
    TABLE_2,
    TABLE_3,
    TABLE_5,
    TEST_TILTS,
    TILTS,
)
from shaketable.studies.boroschek_iruretagoyena_2006.uplift import uplift_table
from shaketable.studies.study import Study
from shaketable.support import Support
from shaketable.tilting import (
    TiltCounts,
    control_share,
    count_outcomes,
    fall_share,
)
from shaketable.units import degrees

NAME = "boroschek-iruretagoyena-2006"
REFERENCE = (
    "Boroschek R., Iruretagoyena A. (2006) Controlled overturning of unanchored rigid bodies, "
    "Earthquake Engng Struct. Dyn. 35(6):695-711"
)
DRAWS = 400  # of the bootstrap over recordings
FRICTION = 2.0  # of the general model: high, as in the paper, so that nothing slides
TILTS_DEG = np.round(np.degrees(TILTS), 9)


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
    for model in models:
        require_model(model)
    bodies = [size.body for size in TABLE_1]
    counted = np.array([[counts(motion, body) for motion in motions] for body in bodies])
    each = 2 * len(motions) * len(bodies) * TILTS.size
    tests = 2 * len(TABLE_5) * (len(motions) + 25 * TEST_TILTS.size)
    with meter("study", len(models) * each + tests, progress) as done:
        outcomes = {
            model: count_outcomes(
                bodies,
                motions,
                TILTS,
                model=model,
                support=Support(static_friction=FRICTION) if model == "general" else None,
                counted=counted,
                progress=done,
            )
            for model in models
        }
        experiment = simulate_tests(motions, done)
    first = outcomes[models[0]]
    weights = resamples(first.falls.shape[2], DRAWS, seed)
    shares = {model: control_share(each, weights) for model, each in outcomes.items()}
    fits = fit_curves(TILTS, shares[models[0]], TABLE_1)
    errors = _table_3(shares[models[0]][0], fits)
    apart = None
    if len(models) > 1:
        apart = float(np.nanmax(np.abs(shares[models[0]][0] - shares[models[1]][0])))
    falls = np.tensordot(weights, first.falls.sum(axis=0), ([1], [1]))
    recordings = int(recordings_of(motions).max()) + 1
    said = f"{len(motions)} motions of {recordings} recordings" + (
        f", {description}" if description else ""
    )
    judged = claims(Found(shares[models[0]], falls, fits, errors, apart))
    return Study(
        name=NAME,
        reference=REFERENCE,
        records=said,
        tables={
            "table_1": _table_1(counted),
            "table_2": _table_2(fits),
            "table_3": errors,
            "table_5": _table_5(experiment.counts),
            "table_6": _table_6(experiment),
            "fits": _fit_table(fits),
            "fit_errors": _fit_errors(shares[models[0]][0], fits),
            "curves": _curves(fits),
            "rates": _rates(outcomes, weights),
            "mean_rates": _mean_rates(shares),
            "figure_02": uplift_table(),
            "figure_13": _figure_13(experiment.counts, seed),
            "claims": pd.DataFrame(judged).assign(records=said),
        },
    )


def counts(motion: Motion, body: Body) -> bool:
    """Whether a motion lifts a body off a level support, in either direction (eq. 1)."""
    vertical = 0.0 if motion.vertical is None else motion.vertical
    limit = uplift_acceleration(body, 0.0, vertical)[0]
    return bool((np.abs(motion.horizontal) > limit).any())


def _table_1(counted: NDArray[np.bool_]) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "body": k + 1,
            "base_m": size.width,
            "height_m": size.height,
            "b_over_h": size.width / size.height,
            "r_m": np.hypot(size.width, size.height) / 2,
            "alpha_rad": size.body.slenderness_left,
            "records": int(counted[k].sum()),
            "records_of": counted.shape[1],
            "printed_records": size.records,
            "printed_records_of": RECORDS,
        }
        for k, size in enumerate(TABLE_1)
    )


def _table_2(fits: Fits) -> pd.DataFrame:
    fitted = fits.gcor_at(TILTS)
    low, high = interval(fitted[1:])
    return pd.DataFrame(
        {
            "tilt_deg": TILTS_DEG,
            "printed_pct": TABLE_2,
            "gcor_pct": 100 * gcor(TILTS),
            "gcor_c1_0.046_pct": 100 * controlled_rate(TILTS, C1_OF_TABLE_2),
            "refit_pct": 100 * fitted[0],
            "refit_low_pct": 100 * low,
            "refit_high_pct": 100 * high,
        }
    )


def _table_3(observed: NDArray[np.float64], fits: Fits) -> pd.DataFrame:
    """Departures of each body from the printed and the fitted curves, beside the printed ones."""
    general = fits.gcor_at(TILTS)[0]
    rows = []
    for k, (size, printed) in enumerate(zip(TABLE_1, TABLE_3, strict=True)):
        curves = {
            "gcor": gcor(TILTS),
            "scor": scor(TILTS, size.width, size.height),
            "gcor_refit": general,
            "scor_refit": fits.scor_at(TILTS, size)[0],
        }
        row: dict[str, float] = {"body": k + 1, "base_m": size.width, "height_m": size.height}
        for name, curve in curves.items():
            largest, area, error = departures(TILTS_DEG, observed[k], curve)
            row |= {
                f"{name}_max_difference_pct": largest,
                f"{name}_area_pct_deg": area,
                f"{name}_error_pct": error,
            }
        for at, name in enumerate(("gcor", "scor")):
            row |= {
                f"printed_{name}_max_difference_pct": printed.max_difference[at],
                f"printed_{name}_area_pct_deg": printed.area[at],
                f"printed_{name}_error_pct": printed.error[at],
            }
        rows.append(row)
    return pd.DataFrame(rows)


def _fit_table(fits: Fits) -> pd.DataFrame:
    columns = {
        "gcor_c1_rad": (0.048, fits.gcor[:, 0]),
        "gcor_c2": (0.48, fits.gcor[:, 1]),
        "scor_per_slenderness_rad": (SCOR.slenderness, fits.scor[:, 0]),
        "scor_per_r_rad_m": (SCOR.size, fits.scor[:, 1]),
        "scor_constant_rad": (SCOR.constant, fits.scor[:, 2]),
    }
    rows = []
    for name, (printed, draws) in columns.items():
        low, high = interval(draws[1:])
        rows.append(
            {
                "coefficient": name,
                "printed": printed,
                "refit": draws[0],
                "refit_low": float(low),
                "refit_high": float(high),
            }
        )
    return pd.DataFrame(rows)


def _fit_errors(observed: NDArray[np.float64], fits: Fits) -> pd.DataFrame:
    """Eq. 12's error of the printed and of the fitted curves, of the mean and of all bodies."""
    mean = body_mean(observed[None])[0]
    general, fitted = gcor(TILTS), fits.gcor_at(TILTS)[0]
    specific = np.array([scor(TILTS, size.width, size.height) for size in TABLE_1])
    specific_fit = np.array([fits.scor_at(TILTS, size)[0] for size in TABLE_1])
    every = np.ones((len(TABLE_1), 1))
    rows = {
        "GCOR, mean of the bodies": (mean, general, fitted),
        "GCOR, all bodies": (observed, every * general, every * fitted),
        "SCOR, all bodies": (observed, specific, specific_fit),
    }
    return pd.DataFrame(
        {
            "curve": name,
            "printed_error_pct": 100 * curve_error(found, printed),
            "refit_error_pct": 100 * curve_error(found, refit),
        }
        for name, (found, printed, refit) in rows.items()
    )


def _curves(fits: Fits) -> pd.DataFrame:
    """Printed and fitted curves at fine tilts; body 0 is GCOR."""
    tilts = np.radians(np.arange(0.0, 7.01, 0.1))
    parts = []
    for k, size in enumerate((None, *TABLE_1)):
        if size is None:
            printed, draws = gcor(tilts), fits.gcor_at(tilts)
        else:
            printed = scor(tilts, size.width, size.height)
            draws = fits.scor_at(tilts, size)
        low, high = interval(draws[1:])
        parts.append(
            pd.DataFrame(
                {
                    "body": k,
                    "tilt_deg": np.degrees(tilts),
                    "printed": printed,
                    "refit": draws[0],
                    "refit_low": low,
                    "refit_high": high,
                }
            )
        )
    return pd.concat(parts, ignore_index=True)


def _rates(counts: Mapping[str, TiltCounts], weights: NDArray[np.float64]) -> pd.DataFrame:
    """Every body at every tilt by every model."""
    return pd.concat(
        [_body_rates(each, weights).assign(model=model) for model, each in counts.items()],
        ignore_index=True,
    )


def _body_rates(counts: TiltCounts, weights: NDArray[np.float64]) -> pd.DataFrame:
    from statsmodels.stats.proportion import proportion_confint

    control, falls = control_share(counts, weights), fall_share(counts, weights)
    low, high = interval(control[1:])
    falls_low, falls_high = interval(falls[1:])
    fell, down = counts.falls.sum(axis=2), counts.downhill.sum(axis=2)
    with np.errstate(invalid="ignore", divide="ignore"):
        binomial = proportion_confint(down.ravel(), fell.ravel(), method="wilson")
    body, tilt = np.indices(fell.shape)
    return pd.DataFrame(
        {
            "body": body.ravel() + 1,
            "tilt_deg": np.round(np.degrees(counts.tilts), 9)[tilt.ravel()],
            "simulations": counts.simulations.sum(axis=1)[body.ravel()],
            "falls": fell.ravel(),
            "downhill": down.ravel(),
            "rate": control[0].ravel(),
            "rate_low": low.ravel(),
            "rate_high": high.ravel(),
            "binomial_low": binomial[0],
            "binomial_high": binomial[1],
            "fall_share": falls[0].ravel(),
            "fall_share_low": falls_low.ravel(),
            "fall_share_high": falls_high.ravel(),
        }
    )


def _mean_rates(shares: Mapping[str, NDArray[np.float64]]) -> pd.DataFrame:
    """Mean over the bodies by every model, with what GCOR says."""
    parts = []
    for model, each in shares.items():
        mean = body_mean(each)
        low, high = interval(mean[1:])
        parts.append(
            pd.DataFrame(
                {
                    "model": model,
                    "tilt_deg": TILTS_DEG,
                    "rate": mean[0],
                    "rate_low": low,
                    "rate_high": high,
                    "gcor": gcor(TILTS),
                }
            )
        )
    return pd.concat(parts, ignore_index=True)


def _table_5(counts: TiltCounts) -> pd.DataFrame:
    rows = []
    for k, specimen in enumerate(TABLE_5):
        row: dict[str, float] = {
            "body": k + 1,
            "base_mm": specimen.width,
            "height_mm": specimen.height,
            "depth_mm": specimen.depth,
            "b_over_h": specimen.width / specimen.height,
            "cg_from_left_mm": specimen.cg_from_left,
            "cg_height_mm": specimen.cg_height,
        }
        for j, tilt in enumerate(TEST_TILTS):
            at = f"{degrees(tilt):g}_deg"
            fell = int(counts.falls[k, j].sum())
            row |= {
                f"falls_at_{at}": fell,
                f"rate_at_{at}": counts.downhill[k, j].sum() / fell if fell else np.nan,
            }
        rows.append(row)
    return pd.DataFrame(rows)


def _table_6(experiment: Experiment) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "record": one.motion.name,
            "scale": one.scale,
            "printed_record": one.printed,
        }
        for one in experiment.chosen
    )


def _figure_13(counts: TiltCounts, seed: int) -> pd.DataFrame:
    """Mean over the seven bodies at the tilts of the tests (figure 13)."""
    mean = body_mean(control_share(counts, resamples(counts.falls.shape[2], DRAWS, seed)))
    low, high = interval(mean[1:])
    return pd.DataFrame(
        {
            "tilt_deg": np.round(np.degrees(TEST_TILTS), 9),
            "rate": mean[0],
            "rate_low": low,
            "rate_high": high,
            "gcor": gcor(TEST_TILTS),
        }
    )
