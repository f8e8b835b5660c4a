"""How often a criterion is wrong, and in which direction."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.resampling import interval, ratio
from shaketable_studies.boroschek_romo_2004.cases import Cases
from shaketable_studies.boroschek_romo_2004.grid import CG_HEIGHTS, ECCENTRICITIES


def performance(
    cases: Cases, says: dict[str, NDArray[np.bool_]], weights: NDArray[np.float64]
) -> pd.DataFrame:
    """Each criterion by eccentricity and height, 0 for all of them; intervals over recordings.

    A case is a body under a motion in one direction. A criterion is satisfied unless it calls safe
    what falls (false safe, as a share of what falls); what it does not call safe and stands is a
    false alarm (as a share of what stands).

    Args:
        says: by each criterion's name, whether it says that the body may overturn,
            (body, motion).
        weights: of the draws, (k, recording).
    """
    falls = cases.falls
    stands = 2 - falls
    rows = []
    for name, warned in says.items():
        for eccentricity, height, chosen in _groups(cases.rows):
            here = chosen[:, None]
            missed, fell, alarmed, stood = (
                cases.by_recording(np.where(here & which, how, 0).sum(axis=0))
                for which, how in (
                    (~warned, falls),
                    (True, falls),
                    (warned, stands),
                    (True, stands),
                )
            )
            row = {
                "criterion": name,
                "eccentricity": eccentricity,
                "cg_height_m": height,
                "falls": int(fell.sum()),
                "missed": int(missed.sum()),
                "stands": int(stood.sum()),
                "alarms": int(alarmed.sum()),
            }
            shares = {
                "satisfied": (fell + stood - missed, fell + stood),
                "false_safe": (missed, fell),
                "false_alarm": (alarmed, stood),
            }
            for share, (count, total) in shares.items():
                row |= _with_interval(share, ratio(count, total, weights))
            rows.append(row)
    return pd.DataFrame(rows)


def _groups(rows: pd.DataFrame) -> Iterator[tuple[float, float, NDArray[np.bool_]]]:
    """Bodies of each eccentricity and height, and of all (0)."""
    for eccentricity in (0.0, *ECCENTRICITIES):
        for height in (0.0, *CG_HEIGHTS):
            chosen = np.ones(len(rows), np.bool_)
            if eccentricity:
                chosen &= (rows["eccentricity"] == eccentricity).to_numpy()
            if height:
                chosen &= (rows["cg_height_m"] == height).to_numpy()
            yield eccentricity, height, chosen


def _with_interval(name: str, draws: NDArray[np.float64]) -> dict[str, float]:
    low, high = interval(draws[1:])
    return {name: float(draws[0]), f"{name}_low": float(low), f"{name}_high": float(high)}


def overturned(cases: Cases, weights: NDArray[np.float64]) -> pd.DataFrame:
    """Share overturned by eccentricity and height (figure 7), and its ratio to the symmetric
    bodies' (figure 8)."""
    simulations = 2 * cases.by_recording(np.ones(len(cases.motions), np.int64))
    shares = {}
    for eccentricity, height, chosen in _groups(cases.rows):
        if eccentricity:
            fell = cases.by_recording(cases.falls[chosen].sum(axis=0))
            shares[eccentricity, height] = ratio(fell, simulations * int(chosen.sum()), weights)
    rows = []
    for (eccentricity, height), share in shares.items():
        with np.errstate(invalid="ignore", divide="ignore"):
            more = share / np.where(shares[0.5, height] > 0.0, shares[0.5, height], np.nan)
        rows.append(
            {
                "eccentricity": eccentricity,
                "cg_height_m": height,
                **_with_interval("overturned", share),
                **_with_interval("ratio", more),
            }
        )
    return pd.DataFrame(rows)


def violators(cases: Cases) -> pd.DataFrame:
    """Motions that overturn bodies which a published criterion calls safe, by name."""
    columns = ("criterion", "eccentricity", "record", "pga_m_s2", "pgv_m_s", "bodies", "falls")
    rows = []
    for name, score in cases.scores.items():
        for eccentricity in ECCENTRICITIES:
            here = (cases.rows["eccentricity"] == eccentricity).to_numpy()
            missed = (cases.falls > 0) & (score <= 1.0) & here[:, None]
            for k in np.flatnonzero(missed.any(axis=0)):
                peak = cases.peaks[k]
                which = missed[:, k]
                fell = int(cases.falls[which, k].sum())
                said = (name, eccentricity, cases.motions[k], peak.acceleration, peak.velocity)
                worst = float(score[which, k].min())
                rows.append((*said, int(which.sum()), fell, worst))
    return pd.DataFrame(rows, columns=[*columns, "smallest_score"])
