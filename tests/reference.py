"""An independent integrator of physics.md section 2, to hold the kernels against.

SciPy's DOP853 at rtol 1e-13, restarted at every sample, impacts and turning points found on its
dense output. It shares no code and no series with the package, and ends a bounce sequence by a
plain speed limit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

G = 9.80665
REST_SPEED = 1e-7  # rad/s
FREE_TIME = 200.0  # s after the record


class Reference(NamedTuple):
    outcome: int
    peak: float
    impact_times: list[float]
    overturning_time: float


def integrate(body, motion, tilt=0.0, *, kept=None, theta0=0.0):
    h, b_left = body.cg_height, body.left
    b_right = body.width - b_left
    i2 = body.gyration_radius**2
    arm = {1: b_right, -1: b_left}
    r = {s: math.hypot(h, arm[s]) for s in arm}
    alpha = {s: math.atan(arm[s] / h) for s in arm}
    e = {
        s: kept
        if kept is not None
        else (i2 + h * h - b_left * b_right) / (i2 + h * h + arm[-s] ** 2)
        for s in arm
    }
    ax = motion.horizontal
    ay = np.zeros_like(ax) if motion.vertical is None else motion.vertical
    dt = motion.time_step

    def acceleration(s, theta, a, g):
        phi = s * alpha[s] - theta + tilt
        return -r[s] / (i2 + r[s] ** 2) * (g * math.sin(phi) + a * math.cos(phi))

    side, theta, omega = (0, 0.0, 0.0) if theta0 == 0 else (int(math.copysign(1, theta0)), theta0, 0.0)
    peak, impacts = abs(theta0), []
    last = ax.size - 1
    i = 0
    while True:
        t, end = i * dt, (i + 1) * dt
        free = i >= last
        a0, a1 = (0.0, 0.0) if free else (ax[i], ax[i + 1])
        g0, g1 = (G, G) if free else (G + ay[i], G + ay[i + 1])
        t0 = t

        def a_at(x, a0=a0, a1=a1, t0=t0):
            return a0 + (a1 - a0) * (x - t0) / dt

        def g_at(x, g0=g0, g1=g1, t0=t0):
            return g0 + (g1 - g0) * (x - t0) / dt

        while t < end:
            if side == 0:
                lifts = []
                for s in (1, -1):

                    def moment(x, s=s):
                        return s * acceleration(s, 0.0, a_at(x), g_at(x))

                    if moment(t) > 0:
                        lifts.append((t, s))
                    elif moment(end) > 0:
                        lifts.append((brentq(moment, t, end, xtol=1e-15, rtol=1e-15), s))
                if not lifts:
                    break
                t, side = min(lifts)
                theta = omega = 0.0

            def rhs(x, y, s=side):
                return [y[1], acceleration(s, y[0], a_at(x), g_at(x))]

            solver = DOP853(rhs, t, [theta, omega], end, rtol=1e-13, atol=1e-16)
            hit = None
            while solver.status == "running" and hit is None:
                solver.step()
                dense = solver.dense_output()
                grid = np.linspace(solver.t_old, solver.t, 9)
                values = np.array([dense(x) for x in grid])
                for k in range(8):
                    if values[k, 1] * values[k + 1, 1] < 0 and values[k, 1] * side > 0:
                        top = brentq(lambda x: dense(x)[1], grid[k], grid[k + 1], xtol=1e-15)
                        peak = max(peak, side * dense(top)[0])
                    if side * values[k + 1, 0] >= math.pi / 2:
                        fall = brentq(
                            lambda x: side * dense(x)[0] - math.pi / 2, grid[k], grid[k + 1]
                        )
                        return Reference(side, math.pi / 2, impacts, fall)
                    low = grid[k + 1]
                    if side * values[k + 1, 0] > 0 and values[k, 1] * side < 0 < values[k + 1, 1] * side:
                        low = brentq(lambda x: dense(x)[1], grid[k], grid[k + 1], xtol=1e-15)
                    if side * dense(low)[0] < 0 and (side * values[k, 0] > 0 or k > 0):
                        hit = brentq(lambda x: dense(x)[0], grid[k], low, xtol=1e-16, rtol=1e-15)
                        theta, omega = 0.0, dense(hit)[1]
                        break
                    peak = max(peak, side * values[k + 1, 0])
            if hit is None:
                theta, omega, t = solver.y[0], solver.y[1], end
                if side * theta < 0:
                    raise AssertionError("an impact was missed")
                continue
            t = hit
            impacts.append(t)
            omega *= e[side]
            side = -side
            if e[-side] <= 0 or abs(omega) < REST_SPEED:
                side, theta, omega = 0, 0.0, 0.0
        i += 1
        if i >= last and side == 0:
            return Reference(0, peak, impacts, math.nan)
        if i * dt > last * dt + FREE_TIME:
            raise AssertionError("the reference did not come to an end")
