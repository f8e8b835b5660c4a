"""Where a solid is in each picture of its film."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from shaketable.drawing.shown import ShownMotion, ShownSupport, ShownSurroundings
from shaketable.drawing.solid_mesh import ShownSolid

LEAD, TAIL = 0.5, 1.0  # s shown before the first and after the last movement
MOVED = 1e-4  # m or rad: the eye sees no smaller movement


class ShownAround(ShownSupport, Protocol):
    """What is asked of a `Support` in three dimensions."""

    @property
    def azimuth(self) -> float: ...


class ShownRun(Protocol):
    """What is asked of a `SolidResponse`."""

    @property
    def body(self) -> ShownSolid: ...
    @property
    def motion(self) -> ShownMotion: ...
    @property
    def support(self) -> ShownAround: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    @property
    def position(self) -> NDArray[np.float64]: ...
    @property
    def quaternions(self) -> NDArray[np.float64]: ...
    @property
    def surroundings(self) -> ShownSurroundings | None: ...
    @property
    def strap_forces(self) -> NDArray[np.float64]: ...
    @property
    def strap_broke_at(self) -> tuple[float, ...]: ...


class Poses(NamedTuple):
    """A solid at some times.

    Attributes:
        time: [s], (n,).
        position: of the centre of gravity in the support's frame [m], (n, 3).
        quaternions: the body's frame to the support's, scalar last, of one sign, (n, 4).
    """

    time: NDArray[np.float64]
    position: NDArray[np.float64]
    quaternions: NDArray[np.float64]


def poses_of(run: ShownRun, rate: float, most: int, fewest: float) -> Poses:
    """From just before the body moves until just after, evenly in time.

    Args:
        run: what is shown.
        rate: pictures a second.
        most: pictures, from which on there are fewer a second.
        fewest: pictures a second, however long the film is.
    """
    from scipy.spatial.transform import Rotation, Slerp

    time = run.time
    turn = np.abs(run.quaternions - run.quaternions[0]).max(axis=1)
    moved = np.abs(run.position - run.position[0]).max(axis=1) + turn
    still = np.abs(np.diff(moved, prepend=moved[:1])) < MOVED / 100
    moving = np.flatnonzero((moved > MOVED) & ~still)
    first, last = (time[moving[0]], time[moving[-1]]) if moving.size else (0.0, time[-1])
    begin, until = max(first - LEAD, 0.0), last + TAIL
    even = np.arange(begin, until, 1 / min(rate, max(most / (until - begin), fewest)))
    within = np.clip(even, time[0], time[-1])
    turned = Slerp(time, Rotation.from_quat(run.quaternions))(within).as_quat()
    flips = np.cumprod(np.where((turned[1:] * turned[:-1]).sum(axis=1) < 0.0, -1.0, 1.0))
    turned[1:] *= flips[:, None]
    position = np.column_stack([np.interp(within, time, each) for each in run.position.T])
    return Poses(even, position, turned)


def tilting(support: ShownAround) -> NDArray[np.float64]:
    """The support's frame to the level one, as a matrix: downhill toward its azimuth."""
    from scipy.spatial.transform import Rotation

    toward = support.azimuth + math.pi / 2
    axis = np.array([math.cos(toward), math.sin(toward), 0.0])
    return np.asarray(Rotation.from_rotvec(support.tilt * axis).as_matrix())


class ShownPlane(NamedTuple):
    """A wall in the support's frame.

    Attributes:
        foot: of the wall, straight before the body's foot at the start [m], (3,).
        axes: columns: into the wall, along its foot, and up along it, (3, 3).
    """

    foot: NDArray[np.float64]
    axes: NDArray[np.float64]


def planes_of(run: ShownRun) -> list[ShownPlane]:
    """Each wall beside a solid; its gap is from the nearest point of the body at the start."""
    from scipy.spatial.transform import Rotation

    body = run.body
    low, high = -body.cg_height, (body.height or 2.0 * body.cg_height) - body.cg_height
    start = Rotation.from_quat(run.quaternions[0])
    found = []
    for wall in run.surroundings.walls if run.surroundings else ():
        toward = np.array([math.cos(wall.azimuth), math.sin(wall.azimuth), 0.0])
        if wall.vertical:
            toward = tilting(run.support).T @ toward
        own = start.inv().apply(toward)
        if body.diameter is not None:
            reach = body.diameter / 2 * math.hypot(*own[:2])
        else:
            reach = float((body.corners @ own[:2]).max())
        far = reach + max(own[2] * low, own[2] * high) + wall.gap  # from the centre of gravity
        along = np.cross([0.0, 0.0, 1.0], toward)
        along /= np.linalg.norm(along)
        up = np.cross(toward, along)
        foot = run.position[0] + far * toward
        foot = foot - foot[2] / up[2] * up
        found.append(ShownPlane(foot, np.column_stack([toward, along, up])))
    return found


class ShownPull(NamedTuple):
    """A strap at some times.

    Attributes:
        point: of the body, in the support's frame [m], (n, 3).
        anchor: in it [m], (3,).
        force: [N], (n,).
        whole: whether it has not broken, (n,).
    """

    point: NDArray[np.float64]
    anchor: NDArray[np.float64]
    force: NDArray[np.float64]
    whole: NDArray[np.bool_]


def pulls_of(run: ShownRun, poses: Poses) -> list[ShownPull]:
    """Each strap of a solid in its poses."""
    from scipy.spatial.transform import Rotation

    straps = run.surroundings.straps if run.surroundings else ()
    turns = Rotation.from_quat(poses.quaternions)
    forces = run.strap_forces
    return [
        ShownPull(
            poses.position + turns.apply(np.array(strap.point) - [0.0, 0.0, run.body.cg_height]),
            np.array(strap.anchor),
            np.interp(poses.time, run.time, forces[:, k]),
            ~(poses.time >= broke),
        )
        for k, (strap, broke) in enumerate(zip(straps, run.strap_broke_at, strict=True))
    ]
