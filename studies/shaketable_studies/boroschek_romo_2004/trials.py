"""The criteria put to the test: bodies that rock, and motions weak enough to be called safe.

What does not rock satisfies any criterion, and so does what a criterion calls unsafe: a rule that
always says "falls" is satisfied in every case. Here only cases that rock count, motions are also
scaled down to peak velocities at which criteria begin to say "safe", and beside what a criterion
misses stands how often it calls safe what rocks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria import ishiyama_1982
from shaketable.criteria.overturning import ISHIYAMA, KNOWN, UNKNOWN
from shaketable.motion import Motion
from shaketable.resampling import interval, ratio
from shaketable.signal import peaks
from shaketable.units import CM
from shaketable_studies.boroschek_romo_2004.cases import simulate_cases
from shaketable_studies.boroschek_romo_2004.grid import CG_HEIGHTS, ECCENTRICITIES

LITERAL = "known eccentricity, eq. 2 to the letter"
VELOCITIES = (0.02, 0.05, 0.10, 0.15)  # m/s, to which motions are scaled down
SAYS_SAFE = 0.05  # of what rocks: a criterion that says it less often says nothing


class Tried(NamedTuple):
    """What became of the cases that rock.

    Attributes:
        table: by criterion, eccentricity and height, 0 for all.
        counterexamples: falls that a published criterion calls safe, by motion.
        alarms: share of what rocks and stands that the rule for an unknown eccentricity does not
            call safe, of every draw, {(eccentricity, height): (k,)}.
        margins: the mean logarithm of PGV over that rule's limit among what falls, likewise.
    """

    table: pd.DataFrame
    counterexamples: pd.DataFrame
    alarms: dict[tuple[float, float], NDArray[np.float64]]
    margins: dict[tuple[float, float], NDArray[np.float64]]


def simulations(motions: int, bodies: int) -> int:
    """How many simulations `try_criteria` runs."""
    return 2 * bodies * motions * (1 + len(VELOCITIES))


def try_criteria(
    rows: pd.DataFrame,
    motions: Sequence[Motion],
    weights: NDArray[np.float64],
    done: Callable[[int], None],
) -> Tried:
    """Judge the published criteria by every motion as recorded and scaled down to VELOCITIES."""
    levels = [("as recorded", list(motions))]
    velocity = [peaks(motion).velocity for motion in motions]
    for wanted in VELOCITIES:
        scaled = [
            motion.scaled(min(1.0, wanted / v) if v > 0.0 else 1.0)
            for motion, v in zip(motions, velocity, strict=True)
        ]
        levels.append((f"{wanted / CM:g} cm/s", scaled))
    parts, found = [], []
    for level, shaking in levels:
        cases = simulate_cases(rows, shaking, done)
        base, nu, h = (
            rows[name].to_numpy()[:, None] for name in ("base_m", "eccentricity", "cg_height_m")
        )
        nearer = np.minimum(nu, 1.0 - nu) * base
        pga = np.array([peak.acceleration for peak in cases.peaks])
        pgv = np.array([peak.velocity for peak in cases.peaks])
        # B' in place of B everywhere, its inertia too
        letter = np.sqrt(((2 * nearer) ** 2 + (2 * h) ** 2) / 12.0)
        says = {name: cases.scores[name] > 1.0 for name in (ISHIYAMA, KNOWN, UNKNOWN)}
        says[LITERAL] = ishiyama_1982.may_overturn(nearer, h, letter, pga, pgv)
        rocks = pga > ishiyama_1982.overturning_acceleration(nearer, h)
        parts.append((cases, says, np.broadcast_to(rocks, cases.falls.shape)))
        for name in (KNOWN, UNKNOWN, LITERAL):
            missed = np.where(~says[name], cases.falls, 0)
            for body, motion in np.argwhere(missed > 0):
                found.append(
                    {
                        "criterion": name,
                        "eccentricity": float(nu[body, 0]),
                        "cg_height_m": float(h[body, 0]),
                        "base_m": float(base[body, 0]),
                        "record": cases.motions[motion],
                        "level": level,
                        "pga_m_s2": float(pga[motion]),
                        "pgv_m_s": float(pgv[motion]),
                        "falls": int(missed[body, motion]),
                    }
                )
    columns = ["criterion", "eccentricity", "cg_height_m", "base_m", "record", "level",
               "pga_m_s2", "pgv_m_s", "falls"]  # fmt: skip
    table, alarms, margins = [], {}, {}
    for name in (ISHIYAMA, KNOWN, LITERAL, UNKNOWN):
        for eccentricity in ECCENTRICITIES:
            for height in (0.0, *CG_HEIGHTS):
                here = (rows["eccentricity"] == eccentricity).to_numpy() & (
                    (height == 0.0) | (rows["cg_height_m"] == height).to_numpy()
                )
                counts = np.zeros((5, weights.shape[1]), np.int64)
                above = np.zeros(weights.shape[1])
                for cases, says, rocks in parts:
                    counted = rocks & here[:, None]
                    falls = np.where(counted, cases.falls, 0)
                    stands = np.where(counted, 2 - cases.falls, 0)
                    safe = ~says[name]
                    each = (
                        falls + stands,
                        np.where(safe, falls + stands, 0),
                        falls,
                        np.where(safe, falls, 0),
                        np.where(safe, 0, stands),
                    )
                    counts += np.stack([cases.by_recording(one.sum(axis=0)) for one in each])
                    if name == UNKNOWN:
                        margin = (np.log(cases.scores[UNKNOWN]) * falls).sum(axis=0)
                        above += np.bincount(cases.recording, margin, weights.shape[1])
                rock, called, fell, missed, alarmed = counts
                share, lost = ratio(called, rock, weights), ratio(missed, fell, weights)
                ends = interval(lost[1:])
                if name == UNKNOWN:
                    alarms[eccentricity, height] = ratio(alarmed, rock - fell, weights)
                    margins[eccentricity, height] = ratio(above, fell, weights)
                table.append(
                    {
                        "criterion": name,
                        "eccentricity": eccentricity,
                        "cg_height_m": height,
                        "rocks": int(rock.sum()),
                        "called_safe": float(share[0]),
                        "falls": int(fell.sum()),
                        "missed": int(missed.sum()),
                        "missed_share": float(lost[0]),
                        "missed_low": float(ends[0]),
                        "missed_high": float(ends[1]),
                    }
                )
    return Tried(pd.DataFrame(table), pd.DataFrame(found, columns=columns), alarms, margins)
