"""The same cases in other software. Each takes (body, motion, tilt) and returns (outcome, peak).

SciPy and heyoka solve the same equations as the package: rocking about a corner, plastic
impacts. MuJoCo solves a box on a plane with contact and friction, which is another, softer
model.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from shaketable import Body, Motion

G = 9.80665
REST_SPEED = 1e-4  # rad/s
Case = tuple[int, float]


class _Rocker:
    """Constants of one case, and what happens at rest and at impacts (theory, section 2)."""

    def __init__(self, body: Body, motion: Motion, tilt: float) -> None:
        self.time, self.a = motion.time, motion.horizontal
        self.dt, self.tilt = motion.time_step, tilt
        self.alpha = {1: body.slenderness_right, -1: body.slenderness_left}
        r = {s: math.hypot(body.cg_height, b) for s, b in ((1, body.right), (-1, body.left))}
        i2 = body.gyration_radius**2
        self.k = {s: r[s] / (i2 + r[s] ** 2) for s in r}
        through = i2 + body.cg_height**2 - body.left * body.right
        self.keep = {s: through / (i2 + r[-s] ** 2) for s in r}

    def acceleration(self, s: int, theta: float, a: float) -> float:
        phi = s * self.alpha[s] - theta + self.tilt
        return -self.k[s] * (G * math.sin(phi) + a * math.cos(phi))

    def uplift(self, start: float) -> tuple[float, int]:
        """First time from `start` at which a resting body lifts, and the side."""
        first = int(start / self.dt)
        sine = {s: math.sin(s * self.alpha[s] + self.tilt) for s in (1, -1)}
        cosine = {s: math.cos(s * self.alpha[s] + self.tilt) for s in (1, -1)}
        moments = {s: -s * (G * sine[s] + self.a[first:] * cosine[s]) for s in (1, -1)}
        best = (math.inf, 0)
        for s, moment in moments.items():
            up = np.flatnonzero(moment[1:] > 0)
            if moment[0] > 0 and start >= first * self.dt:
                value = moment[0] + (moment[1] - moment[0]) * (start / self.dt - first)
                if value > 0:
                    best = min(best, (start, s))
            if up.size:
                j = int(up[0])
                part = -moment[j] / (moment[j + 1] - moment[j]) if moment[j] <= 0 else 0.0
                best = min(best, (max((first + j + part) * self.dt, start), s))
        return best


def scipy_solve_ivp(body: Body, motion: Motion, tilt: float, rtol: float = 1e-8) -> Case:
    """SciPy's RK45 with terminal events, the record interpolated linearly."""
    rocker = _Rocker(body, motion, tilt)
    end = motion.duration
    t, peak = 0.0, 0.0
    while True:
        t, s = rocker.uplift(t)
        if s == 0 or t >= end:
            return 0, peak
        y = [0.0, 0.0]
        while True:

            def rhs(x: float, y: Any, s: int = s) -> list[float]:
                a = float(np.interp(x, rocker.time, rocker.a, right=0.0))
                return [y[1], rocker.acceleration(s, y[0], a)]

            def lands(x: float, y: Any, s: int = s, start: float = t) -> float:
                return s * y[0] if x > start + 1e-9 else 1.0

            def falls(x: float, y: Any, s: int = s) -> float:
                return s * y[0] - math.pi / 2

            lands.terminal, lands.direction = True, -1  # type: ignore[attr-defined]
            falls.terminal = True  # type: ignore[attr-defined]
            run = solve_ivp(
                rhs, (t, max(end, t) + 10.0), y, rtol=rtol, atol=1e-10,
                max_step=rocker.dt, events=[lands, falls],
            )  # fmt: skip
            peak = max(peak, float(np.abs(run.y[0]).max()))
            if run.t_events[1].size:
                return s, math.pi / 2
            if not run.t_events[0].size:
                return 0, peak
            t = float(run.t_events[0][0])
            speed = rocker.keep[s] * float(run.y_events[0][0][1])
            s = -s
            y = [0.0, speed]
            if abs(speed) < REST_SPEED or rocker.keep[-s] <= 0:
                break


@cache
def _heyoka_stepper() -> Any:
    import heyoka as hy

    theta, omega = hy.make_vars("theta", "omega")
    k, alpha, push, slope, start = (hy.par[n] for n in range(5))
    a = push + slope * (hy.time - start)
    phi = alpha - theta
    equations = [
        (theta, omega),
        (omega, -k * (G * hy.sin(phi) + a * hy.cos(phi))),
    ]
    tops: list[float] = []

    def note_top(stepper: Any, time: float, direction: int) -> None:
        stepper.update_d_output(time)
        tops.append(float(stepper.d_output[0]))

    landing = hy.t_event(theta, direction=hy.event_direction.negative)
    fall = hy.t_event(theta - math.pi / 2)
    top = hy.nt_event(omega, note_top, direction=hy.event_direction.negative)
    stepper = hy.taylor_adaptive(
        equations, [0.0, 0.0], pars=[0.0] * 5, tol=1e-15, t_events=[landing, fall], nt_events=[top]
    )
    return stepper, tops


def heyoka(body: Body, motion: Motion, tilt: float) -> Case:
    """heyoka's adaptive Taylor integrator with its event detection, a record sample at a time.

    Seen from the side that the body rocks on: s θ, s a_x, α_s + s β.
    """
    rocker = _Rocker(body, motion, tilt)
    stepper, tops = _heyoka_stepper()
    tops.clear()
    t, peak, last = 0.0, 0.0, motion.horizontal.size - 1
    while True:
        t, s = rocker.uplift(t)
        if s == 0 or t >= motion.duration:
            return 0, max([peak, *tops])
        stepper.state[:] = [1e-13, 0.0]  # off the ground: a root at 0 hides the next
        while s != 0:
            i = int(t / rocker.dt + 1e-9)
            a0, a1 = (rocker.a[i], rocker.a[i + 1]) if i < last else (0.0, 0.0)
            stepper.pars[:] = [
                rocker.k[s],
                rocker.alpha[s] + s * rocker.tilt,
                s * a0,
                s * (a1 - a0) / rocker.dt,
                i * rocker.dt,
            ]
            stepper.time = t
            code = int(stepper.propagate_until((i + 1) * rocker.dt)[0].value)
            t = stepper.time
            peak = max(peak, float(stepper.state[0]))
            if code in (-1, 0):  # stopped by the first event: it lands
                speed = -rocker.keep[s] * float(stepper.state[1])
                s = -s
                stepper.reset_cooldowns()
                stepper.state[:] = [1e-13, speed]
                if speed < REST_SPEED:
                    break
            elif code in (-2, 1):
                return s, math.pi / 2
            elif t > motion.duration + 20.0:
                return 0, max([peak, *tops])


def mujoco_contact(
    body: Body, motion: Motion, tilt: float, static_friction: float, step: float, end: float
) -> tuple[int, float, float]:
    """MuJoCo: a box on a plane with contacts as hard as the step allows, pushed by the apparent
    gravity; outcome, peak rotation, slip at the end. Beyond 80° it counts as overturned."""
    import mujoco as mj

    width, height = body.base, 2 * body.cg_height
    depth = 4 * height
    friction = min(static_friction, 5.0)
    contact = f'friction="{friction} 0.005 0.0001" solref="{4 * step} 1"'
    middle = body.base / 2 - body.left  # of the box, from the centre of gravity's foot
    inertia = body.gyration_radius**2
    model = mj.MjModel.from_xml_string(f"""
      <mujoco><option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="50"/>
      <worldbody><geom type="plane" size="50 50 1" {contact}/>
      <body pos="0 0 {body.cg_height}"><freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="{inertia} {inertia} {inertia}"/>
      <geom type="box" pos="{middle} 0 0" size="{width / 2} {depth / 2} {height / 2}" {contact}/>
      </body></worldbody></mujoco>""")
    data = mj.MjData(model)
    times = np.arange(0.0, end, step)
    lift = np.zeros_like(motion.horizontal) if motion.vertical is None else motion.vertical
    push, up = (np.interp(times, motion.time, a, right=0.0) for a in (motion.horizontal, lift))
    sine, cosine = math.sin(tilt), math.cos(tilt)
    along = -push * cosine - (G + up) * sine
    normal = push * sine - (G + up) * cosine
    peak = 0.0
    for n in range(times.size):
        model.opt.gravity[:] = [along[n], 0.0, normal[n]]
        mj.mj_step(model, data)
        w, _, y, _ = data.qpos[3:7]
        theta = 2 * math.atan2(y, w)
        peak = max(peak, abs(theta))
        if abs(theta) > math.radians(80):
            return (1 if theta > 0 else -1), math.pi / 2, math.nan
    arm = body.right if theta > 0 else -body.left
    corner = arm * math.cos(theta) - body.cg_height * math.sin(theta)
    return 0, peak, float(data.qpos[0]) + corner - arm


def mujoco(body: Body, motion: Motion, tilt: float) -> Case:
    """The same with high friction, for W1."""
    end = motion.duration + 5.0
    return mujoco_contact(body, motion, tilt, math.inf, 5e-4, end)[:2]


PEERS: dict[str, Callable[[Body, Motion, float], Case]] = {
    "SciPy solve_ivp (RK45, rtol 1e-8)": scipy_solve_ivp,
    "heyoka (adaptive Taylor, events)": heyoka,
    "MuJoCo (box on a plane)": mujoco,
}
