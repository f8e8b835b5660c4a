"""A solid's numbers, and the workspace that one run writes to.

| symbol | word | unit |
|---|---|---|
| p, v | centre of gravity and its velocity, support frame | m, m/s |
| Q | rotation, body frame to support frame, as a quaternion w, x, y, z | |
| ω | angular velocity, body frame | rad/s |
| f | body force per unit mass, support frame: Rᵀ(-a - g Z) | m/s² |
| λ = (T_x, T_y, N) | reaction of one contact per unit mass, support frame | m/s² |
| r | a contact point from the centre of gravity, body frame | m |
| u | velocity of a contact point, support frame | m/s |
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from shaketable.compiled import kernel
from shaketable.physics.space.vectors import Sym, Vec

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Where a state's numbers lie.
P, Q, V, W, STATE = 0, 3, 7, 10, 13
BETWEEN = 7  # the row of the stages that a look between two steps writes
# Columns of a contact point.
X, Y, STATIC, KINETIC, POINT = range(5)
# Columns of a strap: its point from the centre of gravity (body frame) and its anchor (support
# frame) [m], k and c by the body's mass [1/s², 1/s], what it is longer than between these at the
# start [m], its strength by the mass [m/s²]; then, of a run: L₀ [m], the largest force so far
# [m/s²], and when it broke [s].
ARM, ANCHOR, STIFFNESS, DAMPING, SLACK, STRENGTH, LENGTH, FORCE_PEAK, BROKE, STRAP = (
    0, 3, 6, 7, 8, 9, 10, 11, 12, 13,
)  # fmt: skip
MOST_STRAPS = 8
# Columns of a plane that a solid may touch, the support first, then walls: unit normal toward the
# body and two tangents (support frame), n·p at the plane [m], friction, restitution; and of a wall
# as it is given: its azimuth [rad], its gap at the start [m], and 1 if it is vertical in the level
# frame, 0 if it is normal to the support.
(
    NORMAL, TANGENT, BINORMAL, OFFSET, FRICTION, RESTITUTION, TOWARD, FREE_GAP, VERTICAL, PLANE,
) = (0, 3, 6, 9, 10, 11, 12, 13, 14, 15)  # fmt: skip
MOST_WALLS = 4
# Columns of a touch, a contact on any plane: its plane; which point (of the support's contacts, or
# of the outline); r and how fast it moves along the body (body frame); where it slips, along its
# plane's tangents; 1 if it does, 1 if a row of `rows` carries its pressure; μ_s, μ_k; the plane's
# tangents and normal as the body sees them.
(
    OF_PLANE, WHICH, LEVER, ALONG, SLIP_DIRECTION, MOVES, CARRIES, STATIC_AT, KINETIC_AT, FRAME,
    TOUCH,
) = (0, 1, 2, 5, 8, 10, 11, 12, 13, 14, 23)  # fmt: skip
MOST_TOUCHES, MOST_OUTLINE = 48, 32
CLOCK = 0  # of `Workspace.clock`: when the interval began [s], and how far it is [s]
# What `Workspace.mode` tells: how the closed points lie (CONTACT_KIND), what keeps them from
# slipping (FRICTION_STATE),
# the row of the one that sticks where only one does, how many are closed, the places (among the
# closed) of the two that are farthest apart, and how many points are on the support.
# Then how many touches there are, and how many rows `kept` has; both of a mode beside a wall alone.
(
    CONTACT_KIND, FRICTION_STATE, PIVOT, CLOSED, FIRST, LAST, NEAR, TOUCHES, ROWS, MODE,
) = range(10)  # fmt: skip
FLIGHT, CORNER, EDGE, FLAT, WALLED = range(5)
SLIPS, PIVOTS, STICKS = range(3)
# What `Workspace.judged` tells of the reactions: the least pressure and the least margin to the
# edge of the friction cone [m/s²], negative where the contact ends; what they were as a step began;
# and how far below zero they must be to end the mode.
PRESS, CONE, PRESS_BEFORE, CONE_BEFORE, PAST, JUDGED = range(6)
# What a run writes down of itself; the peak as the square of the sine of the nutation. The foot of
# the centre of gravity is at START_X, START_Y as it begins; FARTHEST is the square of how far from
# there it comes.
(
    PEAK, LIFT, YAW, IMPACTS, EVENTS, STEPS, ENERGY_CUTS, FALLBACKS, EVER_ENERGY, START_X, START_Y,
    FARTHEST, TALLY,
) = range(13)  # fmt: skip


class Thresholds(NamedTuple):
    """Below what something counts as nothing: in proportion to a solid, but for the last one."""

    bounce: float  # m/s: what lands more slowly does not bounce
    settle: float  # m/s: a base whose corners move more slowly is laid flat (`settling`)
    leaving: float  # m/s: a point that leaves an impact more slowly may as well stay
    # m/s: below this speed the direction of friction goes over from that of the slip to the one
    # that the slip had when it began or became so slow; it would turn in a time of |u| / (μ g)
    turning: float
    slow: float  # m/s: a slower contact does not slip, if it can stick
    slipping: float  # m/s: nor does a slower one, whatever it can do
    landing: float  # m: points this near to the support when another lands, land with it
    hovering: float  # m: what time stepping has brought to rest may hang so far above the support
    starting: float  # m/s²: a point of a flat base that accelerates by less stays


class SolidParameters(NamedTuple):
    """A solid, and how its contacts behave.

    Compiled code gets it as a record of the type `SHAPE`, one pointer: as a tuple its numbers would
    be copied at every call.
    """

    h: float  # height of the centre of gravity over the base [m]
    radius: float  # of a circular base [m], 0 if contact is at points
    hull: int  # the first so many points are the hull's corners, counterclockwise from above
    contacts: int  # points in all: of a circle those of its ring, or the high points of its rim
    inertia: Sym  # per unit mass about the centre of gravity [m²]
    mobility: Sym  # its inverse
    restitution: float  # e_n
    factor: float  # on the velocities that an impact leaves at a contact that stays and sticks
    limits: Thresholds
    # errors of a step that are just accepted [m, rad, m/s, rad/s], times 1 + the size of what they
    # are errors of
    tolerance: float
    rolling: float  # length that times N bounds the moment against rolling [m]
    contour: float  # that times N and the rate of a rim's contact around it is what is lost [m]
    drilling: float  # and against turning about the normal [m]
    inscribed: float  # distance of the foot of the centre of gravity from the nearest side [m]
    reach: float  # and from the farthest point [m]
    least_static: float  # the least μ_s of the points
    inner: float  # distance of the inner ring's points, in parts of the outer's
    uniform: bool  # all points have the same friction
    rise: float  # of a rim on high points, of its circle over the plane of these [m]; 0 without
    straps: int  # how many
    walls: int  # how many
    # points of the body that may touch a wall: of a circle its rims, which turn toward the wall
    outline: int
    # where the support ends: direction of its edge, distance from the origin, infinite without an
    # edge [m], and how far below it the floor is [m]
    edge_x: float
    edge_y: float
    edge_at: float
    drop: float
    # pull-off strength of all glued feet by the mass [m/s²], 0 without, and their middle [m]
    glue: float
    glue_x: float
    glue_y: float


class Workspace(NamedTuple):
    """What one run works in: n is the number of points and one more, the rolling rim.

    Compiled code gets it as a record of the type `WORKSPACE`, as it does SolidParameters.
    """

    points: Floats  # (n, POINT)
    state: Floats  # (STATE,)
    trial: Floats  # (STATE,): the end of a step on trial
    stages: Floats  # (8, STATE): rates; the last row is for a look between two steps
    between: Floats  # (4, STATE): the polynomial through a step
    mode: Integers  # (MODE,)
    closed: Integers  # (n,): rows of the closed points
    near: Integers  # (n,): rows of the points on the support, before it is known which stay
    slip: Floats  # (n, 2): direction in which each point slips, as the step began
    moving: Integers  # (n,): 1 if it slips
    carries: Integers  # (n,): 1 if it carries part of the pressure, by closed place
    basis: Floats  # (n, 3): how the pressure may be shared, by closed place
    shares: Floats  # (n, 3): reactions, by closed place
    judged: Floats  # (JUDGED,)
    rim: Floats  # (6,): azimuth on the rim x, y; how it moves along x, y; where the step began x, y
    rows: Floats  # (6, 6): constraints
    columns: Floats  # (6, 6): reactions
    system: Floats  # (6, 7)
    solved: Floats  # (6,)
    anchor: Floats  # (4,): what a sticking contact keeps: point x, y; direction x, y
    free: Floats  # (n, 3): velocity or acceleration of each closed place without reaction
    goal: Floats  # (n,): the least of it along the normal afterwards
    local: Floats  # (n, 6): response of each closed place to its own reaction
    effects: Floats  # (n + 4, 6): what each constraint gets from a unit of each reaction
    tally: Floats  # (TALLY,)
    straps: Floats  # (MOST_STRAPS, STRAP)
    held: Integers  # (MOST_STRAPS,): what each strap does
    torque: Floats  # (3,): of all straps, by the body's mass, body frame [m²/s²]
    clock: Floats  # (2,)
    planes: Floats  # (1 + MOST_WALLS, PLANE)
    outline: Floats  # (MOST_OUTLINE, 3): points that may touch walls, body frame; rims' centres
    touches: Floats  # (MOST_TOUCHES, TOUCH)
    kept: Integers  # (6, 2): the touch and the component of each row
    kept_state: Floats  # (STATE,): before a mode is tried


#: The largest solid's: corners and the rim.
MOST = 65

_SIZES: dict[str, tuple[int, ...]] = {
    "points": (MOST, POINT),
    "state": (STATE,),
    "trial": (STATE,),
    "stages": (BETWEEN + 1, STATE),
    "between": (4, STATE),
    "mode": (MODE,),
    "closed": (MOST,),
    "near": (MOST,),
    "slip": (MOST, 2),
    "moving": (MOST,),
    "carries": (MOST,),
    "basis": (MOST, 3),
    "shares": (MOST, 3),
    "judged": (JUDGED,),
    "rim": (6,),
    "rows": (6, 6),
    "columns": (6, 6),
    "system": (6, 7),
    "solved": (6,),
    "anchor": (4,),
    "free": (MOST, 3),
    "goal": (MOST,),
    "local": (MOST, 6),
    "effects": (MOST + 4, 6),
    "tally": (TALLY,),
    "straps": (MOST_STRAPS, STRAP),
    "held": (MOST_STRAPS,),
    "torque": (3,),
    "clock": (2,),
    "planes": (1 + MOST_WALLS, PLANE),
    "outline": (MOST_OUTLINE, 3),
    "touches": (MOST_TOUCHES, TOUCH),
    "kept": (6, 2),
    "kept_state": (STATE,),
}
_INTEGERS = {"mode", "closed", "near", "moving", "carries", "held", "kept"}
WORKSPACE = np.dtype(
    [
        (name, np.int64 if name in _INTEGERS else np.float64, _SIZES[name])
        for name in Workspace._fields
    ]
)
#: An array of one record: how Python code passes a workspace.
Workspaces = NDArray[np.void]


def make_workspaces() -> Workspaces:
    """Empty ones."""
    return np.zeros(1, WORKSPACE).view(np.recarray)  # plain Python takes names of a record, too


_TYPES: dict[str, DTypeLike] = {
    "hull": np.int64,
    "contacts": np.int64,
    "inertia": [(name, np.float64) for name in Sym._fields],
    "mobility": [(name, np.float64) for name in Sym._fields],
    "limits": [(name, np.float64) for name in Thresholds._fields],
    "uniform": np.bool_,
    "straps": np.int64,
    "walls": np.int64,
    "outline": np.int64,
}
SOLID_RECORD = np.dtype(
    [(name, _TYPES.get(name, np.float64)) for name in SolidParameters._fields], align=True
)
#: An array of records: how Python code passes shapes.
SolidRecords = NDArray[np.void]


def make_records(*shapes: SolidParameters) -> SolidRecords:
    """An array of shapes."""
    return np.array([tuple(shape) for shape in shapes], SOLID_RECORD).view(np.recarray)


@kernel
def vec(numbers: Floats, first: int) -> Vec:
    return Vec(numbers[first], numbers[first + 1], numbers[first + 2])


@kernel
def put(numbers: Floats, first: int, a: Vec) -> None:
    numbers[first] = a.x
    numbers[first + 1] = a.y
    numbers[first + 2] = a.z
