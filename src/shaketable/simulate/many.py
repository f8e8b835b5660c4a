"""Many bodies under many motions, on all cores."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from shaketable.body import Body
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.around import Around
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.kinds import CPU
from shaketable.solid import Solid

if TYPE_CHECKING:
    import xarray as xr


def simulate_many(
    bodies: Sequence[Body] | Sequence[Solid],
    motions: Sequence[Motion],
    *,
    tilts: ArrayLike = (0.0,),
    scales: ArrayLike = (1.0,),
    polarities: ArrayLike = (1, -1),
    azimuth: float = math.pi,
    orientations: ArrayLike = (0.0,),
    model: Model | str | None = None,
    surroundings: Around = None,
    device: str = CPU,
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Shake every body under every motion, polarity, tilt and scale, on all cores.

    Args:
        bodies, motions: at least one of each; all bodies planar, or all of them Solids.
        tilts: β of the support [rad]; on a negative tilt downhill is toward +x.
        scales: factors on all components of each motion.
        polarities: 1 and -1; -1 reverses the horizontal components.
        azimuth: of downhill on all tilts, from +x toward +y [rad]; planar bodies need π.
        orientations: of Solids on their supports, from x toward y [rad].
        model: `Rocking(...)` or `General(...)`, or "rocking" or "general" for their defaults;
            rocking by default; Solids need the general one, their default.
        surroundings: what stands beside Solids and holds them, or the wall that planar bodies rock
            away from: one for all, or a list of one of each; nothing by default.
        device: "cpu", or "cuda" for a GPU by NVIDIA (extra `gpu`), of planar bodies.
        progress: True shows a progress bar with the time left on stderr; a function is instead
            told how many more simulations are done.
        threads: all cores by default; the results do not depend on it.

    Returns:
        Dataset over (body, motion, polarity, tilt, scale), of Solids also over orientation. Its
        variables are those of `simulate.result_fields.FIELDS`, with their units and meanings
        (docs/reference/results.md): outcome (see Outcome), overturning_time, peak_rotation, impacts
        and ending of all; of the general model displacement_x, slip_downhill, slip_uphill and
        max_lift; of Solids fall_azimuth, displacements, yaw and max_lift, in surroundings
        held_up, and with straps strap_force and strap_broke_at over (..., strap). Where a body has
        its own restitution factor, a coordinate tells those of all.

    Raises:
        InputError: nothing to simulate, anything other than bodies and motions, an unknown model,
            a polarity that is neither 1 nor -1, a tilt on which a body falls by itself, or a device
            that is not there.
    """
    ensemble = Ensemble.of(
        bodies,
        motions,
        tilts=tilts,
        scales=scales,
        polarities=polarities,
        azimuth=azimuth,
        orientations=orientations,
        model=model,
        surroundings=surroundings,
    )
    ensemble.require_standing()
    results = ensemble.results()
    ensemble.warn_of(ensemble.run(results.store, threads, progress, device))
    return ensemble.dataset(results).assign_coords(ensemble.coordinates())
