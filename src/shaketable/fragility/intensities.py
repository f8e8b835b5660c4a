"""Intensity measures of the motions that bodies met, as coordinates of a Dataset of runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.resampling import recordings_of
from shaketable.signal import Measure, measure_named
from shaketable.signal.intensity import Record

if TYPE_CHECKING:
    import xarray as xr

OWN, GEOMETRIC_MEAN = "own", "geometric mean"
COMPONENTS = (OWN, GEOMETRIC_MEAN)


def with_intensities(
    runs: xr.Dataset,
    motions: Sequence[Motion],
    measures: Sequence[str],
    *,
    components: str = OWN,
) -> xr.Dataset:
    """Add the intensity measures of the scaled motions to a Dataset of runs, as coordinates.

    They are those of the motion under the support: of the ground, or of a floor where floors'
    motions were given.

    Args:
        runs: what `simulate_many` or `run_campaign` gives, over motion and scale.
        motions: those of the runs, in their order.
        measures: names as OpenQuake writes them: PGA, PGV, SA(1.0), AvgSA(1.0), and the others of
            `intensity_measures`.
        components: "own" takes each component by itself; "geometric mean" takes that of both
            components of a recording where there are two.

    Returns:
        The same with a coordinate over (motion, scale) for each measure, with its units.

    Raises:
        InputError: other motions than those of the runs, or a measure that is not known.
    """
    if "motion" not in runs.dims or "scale" not in runs.dims:
        found = ", ".join(map(str, runs.dims))
        raise InputError(f"runs= must have the dimensions motion and scale, got {found}")
    if runs.sizes["motion"] != len(motions):
        raise InputError(
            f"motions= must be those of the runs: {runs.sizes['motion']} of them, "
            f"got {len(motions)}"
        )
    added = {}
    for name in measures:
        measure = measure_named(name)
        values = intensities(motions, measure, runs["scale"].values, components=components)
        attributes = {"units": measure.unit, "long_name": measure.meaning}
        if components == GEOMETRIC_MEAN:
            attributes["long_name"] += ", geometric mean of both components"
        added[measure.name] = (("motion", "scale"), values, attributes)
    return runs.assign_coords(added)


def intensities(
    motions: Sequence[Motion],
    measure: Measure,
    scales: NDArray[np.float64] | Sequence[float] = (1.0,),
    *,
    components: str = OWN,
) -> NDArray[np.float64]:
    """A measure of every motion at every scale, (motion, scale), in SI.

    Args:
        motions, scales: as for `simulate_many`.
        measure: what `measure_named` gives.
        components: as for `with_intensities`.

    Raises:
        InputError: an unknown word for the components.
    """
    if components not in COMPONENTS:
        raise InputError(f"components= must be one of {', '.join(COMPONENTS)}, got {components!r}")
    factors = np.abs(np.asarray(scales, np.float64))
    if measure.power is None:
        values = np.array(
            [
                [
                    measure.of(Record(scale * motion.horizontal, motion.time_step))
                    for scale in factors
                ]
                for motion in motions
            ]
        )
    else:
        once = [measure.of(Record(motion.horizontal, motion.time_step)) for motion in motions]
        values = np.array(once)[:, None] * factors**measure.power
    return _over_components(values, motions) if components == GEOMETRIC_MEAN else values


def _over_components(values: NDArray[np.float64], motions: Sequence[Motion]) -> NDArray[np.float64]:
    """The geometric mean of both components where a recording has two."""
    recording = recordings_of(motions)
    means = values.copy()
    for number in range(int(recording.max()) + 1):
        both = np.flatnonzero(recording == number)
        if both.size == 2:
            means[both] = np.sqrt(values[both[0]] * values[both[1]])
    return means
