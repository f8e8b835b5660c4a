"""The study's tables."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria.boroschek_iruretagoyena_2006 import (
    C1,
    C1_OF_TABLE_2,
    C2,
    SCOR,
    controlled_rate,
    curve_error,
    gcor,
    scor,
)
from shaketable.resampling import interval, recordings_of, wilson_interval
from shaketable.tilting import TiltCounts, downhill_share, fall_share
from shaketable.units import degrees
from shaketable_studies.boroschek_iruretagoyena_2006.experiment import Experiment
from shaketable_studies.boroschek_iruretagoyena_2006.fits import CurveFits, body_mean, departures
from shaketable_studies.boroschek_iruretagoyena_2006.printed import (
    RECORDS,
    SHAKER_DISPLACEMENT,
    TABLE_1,
    TABLE_2,
    TABLE_3,
    TABLE_5,
    TEST_TILTS,
    TILTS,
)

TILTS_DEG = np.round(np.degrees(TILTS), 9)


def table_1(counted: NDArray[np.bool_]) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "body": k + 1,
            "base_m": size.base,
            "height_m": size.height,
            "b_over_h": size.base / size.height,
            "r_m": np.hypot(size.base, size.height) / 2,
            "alpha_rad": size.body.slenderness_left,
            "records": int(counted[k].sum()),
            "records_of": counted.shape[1],
            "printed_records": size.records,
            "printed_records_of": RECORDS,
        }
        for k, size in enumerate(TABLE_1)
    )


def table_2(fits: CurveFits) -> pd.DataFrame:
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


def table_3(observed: NDArray[np.float64], fits: CurveFits) -> pd.DataFrame:
    """Departures of each body from the printed and the fitted curves, beside the printed ones."""
    general = fits.gcor_at(TILTS)[0]
    rows = []
    for k, (size, printed) in enumerate(zip(TABLE_1, TABLE_3, strict=True)):
        curves = {
            "gcor": gcor(TILTS),
            "scor": scor(TILTS, size.base, size.height),
            "gcor_refit": general,
            "scor_refit": fits.scor_at(TILTS, size)[0],
        }
        row: dict[str, float] = {"body": k + 1, "base_m": size.base, "height_m": size.height}
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


def fit_table(fits: CurveFits) -> pd.DataFrame:
    columns = {
        "gcor_c1_rad": (C1, fits.gcor[:, 0]),
        "gcor_c2": (C2, fits.gcor[:, 1]),
        "scor_per_width_ratio_rad": (SCOR.width_ratio, fits.scor[:, 0]),
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


def fit_errors(observed: NDArray[np.float64], fits: CurveFits) -> pd.DataFrame:
    """Eq. 12's error of the printed and of the fitted curves, of the mean and of all bodies."""
    mean = body_mean(observed[None])[0]
    general, fitted = gcor(TILTS), fits.gcor_at(TILTS)[0]
    specific = np.array([scor(TILTS, size.base, size.height) for size in TABLE_1])
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


def curves(fits: CurveFits) -> pd.DataFrame:
    """Printed and fitted curves at fine tilts; body 0 is GCOR."""
    tilts = np.radians(np.arange(0.0, 7.01, 0.1))
    parts = []
    for k, size in enumerate((None, *TABLE_1)):
        if size is None:
            printed, draws = gcor(tilts), fits.gcor_at(tilts)
        else:
            printed = scor(tilts, size.base, size.height)
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


def rates(counts: Mapping[str, TiltCounts], weights: NDArray[np.float64]) -> pd.DataFrame:
    """Every body at every tilt by every model."""
    return pd.concat(
        [_body_rates(each, weights).assign(model=model) for model, each in counts.items()],
        ignore_index=True,
    )


def _body_rates(counts: TiltCounts, weights: NDArray[np.float64]) -> pd.DataFrame:
    control, falls = downhill_share(counts, weights), fall_share(counts, weights)
    low, high = interval(control[1:])
    fell, down = counts.falls.sum(axis=2), counts.downhill.sum(axis=2)
    body, tilt = np.indices(fell.shape)
    with np.errstate(invalid="ignore"):
        toward = down / fell
    # recordings are the experiments: those with a fall, and those that were simulated
    binomial = wilson_interval(toward, (counts.falls > 0).sum(axis=2))
    shaken = (counts.simulations > 0).sum(axis=1)[:, None]
    falls_low, falls_high = wilson_interval(falls[0], shaken)
    return pd.DataFrame(
        {
            "body": body.ravel() + 1,
            "tilt_deg": TILTS_DEG[tilt.ravel()],
            "simulations": counts.simulations.sum(axis=1)[body.ravel()],
            "falls": fell.ravel(),
            "downhill": down.ravel(),
            "rate": control[0].ravel(),
            "rate_low": low.ravel(),
            "rate_high": high.ravel(),
            "binomial_low": binomial[0].ravel(),
            "binomial_high": binomial[1].ravel(),
            "fall_share": falls[0].ravel(),
            "fall_share_low": falls_low.ravel(),
            "fall_share_high": falls_high.ravel(),
        }
    )


def mean_rates(shares: Mapping[str, NDArray[np.float64]]) -> pd.DataFrame:
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


def table_5(counts: TiltCounts) -> pd.DataFrame:
    rows = []
    for k, specimen in enumerate(TABLE_5):
        row: dict[str, float] = {
            "body": k + 1,
            "base_mm": specimen.width_mm,
            "height_mm": specimen.height_mm,
            "depth_mm": specimen.depth_mm,
            "b_over_h": specimen.width_mm / specimen.height_mm,
            "cg_from_edge_mm": specimen.cg_from_edge_mm,
            "cg_height_mm": specimen.cg_height_mm,
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


def table_6(experiment: Experiment) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "record": one.motion.name,
            "scale": one.scale,
            "peak_displacement_m": one.peak_displacement,
            "printed_record": one.printed,
        }
        for one in experiment.chosen
    )


def figure_13(experiment: Experiment, weights: NDArray[np.float64]) -> pd.DataFrame:
    """Mean over the seven bodies at the tilts of the tests."""
    mean = body_mean(downhill_share(experiment.counts, weights))
    low, high = interval(mean[1:])
    mirrored = body_mean(downhill_share(experiment.mirrored, weights))[0]
    within = np.array([one.peak_displacement <= SHAKER_DISPLACEMENT for one in experiment.chosen])
    # recordings whose motions all stay within the table's displacement
    recording = recordings_of([one.motion for one in experiment.chosen])
    every = np.bincount(recording[~within], minlength=int(recording.max()) + 1) == 0
    only = body_mean(downhill_share(experiment.counts, every[None].astype(np.float64)))[0]
    return pd.DataFrame(
        {
            "tilt_deg": np.round(np.degrees(TEST_TILTS), 9),
            "rate": mean[0],
            "rate_low": low,
            "rate_high": high,
            "rate_other_edge": mirrored,
            "rate_within_displacement": only,
            "gcor": gcor(TEST_TILTS),
        }
    )
