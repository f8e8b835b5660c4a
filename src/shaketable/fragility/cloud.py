"""A cloud: simulations of all motions at some scales, new ones or those of before."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.counts import Counts, counted, warn_of_scales
from shaketable.fragility.limit_states import LimitState
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.outcome import Outcome
from shaketable.progress import Progress
from shaketable.simulate import simulate_many
from shaketable.simulate.around import Around
from shaketable.simulate.checks import numbers, unique_names
from shaketable.surroundings import Surroundings, told_surroundings

if TYPE_CHECKING:
    import xarray as xr

#: Share of reached states below which, and above 1 less it, a scale adds nothing.
SATURATED_SHARE = 0.02
TRIED = 2.0 ** np.arange(-4.0, 3.25, 0.5)  # scales, if none are given
OVER = ("body", "motion", "polarity", "tilt", "scale")


class Cloud(NamedTuple):
    """What was counted, and the scales of the motions, rising, (scale,)."""

    counts: Counts
    scales: NDArray[np.float64]


def cloud_of(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    states: Sequence[LimitState],
    *,
    scales: ArrayLike | None,
    tilt: float,
    polarities: ArrayLike,
    model: Model,
    surroundings: Around = None,
    progress: Progress,
    threads: int | None,
) -> Cloud:
    """New simulations; without scales, at those of TRIED that tell anything.

    Raises:
        InputError: what `simulate_many` says, or scales that are not above 0.
    """
    tried = TRIED if scales is None else np.unique(numbers("scales", scales))
    if not tried[0] > 0.0:
        raise InputError(f"scales= must be above 0, got {tried[0]:g}")
    runs = simulate_many(
        bodies, motions, tilts=[tilt], scales=tried, polarities=polarities, model=model,
        surroundings=surroundings, progress=progress, threads=threads,
    )  # fmt: skip
    counts = counted(runs, bodies, states)
    if scales is None:
        telling = telling_scales(counts)
        counts, tried = counts.at(telling), tried[telling]
    warn_of_scales(tried)
    return Cloud(counts, tried)


def cloud_from(
    runs: xr.Dataset,
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    states: Sequence[LimitState],
    *,
    tilt: float,
    model: Model,
    surroundings: Sequence[Surroundings | None] = (),
) -> Cloud:
    """Simulations of before, on one of their tilts.

    Raises:
        InputError: they are of others, or not all done.
    """
    require_runs(runs, bodies, motions, model)
    theirs, ours_told = runs.attrs.get("surroundings", ""), told_surroundings(surroundings)
    if theirs != ours_told:
        raise InputError(
            f"runs= were simulated with surroundings={theirs or None}, but surroundings= is "
            f"{ours_told or None}"
        )
    away = np.abs(runs["tilt"].values - tilt)
    nearest = int(np.argmin(away))
    if away[nearest] > 1e-9:
        raise InputError(f"runs= are on no tilt of {tilt:g} rad; give tilt= as one of theirs")
    order = np.argsort(runs["scale"].values, kind="stable")
    ours = runs.isel(tilt=[nearest], scale=order)
    scales = ours["scale"].values.astype(np.float64)
    if not (scales.size and scales[0] > 0.0):
        raise InputError("runs= must have scales above 0")
    warn_of_scales(scales)
    return Cloud(counted(ours, bodies, states), scales)


def require_runs(
    runs: xr.Dataset, bodies: Sequence[Body], motions: Sequence[Motion], model: Model
) -> None:
    """InputError unless runs are of these bodies, motions and model, and all done."""
    if "outcome" not in runs or set(runs["outcome"].dims) != set(OVER):
        raise InputError(f"runs= must be over {', '.join(OVER)}, with outcomes")
    for name, many, given in (
        ("body", "bodies", unique_names(bodies)),
        ("motion", "motions", unique_names(motions)),
    ):
        theirs = [str(each) for each in runs[name].values.tolist()]
        if theirs != given:
            found = f"{len(theirs)}, of which {theirs[0]!r} is the first"
            raise InputError(
                f"runs= are of other {many}, or in another order: {found}; given are "
                f"{len(given)}, of which {given[0]!r} is the first"
            )
    simulated = runs.attrs.get("model")
    if simulated != repr(model):
        raise InputError(f"runs= were simulated with {simulated}, but model= is {model!r}")
    if "done" in runs and not bool(runs["done"].all()):
        raise InputError(
            "runs= are not all done: go on with the campaign until it is, and open it whole"
        )
    known = {int(outcome) for outcome in Outcome}
    strange = set(np.unique(runs["outcome"].values).tolist()) - known
    if strange:
        raise InputError(f"runs= hold outcomes that are none: {', '.join(map(str, strange))}")


def telling_scales(counts: Counts) -> NDArray[np.intp]:
    """The scales from the last at which hardly anything happens to the first at which all does.

    They are those of all bodies and states together.
    """
    share = counts.reached.mean(axis=2).reshape(-1, counts.reached.shape[-1]) / counts.trials
    rare, sure = share < SATURATED_SHARE, share > 1.0 - SATURATED_SHARE
    first = max(0, int(np.where(rare.any(axis=1), (~rare).argmax(axis=1), 0).min()) - 1)
    last = np.where(sure.any(axis=1), sure.argmax(axis=1), share.shape[1] - 1).max()
    return np.arange(first, max(first, int(last)) + 1)
