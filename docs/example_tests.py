"""Write examples/tests.csv and examples/others.csv: tests of a virtual laboratory.

Run as `python docs/example_tests.py`. The body that was "tested" is not quite the 0.12 m × 0.70 m
cabinet that the laboratory measured: its feet stand in, its centre of gravity is off the middle,
it loses more at impacts than a rigid block, and the table is not quite what it was told to be.
`calibrate` has to find that out.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd

from shaketable import Body, Outcome, simulate
from shaketable.records import suite

TESTED = Body.rectangle(0.11, 0.70, eccentricity=0.47, restitution_factor=0.95)
SCALES = (0.4, 0.7, 1.1)
NOISE = 0.05  # of the table's amplitude, as a standard deviation of its logarithm
EXAMPLES = Path(__file__).parents[1] / "examples"


def tests() -> pd.DataFrame:
    """A motion of each record of FEMA P-695's far-field set at three scales, and what was seen."""
    random = np.random.default_rng(1)
    rows = []
    for motion in suite("fema-p695-far-field")[::2]:
        assert motion.origin is not None
        for scale in SCALES:
            felt = motion.scaled(scale * np.exp(random.normal(0.0, NOISE)))
            rows.append(
                {
                    "test": f"T{len(rows) + 1:02d}",
                    "motion": motion.name,
                    "scale": scale,
                    "fell": "yes"
                    if simulate(TESTED, felt).outcome is not Outcome.STANDING
                    else "no",
                    "record": f"{motion.origin.event} {motion.origin.station}",
                    "order": len(rows) + 1,
                }
            )
    return pd.DataFrame(rows)


def others() -> pd.DataFrame:
    """Motions near faults, whose outcome is to be predicted."""
    names = [motion.name for motion in suite("fema-p695-near-field-pulse")[::4]]
    pairs = [(name, scale) for name in names for scale in (0.2, 0.4)]
    tests = [f"N{k:02d}" for k in range(1, len(pairs) + 1)]
    return pd.DataFrame(pairs, columns=["motion", "scale"]).assign(test=tests)


if __name__ == "__main__":
    tests().to_csv(EXAMPLES / "tests.csv", index=False)
    others()[["test", "motion", "scale"]].to_csv(EXAMPLES / "others.csv", index=False)
