"""Moreau and Jean's time stepping for a solid with corners, independent of the package.

First order: velocities after each step from impulses at the corners that are, half a step ahead,
on or under the support (Moreau 1988, Jean 1999; Acary & Brogliato 2008, section 10.1), found by
projected Gauss-Seidel with Coulomb's disc. Nothing in it knows of phases or events.
"""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SWEEPS = 400
CONVERGED = 1e-11


class Reached(NamedTuple):
    """Where time stepping came to."""

    fell: bool
    azimuth: float  # of the axis as it fell [rad]
    peak: float  # nutation [rad]
    displacement: Floats  # (2,) [m]
    yaw: float  # [rad]
    straps: Floats  # (strap, 2): largest force by the mass [m/s²], time of breaking [s]


@numba.njit(cache=True)
def _rotation(q: Floats) -> Floats:
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@numba.njit(cache=True)
def _march(
    corners: Floats,
    radius: float,
    inertia: Floats,
    friction: float,
    restitution: float,
    force: Floats,
    h_sample: float,
    parts: int,
    orientation: float,
    straps: Floats,
    pulled: Floats,
    out: Floats,
) -> None:
    n = corners.shape[0]
    height = -corners[0, 2]
    inverse = np.linalg.inv(inertia)
    p, v, w = np.array([0.0, 0.0, height]), np.zeros(3), np.zeros(3)
    q = np.array([np.cos(orientation / 2), 0.0, 0.0, np.sin(orientation / 2)])
    h = h_sample / parts
    peak, yaw, last = 0.0, 0.0, orientation
    impulses = np.zeros((n, 3))
    for i in range(force.shape[0] - 1):
        for j in range(parts):
            f = force[i] + (j + 0.5) / parts * (force[i + 1] - force[i])
            rot = _rotation(q)
            world = rot @ inertia @ rot.T
            back = rot @ inverse @ rot.T
            if radius > 0.0:  # the last corner is a rim's lowest point
                down = np.hypot(rot[2, 0], rot[2, 1])
                if down > 0.0:
                    corners[n - 1, 0] = -radius * rot[2, 0] / down
                    corners[n - 1, 1] = -radius * rot[2, 1] / down
            v_free = v + h * f
            w_free = w - h * (back @ np.cross(w, world @ w))
            for s in range(straps.shape[0]):
                if np.isfinite(pulled[s, 1]):
                    continue
                arm = rot @ straps[s, :3]
                apart = straps[s, 3:6] - p - arm
                length = np.sqrt((apart**2).sum())
                toward = apart / length
                rate = -(toward * (v + np.cross(w, arm))).sum()
                stretch = length - straps[s, 8]
                size = straps[s, 6] * stretch + straps[s, 7] * rate
                if stretch > 0.0 and size > 0.0:
                    pulled[s, 0] = max(pulled[s, 0], min(size, straps[s, 9]))
                    if size >= straps[s, 9]:
                        pulled[s, 1] = i * h_sample + j * h
                        continue
                    v_free = v_free + h * size * toward
                    w_free = w_free + h * (back @ np.cross(arm, size * toward))
            arms = corners @ rot.T
            active = np.zeros(n, np.bool_)
            before = np.zeros(n)
            count = 0
            for c in range(n):
                u = v + np.cross(w, arms[c])
                before[c] = u[2]
                active[c] = p[2] + arms[c, 2] + 0.5 * h * u[2] <= 0.0
                count += active[c]
            v, w = v_free, w_free
            if count:
                for c in range(n):
                    if active[c]:
                        v = v + impulses[c]
                        w = w + back @ np.cross(arms[c], impulses[c])
                    else:
                        impulses[c] = 0.0
                response = np.zeros((n, 3, 3))
                inverted = np.zeros((n, 3, 3))
                for c in range(n):
                    x, y, z = arms[c]
                    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
                    response[c] = np.eye(3) - cross @ back @ cross
                    inverted[c] = np.linalg.inv(response[c])
                for _ in range(SWEEPS):
                    change = 0.0
                    for c in range(n):
                        if not active[c]:
                            continue
                        u = v + np.cross(w, arms[c])
                        goal = -restitution * before[c] if before[c] < 0.0 else 0.0
                        free = u - response[c] @ impulses[c]
                        new = np.zeros(3)
                        if free[2] < goal:
                            new = inverted[c] @ (np.array([0.0, 0.0, goal]) - free)
                            if np.hypot(new[0], new[1]) > friction * new[2]:
                                new = _slipping(response[c], free, goal, friction, impulses[c])
                        d = new - impulses[c]
                        impulses[c] = new
                        v = v + d
                        w = w + back @ np.cross(arms[c], d)
                        change = max(change, np.abs(d).max())
                    if change < CONVERGED:
                        break
            else:
                impulses[:] = 0.0
            p = p + h * v
            half = 0.5 * h
            dq = np.array(
                [
                    -w[0] * q[1] - w[1] * q[2] - w[2] * q[3],
                    w[0] * q[0] + w[1] * q[3] - w[2] * q[2],
                    w[1] * q[0] + w[2] * q[1] - w[0] * q[3],
                    w[2] * q[0] + w[0] * q[2] - w[1] * q[1],
                ]
            )
            q = q + half * dq
            q = q / np.sqrt((q**2).sum())
            axis = _rotation(q)[:, 2]
            peak = max(peak, np.arctan2(np.hypot(axis[0], axis[1]), axis[2]))
            now = 2 * np.arctan2(q[3], q[0])
            yaw += (now - last + np.pi) % (2 * np.pi) - np.pi
            last = now
            if axis[2] <= 0.0:
                out[:] = np.array(
                    [
                        1.0,
                        np.arctan2(axis[1], axis[0]),
                        np.pi / 2,
                        p[0] - height * axis[0],
                        p[1] - height * axis[1],
                        yaw,
                    ]
                )
                return
    axis = _rotation(q)[:, 2]
    out[:] = np.array([0.0, np.nan, peak, p[0] - height * axis[0], p[1] - height * axis[1], yaw])


@numba.njit(cache=True)
def _slipping(
    response: Floats, free: Floats, goal: float, friction: float, guess: Floats
) -> Floats:
    """The impulse of a corner that slips on: friction against the slip that follows."""
    t = guess[:2].copy()
    if np.hypot(t[0], t[1]) == 0.0:
        t = -free[:2]
    step = 1.0 / (response[0, 0] + response[1, 1])
    normal = 0.0
    for _ in range(200):
        normal = max(
            0.0, (goal - free[2] - response[2, 0] * t[0] - response[2, 1] * t[1]) / response[2, 2]
        )
        u = np.empty(2)
        for a in range(2):
            u[a] = free[a] + response[a, 0] * t[0] + response[a, 1] * t[1]
            u[a] += response[a, 2] * normal
        new = t - step * u
        size = np.hypot(new[0], new[1])
        if size > friction * normal:
            new = new * (friction * normal / size)
        done = np.abs(new - t).max() < 1e-14
        t = new
        if done:
            break
    return np.array([t[0], t[1], normal])


def march(
    corners: Floats,
    inertia: Floats,
    force: Floats,
    time_step: float,
    *,
    friction: float,
    restitution: float = 0.0,
    parts: int,
    orientation: float = 0.0,
    rim: tuple[float, float] | None = None,
    straps: Floats | None = None,
) -> Reached:
    """Shake a solid at rest on its base.

    Args:
        corners: from the centre of gravity, body frame [m], shape (n, 3), all at one height.
        inertia: about it, per unit mass [m²], (3, 3).
        force: per unit mass in the support's frame, linear between samples [m/s²], (n, 3).
        time_step: of the samples [s].
        parts: steps in each sample.
        orientation: ψ0 [rad].
        rim: radius of a rim, and its height over the corners [m].
        straps: of each its point from the centre of gravity, its anchor, k and c by the mass, its
            length without force and its strength by the mass, (strap, 10).
    """
    out = np.empty(6)
    rows = np.empty((0, 10)) if straps is None else np.ascontiguousarray(straps)
    pulled = np.tile([0.0, np.nan], (len(rows), 1))
    radius = 0.0
    corners = np.array(corners, np.float64)
    if rim is not None:
        radius, rise = rim
        corners = np.concatenate([corners, [[radius, 0.0, corners[0, 2] + rise]]])
    _march(
        corners, radius, inertia, friction, restitution,
        np.ascontiguousarray(force), time_step, parts, orientation, rows, pulled, out,
    )  # fmt: skip
    return Reached(bool(out[0]), out[1], out[2], out[3:5].copy(), out[5], pulled)
