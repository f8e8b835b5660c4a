"""What the paper leaves open: friction, loss at impacts, eccentric bodies and upper floors.

The paper's bodies are symmetric, do not slide, lose at an impact what a plastic one loses, and
stand on the ground. Here four of them are run with one of these changed at a time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.models import General, Model, Rocking
from shaketable.motion import Motion
from shaketable.resampling import interval, recordings_of
from shaketable.simulate import count_by_recording, simulate_many
from shaketable.synthesis import ShearBuilding, floor_motions
from shaketable.tilting import TiltCounts, control_tilt, downhill_share
from shaketable_studies.boroschek_iruretagoyena_2006.fits import body_mean
from shaketable_studies.boroschek_iruretagoyena_2006.printed import TABLE_1

CHOSEN = (1, 5, 8, 11)  # of table I: b/h 0.25 to 0.30, 0.2 to 1.5 m
TILTS = np.radians(np.arange(0.0, 7.01, 1.0))
FRICTIONS = (0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.7, 1.0)
LOSSES = (0.6, 0.7, 0.8, 0.9, 1.0)
ECCENTRICITIES = (0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65)  # ν1: below 0.5 it is nearer downhill
HOUSE = ShearBuilding(storeys=4, first_period=0.5, name="4 storeys, 0.5 s")


class Variation(NamedTuple):
    """One way in which bodies, model or motions differ from the paper's."""

    question: str
    value: float
    bodies: Sequence[Body]
    motions: Sequence[Motion]
    model: Model


def all_of(motions: Sequence[Motion]) -> Iterator[Variation]:
    """Every variation."""
    sizes = [TABLE_1[k] for k in CHOSEN]
    plain = [size.body for size in sizes]
    for friction in FRICTIONS:
        yield Variation("friction", friction, plain, motions, General(static_friction=friction))
    for factor in LOSSES:
        yield Variation("loss factor", factor, plain, motions, Rocking(restitution_factor=factor))
    for nu in ECCENTRICITIES:
        off = [Body.rectangle(size.base, size.height, eccentricity=nu) for size in sizes]
        yield Variation("eccentricity", nu, off, motions, Rocking())
    floors = [[motion, *floor_motions(HOUSE, motion)] for motion in motions]
    for floor in range(HOUSE.storeys + 1):
        yield Variation("floor", floor, plain, [one[floor] for one in floors], Rocking())


def simulations(motions: int) -> int:
    """How many simulations `variations` runs."""
    kinds = len(FRICTIONS) + len(LOSSES) + len(ECCENTRICITIES) + HOUSE.storeys + 1
    return int(kinds * len(CHOSEN) * TILTS.size * 2 * motions)


def variations(
    motions: Sequence[Motion], weights: NDArray[np.float64], done: Callable[[int], None]
) -> pd.DataFrame:
    """The mean share downhill by tilt for every variation, with its interval.

    Args:
        motions: those of the study.
        weights: of the draws over their recordings, (k, recording).
        done: is told how many more simulations were done.
    """
    recording = recordings_of(motions)
    parts = []
    for one in all_of(motions):
        stands = [t for t in TILTS if t < one.model.rest_limit and _all_stand(one, t)]
        runs = simulate_many(one.bodies, one.motions, tilts=stands, model=one.model, progress=done)
        counts = TiltCounts.of(np.array(stands), count_by_recording(runs, recording))
        mean = body_mean(downhill_share(counts, weights))
        low, high = interval(mean[1:])
        parts.append(
            pd.DataFrame(
                {
                    "question": one.question,
                    "value": one.value,
                    "tilt_deg": np.degrees(stands),
                    "falls": counts.falls.sum(axis=(0, 2)),
                    "simulations": counts.simulations.sum(),
                    "downhill": mean[0],
                    "low": low,
                    "high": high,
                }
            )
        )
    return pd.concat(parts, ignore_index=True)


def _all_stand(one: Variation, tilt: float) -> bool:
    return all(tilt < body.slenderness_left for body in one.bodies)


def tilts_for_95(table: pd.DataFrame) -> pd.DataFrame:
    """For every variation the share downhill on a level support, and the tilt for 95 %."""
    rows = []
    for (question, value), here in table.groupby(["question", "value"], sort=False):
        tilts, share = here["tilt_deg"].to_numpy(), here["downhill"].to_numpy()
        # the interval's ends, read the other way round
        ends = [float(control_tilt(tilts, here[end].to_numpy(), 0.95)) for end in ("high", "low")]
        rows.append(
            {
                "question": question,
                "value": value,
                "downhill_when_level": share[0],
                "falls_when_level": int(here["falls"].iloc[0]),
                "tilt_for_95_deg": float(control_tilt(tilts, share, 0.95)),
                "tilt_low_deg": ends[0],
                "tilt_high_deg": ends[1],
            }
        )
    return pd.DataFrame(rows)
