"""Vectors, symmetric tensors and rotations, as scalars for compiled code."""

from __future__ import annotations

import math
from typing import NamedTuple

from shaketable.compiled import kernel


class Vec(NamedTuple):
    """Three components along the axes of one frame."""

    x: float
    y: float
    z: float


class Sym(NamedTuple):
    """A symmetric tensor."""

    xx: float
    yy: float
    zz: float
    xy: float
    xz: float
    yz: float


class Axes(NamedTuple):
    """The support's axes as the body's frame sees them: the rows of Q, body to support."""

    x: Vec
    y: Vec
    z: Vec


ZERO = Vec(0.0, 0.0, 0.0)


@kernel
def add(a: Vec, b: Vec) -> Vec:
    return Vec(a.x + b.x, a.y + b.y, a.z + b.z)


@kernel
def subtract(a: Vec, b: Vec) -> Vec:
    return Vec(a.x - b.x, a.y - b.y, a.z - b.z)


@kernel
def times(s: float, a: Vec) -> Vec:
    return Vec(s * a.x, s * a.y, s * a.z)


@kernel
def dot(a: Vec, b: Vec) -> float:
    return a.x * b.x + a.y * b.y + a.z * b.z


@kernel
def cross(a: Vec, b: Vec) -> Vec:
    return Vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


@kernel
def applied(m: Sym, a: Vec) -> Vec:
    """The product of a tensor and a vector."""
    return Vec(
        m.xx * a.x + m.xy * a.y + m.xz * a.z,
        m.xy * a.x + m.yy * a.y + m.yz * a.z,
        m.xz * a.x + m.yz * a.y + m.zz * a.z,
    )


@kernel
def inverse(m: Sym) -> Sym:
    xx = m.yy * m.zz - m.yz * m.yz
    xy = m.xz * m.yz - m.xy * m.zz
    xz = m.xy * m.yz - m.xz * m.yy
    one = 1.0 / (m.xx * xx + m.xy * xy + m.xz * xz)
    yy = m.xx * m.zz - m.xz * m.xz
    yz = m.xy * m.xz - m.xx * m.yz
    zz = m.xx * m.yy - m.xy * m.xy
    return Sym(one * xx, one * yy, one * zz, one * xy, one * xz, one * yz)


@kernel
def about(m: Sym, r: Vec) -> Sym:
    """The inertia per unit mass about a point at `r` from the centre of gravity (Steiner)."""
    return Sym(
        m.xx + r.y * r.y + r.z * r.z,
        m.yy + r.x * r.x + r.z * r.z,
        m.zz + r.x * r.x + r.y * r.y,
        m.xy - r.x * r.y,
        m.xz - r.x * r.z,
        m.yz - r.y * r.z,
    )


@kernel
def axes_of(w: float, x: float, y: float, z: float) -> Axes:
    """The rotation of a quaternion of any length."""
    s = 2.0 / (w * w + x * x + y * y + z * z)
    return Axes(
        Vec(1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)),
        Vec(s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)),
        Vec(s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)),
    )


class LongAxes(NamedTuple):
    """Axes of the length of their quaternion's square.

    What is asked of them is divided by that at the end, for which it need not wait.
    """

    axes: Axes
    one: float  # by their length


@kernel
def long_axes_of(w: float, x: float, y: float, z: float) -> LongAxes:
    ww, xx, yy, zz = w * w, x * x, y * y, z * z
    axes = Axes(
        Vec((ww + xx) - (yy + zz), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        Vec(2.0 * (x * y + w * z), (ww + yy) - (xx + zz), 2.0 * (y * z - w * x)),
        Vec(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), (ww + zz) - (xx + yy)),
    )
    return LongAxes(axes, 1.0 / ((ww + xx) + (yy + zz)))


@kernel
def on_support(q: Axes, a: Vec) -> Vec:
    """A vector of the body's frame in the support's."""
    return Vec(dot(q.x, a), dot(q.y, a), dot(q.z, a))


@kernel
def on_body(q: Axes, a: Vec) -> Vec:
    """A vector of the support's frame in the body's."""
    return add(add(times(a.x, q.x), times(a.y, q.y)), times(a.z, q.z))


@kernel
def unit(a: Vec) -> Vec:
    return times(1.0 / math.sqrt(dot(a, a)), a)
