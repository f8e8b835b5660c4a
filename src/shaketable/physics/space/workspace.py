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

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray

from shaketable.compiled import kernel
from shaketable.physics.space.vectors import Sym, Vec

Floats = NDArray[np.float64]
Floats6 = NDArray[np.float64]  # six, as a field of a record; `Floats` are three there
PerStrap = NDArray[np.float64]  # one for each strap, likewise
Integers = NDArray[np.int64]

# Where a state's numbers lie: first what the motion of a body that turns about a point depends on,
# then what that of any other does, and then the place.
Q, W, V, P, STATE = 0, 4, 7, 10, 13
BETWEEN = 7  # the row of the stages that a look between two steps writes
MOST_STRAPS = 8
MOST_WALLS = 4
MOST_TOUCHES, MOST_OUTLINE = 112, 32
MOST_SIDES = 3 * MOST_OUTLINE // 2  # of a body, which the edge of its support may meet
FLIGHT, CORNER, EDGE, FLAT, WALLED = range(5)  # kinds of a mode: how the closed points lie
SLIPS, PIVOTS, STICKS = range(3)  # grips of a mode: what keeps them from slipping
# What `Touch.carries` says: it carries a share, it may carry if it is independent of those that do,
# it follows from them and carries nothing, or it would pull.
PRESSES, MAY_PRESS, DEPENDENT, PULLS = 2, 1, 0, -1


class Clock:
    """The time of a run [s]; the loop over the samples writes it."""

    begun: float  # when the interval began
    passed: float  # how far it is


class Point:
    """A point of the base that may touch the support; written before a run, but for the rim's."""

    x: float  # body frame [m]
    y: float
    static: float  # μ_s
    kinetic: float  # μ_k


class Rim:
    """Where a circular base is lowest; `contacts` writes it."""

    x: float  # azimuth of the point, body frame
    y: float
    along_x: float  # how it moves along the rim [m/s]
    along_y: float
    before_x: float  # its azimuth as the step began
    before_y: float


class HeldStrap:
    """A strap; written before a run, but for the last three, which `straps` writes."""

    arm: Floats  # (3,): its point from the centre of gravity, body frame [m]
    anchor: Floats  # (3,): support frame [m]
    stiffness: float  # k by the body's mass [1/s²]
    damping: float  # c by it [1/s]
    slack: float  # what it is longer than between these at the start [m]
    strength: float  # by the mass [m/s²]
    length: float  # L₀ [m]
    force_peak: float  # the largest force so far, by the mass [m/s²]
    broke_at: float  # [s], NaN if it did not


class Plane:
    """What a solid may touch: the support first, then walls, a lip's face and the line of an edge.

    `walls` and `edge` write their places.
    """

    normal: Floats  # (3,): toward the body, support frame
    tangent: Floats  # (3,)
    binormal: Floats  # (3,)
    offset: float  # n·p at the plane [m]
    friction: float
    restitution: float
    toward: float  # of a wall as it is given: its azimuth [rad]
    free_gap: float  # its gap at the start [m]
    vertical: float  # 1 in the level frame, 0 where it is normal to the support


class Touch:
    """A contact of the body, on any plane.

    `touches` lists it and writes where it is, which is asked of those on walls, or where all decide
    together; what decides a mode writes the rest.
    """

    plane: int  # 0 is the support, then walls; `edge` numbers the face of a lip and the line
    point: int  # of the support's contacts, or of the outline; of the line which side it meets
    moves: int  # 1 if it slips
    carries: int  # of a mode beside a wall, what it may bear: as `walled` says
    slip_x: float  # where it slips, along the tangents, as the step began
    slip_y: float
    static: float  # μ_s
    kinetic: float  # μ_k
    lever: Floats  # r, body frame [m]
    along: Floats  # how fast that moves along the body [m/s]
    bend: float  # what the turning of its normal adds to the acceleration of its gap [m/s²]
    tangent: Floats  # of its plane, as the body sees it
    binormal: Floats
    normal: Floats
    share: Floats  # its reaction: along its tangents and its normal [m/s²; of impacts m/s]
    free: Floats  # its velocity or acceleration without any reaction, likewise
    goal: float  # the least of it along the normal afterwards
    own: Floats6  # its response to its own reaction, as Sym
    basis: Floats  # how the pressure may be shared on the support (`constraints`)
    active: int  # 1 if it has a part of the pressure there, of which some may pull
    spread: Floats6  # its pressure for a unit of each row's unknown (`walled`)
    found: Floats  # its reaction that was found, while others are tried


class Mode:
    """The contact mode: `modes` writes how points lie, `closing` and `touches` what is listed."""

    kind: int  # FLIGHT, CORNER, EDGE, FLAT or WALLED
    grip: int  # SLIPS, PIVOTS or STICKS
    pivot: int  # place of the touch that sticks, where only one does
    touches: int  # how many touches are listed
    near: int  # how many of them are on the support: the first ones
    closed: int  # how many of them are closed
    rolls: int  # 1 if the lowest point of a rim is
    first: int  # places, in the list, of the two closed ones that are farthest apart
    last: int
    rows: int  # how many rows `kept` has, of a mode beside a wall
    pressures: int  # the first so many of these are pressures


class Judged:
    """What the reactions say of the mode [m/s²]; negative where it ends.

    `rates` and, beside walls, `walled` write the first three, `events` and `interval` the others.
    """

    press: float  # the least pressure
    cone: float  # the least margin to the edge of the friction cone
    along: float  # the force along a side that sticks, of which its ends have a part each
    press_before: float  # what they were as the step began
    cone_before: float
    past: float  # how far below zero they must be to end the mode


class Tally:
    """What a run writes down of itself; `interval` and what it asks write it."""

    peak: float  # square of the sine of the largest nutation
    lift: float  # [m]
    yaw: float  # [rad]
    yaw_w: float  # of the rotation that it was told of
    yaw_z: float
    impacts: int
    events: int
    steps: int
    energy_cuts: int  # impacts whose restitution was lowered, as they would have given energy
    fallbacks: int  # problems that were not solved exactly: the nearest answer was taken
    start_x: float  # where the foot of the centre of gravity is as it begins [m]
    start_y: float
    farthest: float  # square of how far from there it comes [m²]
    left_at: float  # when it last touched its support or the edge of that [s]
    tips: float  # how far its axis has turned toward the edge, turn by turn [rad]
    met: int  # 1 once it has met a wall, the edge, or what holds it
    slip_back: float  # of a body in the plane, the farthest of its corners toward -x [m]
    slip_front: float  # and toward +x
    start_yaw: float  # as it begins [rad]
    shaken_x: float  # displacement and yaw at the motion's end, or where it ends before [m, m, rad]
    shaken_y: float
    shaken_yaw: float
    calm: int  # intervals, one after the other, in which it hardly moved
    was_x: float  # where it was an interval ago, while it lies flat [m]
    was_y: float
    lively: float  # the most kinetic energy of the present second, by the mass [m²/s²]
    was_lively: float  # and of the one before
    swings: int  # seconds, one after the other, in which it hardly lost any
    looked_at: float  # when the present second began, since the motion ended [s]
    ending: int  # one of `found`
    ended: float  # when [s]
    landed: int  # 1 if it came down past the edge
    samples: int  # of its history


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
    planar: bool  # it moves in the plane of x and z alone, and tells its slip there (`in_plane`)
    uniform: bool  # all points have the same friction
    rise: float  # of a rim on high points, of its circle over the plane of these [m]; 0 without
    straps: int  # how many
    walls: int  # how many
    # points of the body that may touch a wall: of a circle its rims, which turn toward the wall
    outline: int
    size: float  # distance of the body's farthest point from the centre of gravity [m]
    # where the support ends: direction of its edge, distance from the origin, infinite without an
    # edge [m], how high its lip is [m], and how far below it the floor is [m]
    edge_x: float
    edge_y: float
    edge_at: float
    lip: float
    drop: float
    # pull-off strength of all glued feet by the mass [m/s²], 0 without, and their middle [m]
    glue: float
    glue_x: float
    glue_y: float


class Workspace(NamedTuple):
    """What one run works in: n is the number of points and one more, the rolling rim.

    Compiled code gets it as a record of the type `WORKSPACE`, as it does SolidParameters.
    """

    points: Sequence[Point]  # (n,)
    state: Floats  # (STATE,)
    trial: Floats  # (STATE,): the end of a step on trial
    stages: Floats  # (8, STATE): rates; the last row is for a look between two steps
    between: Floats  # (4, STATE): the polynomial through a step
    mode: Mode
    closed: Integers  # (MOST_TOUCHES,): places in the list of what is closed
    judged: Judged
    rim: Rim
    rows: Floats  # (6, 6): constraints
    columns: Floats  # (6, 6): reactions
    system: Floats  # (6, 7)
    solved: Floats  # (6,)
    anchor: Floats  # (4,): what a sticking contact keeps: point x, y; direction x, y
    effects: Floats  # (n + 4, 6): what each constraint gets from a unit of each reaction
    tally: Tally
    straps: Sequence[HeldStrap]  # (MOST_STRAPS,)
    held: Integers  # (MOST_STRAPS,): what each strap does
    torque: Floats  # (3,): of all straps, by the body's mass, body frame [m²/s²]
    clock: Clock
    planes: Sequence[Plane]  # (3 + MOST_WALLS,)
    outline: Floats  # (MOST_OUTLINE, 3): points that may touch walls, body frame; rims' centres
    past: Integers  # (n,): 1 for each point of the base that is past the edge; `edge` writes it
    behind: Integers  # (BEHIND,): 1 for each surface of an edge that the body is behind
    kept: Integers  # (6, 2): the touch and the component of each row
    independent: Floats  # (6, 6): these rows, made orthogonal to one another
    made_of: Floats  # (6, 6): each of those, in rows
    parts: Floats  # (6,): along each of them, what of the row that was looked at last
    change: Floats  # (6,): of velocity or acceleration, and of spin, by all touches; body frame
    kept_state: Floats  # (STATE,): before a mode is tried
    touches: Sequence[Touch]  # (MOST_TOUCHES,): the list: what may bear something, or lands


#: The largest solid's: corners and the rim.
MOST = 65
#: Where `behind` tells of points on the support, of the outline at a lip, and of sides at the line.
BEHIND_LIP = MOST
BEHIND_SIDES = BEHIND_LIP + MOST_OUTLINE
BEHIND = BEHIND_SIDES + MOST_SIDES

_SIZES: dict[str, tuple[int, ...]] = {
    "state": (STATE,),
    "trial": (STATE,),
    "stages": (BETWEEN + 1, STATE),
    "between": (4, STATE),
    "closed": (MOST_TOUCHES,),
    "rows": (6, 6),
    "columns": (6, 6),
    "system": (6, 7),
    "solved": (6,),
    "anchor": (4,),
    "effects": (MOST + 4, 6),
    "held": (MOST_STRAPS,),
    "torque": (3,),
    "outline": (MOST_OUTLINE, 3),
    "past": (MOST,),
    "behind": (BEHIND,),
    "kept": (6, 2),
    "independent": (6, 6),
    "made_of": (6, 6),
    "parts": (6,),
    "change": (6,),
    "kept_state": (STATE,),
}
_INTEGERS = {
    "closed",
    "held",
    "kept",
    "past",
    "behind",
}
#: Fields that are records, and how many there are of each; none of one alone.
_RECORDS: dict[str, tuple[type, tuple[int, ...]]] = {
    "points": (Point, (MOST,)),
    "mode": (Mode, ()),
    "judged": (Judged, ()),
    "rim": (Rim, ()),
    "tally": (Tally, ()),
    "straps": (HeldStrap, (MOST_STRAPS,)),
    "clock": (Clock, ()),
    "planes": (Plane, (3 + MOST_WALLS,)),
    "touches": (Touch, (MOST_TOUCHES,)),
}


def record_type(fields: type) -> np.dtype[np.void]:
    """The type of a record, by the annotations of a class."""
    kinds = {
        "int": (np.int64, ()),
        "float": (np.float64, ()),
        "Floats": (np.float64, (3,)),
        "Floats6": (np.float64, (6,)),
        "PerStrap": (np.float64, (MOST_STRAPS,)),
    }
    return np.dtype([(name, *kinds[kind]) for name, kind in fields.__annotations__.items()])


def _field(name: str) -> tuple[str, DTypeLike, tuple[int, ...]]:
    if name in _RECORDS:
        kind, shape = _RECORDS[name]
        return name, record_type(kind), shape
    return name, np.int64 if name in _INTEGERS else np.float64, _SIZES[name]


WORKSPACE = np.dtype([_field(name) for name in Workspace._fields])
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
    "planar": np.bool_,
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
