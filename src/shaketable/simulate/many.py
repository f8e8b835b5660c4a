"""Many bodies under many motions, on all cores."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from shaketable.body import Body
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.checks import (
    listed,
    numbers,
    require_polarities,
    require_stable,
    warn,
)
from shaketable.simulate.ensemble import Group, Rows, downhill_of, run_groups
from shaketable.simulate.members import Members, dataset, factors_of, names
from shaketable.support import Support

if TYPE_CHECKING:
    import xarray as xr

DIMENSIONS = ("body", "motion", "polarity", "tilt", "scale")


def simulate_many(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    *,
    tilts: ArrayLike = (0.0,),
    scales: ArrayLike = (1.0,),
    polarities: ArrayLike = (1, -1),
    model: Model | str | None = None,
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Shake every body under every motion, polarity, tilt and scale, on all cores.

    Args:
        bodies, motions: at least one of each.
        tilts: β of the support [rad]; on a negative tilt downhill is toward +x.
        scales: factors on both components of each motion.
        polarities: 1 and -1; -1 reverses the horizontal component.
        model: `Rocking(...)` or `General(...)`, or "rocking" or "general" for their defaults;
            rocking by default.
        progress: True shows a progress bar with the time left on stderr; a function is instead
            told how many more simulations are done.
        threads: all cores by default; the results do not depend on it.

    Returns:
        Dataset over (body, motion, polarity, tilt, scale): outcome (int8, see Outcome),
        overturning_time [s] (NaN if standing), peak_rotation [rad], impacts. With the general
        model also slip [m] at the end, + toward +x, the farthest slip_downhill and slip_uphill
        [m], both >= 0, max_lift [m], and ending (int8; its attributes say what the flags mean).
        Where a body has its own restitution factor, a coordinate tells those of all.

    Raises:
        InputError: nothing to simulate, anything other than bodies and motions, an unknown model,
            a polarity that is neither 1 nor -1, or a tilt on which a body falls by itself.
    """
    bodies, motions = listed("bodies", bodies, Body), listed("motions", motions, Motion)
    beta, factors = numbers("tilts", tilts), numbers("scales", scales)
    signs = numbers("polarities", polarities)
    require_polarities(signs)
    model = model_of(model)
    for tilt in {float(beta.min()), float(beta.max())}:
        Support(tilt=tilt)  # raises InputError for a tilt out of range
        require_stable(bodies, tilt)
    warn(model, beta.tolist())

    shape = (len(bodies), signs.size, beta.size)
    of_body, of_polarity, of_tilt = (index.ravel() for index in np.indices(shape))
    pair_body, pair_tilt = (index.ravel() for index in np.indices((len(bodies), beta.size)))
    table = model.tabulate([bodies[k] for k in pair_body], beta[pair_tilt])
    rows = Rows(
        table.take(of_body * beta.size + of_tilt),
        signs[of_polarity],
        downhill_of(beta)[of_tilt],
    )
    every = np.arange(of_body.size)
    groups = [
        Group(motion, scale, every, every + (m * factors.size + s) * every.size)
        for m, motion in enumerate(motions)
        for s, scale in enumerate(factors.tolist())
    ]
    members = Members.empty(len(groups) * every.size)
    run_groups(model, rows, groups, members, threads, progress)
    arrays = members.reshaped((len(motions), factors.size, *shape), (2, 0, 3, 4, 1))
    coordinates = {
        "body": names(bodies),
        "motion": names(motions),
        "polarity": signs.astype(np.int64),
        "tilt": ("tilt", beta, {"units": "rad", "long_name": "tilt of the support"}),
        "scale": factors,
        **factors_of("body", bodies, model),
    }
    return dataset(arrays, DIMENSIONS, coordinates, model)
