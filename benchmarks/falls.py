"""`python -m benchmarks.falls`: which way W1's falls go, by a second method.

The two models of the package take a body that neither slides nor jumps through the same
arithmetic, so that their agreement shows nothing. Moreau-Jean's time stepping knows no phases, no
events and no rocking equation: only contact impulses. A sample of W1's simulations, half of them
falls, is run with it. Near a border of falling its error of first order may decide otherwise: the
cases that differ are run again with steps so small that this is told from a disagreement.
"""

from __future__ import annotations

import argparse
import math

import numpy as np
from tests.support.pulses import Case

from benchmarks.cases import BODIES, TILTS, motions
from benchmarks.time_stepping import Stepped, time_stepping
from shaketable import Body, General, Motion, Response, Support, simulate, simulate_many

STEP, SMALL_STEP = 1e-4, 5e-6  # s
AFTER = 2.0  # s, that a fall or the end of a motion is followed
FRICTION = 2.0  # nothing slides, as in the study


def falls(count: int, seed: int = 3) -> list[tuple[Body, Motion, float]]:
    """Members of W1 drawn at random, half of them falls."""
    shaking = motions()
    runs = simulate_many(BODIES, shaking, tilts=TILTS, progress=False)
    fell = (runs.outcome.squeeze("scale") != 0).transpose("body", "motion", "polarity", "tilt")
    rocks = (runs.impacts.squeeze("scale") > 0).transpose("body", "motion", "polarity", "tilt")
    rng = np.random.default_rng(seed)
    chosen = []
    for wanted in (fell.values, ~fell.values & rocks.values):
        members = np.argwhere(wanted)
        for body, motion, polarity, tilt in members[rng.permutation(len(members))[: count // 2]]:
            one = shaking[motion]
            chosen.append((BODIES[body], one.reversed() if polarity else one, float(TILTS[tilt])))
    return chosen


def by_time_stepping(case: tuple[Body, Motion, float], run: Response, step: float) -> Stepped:
    """A case until the fall that we found, or the motion's end, and AFTER."""
    body, motion, tilt = case
    fallen = run.overturning_time
    end = motion.duration if math.isnan(fallen) else min(fallen, motion.duration)
    again = Case(body, motion, Support(tilt=tilt), General(static_friction=FRICTION))
    return time_stepping(again, end + AFTER, step)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100)
    cases = falls(parser.parse_args().cases)
    ours = [simulate(body, motion, Support(tilt=tilt)) for body, motion, tilt in cases]
    found = [by_time_stepping(case, run, STEP) for case, run in zip(cases, ours, strict=True)]
    alike = [f.outcome == run.outcome for f, run in zip(found, ours, strict=True)]
    of_falls = [same for same, run in zip(alike, ours, strict=True) if run.outcome != 0]
    off = sorted(
        abs(f.peak - run.peak_rotation)
        for f, run in zip(found, ours, strict=True)
        if f.outcome == run.outcome == 0
    )
    print(f"{len(cases)} simulations of W1 by Moreau-Jean in steps of {STEP:g} s:")
    print(f"same outcome in {sum(alike)}; of {len(of_falls)} falls {sum(of_falls)} the same way")
    print(f"where both stand, the peak rotation differs by {off[len(off) // 2]:.1e} rad (median)")
    differ = [k for k, same in enumerate(alike) if not same]
    again = [by_time_stepping(cases[k], ours[k], SMALL_STEP) for k in differ]
    settled = sum(f.outcome == ours[k].outcome for k, f in zip(differ, again, strict=True))
    print(f"of the {len(differ)} that differ, {settled} agree in steps of {SMALL_STEP:g} s")


if __name__ == "__main__":
    main()
