"""The acceleration at which a body begins to rock, by eq. 1 and by simulation (figure 2)."""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.body import Body
from shaketable.criteria.boroschek_iruretagoyena_2006 import uplift_acceleration
from shaketable.motion import Motion
from shaketable.simulate import simulate
from shaketable.support import Support
from shaketable.units import STANDARD_GRAVITY

RATIOS = (0.20, 0.25, 0.30)  # b/h of figure 2
TILTS_DEG = np.arange(0.0, 8.01, 1.0)
GROWTH, STEP = 0.1, 0.001  # of the ramp: g/s, s; a sample is 0.0001 g
STRONGEST = 1.0  # g, its end: more than any body of the figure takes


def uplift_table() -> pd.DataFrame:
    """Accelerations [g] at the tilts of figure 2, toward either side."""
    rows = []
    for ratio in RATIOS:
        body = Body.rectangle(ratio, 1.0)
        for tilt_deg in TILTS_DEG:
            tilt = np.radians(tilt_deg)
            downhill, uphill = (
                float(a) / STANDARD_GRAVITY for a in uplift_acceleration(body, tilt)
            )
            rows.append(
                {
                    "b_over_h": ratio,
                    "tilt_deg": tilt_deg,
                    "downhill_g": downhill,
                    "uphill_g": uphill,
                    "simulated_downhill_g": simulated_uplift(body, float(tilt), 1),
                    "simulated_uphill_g": simulated_uplift(body, float(tilt), -1),
                }
            )
    return pd.DataFrame(rows)


def simulated_uplift(body: Body, tilt: float, sign: int) -> float:
    """|a_x| [g] at which a slowly growing acceleration of that sign lifts a corner."""
    samples = round(STRONGEST / GROWTH / STEP) + 1
    ramp = np.linspace(0.0, sign * STRONGEST * STANDARD_GRAVITY, samples)
    run = simulate(body, Motion(ramp, STEP), Support(tilt=tilt))
    lifted = int(np.flatnonzero(run.rotation)[0])
    return GROWTH * float(run.time[lifted])
