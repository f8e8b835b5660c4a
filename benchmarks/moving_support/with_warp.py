"""A case in MuJoCo Warp, on a support at rest under apparent gravity; on a GPU where there is one.

It is made for many worlds at once: one box by itself, on a CPU, takes it a hundred launches a step.
"""

from __future__ import annotations

import math

import numpy as np

from benchmarks.moving_support.cases import Answers, Case
from benchmarks.moving_support.with_mujoco import WAYS, between, model_of

EVERY = 0.0025  # s between looks at where the box is


def run(case: Case, step: float) -> Answers:
    import mujoco as mj
    import mujoco_warp as mjw
    import warp as wp

    wp.config.quiet = True
    plain = model_of(case, step, WAYS[0])
    begun = mj.MjData(plain)
    mj.mj_forward(plain, begun)
    model, data = mjw.put_model(plain), mjw.put_data(plain, begun)
    count, looks = round(case.seconds / step), round(EVERY / step)
    at, known = np.arange(count) * step, np.arange(len(case.force)) * case.step
    force = np.column_stack([np.interp(at, known, each) for each in case.force.T])
    peak = 0.0
    for k in range(count):
        model.opt.gravity.assign(force[None, k].astype(np.float32))
        mjw.step(model, data)
        if (k + 1) % looks == 0:
            axis = data.xmat.numpy()[0, -1].reshape(3, 3)[:, 2].astype(float)
            peak = max(peak, between(axis, np.array([0.0, 0.0, 1.0])))
            if peak > math.pi / 2:
                return Answers(math.nan, math.pi / 2, falls=True)
    axis = data.xmat.numpy()[0, -1].reshape(3, 3)[:, 2]
    away = data.xpos.numpy()[0, -1] - case.solid.cg_height * axis
    return Answers(float(math.hypot(away[0], away[1])), peak, falls=False)
