"""What a simulation of a solid returns."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.models import General
from shaketable.outcome import Outcome
from shaketable.response import Response
from shaketable.solid import Solid
from shaketable.units import degrees

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from scipy.spatial.transform import Rotation


class Contact(IntEnum):
    """What of the base is on the support."""

    NOTHING = 0
    POINT = 1  # a corner, a foot, or a point of a rim
    SIDE = 2
    BASE = 3
    WALL = 4  # the body presses against a wall
    EDGE = 5  # the edge of its support, or the lip there, bears a part of it


class Grip(IntEnum):
    """What the points on the support do."""

    SLIPS = 0  # all of them, or there are none
    PIVOTS = 1  # one sticks and the others slip
    STICKS = 2


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SolidResponse(Response):
    """The result of one simulation in three dimensions.

    All directions and positions are in the support's frame: x and y in its plane, z its normal.
    The last sample of a solid that overturned is at `overturning_time`.

    Attributes:
        outcome: DOWNHILL or UPHILL: whether the azimuth of the fall is within 90° of the support's.
            On a level support, toward -x is DOWNHILL.
        fall_azimuth: direction of the axis as it fell, from x toward y, in (-π, π] [rad]; NaN if
            it stands.
        within_45_of_dip: whether that is within 45° of the support's azimuth or of its opposite.
        pivot_contacts: the corner or foot that it fell over, or the two of a side, as rows of
            `body.contacts`; none if it stands or its base is a circle.
        displacement_x, displacement_y: of the foot of the centre of gravity from where it stood
            [m], at the end of the history, or at the fall: what wobbles on after the motion moves
            on.
        yaw: turn about the normal by then [rad], counted on beyond π.
        displacement_x_at_motion_end, displacement_y_at_motion_end, yaw_at_motion_end: the same as
            the motion ended, or at a fall before.
        farthest_displacement: that the foot was from where it stood, at the ends of steps [m].
        max_lift: at the ends of steps.
        impacts: how often some point landed.
        position, velocity: shape (n, 3); z from the support.
        quaternions: the body's frame to the support's, scalar last, shape (n, 4).
        angular_velocity: in the body's frame [rad/s], shape (n, 3).
        contact: what of the base is on the support, shape (n,).
        grip: whether it slips, shape (n,).
        fallbacks: how often accumulating events were stepped over, or reactions of all points
            together did not converge (theory, section 11).
        orientation: of the solid on its support at the start, from x toward y [rad].
    """

    body: Solid
    model: General
    fall_azimuth: float
    within_45_of_dip: bool
    pivot_contacts: tuple[int, ...]
    displacement_y: float
    yaw: float
    displacement_x_at_motion_end: float
    displacement_y_at_motion_end: float
    yaw_at_motion_end: float
    farthest_displacement: float
    quaternions: NDArray[np.float64]
    angular_velocity: NDArray[np.float64]
    contact: tuple[Contact, ...]
    grip: tuple[Grip, ...]
    fallbacks: int
    orientation: float

    @property
    def rotation(self) -> Rotation:
        """The body's frame to the support's, as n rotations of SciPy."""
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.quaternions)

    @property
    def nutation(self) -> NDArray[np.float64]:
        """Angle between the body's axis and the support's normal [rad], shape (n,)."""
        axis = self.axis
        return np.asarray(np.arctan2(np.hypot(axis[:, 0], axis[:, 1]), axis[:, 2]))

    @property
    def axis(self) -> NDArray[np.float64]:
        """The body's axis, a unit vector, shape (n, 3)."""
        x, y, z, w = self.quaternions.T
        return np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])

    @property
    def foot(self) -> NDArray[np.float64]:
        """Foot of the centre of gravity on the body's base, from where it stood [m], (n, 3)."""
        return self.position - self.body.cg_height * self.axis

    @property
    def strap_forces(self) -> NDArray[np.float64]:
        """The force of each strap at the samples [N], shape (n, strap)."""
        straps = self.surroundings.straps if self.surroundings else ()
        forces = np.zeros((self.time.size, len(straps)))
        for k, strap in enumerate(straps):
            arm = np.array(strap.point) - [0.0, 0.0, self.body.cg_height]
            toward = np.array(strap.anchor) - self.position - self.rotation.apply(arm)
            length = np.linalg.norm(toward, axis=1)
            moves = self.velocity + self.rotation.apply(np.cross(self.angular_velocity, arm))
            rate = -(toward * moves).sum(axis=1) / length
            forces[:, k] = strap.pulls(length, rate, float(length[0]))
            forces[self.time >= self.strap_broke_at[k], k] = 0.0
        return forces

    def plot(self, ax: tuple[Axes, Axes, Axes] | None = None) -> tuple[Axes, Axes, Axes]:
        """Nutation over time, the foot's way below it, below that the motion; returns the axes."""
        from shaketable.drawing.solid_history import plot_solid

        return plot_solid(self, ax)

    def animate(self, path: str | Path) -> Path:
        """Write the solid's motion; the path's ending chooses GIF, MP4, or glTF (.glb).

        A film is in perspective; a scene in glTF can be looked at from anywhere, in the viewers
        of most systems and in browsers. It needs the extra `gltf`.
        """
        from shaketable.drawing.files import SCENE, require_film_or_scene
        from shaketable.drawing.solid_film import animate_solid
        from shaketable.drawing.solid_gltf import write_gltf

        path = Path(path)
        require_film_or_scene(path)
        write = write_gltf if path.suffix.lower() == SCENE else animate_solid
        return write(self, path)

    def __repr__(self) -> str:
        ends = (
            ""
            if self.outcome is Outcome.STANDING
            else f" toward {degrees(self.fall_azimuth):.0f}° at {self.overturning_time:.3f} s"
        )
        x, y = 1e3 * self.displacement_x, 1e3 * self.displacement_y
        return (
            f"SolidResponse({self.outcome.name}{ends}, peak {degrees(self.peak_rotation):.3g}°, "
            f"moved ({x:.3g}, {y:.3g}) mm, turned {degrees(self.yaw):.3g}°, {self.impacts} "
            f"impacts, {self.time.size} samples; {self.body!r}, {self.motion!r}, "
            f"tilt {degrees(self.support.tilt):.3g}° toward "
            f"{degrees(self.support.azimuth):.3g}°, {self.model!r})"
        )
