"""What the paper says, beside what the floors at hand say."""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.criteria import kaneko_hayashi_2004
from shaketable.studies.cimellaro_2020.printed import TABLE_2, TABLE_3
from shaketable.studies.study import NO, OPEN, YES, Claim


def claims(
    table_2: pd.DataFrame, errors: pd.DataFrame, r_squared: float, models: pd.DataFrame
) -> list[Claim]:
    """The paper's claims, one by one; judged as observed."""
    return [
        _floors_disagree(table_2),
        _direct_agrees(table_2),
        _higher(table_2),
        _no_less_accurate(errors),
        _size(errors),
        _better_than_kaneko(models),
        _very_high_means(),
        Claim(
            "a polynomial of second order describes the risk",
            "the best of several surfaces",
            f"fitted anew R² {r_squared:.2f}",
            OPEN,
        ),
    ]


def _spreads(table_2: pd.DataFrame, way: str) -> pd.Series:
    """Largest difference between the channels of a floor, for floors with more than one."""
    known = table_2[table_2["storey"] > 0]
    grouped = known.groupby(["building", "storey"])[way]
    spread = grouped.max() - grouped.min()
    return spread[grouped.size() > 1]


def _floors_disagree(table_2: pd.DataFrame) -> Claim:
    name, says = "Kaneko & Hayashi's switch makes channels of one floor disagree", "yes"
    spread = _spreads(table_2, "simplified")
    if spread.empty:
        return Claim(name, says, "no floor with more than one channel is known", OPEN)
    switched = table_2[table_2["storey"] > 0].groupby(["building", "storey"])["branch"].nunique()
    both = switched.reindex(spread.index) > 1
    worst = [float(s.max()) if len(s) else np.nan for s in (spread[both], spread[~both])]
    said = (
        f"largest difference {100 * spread.max():.0f} %; of {len(spread)} floors {int(both.sum())} "
        f"have channels on both branches"
    )
    if not both.any():
        return Claim(name, says, f"{said}: the switch is not put to the test here", OPEN)
    said += f": up to {100 * worst[0]:.0f} % there"
    if not both.all():
        said += f", up to {100 * worst[1]:.0f} % elsewhere"
    return Claim(name, says, said, YES if both.all() or worst[0] > worst[1] else NO)


def _direct_agrees(table_2: pd.DataFrame) -> Claim:
    name = "direct integration and the formula agree within a floor"
    parts = {way: _spreads(table_2, way) for way in ("simplified", "direct", "formula")}
    if parts["direct"].empty:
        return Claim(name, "yes", "no floor with more than one channel is known", OPEN)
    means = {way: 100 * float(spread.mean()) for way, spread in parts.items()}
    said = (
        f"mean difference between the channels of a floor: simplified {means['simplified']:.0f} %, "
        f"direct {means['direct']:.0f} %, formula {means['formula']:.0f} %; channels in two "
        "directions need not agree"
    )
    less = means["direct"] < means["simplified"] and means["formula"] < means["simplified"]
    return Claim(name, f"yes: {_printed_spreads()} in its table 2", said, YES if less else OPEN)


def _printed_spreads() -> str:
    """Mean differences within a floor, from the paper's own table 2."""
    table = pd.DataFrame(TABLE_2)
    grouped = table.groupby(["building", "storey"])
    ways = grouped[["simplified", "direct", "proposed"]]
    spread = ways.max() - ways.min()
    means = spread[grouped.size() > 1].mean()
    return f"{means['simplified']:.0f}, {means['direct']:.0f} and {means['proposed']:.0f} %"


def _very_high_means() -> Claim:
    """The claim about table 3, judged by what is printed there."""
    means = [sample.mean[1] for sample in TABLE_3]
    above = sum(kaneko_hayashi_2004.risk_class(risk) == "very high" for risk in means)
    return Claim(
        "the formula calls the mean overturning accelerations of the tests very high risks",
        "yes",
        f"of the {len(means)} printed in table 3, {above} are: the others are 0.66 to 0.69",
        YES if above == len(means) else NO,
    )


def _higher(table_2: pd.DataFrame) -> Claim:
    above = int((table_2["direct_low"] > table_2["simplified"]).sum())
    below = int((table_2["direct_high"] < table_2["simplified"]).sum())
    return Claim(
        "direct integration gives higher risks than Kaneko & Hayashi",
        "yes",
        f"of {len(table_2)} channels surely higher in {above}, surely lower in {below}",
        YES if above > 2 * below else NO if below > 2 * above else OPEN,
    )


def _no_less_accurate(errors: pd.DataFrame) -> Claim:
    every = errors[errors["height_m"] == 0.0].iloc[0]
    return Claim(
        "the formula loses no accuracy",
        "yes",
        f"root mean square off direct integration: formula {100 * every['formula_rms_off']:.0f} %, "
        f"fitted anew {100 * every['refit_rms_off']:.0f} %, Kaneko & Hayashi "
        f"{100 * every['simplified_rms_off']:.0f} %",
        NO if every["formula_rms_off"] > 0.1 else YES,
    )


def _size(errors: pd.DataFrame) -> Claim:
    rows = errors[errors["height_m"] > 0.0]
    said = ", ".join(
        f"{row.formula_mean_off:+.0%} for {row.height_m:g} m" for row in rows.itertuples()
    )
    spread = rows["formula_mean_off"].max() - rows["formula_mean_off"].min()
    return Claim(
        "size need not be known",
        "eq. 9 has B/H and PFA alone",
        f"the formula is off in the mean by {said}",
        NO if spread > 0.1 else YES,
    )


def _better_than_kaneko(models: pd.DataFrame) -> Claim:
    """On recorded ground motions, with the deviations that simulations give Kaneko and Hayashi."""
    grid = models[models["bodies"] == "grid of sizes"].set_index("model")["brier"]
    said = ", ".join(f"{name} {brier:.3f}" for name, brier in grid.sort_values().items())
    better = grid["Cimellaro, eq. 9"] < grid["Kaneko & Hayashi"]
    return Claim(
        "the formula predicts better than Kaneko & Hayashi",
        "more consistent results",
        f"Brier scores (0 is perfect, 0.25 a coin): {said}",
        YES if better else NO,
    )
