"""An independent integrator of theory, section 2, to hold the kernels against.

SciPy's DOP853 at rtol 1e-13, restarted at every sample, impacts and turning points found on its
dense output. It shares no code and no series with the package, and ends a bounce sequence by a
plain speed limit.
"""

from __future__ import annotations

import math
from itertools import pairwise
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


class Flight(NamedTuple):
    """One side's rocking until an impact, a fall or the end of the interval."""

    time: float
    theta: float
    omega: float
    peak: float
    hit: bool
    fallen: bool


def fly(acceleration, side, start, theta, omega, end, peak):
    """Integrate to `end`, or to the first event on DOP853's dense output."""
    solver = DOP853(
        lambda x, y: [y[1], acceleration(x, y[0])],
        start,
        [theta, omega],
        end,
        rtol=1e-13,
        atol=1e-16,
    )
    while solver.status == "running":
        solver.step()
        dense = solver.dense_output()

        def height(x, dense=dense):
            return side * dense(x)[0]

        def speed(x, dense=dense):
            return side * dense(x)[1]

        grid = np.linspace(solver.t_old, solver.t, 9)
        for first, last in pairwise(grid):
            low = last
            if speed(first) > 0 > speed(last):
                peak = max(peak, height(brentq(speed, first, last, xtol=1e-15)))
            elif speed(first) < 0 < speed(last) and height(last) > 0:
                low = brentq(speed, first, last, xtol=1e-15)
            if height(last) >= math.pi / 2:
                fall = brentq(lambda x: height(x) - math.pi / 2, first, last)
                return Flight(fall, 0.0, 0.0, math.pi / 2, False, True)
            if height(low) < 0 and (height(first) > 0 or first > start):
                hit = brentq(height, first, low, xtol=1e-16, rtol=1e-15)
                return Flight(hit, 0.0, dense(hit)[1], peak, True, False)
            peak = max(peak, height(last))
    if side * solver.y[0] < 0:
        raise AssertionError("the reference missed an impact")
    return Flight(end, *solver.y, peak, False, False)


def integrate(body, motion, tilt=0.0, *, kept=None, theta0=0.0):
    """The outcome, peak rotation and impacts of `body` under `motion`, in plain Python."""
    h, b_left = body.cg_height, body.left
    arm = {1: body.base - b_left, -1: b_left}
    i2 = body.gyration_radius**2
    r = {s: math.hypot(h, arm[s]) for s in arm}
    alpha = {s: math.atan(arm[s] / h) for s in arm}
    e = {s: (i2 + h * h - arm[1] * arm[-1]) / (i2 + h * h + arm[-s] ** 2) for s in arm}
    if kept is not None:
        e = dict.fromkeys(arm, kept)
    ax, dt = motion.horizontal, motion.time_step
    ay = np.zeros_like(ax) if motion.vertical is None else motion.vertical
    last = ax.size - 1
    side = 0 if theta0 == 0 else int(math.copysign(1, theta0))
    theta, omega, peak, impacts = theta0, 0.0, abs(theta0), []
    i = 0
    while i < last or side != 0:
        if i * dt > last * dt + FREE_TIME:
            raise AssertionError("the reference did not come to an end")
        t, end = i * dt, (i + 1) * dt
        a0, a1, g0, g1 = (0.0, 0.0, G, G)
        if i < last:
            a0, a1, g0, g1 = ax[i], ax[i + 1], G + ay[i], G + ay[i + 1]

        def acceleration(s, x, angle, t0=t, a0=a0, a1=a1, g0=g0, g1=g1):
            part = (x - t0) / dt
            phi = s * alpha[s] - angle + tilt
            a, g = a0 + (a1 - a0) * part, g0 + (g1 - g0) * part
            return -r[s] / (i2 + r[s] ** 2) * (g * math.sin(phi) + a * math.cos(phi))

        while t < end:
            if side == 0:
                lifts = []
                for s in (1, -1):

                    def moment(x, s=s, acceleration=acceleration):
                        return s * acceleration(s, x, 0.0)

                    if moment(t) > 0:
                        lifts.append((t, s))
                    elif moment(end) > 0:
                        lifts.append((brentq(moment, t, end, xtol=1e-15, rtol=1e-15), s))
                if not lifts:
                    break
                t, side = min(lifts)
                theta = omega = 0.0

            def own(x, angle, s=side, acceleration=acceleration):
                return acceleration(s, x, angle)

            t, theta, omega, peak, hit, fallen = fly(own, side, t, theta, omega, end, peak)
            if fallen:
                return Reference(side, peak, impacts, t)
            if hit:
                impacts.append(t)
                omega *= e[side]
                side = -side
                if e[-side] <= 0 or abs(omega) < REST_SPEED:
                    side, theta, omega = 0, 0.0, 0.0
        i += 1
    return Reference(0, peak, impacts, math.nan)
