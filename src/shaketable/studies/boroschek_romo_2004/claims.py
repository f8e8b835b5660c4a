"""What the paper says, beside what the motions at hand say."""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.criteria.overturning import ISHIYAMA, KNOWN, UNKNOWN
from shaketable.studies.boroschek_romo_2004.cases import Cases
from shaketable.studies.study import NO, OPEN, YES, Claim

ENOUGH = 100  # falls: with fewer a criterion has not been put to the test


def claims(cases: Cases, criteria: pd.DataFrame, overturned: pd.DataFrame) -> list[Claim]:
    """The paper's claims, one by one.

    Args:
        cases: for the names of motions.
        criteria: the table of `performance`.
        overturned: the table of figures 7 and 8.
    """
    return [
        _ishiyama(cases, criteria),
        _known(criteria),
        _unknown(criteria, 0.3),
        _unknown(criteria, 0.2),
        _more_fall(overturned),
    ]


def _row(criteria: pd.DataFrame, name: str, eccentricity: float) -> pd.Series:
    chosen = criteria[
        (criteria["criterion"] == name)
        & (criteria["eccentricity"] == eccentricity)
        & (criteria["cg_height_m"] == 0.0)
    ]
    return chosen.iloc[0]


def _percent(row: pd.Series, name: str) -> str:
    value, low, high = (100 * row[f"{name}{end}"] for end in ("", "_low", "_high"))
    return f"{value:.3g} % ({low:.3g} to {high:.3g})"


def _satisfied(rows: list[pd.Series], limit: float) -> str:
    """Whether a criterion is satisfied in at least `limit` of the cases, in every one of the rows.

    What stands satisfies any criterion: without falls nothing is decided.
    """
    if any(row["satisfied_high"] < limit for row in rows):
        return NO
    tried = all(row["falls"] >= ENOUGH for row in rows)
    return YES if tried and all(row["satisfied_low"] >= limit for row in rows) else OPEN


def _missed(row: pd.Series) -> str:
    """The share of the falls that a criterion misses."""
    if not row["falls"]:
        return "nothing falls"
    return f"missing {_percent(row, 'false_safe')} of the falls"


def _ishiyama(cases: Cases, criteria: pd.DataFrame) -> Claim:
    row = _row(criteria, ISHIYAMA, 0.5)
    symmetric = (cases.rows["eccentricity"] == 0.5).to_numpy()
    missed = (cases.falls[symmetric] > 0) & (cases.scores[ISHIYAMA][symmetric] <= 1.0)
    names = [cases.motions[k] for k in np.flatnonzero(missed.any(axis=0))]
    by = f"; violated by {', '.join(names)}" if names else ""
    return Claim(
        "Ishiyama's criterion is satisfied by symmetric bodies",
        "in 99.4 % of the cases, violated by Chile 1985 Iloca N90E and Northridge 1994 City "
        "Terrace 090",
        f"in {_percent(row, 'satisfied')}, {_missed(row)}{by}",
        _satisfied([row], 0.99),
    )


def _known(criteria: pd.DataFrame) -> Claim:
    rows = {nu: _row(criteria, KNOWN, nu) for nu in (0.4, 0.3, 0.2)}
    said = "; ".join(f"ν = {nu:g}: {_percent(row, 'satisfied')}" for nu, row in rows.items())
    return Claim(
        "with a known eccentricity Ishiyama's criterion is valid with B' = 2νB",
        "yes",
        f"satisfied in {said}",
        _satisfied(list(rows.values()), 0.99),
    )


def _unknown(criteria: pd.DataFrame, nu: float) -> Claim:
    row = _row(criteria, UNKNOWN, nu)
    inside = nu >= 0.3
    limit = 0.999 if inside else 0.99
    return Claim(
        f"the factor 0.2 is conservative for ν = {nu:g}",
        "yes" if inside else "not said: its range ends at 0.3",
        f"satisfied in {_percent(row, 'satisfied')}, {_missed(row)}; false alarms in "
        f"{_percent(row, 'false_alarm')} of what stands",
        _satisfied([row], limit),
    )


def _more_fall(overturned: pd.DataFrame) -> Claim:
    rows = overturned[overturned["eccentricity"] == 0.3]
    every = rows[rows["cg_height_m"] == 0.0].iloc[0]
    each = rows[rows["cg_height_m"] > 0.0]
    name, says = (
        "at ν = 0.3 more bodies overturn than symmetric ones",
        "about 2 to 3.5 times as many",
    )
    if not np.isfinite(rows["ratio"]).all():
        return Claim(name, says, "at some heights no symmetric body falls", OPEN)
    said = ", ".join(
        f"{ratio:.2g} for {height:g} m"
        for height, ratio in zip(each["cg_height_m"], each["ratio"], strict=True)
    )
    inside = bool((each["ratio_low"] >= 2.0).all() and (each["ratio_high"] <= 3.5).all())
    outside = bool(((each["ratio_high"] < 2.0) | (each["ratio_low"] > 3.5)).any())
    return Claim(
        name,
        says,
        f"{every['ratio']:.3g} times as many ({every['ratio_low']:.3g} to "
        f"{every['ratio_high']:.3g}); by height {said}",
        YES if inside else NO if outside else OPEN,
    )
