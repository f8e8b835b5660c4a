"""Moreau and Jean's time stepping for a solid among planes, independent of the package.

First order: velocities after each step from impulses at the points that are, half a step ahead,
on or behind their plane (Moreau 1988, Jean 1999; Acary & Brogliato 2008, section 10.1), found by
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
    points: Floats,
    planes: Floats,
    inertia: Floats,
    force: Floats,
    h_sample: float,
    parts: int,
    orientation: float,
    straps: Floats,
    pulled: Floats,
    out: Floats,
) -> None:
    n = points.shape[0]
    height = -points[0, 2]
    corners = points[:, :3].copy()
    frames = np.empty((n, 3, 3))  # of each point's plane: two tangents and the normal
    offset, friction, restitution = np.empty(n), np.empty(n), np.empty(n)
    for c in range(n):
        plane = planes[int(points[c, 3])]
        frames[c, 2] = plane[:3]
        other = np.array([1.0, 0.0, 0.0]) if abs(plane[0]) < 0.7 else np.array([0.0, 0.0, 1.0])
        first = other - (other * plane[:3]).sum() * plane[:3]
        frames[c, 0] = first / np.sqrt((first**2).sum())
        frames[c, 1] = np.cross(frames[c, 2], frames[c, 0])
        offset[c], friction[c], restitution[c] = plane[3], plane[4], plane[5]
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
            for c in range(n):
                if points[c, 4] > 0.0:  # a rim's point that is nearest to its plane
                    normal = rot.T @ frames[c, 2]
                    down = np.hypot(normal[0], normal[1])
                    if down > 0.0:
                        corners[c, 0] = -points[c, 4] * normal[0] / down
                        corners[c, 1] = -points[c, 4] * normal[1] / down
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
                before[c] = (frames[c, 2] * u).sum()
                gap = (frames[c, 2] * (p + arms[c])).sum() - offset[c]
                active[c] = gap + 0.5 * h * before[c] <= 0.0
                count += active[c]
            v, w = v_free, w_free
            if count:
                for c in range(n):
                    if active[c]:
                        impulse = frames[c].T @ impulses[c]
                        v = v + impulse
                        w = w + back @ np.cross(arms[c], impulse)
                    else:
                        impulses[c] = 0.0
                response = np.zeros((n, 3, 3))
                inverted = np.zeros((n, 3, 3))
                for c in range(n):
                    x, y, z = arms[c]
                    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
                    response[c] = frames[c] @ (np.eye(3) - cross @ back @ cross) @ frames[c].T
                    inverted[c] = np.linalg.inv(response[c])
                for _ in range(SWEEPS):
                    change = 0.0
                    for c in range(n):
                        if not active[c]:
                            continue
                        u = frames[c] @ (v + np.cross(w, arms[c]))
                        goal = -restitution[c] * before[c] if before[c] < 0.0 else 0.0
                        free = u - response[c] @ impulses[c]
                        new = np.zeros(3)
                        if free[2] < goal:
                            new = inverted[c] @ (np.array([0.0, 0.0, goal]) - free)
                            if np.hypot(new[0], new[1]) > friction[c] * new[2]:
                                new = _slipping(response[c], free, goal, friction[c], impulses[c])
                        d = new - impulses[c]
                        impulses[c] = new
                        impulse = frames[c].T @ d
                        v = v + impulse
                        w = w + back @ np.cross(arms[c], impulse)
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
    walls: Floats | None = None,
    outline: Floats | None = None,
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
        walls: of each its normal toward the body, n·p on it, friction and restitution, (wall, 6).
        outline: points that may touch walls, from the centre of gravity, and the radius of a rim
            about each, else 0, (point, 4).
    """
    out = np.empty(6)
    rows = np.empty((0, 10)) if straps is None else np.ascontiguousarray(straps)
    pulled = np.tile([0.0, np.nan], (len(rows), 1))
    corners = np.array(corners, np.float64)
    points = [[*corner, 0.0, 0.0] for corner in corners]
    if rim is not None:
        radius, rise = rim
        points.append([radius, 0.0, corners[0, 2] + rise, 0.0, radius])
    planes = np.array([[0.0, 0.0, 1.0, 0.0, friction, restitution]])
    if walls is not None and outline is not None:
        planes = np.concatenate([planes, walls])
        points += [
            [*place, k + 1.0, radius] for k in range(len(walls)) for *place, radius in outline
        ]
    _march(
        np.array(points), planes, inertia, np.ascontiguousarray(force), time_step, parts,
        orientation, rows, pulled, out,
    )  # fmt: skip
    return Reached(bool(out[0]), out[1], out[2], out[3:5].copy(), out[5], pulled)
