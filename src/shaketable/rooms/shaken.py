"""All things of a room under the same motions, each with the walls that it may touch.

Each run has one motion, one polarity and one direction of the motion in the plan: it shakes all
things together, so that what happens to two of them in one run happens at once. Things do not touch
each other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.solid_runs import run_solids
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.stood import Stood, Ways
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.progress import Done
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shapes import own_angle, walls_near
from shaketable.surroundings import Surroundings, Wall
from shaketable.tilting import TURNS

RESTITUTION = 0.3  # of a wall, as for an inventory
GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0  # of a step between two directions, from motion to motion
MOST_WALLS = 4  # that a body may touch


@dataclass(frozen=True, eq=False)
class Fate:
    """What becomes of a thing in each run, in the plan.

    Attributes:
        fell: whether it fell.
        held_up: whether it did not fall, and would without its walls and straps.
        toward: direction in which it fell, from +x toward +y [rad]; NaN where it did not.
        shift: how far its foot came, (run, 2) [m].
        yaw: by how much it is turned, from +x toward +y [rad].
    """

    fell: NDArray[np.bool_]
    held_up: NDArray[np.bool_]
    toward: NDArray[np.float64]
    shift: NDArray[np.float64]
    yaw: NDArray[np.float64]


def directions(motions: Sequence[Motion], room: Room, turns: int = TURNS) -> NDArray[np.float64]:
    """Directions of the motions' first components in the plan [rad], (motion, turn).

    One, where north is known and each motion's azimuth. Otherwise some over half a turn, of which
    the other half is the reversed motion: those of one motion lie between those of the others, so
    that all directions of the plan are met alike, also where each motion has only one.

    Args:
        motions: with both components.
        room: that they shake.
        turns: how many where the direction is not known.
    """
    azimuths = [motion.origin.azimuth if motion.origin else None for motion in motions]
    if room.north is not None and None not in azimuths:
        along = np.radians(np.array(azimuths, np.float64))
        return np.asarray(math.pi / 2 - along - room.north)[:, None]
    step = math.pi / turns
    first = step * np.remainder(GOLDEN * np.arange(len(motions)), 1.0)
    return np.asarray(first[:, None] + step * np.arange(turns))


def ways_of(along: NDArray[np.float64]) -> Ways:
    """How +x of the plan meets each motion, as it was recorded and reversed.

    Args:
        along: directions of the motions' first components in the plan, as of `directions`.
    """
    return np.repeat(-along[:, None, :], 2, axis=1)


def stands(room: Room, thing: Thing, space: ShakingInSpace) -> Stood:
    """How a thing stands, beside the walls of its room; its base is known."""
    stood = space.stood(at_walls(room, thing))
    assert stood is not None
    return stood


def shake(
    room: Room,
    things: Sequence[tuple[Thing, Stood]],
    space: ShakingInSpace,
    ways: Ways,
    done: Done,
) -> list[Fate]:
    """What becomes of some things of a room.

    Args:
        room: where they are.
        things: on its floor, each with how it stands.
        space: motions with both components, and the model.
        ways: by how much +x of the plan is turned to each motion, as of `ways_of`.
        done: is told how many more simulations were made.
    """
    own = [np.remainder(own_angle(thing, room) + ways, 2 * math.pi) for thing, _ in things]
    found = []
    runs = run_solids([stood for _, stood in things], own, space.trial, done)
    for (thing, _), its in zip(things, runs, strict=True):
        angle = own_angle(thing, room)
        x, y = its.along.ravel(), its.across.ravel()
        found.append(
            Fate(
                fell=its.fell.ravel(),
                held_up=its.held_up.ravel(),
                toward=its.toward.ravel() + angle,
                shift=np.column_stack(
                    [x * math.cos(angle) - y * math.sin(angle),
                     x * math.sin(angle) + y * math.cos(angle)]
                ),
                yaw=its.turned.ravel(),
            )
        )  # fmt: skip
    return found


def at_walls(room: Room, thing: Thing) -> Item:
    """A thing with the walls of its room that it may touch when it falls; doors are closed."""
    item, walls = thing.item, []
    for gap, out in walls_near(room, thing)[:MOST_WALLS]:
        azimuth = math.remainder(math.atan2(out[1], out[0]) - own_angle(thing, room), 2 * math.pi)
        walls.append(Wall(azimuth=azimuth, gap=gap, restitution=RESTITUTION))
    if not walls:
        return item
    around = item.surroundings or Surroundings()
    return replace(item, surroundings=replace(around, walls=tuple(walls)))
