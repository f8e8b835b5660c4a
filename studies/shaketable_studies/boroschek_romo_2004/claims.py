"""What the paper says, beside what the motions at hand say."""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.criteria.overturning import ISHIYAMA, KNOWN, UNKNOWN
from shaketable.resampling import interval
from shaketable.study import BY_CONSTRUCTION, NO, OPEN, YES, Claim
from shaketable_studies.boroschek_romo_2004.cases import Cases
from shaketable_studies.boroschek_romo_2004.friction import needed
from shaketable_studies.boroschek_romo_2004.grid import CG_HEIGHTS
from shaketable_studies.boroschek_romo_2004.trials import LITERAL, SAYS_SAFE, Tried

ENOUGH = 100  # falls: with fewer a criterion has not been put to the test
MOST_NAMED = 4
MARGIN = 0.1  # of friction, beyond what is enough at rest
#: The share of falls that a criterion may miss: the paper's 99.4 % of all cases, and none.
MAY_MISS, NONE = 0.01, 0.001


def claims(
    cases: Cases, tried: Tried, by_widths: pd.DataFrame, demanded: pd.DataFrame
) -> list[Claim]:
    """The paper's claims, one by one.

    Args:
        cases: for the names of motions.
        tried: the criteria judged by what rocks.
        by_widths: figure 8's ratio for several ranges of widths.
        demanded: the friction demands.
    """
    return [
        _ishiyama(cases, tried),
        _known(tried, KNOWN, "its own inertia"),
        _known(tried, LITERAL, "eq. 2 to the letter: B' everywhere, its inertia too"),
        _unknown(tried, 0.3),
        _unknown(tried, 0.2),
        _more_fall(by_widths),
        _more_conservative(tried, "bigger bodies", (0.3, CG_HEIGHTS[-1]), (0.3, CG_HEIGHTS[0])),
        _more_conservative(tried, "smaller eccentricities", (0.5, 0.0), (0.3, 0.0)),
        _without_sliding(demanded),
    ]


def _row(table: pd.DataFrame, name: str, eccentricity: float) -> pd.Series:
    chosen = table[
        (table["criterion"] == name)
        & (table["eccentricity"] == eccentricity)
        & (table["cg_height_m"] == 0.0)
    ]
    return chosen.iloc[0]


def _judged(rows: list[pd.Series], limit: float) -> str:
    """Whether a criterion misses at most `limit` of the falls, and does say "safe".

    A rule that never says so misses nothing: it holds by construction, and is worth nothing.
    """
    if any(row["called_safe"] == 0.0 for row in rows):
        return BY_CONSTRUCTION
    if any(row["missed_low"] > limit for row in rows):
        return NO
    tried = all(row["falls"] >= ENOUGH and row["called_safe"] >= SAYS_SAFE for row in rows)
    return YES if tried and all(row["missed_high"] <= limit for row in rows) else OPEN


def _said(row: pd.Series) -> str:
    if not row["falls"]:
        return f"nothing falls; {100 * row['called_safe']:.0f} % of what rocks is called safe"
    ends = (row["missed_share"], row["missed_low"], row["missed_high"])
    value, low, high = (f"{100 * end:.2g}" for end in ends)
    return (
        f"misses {value} % ({low} to {high}) of {row['falls']} falls and calls "
        f"{100 * row['called_safe']:.0f} % of what rocks safe"
    )


def _limit(share: float) -> str:
    return (
        f" (asked for: at most {100 * share:g} % of the falls missed, of {ENOUGH} or more, and "
        f"{100 * SAYS_SAFE:g} % or more called safe)"
    )


def _ishiyama(cases: Cases, tried: Tried) -> Claim:
    row = _row(tried.table, ISHIYAMA, 0.5)
    symmetric = (cases.rows["eccentricity"] == 0.5).to_numpy()
    missed = (cases.falls[symmetric] > 0) & (cases.scores[ISHIYAMA][symmetric] <= 1.0)
    names = [cases.motions[k] for k in np.flatnonzero(missed.any(axis=0))]
    by = f"; violated by {', '.join(names)}" if names else ""
    return Claim(
        "Ishiyama's criterion is satisfied by symmetric bodies",
        "in 99.4 % of the cases, violated by Chile 1985 Iloca N90E and Northridge 1994 City "
        "Terrace 090",
        f"{_said(row)}{by}{_limit(MAY_MISS)}",
        _judged([row], MAY_MISS),
    )


def _known(tried: Tried, name: str, how: str) -> Claim:
    rows = {nu: _row(tried.table, name, nu) for nu in (0.4, 0.3, 0.2)}
    said = "; ".join(f"ν = {nu:g}: {_said(row)}" for nu, row in rows.items())
    return Claim(
        f"with a known eccentricity Ishiyama's criterion is valid with B' = 2νB ({how})",
        "yes",
        f"{said}{_limit(MAY_MISS)}",
        _judged(list(rows.values()), MAY_MISS),
    )


def _unknown(tried: Tried, nu: float) -> Claim:
    row = _row(tried.table, UNKNOWN, nu)
    inside = nu >= 0.3
    return Claim(
        f"the factor 0.2 is conservative for ν = {nu:g}",
        "yes" if inside else "not said: its range ends at 0.3",
        f"{_said(row)}{_counterexamples(tried, nu)}{_limit(NONE if inside else MAY_MISS)}",
        _judged([row], NONE if inside else MAY_MISS),
    )


def _counterexamples(tried: Tried, nu: float) -> str:
    table = tried.counterexamples
    here = table[(table["criterion"] == UNKNOWN) & (table["eccentricity"] == nu)]
    names = list(dict.fromkeys(here["record"]))
    if not names:
        return "; no counterexample"
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return f"; counterexamples: {', '.join(names[:MOST_NAMED])}{more}"


def _more_fall(by_widths: pd.DataFrame) -> Claim:
    """Figure 8 for several ranges of widths: the verdict is that of all of them."""
    name = "at ν = 0.3 more bodies overturn than symmetric ones"
    says = "about 2 to 3.5 times as many"
    each = by_widths[by_widths["cg_height_m"] > 0.0]
    every = by_widths[by_widths["cg_height_m"] == 0.0]
    if not np.isfinite(every["ratio"]).all():
        return Claim(name, says, "in some range of widths no symmetric body falls", OPEN)
    told = []
    for row in every.itertuples():
        heights = each.loc[(each["widths"] == row.widths) & np.isfinite(each["ratio"]), "ratio"]
        told.append(
            f"B/H {row.b_over_h_least:.2f} to {row.b_over_h_most:.2f}: {row.ratio:.2g} "
            f"({row.ratio_low:.2g} to {row.ratio_high:.2g}), by height {heights.min():.2g} to "
            f"{heights.max():.2g}"
        )
    inside = (every["ratio_low"] >= 2.0) & (every["ratio_high"] <= 3.5)
    outside = (every["ratio_high"] < 2.0) | (every["ratio_low"] > 3.5)
    return Claim(
        name,
        says,
        f"the widths are not listed, and decide: {'; '.join(told)}",
        YES if inside.all() else NO if outside.all() else OPEN,
    )


def _more_conservative(
    tried: Tried, of_what: str, more: tuple[float, float], less: tuple[float, float]
) -> Claim:
    """By two measures of the factor 0.2, which need not agree.

    A conservative rule does not call safe what rocks and stands, and what falls lies far above its
    limit.
    """
    name = f"more conservative results are obtained for {of_what}"
    alarm = tried.alarms[more] - tried.alarms[less]
    margin = tried.margins[more] - tried.margins[less]
    ends = [tuple(float(e) for e in interval(off[1:])) for off in (alarm, margin)]
    if np.isnan([alarm[0], margin[0], *ends[0], *ends[1]]).any():
        return Claim(name, "in general", "too little rocks or falls to tell", OPEN)
    values = [100 * float(tried.alarms[key][0]) for key in (more, less)]
    times = [float(np.exp(tried.margins[key][0])) for key in (more, less)]
    up, down = all(low > 0.0 for low, _ in ends), all(high < 0.0 for _, high in ends)
    return Claim(
        name,
        "in general",
        f"the factor 0.2 does not call safe {values[0]:.0f} % of what rocks and stands, against "
        f"{values[1]:.0f} % (difference {100 * ends[0][0]:+.0f} to {100 * ends[0][1]:+.0f} %); "
        f"what falls has a PGV of {times[0]:.1f} times its limit in the mean, against "
        f"{times[1]:.1f}",
        YES if up else NO if down else OPEN,
    )


def _without_sliding(demanded: pd.DataFrame) -> Claim:
    """The third condition, that friction suffices while the body rocks."""
    name = "bodies that rock do not slide, where friction is enough at rest"
    says = "assumed: only rocking is analysed"
    if demanded.empty:
        return Claim(name, says, "nothing rocks", OPEN)
    table = needed(demanded)
    symmetric = table[table["eccentricity"] == 0.5]
    told = "; ".join(
        f"B/H {row.b_over_h:.2f}: {row.half:.2f} for half, {row.nineteen_of_twenty:.2f} for "
        "nineteen of twenty"
        for row in symmetric.itertuples()
    )
    margin = demanded["demand"] <= demanded["at_rest"] + MARGIN
    share = margin.groupby(demanded["eccentricity"]).mean()
    enough = "; ".join(f"{100 * value:.0f} % at ν = {nu:g}" for nu, value in share.items())
    return Claim(
        name,
        says,
        f"as it lifts a body asks for more than b/h of the corner about which it rocks: that is "
        f"never enough. Friction needed while rocking, max |R_x|/R_y: {told}; {MARGIN:g} more than "
        f"b/h of the farther corner is enough throughout for {enough} of what rocks",
        BY_CONSTRUCTION,
    )
