"""What the paper says, beside what is printed, what can be recovered and what floors at hand say.

Every verdict can come out either way; each names its threshold and what it rests on.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pandas as pd

from shaketable.criteria import kaneko_hayashi_2004
from shaketable.resampling import FEWEST, ends, ratio, resamples
from shaketable.study import NO, OPEN, YES, Claim, verdict_within
from shaketable_studies.cimellaro_2020.printed import TABLE_2, TABLE_3
from shaketable_studies.cimellaro_2020.pulse import SOLVERS
from shaketable_studies.cimellaro_2020.recovered import FAR
from shaketable_studies.cimellaro_2020.slide import Slides, certain, step
from shaketable_studies.cimellaro_2020.switch import SAME, difference

EQUAL = 0.02  # root mean squares of surfaces that differ by less are alike
ACCURATE = 0.1  # root mean square of a ratio's error up to which no accuracy is lost
WORSE = 3.0  # times the error of the stiff solver
SLID = "the general model, recorded ground motions without verticals"
PRINTED = "the paper's printed tables"
TELLING = 0.05  # mean risk on the floors, below which nothing falls on either channel
FEWEST_OF_A_KIND = 3  # recordings with channels on both branches, and on one
ALIKE = 0.1  # difference of two slide coefficients up to which they are the same
CHANCE = 0.05  # of an arrangement by luck, from which on it proves nothing


class ClaimInputs(NamedTuple):
    """What the claims are judged by; tables as the study gives them."""

    table_2: pd.DataFrame
    table_3: pd.DataFrame
    mixed: pd.DataFrame
    edges: pd.DataFrame
    recorded: pd.DataFrame
    by_building: pd.DataFrame
    by_height: pd.DataFrame
    by_order: pd.DataFrame
    models: pd.DataFrame
    worse: tuple[float, float, float]
    solvers: pd.DataFrame
    slide: Slides
    constants: pd.DataFrame
    seed: int


def claims(found: ClaimInputs) -> list[Claim]:
    """The paper's claims, one by one."""
    return [
        _constants(found.constants),
        _switch_as_printed(found.mixed),
        _switch_anew(found.edges, found.seed),
        *_switch_recorded(found.recorded, found.seed),
        _direct_agrees(found.table_2, found.seed),
        _higher(found.table_2),
        _no_less_accurate(found.by_building),
        _size(found.by_building, found.by_height),
        _better_than_kaneko(found.models, found.worse),
        _table_3(found.table_3),
        *_tests(),
        _stiff(found.solvers),
        _slide(found.slide),
        _second_order(found.by_order),
    ]


def _constants(constants: pd.DataFrame) -> Claim:
    """Whether one B/H and ζ_A explain what is printed without one contradiction."""
    best, before = (
        constants[constants["which"] == which].iloc[0] for which in ("recovered", "assumed before")
    )
    return Claim(
        "the simplified risks of table 2 are Kaneko & Hayashi's of the floors' accelerations",
        "yes; ζ_A and B/H are not printed",
        f"eq. 9 inverted gives the accelerations; with B/H {best.b_over_h_low:g} to "
        f"{best.b_over_h_high:g} and ζ_A {best.zeta_a_low:g} to {best.zeta_a_high:g}, "
        f"{best.entries_met} of the {best['of']} entries between 1 and 100 % come out to their "
        f"rounding, the others are below, as the velocity's branch puts them, none is above; "
        f"{before.b_over_h_low:g} and {before.zeta_a_low:g} would give {before.entries_met}, with "
        f"{before.contradicted} above",
        YES if best.entries_met > best["of"] / 2 else NO,
        PRINTED,
    )


def _switch_as_printed(mixed: pd.DataFrame) -> Claim:
    """Whether the floors that mix branches are those that spread most, in the paper's table."""
    mixes = mixed["mixes"].to_numpy()
    spread = mixed["spread"].to_numpy()
    number = int(mixes.sum())
    name = "Kaneko & Hayashi's switch makes channels of one floor disagree, in table 2"
    if not 0 < number < mixes.size:
        return Claim(name, "yes", "no floor mixes branches, or all do", OPEN, PRINTED)
    apart = spread[mixes].min() > spread[~mixes].max()
    told = " and ".join(f"{100 * one:.0f}" for one in sorted(spread[mixes], reverse=True))
    return Claim(
        name,
        "yes",
        f"of {mixes.size} floors with several channels {number} mix branches (a channel lies more "
        f"than {100 * FAR:.0f} % below the ratio of its acceleration, another does not) and "
        f"spread by {told} %, all others by "
        f"at most {100 * spread[~mixes].max():.0f} %",
        YES if apart else NO,
        PRINTED,
    )


def _switch_anew(edges: pd.DataFrame, seed: int) -> Claim:
    """The same with channels in one direction on floors that twist."""
    off, low, high = difference(edges, seed)
    mixes = edges["mixes"].to_numpy()
    rests = (
        f"{edges['building'].nunique()} buildings that twist under "
        f"{edges['recording'].nunique()} recordings"
    )
    name = "Kaneko & Hayashi's switch makes channels of one floor and direction disagree"
    if np.isnan([off, low, high]).any():
        return Claim(name, "yes", "no floor mixes branches, or all do", OPEN, rests)
    return Claim(
        name,
        "yes",
        f"channels at both edges differ by {100 * edges['simplified_spread'][mixes].mean():.0f} % "
        f"in the mean where they are on both branches ({int(mixes.sum())} of {mixes.size} cases), "
        f"by {100 * edges['simplified_spread'][~mixes].mean():.0f} % where on one: "
        f"{100 * off:+.0f} % (interval {100 * low:+.0f} to {100 * high:+.0f} %; the claim asks for "
        f"more than {100 * SAME:.0f} %); eq. 9 differs by "
        f"{100 * edges['formula_spread'].mean():.0f} % over all",
        YES if low > SAME else NO if high < SAME else OPEN,
        rests,
    )


def _switch_recorded(table: pd.DataFrame, seed: int) -> list[Claim]:
    """The same with the floors given that have several channels in one direction, if any have."""
    if table.empty:
        return []
    mixes = table["mixes"].to_numpy()
    recordings = table["recording"].nunique()
    # of each kind: a bootstrap over fewer draws the same few again and again
    fewest = min(table["recording"][here].nunique() for here in (mixes, ~mixes))
    told = " and by ".join(
        f"{100 * table['simplified_spread'][here].mean():.0f} % where they are on {word}"
        for here, word in ((mixes, "both branches"), (~mixes, "one branch"))
        if here.any()
    )
    verdict = OPEN
    if not mixes.any() or mixes.all():
        between = "no two of them mix branches" if not mixes.any() else "all of them mix branches"
    elif recordings < FEWEST or fewest < FEWEST_OF_A_KIND:
        between = (
            f"{recordings} recordings, of which {fewest} of the rarer kind, are too few to compare"
        )
    else:
        off, low, high = difference(table, seed)
        between = f"{100 * off:+.0f} % (interval {100 * low:+.0f} to {100 * high:+.0f} %)"
        verdict = YES if low > SAME else NO if high < SAME else OPEN
    return [
        Claim(
            "Kaneko & Hayashi's switch makes channels of one recorded floor and direction disagree",
            "yes",
            f"two channels that face one way differ in the mean by {told} "
            f"({int(mixes.sum())} of {mixes.size} cases on both): {between}; eq. 9 differs by "
            f"{100 * table['formula_spread'].mean():.0f} % over all",
            verdict,
            f"floors of the buildings given, buildings times earthquakes: {recordings}",
        )
    ]


def _direct_agrees(table_2: pd.DataFrame, seed: int) -> Claim:
    name = "direct integration is more alike within a floor than Kaneko & Hayashi's ratio"
    says = f"yes: {_printed_spreads()} in its table 2"
    known = table_2[table_2["storey"] > 0]
    grouped = known.groupby(["building", "storey"])[["simplified", "direct", "formula"]]
    spread = (grouped.max() - grouped.min())[grouped.size() > 1]
    if spread.empty:
        return Claim(name, says, "no floor with more than one channel is known", OPEN)
    if known["direct"].mean() < TELLING:
        told = f"{100 * known['direct'].mean():.1f} % of the simulations fall: too few to tell"
        return Claim(name, says, told, OPEN)
    weights = resamples(len(spread), seed=seed)
    draws = ratio(
        (spread["simplified"] - spread["direct"]).to_numpy(), np.ones(len(spread)), weights
    )
    low, high = ends(draws[1:])
    means = 100 * spread.mean()
    return Claim(
        name,
        says,
        f"mean difference between the channels of a floor: simplified {means['simplified']:.0f} %, "
        f"direct {means['direct']:.0f} %, formula {means['formula']:.0f} %; simplified less direct "
        f"{100 * draws[0]:+.0f} % (interval over {len(spread)} floors {100 * low:+.0f} to "
        f"{100 * high:+.0f} %); channels in two directions need not agree",
        YES if low > 0.0 else NO if high < 0.0 else OPEN,
    )


def _printed_spreads() -> str:
    """Mean differences within a floor, from the paper's own table 2."""
    table = pd.DataFrame(TABLE_2)
    grouped = table.groupby(["building", "storey"])
    ways = grouped[["simplified", "direct", "proposed"]]
    spread = ways.max() - ways.min()
    means = spread[grouped.size() > 1].mean()
    return f"{means['simplified']:.0f}, {means['direct']:.0f} and {means['proposed']:.0f} %"


def _higher(table_2: pd.DataFrame) -> Claim:
    """A sign test over the channels in which the two surely differ."""
    from scipy.stats import binomtest

    above = int((table_2["direct_low"] > table_2["simplified"]).sum())
    below = int((table_2["direct_high"] < table_2["simplified"]).sum())
    sure = above + below
    luck = float(binomtest(above, sure).pvalue) if sure else 1.0
    return Claim(
        "direct integration gives higher risks than Kaneko & Hayashi",
        "yes",
        f"of {len(table_2)} channels surely higher in {above}, surely lower in {below}; a fair "
        f"coin would be as uneven with the probability {luck:.2g}",
        OPEN if luck > CHANCE else YES if above > below else NO,
    )


def _no_less_accurate(by_building: pd.DataFrame) -> Claim:
    off = by_building["formula_rms_off"]
    return Claim(
        "the formula loses no accuracy",
        "yes",
        f"root mean square off direct integration: formula {100 * off.min():.0f} to "
        f"{100 * off.max():.0f} % from building to building, Kaneko & Hayashi "
        f"{100 * by_building['simplified_rms_off'].min():.0f} to "
        f"{100 * by_building['simplified_rms_off'].max():.0f} %; up to {100 * ACCURATE:.0f} % no "
        "accuracy is lost",
        verdict_within(float(off.min()), float(off.max()), 0.0, ACCURATE),
    )


def _size(by_building: pd.DataFrame, by_height: pd.DataFrame) -> Claim:
    rows = by_height[by_height["height_m"] > 0.0]
    said = ", ".join(
        f"{row.formula_mean_off:+.0%} for {row.height_m:g} m" for row in rows.itertuples()
    )
    spread = by_building["spread_over_heights"]
    return Claim(
        "size need not be known",
        "eq. 9 has B/H and PFA alone",
        f"the formula is off in the mean by {said}: from one height to another by "
        f"{100 * spread.min():.0f} to {100 * spread.max():.0f} % from building to building; up to "
        f"{100 * ACCURATE:.0f} % size need not be known",
        verdict_within(float(spread.min()), float(spread.max()), 0.0, ACCURATE),
    )


def _better_than_kaneko(models: pd.DataFrame, worse: tuple[float, float, float]) -> Claim:
    """On recorded ground motions, with the deviations that simulations give Kaneko and Hayashi."""
    grid = models[models["bodies"] == "grid of sizes"].set_index("model")["brier"]
    said = ", ".join(f"{name} {brier:.3f}" for name, brier in grid.sort_values().items())
    off, low, high = worse
    return Claim(
        "the formula predicts better than Kaneko & Hayashi",
        "more consistent results",
        f"Brier scores (0 is perfect, 0.25 a coin): {said}; eq. 9 less Kaneko & Hayashi "
        f"{off:+.3f} (interval {low:+.3f} to {high:+.3f})",
        YES if high < 0.0 else NO if low > 0.0 else OPEN,
        "recorded ground motions, furniture of 32 sizes",
    )


def _table_3(table_3: pd.DataFrame) -> Claim:
    """How many entries come out, with each of two values of g."""
    met = {
        g: sum(int(table_3[f"{which}_met_{g}"].sum()) for which in ("mean", "largest", "smallest"))
        for g in ("981", "980665")
    }
    entries = 3 * len(table_3)
    return Claim(
        "table 3 is eq. 9 of the tests' accelerations",
        f"{entries} entries",
        f"{met['981']} of {entries} come out to their two digits with g = 981 cm/s², "
        f"{met['980665']} with 980.665 (AL1's mean differs): the paper took 981",
        YES if max(met.values()) == entries else NO,
        PRINTED,
    )


def _tests() -> list[Claim]:
    """Section 5's three statements about table 3, judged by what is printed there."""
    found = []
    for which, said in (("mean", "very high"), ("largest", "very high"), ("smallest", "high")):
        risks = [getattr(sample, which)[1] for sample in TABLE_3]
        classes = [kaneko_hayashi_2004.risk_class(risk) for risk in risks]
        agree = classes.count(said)
        others = [risk for risk, name in zip(risks, classes, strict=True) if name != said]
        rest = f"; the others are {min(others):.2f} to {max(others):.2f}" if others else ""
        found.append(
            Claim(
                f"the {which} overturning accelerations of the tests are {said} risks",
                "yes: a satisfactory compatibility",
                f"of the {len(risks)} printed in table 3, {agree} are{rest}",
                YES if agree == len(risks) else NO,
                PRINTED,
            )
        )
    return found


def _stiff(solvers: pd.DataFrame) -> Claim:
    """Whether an explicit solver misses the borders that a stiff one finds."""
    error = solvers.set_index("solver")["largest_error"]
    usual, stiff = float(error[SOLVERS[0].name]), float(error[SOLVERS[2].name])
    told = "; ".join(
        f"{row.solver} {row.largest_error:.4f}" for row in solvers.itertuples(index=False)
    )
    return Claim(
        "the equation is stiff: ode23s finds the transition of figure 2, ode45 does not",
        "ode23s is selected",
        f"largest error of the borders in a_p/(αg), bisected to 0.002 and each solver restarted at "
        f"every impact: {told}; with the tolerances that ode45 has by default it misses them where "
        f"its error is more than {WORSE:g} times the stiff one's, and not because of stiffness: "
        "with the same tolerances or with short steps the explicit one finds them",
        YES if usual > WORSE * max(stiff, 1e-3) else NO,
        "figure 2's block, borders known to 1e-4",
    )


def _slide(slides: Slides) -> Claim:
    """Whether B/H and the friction decide, or the height and the strength of shaking too."""
    table, apart = slides
    none, nearly = step(table)
    apart = apart[apart["difference"].notna()]
    nowhere = apart.empty or not {"height", "scale"} <= set(apart["what"])
    if nowhere or not none < nearly:
        return Claim(
            "the slide coefficient is a function of B/H and the friction",
            "in [0, 1]; not printed",
            "too little falls to tell how it goes from no falls to all of those without sliding",
            OPEN,
            SLID,
        )
    known = table.loc[table["friction_over_b_over_h"] >= nearly, "coefficient"]
    far = apart.loc[apart["difference"].abs().groupby(apart["what"]).idxmax()]
    told = "; ".join(
        f"of both {one['what']}s by {100 * one['difference']:+.0f} % (interval "
        f"{100 * one['low']:+.0f} to {100 * one['high']:+.0f} %, at B/H {one['b_over_h']:g} and a "
        f"friction of {one['friction_over_b_over_h']:g} B/H)"
        for one in far.to_dict("records")
    )
    within = ((apart["low"] >= -ALIKE) & (apart["high"] <= ALIKE)).all()
    beyond = ((apart["low"] > ALIKE) | (apart["high"] < -ALIKE)).any()
    return Claim(
        "the slide coefficient is a function of B/H and the friction",
        "in [0, 1]; not printed",
        f"nearly a step in friction over B/H: no falls up to {none:g}, from {nearly:g} on "
        f"{100 * known.min():.0f} to {100 * known.max():.0f} % of those without sliding; of "
        f"{len(apart)} comparisons at one B/H and friction the coefficients differ most {told}; up "
        f"to {100 * ALIKE:.0f} % they are the same, each interval is "
        f"{100 * certain(len(apart)):.2f} %, so that one in twenty such sets misses",
        NO if beyond else YES if within else OPEN,
        SLID,
    )


def _second_order(by_order: pd.DataFrame) -> Claim:
    """Whether a polynomial of second order is off least on buildings it was not fitted to."""
    name, says = "a polynomial of second order describes the risk", "the best of several surfaces"
    if by_order.empty:
        return Claim(name, says, "one building alone cannot tell", OPEN)
    told = "; ".join(
        f"order {order} {100 * here.mean():.0f} % (from {100 * here.min():.0f} to "
        f"{100 * here.max():.0f} %)"
        for order, here in by_order.groupby("order")["rms_off"]
    )
    off = by_order.pivot_table(index="building", columns="order", values="rms_off")
    best = (off[2] < off[1] - EQUAL) & (off[2] <= off[3] + EQUAL)
    worse = (off[2] > off[1] - EQUAL) & (off[2] > off[3] + EQUAL)
    return Claim(
        name,
        says,
        f"off buildings that they were not fitted to, root mean square: {told}",
        YES if best.all() else NO if worse.all() else OPEN,
    )
