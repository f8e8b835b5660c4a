"""Moreau and Jean's time stepping for a planar body among half planes and straps.

Independent of the package, first order: velocities after each step from impulses at the vertices
that are, half a step ahead, on or behind a plane (Moreau 1988, Jean 1999), by projected
Gauss-Seidel with Coulomb's law. Nothing in it knows of phases, modes or events.
"""

from __future__ import annotations

from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SWEEPS = 2000
CONVERGED = 1e-12


class Reached(NamedTuple):
    """Where time stepping came to."""

    fell: float  # +1 toward +x, -1, 0 if it stands
    when: float  # s
    peak: float  # rad
    x: float  # of the lowest corner, from where it stood [m]
    straps: Floats  # (strap,): largest force by the mass [m/s²]


@numba.njit(cache=True)
def _march(
    vertices: Floats, planes: Floats, straps: Floats, i2: float, height: float, force: Floats,
    h_sample: float, parts: int, out: Floats, pulled: Floats,
) -> None:  # fmt: skip
    # planes: n_x, n_y, offset, friction, restitution; the support first, touched by the first two
    # vertices alone; straps: point, anchor, k, c, L0, strength
    h = h_sample / parts
    x, y, theta = 0.0, height, 0.0
    v = np.zeros(3)
    m = 4 * planes.shape[0]
    impulses = np.zeros((m, 2))
    broken = np.zeros(straps.shape[0], np.bool_)
    out[:] = 0.0
    for i in range(force.shape[0] - 1):
        for j in range(parts):
            f = force[i] + (j + 0.5) / parts * (force[i + 1] - force[i])
            s, c = np.sin(theta), np.cos(theta)
            free = v.copy()
            free[0] += h * f[0]
            free[1] += h * f[1]
            for k in range(straps.shape[0]):
                if broken[k]:
                    continue
                q0 = straps[k, 0] * c + straps[k, 1] * s
                q1 = straps[k, 1] * c - straps[k, 0] * s
                d0, d1 = straps[k, 2] - x - q0, straps[k, 3] - y - q1
                length = np.sqrt(d0 * d0 + d1 * d1)
                d0, d1 = d0 / length, d1 / length
                rate = -d0 * (v[0] + v[2] * q1) - d1 * (v[1] - v[2] * q0)
                stretch = length - straps[k, 6]
                size = straps[k, 4] * stretch + straps[k, 5] * rate
                if stretch > 0.0 and size > 0.0:
                    pulled[k] = max(pulled[k], min(size, straps[k, 7]))
                    if size >= straps[k, 7]:
                        broken[k] = True
                        continue
                    free[0] += h * size * d0
                    free[1] += h * size * d1
                    free[2] += h * size * (q1 * d0 - q0 * d1) / i2
            active = np.zeros(m, np.bool_)
            levers = np.zeros((m, 2))
            before = np.zeros(m)
            for p in range(planes.shape[0]):
                for w in range(4 if p > 0 else 2):
                    q0 = vertices[w, 0] * c + vertices[w, 1] * s
                    q1 = vertices[w, 1] * c - vertices[w, 0] * s
                    n0, n1 = planes[p, 0], planes[p, 1]
                    rate = n0 * (v[0] + v[2] * q1) + n1 * (v[1] - v[2] * q0)
                    gap = n0 * (x + q0) + n1 * (y + q1) - planes[p, 2]
                    k = 4 * p + w
                    levers[k, 0], levers[k, 1] = q0, q1
                    before[k] = rate
                    active[k] = gap + 0.5 * h * rate <= 0.0
            v = free
            for k in range(m):
                p = k // 4
                if not active[k]:
                    impulses[k] = 0.0
                    continue
                n0, n1 = planes[p, 0], planes[p, 1]
                p0 = n0 * impulses[k, 0] + n1 * impulses[k, 1]
                p1 = n1 * impulses[k, 0] - n0 * impulses[k, 1]
                v[0] += p0
                v[1] += p1
                v[2] += (levers[k, 1] * p0 - levers[k, 0] * p1) / i2
            for _ in range(SWEEPS):
                change = 0.0
                for k in range(m):
                    if not active[k]:
                        continue
                    p = k // 4
                    n0, n1 = planes[p, 0], planes[p, 1]
                    q0, q1 = levers[k]
                    rn, rt = q1 * n0 - q0 * n1, q1 * n1 + q0 * n0
                    wn, wt = 1.0 + rn * rn / i2, 1.0 + rt * rt / i2
                    un = n0 * v[0] + n1 * v[1] + rn * v[2]
                    target = -planes[p, 4] * min(before[k], 0.0)
                    new = max(0.0, impulses[k, 0] + (target - un) / wn)
                    dn = new - impulses[k, 0]
                    impulses[k, 0] = new
                    v[0] += n0 * dn
                    v[1] += n1 * dn
                    v[2] += rn * dn / i2
                    ut = n1 * v[0] - n0 * v[1] + rt * v[2]
                    most = planes[p, 3] * impulses[k, 0]
                    new = min(most, max(-most, impulses[k, 1] - ut / wt))
                    dt = new - impulses[k, 1]
                    impulses[k, 1] = new
                    v[0] += n1 * dt
                    v[1] += -n0 * dt
                    v[2] += rt * dt / i2
                    change = max(change, abs(dn), abs(dt))
                if change < CONVERGED:
                    break
            x += h * v[0]
            y += h * v[1]
            theta += h * v[2]
            out[2] = max(out[2], abs(theta))
            if abs(theta) >= 0.5 * np.pi:
                out[0] = np.sign(theta)
                out[1] = i * h_sample + j * h
                return
    w = 0 if theta >= 0.0 else 1
    out[3] = x + vertices[w, 0] * np.cos(theta) + vertices[w, 1] * np.sin(theta) - vertices[w, 0]


def march(
    vertices: Floats, planes: Floats, straps: Floats, i2: float, height: float, force: Floats,
    step: float, parts: int,
) -> Reached:  # fmt: skip
    """Where a body comes to that stands at rest.

    Args:
        vertices: base right and left, top right and left, from the centre of gravity [m], (4, 2).
        planes: normal, offset [m], friction and restitution of the support and walls, (n, 5).
        straps: point, anchor [m], k, c by the mass, L₀ [m], strength by the mass, (strap, 8).
        i2: i² [m²].
        height: of the centre of gravity over the base [m].
        force: on the body by its mass at the samples [m/s²], (samples, 2).
        step: between them [s].
        parts: of each.
    """
    out, pulled = np.zeros(4), np.zeros(len(straps))
    _march(vertices, planes, straps, i2, height, force, step, parts, out, pulled)
    return Reached(*out.tolist(), pulled)
