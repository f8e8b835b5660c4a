"""Inertia per unit mass, of the usual bodies and as a user gives it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import require_size
from shaketable.errors import InputError

SYMMETRIC = 1e-9  # of the largest moment of inertia
TRIANGLE = 1e-9


def inertia_tensor(values: ArrayLike) -> NDArray[np.float64]:
    """A tensor that a body can have.

    Raises:
        InputError: one that is not symmetric, or whose principal moments are not positive or do
            not keep to the triangle inequality: no moment exceeds the sum of the other two.
    """
    try:
        tensor = np.array(values, np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"Solid.inertia must be a (3, 3) array of numbers: {error}") from None
    if tensor.shape != (3, 3) or not np.isfinite(tensor).all():
        raise InputError(
            f"Solid.inertia must be a finite (3, 3) array [m²], got shape {tensor.shape}"
        )
    if np.abs(tensor - tensor.T).max() > SYMMETRIC * np.abs(tensor).max():
        raise InputError(f"Solid.inertia must be symmetric, got {tensor.tolist()}")
    tensor = (tensor + tensor.T) / 2
    least, middle, most = np.linalg.eigvalsh(tensor).tolist()
    if least <= 0.0 or most > (least + middle) * (1.0 + TRIANGLE):
        raise InputError(
            "no body has this Solid.inertia: its principal moments "
            f"{least:.6g}, {middle:.6g}, {most:.6g} m² must be positive, and none may exceed the "
            "sum of the other two"
        )
    for moment in (least, most):
        require_size("a radius of gyration of Solid.inertia [m]", math.sqrt(moment))
    tensor.flags.writeable = False
    return tensor


def box_inertia(size_x: float, size_y: float, height: float) -> NDArray[np.float64]:
    """Of a homogeneous box per unit mass about its centroid [m²], (3, 3)."""
    x, y, z = size_x**2, size_y**2, height**2
    return np.diag([y + z, x + z, x + y]) / 12


def prism_inertia(corners: NDArray[np.float64], height: float) -> NDArray[np.float64]:
    """Of a homogeneous prism per unit mass about its centroid [m²], (3, 3).

    Moments of area of the polygon by Green's theorem, over triangles from its first corner.
    """
    a = corners - corners[0]
    b = np.roll(a, -1, axis=0)
    double = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    area = double.sum() / 2
    if area == 0.0:
        raise InputError(f"corners enclose no area: {corners.tolist()}")
    middle = (double[:, None] * (a + b)).sum(axis=0) / (6 * area)
    xx, yy = ((double[:, None] * (a**2 + a * b + b**2)).sum(axis=0) / (12 * area)) - middle**2
    mixed = 2 * a[:, 0] * a[:, 1] + a[:, 0] * b[:, 1] + b[:, 0] * a[:, 1] + 2 * b[:, 0] * b[:, 1]
    xy = (double * mixed).sum() / (24 * area) - middle[0] * middle[1]
    zz = height**2 / 12
    return np.array([[yy + zz, -xy, 0.0], [-xy, xx + zz, 0.0], [0.0, 0.0, xx + yy]])
