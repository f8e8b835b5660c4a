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
from shaketable.fragility.cloud import cloud_of
from shaketable.fragility.covariates import known_covariates
from shaketable.fragility.intensities import OWN, intensities
from shaketable.fragility.limit_states import OVERTURNS
from shaketable.fragility.limit_states import limit_state as state_of
from shaketable.fragility.lognormal import MIN_FITTED_SHARE, Points, basic_limits, fit_many, scored
from shaketable.fragility.wild_score import score_p
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.resampling import DRAWS, ends, events_of, nested_resamples, recordings_of
from shaketable.signal import measure_named
from shaketable.simulate import listed
from shaketable.simulate.checks import unique_names

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
    polarities: ArrayLike = (1, -1),
    components: str = OWN,
    model: Model | str | None = None,
    draws: int = DRAWS,
    seed: int = 0,
    progress: Progress = False,
    threads: int | None = None,
) -> pd.DataFrame:
    """Compare intensity measures by their dispersion (efficiency) and sufficiency.

    Args:
        bodies: one or more; each is compared by itself.
        motions, scales, tilt, polarities, components, model, draws, seed, progress, threads: as
            for `fragility`.
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
        deviation larger, and the probability of such an effect by chance, over earthquakes (see
        `wild_score`); of many such p-values one in twenty is below 0.05 by chance.

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
    counts, tried = cloud_of(
        bodies, motions, [state], scales=scales, tilt=tilt, polarities=polarities,
        model=model_of(model), progress=progress, threads=threads,
    )  # fmt: skip
    levels = [intensities(motions, one, tried, components=components).ravel() for one in known]
    of_point = np.repeat(recording, tried.size)
    trials = np.full(of_point.size, counts.trials)
    rows: list[dict[str, Any]] = []
    for b, called in enumerate(unique_names(bodies)):
        reached = counts.reached[b, 0].ravel()
        points = [Points(im, reached, trials, of_point) for im in levels]
        betas = np.array([fit_many(one, weights).beta for one in points])  # (measure, draw)
        spread = betas / powers[:, None]
        best = int(np.nanargmin(spread[:, 0])) if np.isfinite(spread[:, 0]).any() else 0
        for k in np.argsort(spread[:, 0], kind="stable").tolist():
            low, high = basic_limits(spread[k])
            more = spread[k] - spread[best]
            more_low, more_high = _difference_limits(more) if k != best else (0.0, 0.0)
            row = {
                "body": called,
                "limit_state": state.name,
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
                row[f"{name}_effect"] = _effect(points[k], at)
                row[f"{name}_p"] = score_p(points[k], at, event[of_point], seed)
            rows.append(row)
    return pd.DataFrame(rows)


def _difference_limits(draws: NDArray[np.float64]) -> tuple[float, float]:
    """The 95 % interval of a difference, by the basic bootstrap; NaN as for `basic_limits`."""
    if draws.size < 2 or np.isfinite(draws[1:]).mean() < MIN_FITTED_SHARE:
        return np.nan, np.nan
    return ends(2.0 * draws[0] - draws[1:])


def _effect(points: Points, covariate: NDArray[np.float64]) -> float:
    """The effect on ln θ of one unit of a covariate; NaN where it cannot be fitted."""
    x = np.log(points.intensity)
    columns = np.stack([np.ones_like(x), x - x.mean(), covariate])
    reached, trials = points.reached.astype(np.float64), points.trials.astype(np.float64)
    _, slope, effect = scored(columns, reached[None], trials[None])[0]
    return float(-effect / slope) if np.ptp(covariate) > 0.0 else np.nan
