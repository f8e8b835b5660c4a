"""A body and what surrounds it, and the workspace that one run writes to.

| symbol | word | unit |
|---|---|---|
| x, y | centre of gravity in the support's frame, + toward +x; normal | m |
| θ, ω | rotation, + toward +x; its rate | rad(/s) |
| q | lever from the centre of gravity to a contact | m |
| n, t | normal of a contact, toward the body; tangent (n_y, -n_x) | |
| g, v | gap of a contact; velocity of the body there along t | m, m/s |
| N, T | force at a contact by the body's mass, along n and t | m/s² |
| f | body force per unit mass | m/s² |
| a, b | μ/(1 + μ), 1/(1 + μ), so that Coulomb's law is b |T| <= a N | |

A point (ξ, η) of the body, from the centre of gravity, lies at X = ξ cos θ + η sin θ,
Y = -ξ sin θ + η cos θ, and moves with (x' + ωY, y' - ωX).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# A state: x, y, θ and their rates.
X, Y, TURN, V_X, V_Y, SPIN, STATE = range(7)
MOST_WALLS, MOST_STRAPS = 4, 8
# Columns of a wall: its normal, n·p on it, the shares a and b of its friction, its restitution.
WALL_X, WALL_Y, OFFSET, WALL_A, WALL_B, WALL_E, WALL = range(7)
# Columns of a strap: its point from the centre of gravity (body), its anchor (support) [m], k and c
# by the mass [1/s², 1/s], what it is longer than between these at the start [m], its strength by
# the mass [m/s²]; then, of a run: L₀ [m], the largest force so far [m/s²], when it broke [s].
(
    POINT_X, POINT_Y, ANCHOR_X, ANCHOR_Y, STIFFNESS, DAMPING, SLACK, STRENGTH, LENGTH, MOST_FORCE,
    BROKE, STRAP,
) = range(12)  # fmt: skip
LOOSE, TAUT, RELAXED, BROKEN = range(4)  # what a strap does
# Contacts by their numbers: both corners on the support; four vertices (base right and left, top
# right and left) on each wall; both corners at a lip's face; the edge at the body's four sides.
ON_WALLS, AT_LIP = 2, 2 + 4 * MOST_WALLS
AT_SIDES = AT_LIP + 2
CONTACTS = AT_SIDES + 4
BASE, RIGHT_SIDE, TOP, LEFT_SIDE = range(4)
# Columns of a closed contact: its number; n; q; the shares a, b at rest and as it slips;
# restitution; what curvature adds to the accelerations along n and t; velocities along both.
(
    WHICH, N_X, N_Y, Q_X, Q_Y, A_STICK, B_STICK, A_SLIP, B_SLIP, E, BEND_N, BEND_T, U_N, U_T, TOUCH,
) = range(15)  # fmt: skip
MOST_TOUCHES = 12
# What a contact of a mode does: it sticks, or slips in the direction +1 or -1; where others hold
# the body with it, it bears without friction, or holds with its friction at the edge of its cone
# (times a direction).
STICK, BEARS, HOLDS = 0, 2, 3
# Columns of `Workspace.tally`: what a run writes down of itself.
(
    PEAK, LIFT, FARTHEST_LEFT, FARTHEST_RIGHT, IMPACTS, EVENTS, STEPS, USED, LEFT_AT, CLOCK, PASSED,
    GLUED, PAST, FALLBACKS, CHANGES, TALLY,
) = range(16)  # fmt: skip


class Scene(NamedTuple):
    """A body on its support, and its surroundings.

    Compiled code gets it as a record of the type `SCENE`.
    """

    h: float  # height of the centre of gravity over the base [m]
    right: float  # b_R [m]
    left: float  # b_L
    over: float  # height of the body over its centre of gravity [m]
    i2: float  # i² [m²]
    tilt_sine: float
    tilt_cosine: float
    a_stick: float  # friction of the support, at rest
    b_stick: float
    a_slip: float  # and of a contact that slips
    b_slip: float
    restitution: float  # e_n
    factor: float  # multiplies the angular velocity that a rocking impact leaves
    edge: float  # side of the edge of the support, +1 or -1; 0 without
    edge_at: float  # its distance from the origin [m]
    lip: float  # height of its lip [m]
    edge_a: float  # friction of the edge
    edge_b: float
    edge_e: float  # restitution at it
    drop: float  # what lies below it [m]
    glue: float  # pull-off strength of each foot by the mass [m/s²]; 0 without pads
    mass: float  # kg, NaN where nothing asks for it; what has newtons is divided by it
    walls: int
    straps: int
    wall: Floats  # (MOST_WALLS, WALL)
    strap: Floats  # (MOST_STRAPS, STRAP)


class Workspace(NamedTuple):
    """What one run works in; compiled code gets it as a record of the type `WORKSPACE`."""

    state: Floats  # (STATE,)
    trial: Floats  # (STATE,): the end of a step on trial
    stages: Floats  # (7, STATE): rates
    touch: Floats  # (MOST_TOUCHES, TOUCH): the closed contacts
    goal: Floats  # (MOST_TOUCHES,): least velocity, or acceleration, along n afterwards
    free: Floats  # (3,): velocities or accelerations without reaction
    after: Floats  # (3,): with it
    system: Floats  # (3, 4)
    rows: Floats  # (3, 4): directions of contacts, and what is missed along them
    entries: Integers  # (3, 2): place of a touch and what it does, of the subset on trial
    mode: Integers  # (4, 2): how many contacts the mode has; then their numbers, what they do
    ended: Integers  # (4, 2): the mode that a guard has ended
    force: Floats  # (3,): of the subset on trial, in the order of its unknowns [m/s²]
    reaction: Floats  # (3,): of the mode
    anchor: Floats  # (1,): where a contact that sticks is along its tangent [m]
    behind: Integers  # (CONTACTS,): 1 if the body is on the other side of a surface
    held: Integers  # (MOST_STRAPS,): what each strap does
    strap: Floats  # (MOST_STRAPS, STRAP)
    pull: Floats  # (3,): force and moment of all straps by the mass
    kept: Floats  # (STATE,): a state before something is tried
    tally: Floats  # (TALLY,)


def _record(kind: Any, shapes: dict[str, tuple[int, ...]], integers: set[str]) -> np.dtype[Any]:
    return np.dtype(
        [
            (name, np.int64 if name in integers else np.float64, shapes.get(name, ()))
            for name in kind._fields
        ]
    )


SCENE = _record(
    Scene,
    {"wall": (MOST_WALLS, WALL), "strap": (MOST_STRAPS, STRAP)},
    {"walls", "straps"},
)
WORKSPACE = _record(
    Workspace,
    {
        "state": (STATE,),
        "trial": (STATE,),
        "stages": (7, STATE),
        "touch": (MOST_TOUCHES, TOUCH),
        "goal": (MOST_TOUCHES,),
        "free": (3,),
        "after": (3,),
        "system": (3, 4),
        "rows": (3, 4),
        "entries": (3, 2),
        "mode": (4, 2),
        "ended": (4, 2),
        "force": (3,),
        "reaction": (3,),
        "anchor": (1,),
        "behind": (CONTACTS,),
        "held": (MOST_STRAPS,),
        "strap": (MOST_STRAPS, STRAP),
        "pull": (3,),
        "kept": (STATE,),
        "tally": (TALLY,),
    },
    {"entries", "mode", "ended", "behind", "held"},
)
#: An array of records: how Python code passes scenes and the workspace.
Scenes = NDArray[np.void]


def make_workspace() -> NDArray[np.void]:
    """Workspace for one run."""
    return np.zeros(1, WORKSPACE).view(np.recarray)  # plain Python takes names of a record, too


def no_scenes(count: int) -> Scenes:
    """Scenes to be filled in: nothing surrounds anything."""
    return np.zeros(count, SCENE).view(np.recarray)
