"""The study from motions to tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria import shaketable_2026
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.resampling import events_of, nested_resamples
from shaketable.study import Study, records_in_words, table_of
from shaketable_studies.boroschek_romo_2004 import friction, trials, widths
from shaketable_studies.boroschek_romo_2004.cases import PUBLISHED, Cases, simulate_cases
from shaketable_studies.boroschek_romo_2004.claims import claims
from shaketable_studies.boroschek_romo_2004.grid import grid
from shaketable_studies.boroschek_romo_2004.performance import overturned, performance, violators
from shaketable_studies.boroschek_romo_2004.rule import Rule, fit_rule, roc_tables, rule_table

RULE = "fitted rule"


def run(
    motions: Sequence[Motion],
    *,
    description: str = "",
    seed: int = 0,
    progress: Progress = True,
) -> Study:
    """Do the paper's study with `motions` in place of its records.

    Args:
        motions: at least one, with or without a vertical component; each counts in both
            directions.
        description: what to call them.
        seed: of the bootstrap over recordings.
        progress: as for simulate_many.

    Raises:
        InputError: no scikit-learn, no motions, or no rule can be fitted to what they overturn.
    """
    if not motions:
        raise InputError("the study needs at least one motion")
    rows = grid()
    events = events_of(motions)
    weights = nested_resamples(events, seed=seed)
    total = 2 * len(rows) * len(motions) + trials.simulations(len(motions), len(rows))
    with meter("study", total + widths.simulations(len(motions)), progress) as done:
        cases = simulate_cases(rows, motions, done)
        tried = trials.try_criteria(rows, motions, weights, done)
        by_widths = widths.ratios(motions, weights, done)
    demanded = friction.demands(motions)
    rule = fit_rule(cases, weights)
    warned = {name: cases.scores[name] > 1.0 for name in PUBLISHED}
    criteria = performance(cases, {**warned, RULE: rule.held_out >= shaketable_2026.SAFE}, weights)
    fell = overturned(cases, weights)
    roc, areas = roc_tables(cases, {**cases.scores, RULE: rule.held_out})
    said = records_in_words(len(motions), events.size, description, int(events.max()) + 1)
    return Study(
        records=said,
        tables={
            "bodies": _bodies(rows, cases),
            "points": _points(rows, cases),
            "motions": _motions(cases),
            "figure_07": fell.drop(columns=["ratio", "ratio_low", "ratio_high"]),
            "figure_08": fell.drop(columns=["overturned", "overturned_low", "overturned_high"]),
            "criteria": criteria,
            "violators": violators(cases),
            "rule": rule_table(rule),
            "calibration": _calibration(cases, rule),
            "roc": roc,
            "roc_areas": areas,
            "rocking_cases": tried.table,
            "counterexamples": tried.counterexamples,
            "figure_08_widths": by_widths,
            "friction_demand": demanded,
            "friction_needed": friction.needed(demanded),
            "friction_shares": friction.shares_without_sliding(demanded),
            "claims": table_of(claims(cases, tried, by_widths, demanded), said),
        },
    )


def _bodies(rows: pd.DataFrame, cases: Cases) -> pd.DataFrame:
    """The grid, and how often each body falls."""
    return rows.assign(
        simulations=2 * len(cases.motions),
        falls=cases.falls.sum(axis=1),
    )


def _motions(cases: Cases) -> pd.DataFrame:
    """Peaks of each motion, and whether its baseline had to be corrected."""
    return pd.DataFrame(
        {
            "record": cases.motions,
            "recording": cases.recording,
            "pga_m_s2": [peak.acceleration for peak in cases.peaks],
            "pgv_m_s": [peak.velocity for peak in cases.peaks],
            "baseline_corrected": [peak.corrected for peak in cases.peaks],
        }
    )


def _points(rows: pd.DataFrame, cases: Cases) -> pd.DataFrame:
    """Every body under every motion: in how many of the two directions it falls (figures 4-6)."""
    body, motion = (index.ravel() for index in np.indices(cases.falls.shape))
    return pd.DataFrame(
        {
            "eccentricity": rows["eccentricity"].to_numpy()[body],
            "cg_height_m": rows["cg_height_m"].to_numpy()[body],
            "base_m": rows["base_m"].to_numpy()[body],
            "motion": motion,
            "falls": cases.falls.ravel(),
        }
    )


def _calibration(cases: Cases, rule: Rule) -> pd.DataFrame:
    """Chances that the rule gave for recordings it was not fitted to, and what happened."""
    edges = np.array([0.0, 0.001, 0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.99, 1.0])
    cell: NDArray[np.intp] = np.clip(
        np.searchsorted(edges, rule.held_out, side="right") - 1, 0, edges.size - 2
    )
    found = []
    for k in range(edges.size - 1):
        here = cell == k
        number = 2 * int(here.sum())
        found.append(
            {
                "chance_from": edges[k],
                "chance_to": edges[k + 1],
                "simulations": number,
                "mean_chance": rule.held_out[here].mean() if number else np.nan,
                "fell": cases.falls[here].sum() / number if number else np.nan,
            }
        )
    return pd.DataFrame(found)
