"""A room under one motion: where each of its things is at each time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.assess import CastorFriction
from shaketable.assess.floor import model_in_space
from shaketable.assess.solids import ShakingInSpace
from shaketable.errors import InputError
from shaketable.models import Model, model_of, with_friction
from shaketable.motion import Motion
from shaketable.rooms.prepared import is_simulated, require_sound
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shaken import directions, stands
from shaketable.rooms.shapes import Points, foot_of, own_angle, turned
from shaketable.simulate import ShakingSet, simulate
from shaketable.solid_response import SolidResponse


@dataclass(frozen=True, eq=False)
class ThingShaken:
    """A thing under one motion.

    Attributes:
        thing: of the room.
        response: in the frame of the motion, whose x is along its first component.
        foot: of its centre of gravity before it is shaken, in the plan [m], (2,).
        along: direction of the motion's first component in the plan [rad].
    """

    thing: Thing
    response: SolidResponse
    foot: Points
    along: float

    def poses(self, time: NDArray[np.float64]) -> tuple[Points, NDArray[np.float64]]:
        """Where it is at some times, after the end of the response as at it.

        Args:
            time: [s], (n,).

        Returns:
            Its centre of gravity in the plan and above the floor [m], (n, 3), and its own frame to
            that of the plan as quaternions, scalar last, (n, 4).
        """
        from scipy.spatial.transform import Rotation, Slerp

        run = self.response
        at = np.clip(time, run.time[0], run.time[-1])
        position = np.column_stack([np.interp(at, run.time, each) for each in run.position.T])
        own = Slerp(run.time, Rotation.from_quat(run.quaternions))(at)
        level = turned(position[:, :2], self.along) + self.foot
        in_plan = Rotation.from_rotvec([0.0, 0.0, self.along]) * own
        return np.column_stack([level, position[:, 2]]), np.asarray(in_plan.as_quat())


@dataclass(frozen=True, eq=False)
class RoomShaken:
    """A room under one motion.

    Attributes:
        room: that was shaken.
        motion: as it was scaled.
        along: direction of its first component in the plan [rad].
        things: that were shaken.
    """

    room: Room
    motion: Motion
    along: float
    things: tuple[ThingShaken, ...]


def shake_once(
    room: Room,
    motion: Motion,
    *,
    along: float | None = None,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    friction: float | None = None,
    each: Callable[[], None] = lambda: None,
) -> RoomShaken:
    """Shake a room once, to look at it.

    Args:
        room: such as `read_room(path)` gives.
        motion: with both components, scaled.
        along: direction of its first component in the plan [rad]; if None as north and its azimuth
            say, and where these are not known +x.
        model, castors: as for `assess_room`.
        friction: of what stands on feet or on locked castors, in place of theirs.
        each: is called before each thing is shaken.

    Raises:
        InputError: a plan with faults; the motion has no second component.
    """
    if motion.transverse is None:
        raise InputError(f"{motion.name}: rooms are shaken by both horizontal components")
    require_sound(room)
    general, castors = model_in_space(model_of(model)), castors or CastorFriction()
    if friction is not None:
        general = with_friction(general, friction)
        castors = replace(castors, locked=castors.locked if math.isinf(friction) else friction)
    space = ShakingInSpace(ShakingSet([motion], 1.0, general), 0.0, castors)
    if along is None:
        along = float(directions([motion], room, 1)[0, 0])
    things = []
    for thing in room.things:
        if not is_simulated(thing):
            continue
        each()
        stood = stands(room, thing, space)
        turn = math.remainder(own_angle(thing, room) - along, 2 * math.pi)
        own = general if stood.friction is None else with_friction(general, stood.friction)
        around = stood.around.turned(turn) if stood.around else None
        run = simulate(stood.solid, motion, model=own, orientation=turn, surroundings=around)
        things.append(ThingShaken(thing, run, foot_of(thing, room), along))
    return RoomShaken(room, motion, along, tuple(things))
