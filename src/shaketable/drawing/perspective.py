"""Convex parts of bodies as an eye sees them, in light, with their shadows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.drawing.solid_mesh import Prism

AZIMUTH, ELEVATION = math.radians(-55.0), math.radians(22.0)  # of the eye, seen from the scene
AWAY = 4.5  # distance of the eye, in sizes of the scene
LIGHT = np.array([-0.25, 0.6, -1.0])  # where light goes, in the level frame
BODY = np.array([0.36, 0.62, 0.88])
EDGE = np.full(3, 0.15)
DULLEST = 0.5  # brightness of a face that light does not meet

Points = NDArray[np.float64]


class Camera(NamedTuple):
    """An eye that looks at a point.

    Attributes:
        eye: where it is, in the level frame [m], (3,).
        axes: rows: to the right, up, and away from the eye, (3, 3).
    """

    eye: Points
    axes: Points

    def project(self, points: Points) -> Points:
        """Places in the picture of points in the level frame, (n, 3) to (n, 2)."""
        seen = (points - self.eye) @ self.axes.T
        return np.asarray(seen[:, :2] / seen[:, 2:])


def camera_at(
    target: Points,
    half: float,
    azimuth: float = AZIMUTH,
    elevation: float = ELEVATION,
    away: float = AWAY,
) -> Camera:
    """An eye that sees a plate of this half width around a point.

    Args:
        target: at which it looks, in the level frame [m], (3,).
        half: half the width of what is seen [m].
        azimuth, elevation: of the eye, seen from there [rad]; not from right above.
        away: how far the eye is, in halves.
    """
    out = np.array(
        [
            math.cos(elevation) * math.cos(azimuth),
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
        ]
    )
    right = np.cross([0.0, 0.0, 1.0], out)
    right /= np.linalg.norm(right)
    up = np.cross(out, right)
    return Camera(target + away * half * out, np.array([right, up, -out]))


def shadows(parts: Sequence[Prism], position: Points, turn: Points, plate: Points) -> list[Points]:
    """Outlines of the shadows that the parts cast on the support, in the level frame."""
    from scipy.spatial import ConvexHull

    light = plate.T @ LIGHT
    found = []
    for part in parts:
        points = part.vertices @ turn.T + position
        flat = points[:, :2] - points[:, 2:] / light[2] * light[:2]
        hull = flat[ConvexHull(flat).vertices]
        found.append(np.column_stack([hull, np.zeros(len(hull))]) @ plate.T)
    return found


class Face(NamedTuple):
    """A face as the eye sees it: its outline in the picture, and colours."""

    away: float
    outline: Points
    colour: Points
    edge: Points


def visible(
    parts: Sequence[Prism],
    position: Points,
    turn: Points,
    plate: Points,
    camera: Camera,
    colour: Points = BODY,
) -> list[Face]:
    """All faces that the eye sees, the farthest part first."""
    light = -LIGHT / np.linalg.norm(LIGHT)
    seen = []
    for part in parts:
        points = (part.vertices @ turn.T + position) @ plate.T
        away = float(np.linalg.norm(points.mean(axis=0) - camera.eye))
        for number, face in enumerate(part.faces):
            corners = points[face]
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
            if normal @ (corners[0] - camera.eye) < 0.0:
                lit = max(float(normal @ light) / float(np.linalg.norm(normal)), 0.0)
                lit_colour = shade(lit, colour)
                side_of_round = part.is_round and number > 1
                edge = lit_colour if side_of_round else EDGE
                seen.append(Face(away, camera.project(corners), lit_colour, edge))
    return sorted(seen, key=lambda face: -face.away)


def shade(lit: float, colour: Points = BODY) -> Points:
    """The colour of a face that is met by so much of the light."""
    return np.asarray(colour * (DULLEST + (1 - DULLEST) * lit))
