"""Which intensity measure tells best whether bodies reach a state, and tells enough.

Luco N., Cornell C.A. (2007) Structure-specific scalar intensity measures for near-source and
ordinary earthquake ground motions, Earthquake Spectra 23(2):357-392. A measure is efficient if the
dispersion about it is small: here β of the factor on the motion that a body takes at one value of
the measure, which is β of the measure over the power with which it grows with that factor (2 for
the Arias intensity). It is sufficient if, at a given level of it, nothing else of the motion
matters: then a covariate has no effect beside it in the probit regression.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.counts import counted, telling_scales
from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.fragility import TRIED
from shaketable.fragility.intensities import OWN, intensities
from shaketable.fragility.limit_states import OVERTURNS
from shaketable.fragility.limit_states import limit_state as state_of
from shaketable.fragility.lognormal import Points, fit_many, reflected
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS, ends, events_of, nested_resamples, recordings_of
from shaketable.signal import measure_named
from shaketable.simulate import listed, simulate_many
from shaketable.simulate.checks import numbers

if TYPE_CHECKING:
    import pandas as pd

MEASURES = (
    "PGA", "PGV", "PGD", "SA(0.3)", "SA(1.0)", "SA(2.0)", "AvgSA(1.0)", "CAV", "Arias", "Housner",
)  # fmt: skip


def efficiency(
    bodies: Body | Sequence[Body],
    motions: Sequence[Motion],
    measures: Sequence[str] = MEASURES,
    *,
    limit_state: str = OVERTURNS,
    covariates: Mapping[str, ArrayLike] | None = None,
    scales: ArrayLike | None = None,
    tilt: float = 0.0,
    components: str = OWN,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> pd.DataFrame:
    """Dispersion about each measure, and what else of the motion matters beside it.

    Args:
        bodies: one or more; each is compared by itself.
        motions, scales, tilt, components, model, draws, seed, progress, threads: as for
            `fragility`.
        measures: their names.
        limit_state: whose probability they tell.
        covariates: other quantities of each motion above 0, (motion,) each. The significant
            duration is always among them; magnitude and distance are where the origins of all
            motions tell them.

    Returns:
        A row for each body and measure, the smallest dispersion first: `beta` of the measure;
        `dispersion` of the factor on the motion with its 95 % interval; `more_than_best`, by how
        much it is larger than the smallest, with the interval of that difference; and for each
        covariate its effect on ln θ where its logarithm (the magnitude itself) is one standard
        deviation larger, and the p-value of there being none, over earthquakes.

    Raises:
        InputError: what `fragility` says, a measure that does not grow with the motion, or
            covariates of another length or not above 0.
    """
    import pandas as pd

    bodies = [bodies] if isinstance(bodies, Body) else listed("bodies", bodies, Body)
    motions = listed("motions", motions, Motion)
    state, known = state_of(limit_state), [measure_named(name) for name in measures]
    powers = np.array([one.power or 0 for one in known], np.float64)
    if not powers.all():
        still = known[int(np.argmin(powers))].name
        raise InputError(f"measure {still!r}: does not grow with the motion; it has no dispersion")
    recording = recordings_of(motions)
    event = events_of(motions)
    weights = nested_resamples(event, draws, seed)
    beside = known_covariates(motions, covariates)
    tried = TRIED if scales is None else np.unique(numbers("scales", scales))
    runs = simulate_many(
        bodies, motions, tilts=[tilt], scales=tried, model=model, progress=progress,
        threads=threads,
    )  # fmt: skip
    counts = counted(runs, bodies, [state])
    if scales is None:
        telling = telling_scales(counts)
        counts, tried = counts.at(telling), tried[telling]
    levels = [intensities(motions, one, tried, components=components).ravel() for one in known]
    of_point = np.repeat(recording, tried.size)
    trials = np.full(of_point.size, counts.trials)
    rows: list[dict[str, Any]] = []
    for b, body in enumerate(bodies):
        reached = counts.reached[b, 0].ravel()
        points = [Points(im, reached, trials, of_point) for im in levels]
        betas = np.array([fit_many(one, weights).beta for one in points])  # (measure, draw)
        spread = betas / powers[:, None]
        best = int(np.nanargmin(spread[:, 0])) if np.isfinite(spread[:, 0]).any() else 0
        for k in np.argsort(spread[:, 0], kind="stable").tolist():
            low, high = ends(reflected(spread[k])) if draws else (np.nan, np.nan)
            more = spread[k] - spread[best]
            more_low, more_high = ends(2.0 * more[0] - more[1:]) if draws else (np.nan, np.nan)
            row = {
                "body": body.name,
                "measure": known[k].name,
                "beta": betas[k, 0],
                "dispersion": spread[k, 0],
                "dispersion_low": low,
                "dispersion_high": high,
                "more_than_best": more[0],
                "more_low": more_low,
                "more_high": more_high,
            }
            for name, one in beside.items():
                at = np.repeat(one.standard, tried.size)
                row[f"{name}_effect"], row[f"{name}_p"] = _effect(points[k], at, event[of_point])
            rows.append(row)
    return pd.DataFrame(rows)


def _effect(
    points: Points, covariate: NDArray[np.float64], event: NDArray[np.intp]
) -> tuple[float, float]:
    """The effect on ln θ of one unit of a covariate, and the p-value of there being none."""
    import statsmodels.api as sm

    if not 0 < points.reached.sum() < points.trials.sum() or np.ptp(covariate) == 0.0:
        return np.nan, np.nan
    x = sm.add_constant(np.column_stack([np.log(points.intensity), covariate]))
    counts = np.column_stack([points.reached, points.trials - points.reached])
    family = sm.families.Binomial(sm.families.links.Probit())
    fit = sm.GLM(counts, x, family=family).fit(cov_type="cluster", cov_kwds={"groups": event})
    return float(-fit.params[2] / fit.params[1]), float(fit.pvalues[2])
