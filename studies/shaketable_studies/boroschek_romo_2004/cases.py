"""Every body under every motion: what happened, and what each criterion says."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria import shaketable_2026
from shaketable.criteria.overturning import ISHIYAMA, KNOWN, UNKNOWN, scores
from shaketable.motion import Motion
from shaketable.resampling import recordings_of
from shaketable.signal import Peaks, peaks
from shaketable.simulate import fell, simulate_many
from shaketable_studies.boroschek_romo_2004.grid import bodies_of

PUBLISHED = (ISHIYAMA, KNOWN, UNKNOWN)


@dataclass(frozen=True, eq=False)
class Cases:
    """Bodies of the grid under motions in both directions.

    Attributes:
        rows: the grid, one row per body.
        motions: names of the motions.
        recording: number of each motion's recording, (motion,).
        peaks: those of each motion.
        falls: directions of each motion that overturn the body, 0 to 2, (body, motion).
        scores: how far beyond a criterion's limit a case is, by the criterion's name,
            (body, motion): above 1 the criterion says that the body may overturn.
        measures: those of the fitted rule, (body, motion).
    """

    rows: pd.DataFrame
    motions: list[str]
    recording: NDArray[np.intp]
    peaks: list[Peaks]
    falls: NDArray[np.int64]
    scores: dict[str, NDArray[np.float64]]
    measures: shaketable_2026.Measures

    def by_recording(self, counts: NDArray[np.int64]) -> NDArray[np.int64]:
        """Counts of motions, (..., motion), summed to recordings, (..., recording)."""
        groups = self.recording[:, None] == np.arange(self.recording.max() + 1)
        return np.asarray(counts @ groups)


def simulate_cases(
    rows: pd.DataFrame, motions: Sequence[Motion], done: Callable[[int], None]
) -> Cases:
    """Shake the bodies on a level support with the rocking model, and ask the criteria."""
    bodies = bodies_of(rows)
    runs = simulate_many(bodies, motions, progress=done)
    falls = fell(runs).sum(["polarity", "tilt", "scale"]).transpose("body", "motion").values
    found = [peaks(motion) for motion in motions]
    pga = np.array([each.acceleration for each in found])
    pgv = np.array([each.velocity for each in found])
    sizes = [(b.base, b.left / b.base, b.cg_height, b.gyration_radius) for b in bodies]
    base, nu, h, i = np.array(sizes).T[:, :, None]
    scored = scores(base, nu, h, i, pga, pgv)
    return Cases(
        rows,
        [motion.name for motion in motions],
        recordings_of(motions),
        found,
        falls,
        {name: scored[name] for name in PUBLISHED},
        shaketable_2026.measures(base, nu, h, i, pga, pgv),
    )
