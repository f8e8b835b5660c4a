"""An independent first-order time-stepping of a rigid body on two corners, to hold the general
model against: Moreau-Jean's scheme with Coulomb friction and Newton restitution.

It knows no phases and no events. In each step of fixed length the impulses at the corners that
would penetrate are found by projected Gauss-Seidel on velocities; friction has one coefficient.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numba
import numpy as np

G = 9.80665
SWEEPS = 400
CONVERGED = 1e-13


class Stepped(NamedTuple):
    outcome: int
    peak: float  # rad
    slip: float  # m, of the lowest corner, at the end
    farthest: float  # m, the largest |slip| while a corner is on the support
    lift: float  # m, the largest clearance


@numba.njit
def local(w_tt, w_nn, w_tn, b_t, b_n, mu):
    """Impulse (t, n) of one contact with v = W r + b: 0 <= n ⊥ v_n >= 0, t in the cone."""
    if b_n >= 0.0:
        return 0.0, 0.0
    det = w_tt * w_nn - w_tn * w_tn
    t, n = (-b_t * w_nn + b_n * w_tn) / det, (-b_n * w_tt + b_t * w_tn) / det
    if n >= 0.0 and abs(t) <= mu * n:
        return t, n
    for sign in (1.0, -1.0):  # of the friction
        down = w_nn + sign * mu * w_tn
        if down > 0.0:
            n = -b_n / down
            t = sign * mu * n
            if (w_tt * t + w_tn * n + b_t) * sign <= 0.0:
                return t, n
    return 0.0, 0.0


@numba.njit
def step_on(size, tilt, mu, restitution, push, lift, dt, end, h):
    cg, right, left, i2 = size
    x, y, th = 0.0, cg, 0.0
    vx, vy, om = 0.0, 0.0, 0.0
    arm = np.array([right, -left])
    X, Y, impulse = np.zeros(2), np.zeros(2), np.zeros((2, 2))
    active = np.zeros(2, np.bool_)
    peak = farthest = top = slip = 0.0
    cos_b, sin_b = math.cos(tilt), math.sin(tilt)
    for k in range(int(end / h)):
        at = (k + 0.5) * h / dt
        j = int(at)
        ax = ay = 0.0
        if j + 1 < push.size:
            ax = push[j] + (push[j + 1] - push[j]) * (at - j)
            ay = lift[j] + (lift[j + 1] - lift[j]) * (at - j)
        ft = -ax * cos_b - (G + ay) * sin_b
        fn = ax * sin_b - (G + ay) * cos_b
        x += 0.5 * h * vx
        y += 0.5 * h * vy
        th += 0.5 * h * om
        s, c = math.sin(th), math.cos(th)
        wx, wy, wo = vx + h * ft, vy + h * fn, om
        any_active = False
        for i in range(2):
            X[i], Y[i] = arm[i] * c - cg * s, -arm[i] * s - cg * c
            active[i] = y + Y[i] <= 0.0
            any_active = any_active or active[i]
        if any_active:
            target = np.zeros(2)
            for i in range(2):
                target[i] = restitution * (vy - om * X[i])
                if not active[i]:
                    impulse[i] = 0.0
                else:  # start from the last step's
                    wx += impulse[i, 0]
                    wy += impulse[i, 1]
                    wo += (Y[i] * impulse[i, 0] - X[i] * impulse[i, 1]) / i2
            for _ in range(SWEEPS):
                change = 0.0
                for i in range(2):
                    if not active[i]:
                        continue
                    w_tt, w_nn = 1.0 + Y[i] ** 2 / i2, 1.0 + X[i] ** 2 / i2
                    w_tn = -X[i] * Y[i] / i2
                    t0, n0 = impulse[i]
                    b_t = wx + wo * Y[i] - w_tt * t0 - w_tn * n0
                    b_n = wy - wo * X[i] + target[i] - w_tn * t0 - w_nn * n0
                    t, n = local(w_tt, w_nn, w_tn, b_t, b_n, mu)
                    wx += t - t0
                    wy += n - n0
                    wo += (Y[i] * (t - t0) - X[i] * (n - n0)) / i2
                    impulse[i] = (t, n)
                    change = max(change, abs(t - t0) + abs(n - n0))
                if change < CONVERGED:
                    break
        vx, vy, om = wx, wy, wo
        x += 0.5 * h * vx
        y += 0.5 * h * vy
        th += 0.5 * h * om
        i = 0 if th >= 0.0 else 1
        s, c = math.sin(th), math.cos(th)
        slip = x + arm[i] * c - cg * s - arm[i]
        gap = y - arm[i] * s - cg * c
        peak, top = max(peak, abs(th)), max(top, gap)
        if any_active:
            farthest = max(farthest, abs(slip))
        if abs(th) >= math.pi / 2:
            return (1 if th > 0 else -1), math.pi / 2, slip, farthest, top
    return 0, peak, slip, farthest, top


def time_stepping(case, end, h=1e-5):
    """A `pulses.Case` until `end` [s], in steps of h."""
    body, motion, support, model = case
    size = (body.cg_height, body.right, body.left, body.gyration_radius**2)
    lift = np.zeros_like(motion.horizontal) if motion.vertical is None else motion.vertical
    return Stepped(
        *step_on(
            size,
            support.tilt,
            model.static_friction,
            model.normal_restitution,
            motion.horizontal.copy(),
            lift.copy(),
            motion.time_step,
            end,
            h,
        )
    )
