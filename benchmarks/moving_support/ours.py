"""A case in this package."""

from __future__ import annotations

import math

from benchmarks.moving_support.cases import Answers, Case
from shaketable import General, Motion, Support, simulate


def run(case: Case) -> Answers:
    x, y, z = case.acceleration.T
    motion = Motion(x, case.step, vertical=z, transverse=y)
    found = simulate(
        case.solid,
        motion,
        Support(tilt=case.tilt, azimuth=case.azimuth),
        model=General(static_friction=case.friction),
    )
    falls = found.overturning_time <= case.seconds
    nutation = found.nutation
    end = len(case.acceleration) - 1
    # between samples, but of what comes after the motion
    whole = nutation.argmax() <= end
    peak = found.peak_rotation if whole else nutation[: end + 1].max()
    x, y = found.displacement_x_at_motion_end, found.displacement_y_at_motion_end
    return Answers(math.hypot(x, y), math.pi / 2 if falls else float(peak), falls)
