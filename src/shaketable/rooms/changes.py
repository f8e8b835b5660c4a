"""What could be changed in a room: each thing held, lowered, turned or moved, one at a time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from shaketable.assess.mitigation.trials import TRIALS, Asked
from shaketable.assess.results import MitigationKind
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.stood import Stood
from shaketable.inventory import BaseShape
from shaketable.rooms.faults import faults_of
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shaken import stands
from shaketable.units import radians

STEP = 0.5  # m: by how much things are moved
#: What holds a thing, or makes it steadier, where it stands.
HOLDS = (
    MitigationKind.STRAP,
    MitigationKind.TETHER,
    MitigationKind.LOCK,
    MitigationKind.PAD,
    MitigationKind.LOWER,
)
MOVES = ((-STEP, 0.0), (STEP, 0.0), (0.0, STEP), (0.0, -STEP))
QUARTERS = (90.0, -90.0, 180.0)  # clockwise


class Placed(StrEnum):
    """Where else a thing may stand in its room."""

    TURN = "turn"  # about its middle
    MOVE = "move"


@dataclass(frozen=True, eq=False)
class Change:
    """One thing of a room, changed.

    Attributes:
        thing: its name.
        kind: what is done.
        about: its numbers: of what holds it as in `Mitigation`; clockwise_deg of a turn; x_m and
            y_m of a move.
        number: of the thing among those that are shaken.
        after: the thing then.
        stood: how it stands then.
    """

    thing: str
    kind: MitigationKind | Placed
    about: Mapping[str, float]
    number: int
    after: Thing
    stood: Stood


def changes_of(room: Room, things: tuple[Thing, ...], space: ShakingInSpace) -> list[Change]:
    """Every single change of the things of a room that leaves a plan without faults.

    Args:
        room: as it is.
        things: that are shaken.
        space: how.
    """
    return [
        change
        for number, thing in enumerate(things)
        for change in (*_held(room, number, thing, space), *_placed(room, number, thing, space))
    ]


def _held(room: Room, number: int, thing: Thing, space: ShakingInSpace) -> Iterator[Change]:
    """By what holds it where it is; straps go to the walls of the plan, or to where it stands."""
    stood = stands(room, thing, space)
    walls = stood.around.walls if stood.around else ()
    for kind in HOLDS:
        if kind is MitigationKind.LOWER and _is_round(thing):
            continue  # a cylinder of gas has no shelves
        for trial in TRIALS[kind](Asked(stood, space)):
            its = trial.stood.around.walls if trial.stood.around else ()
            if its == walls:
                yield Change(thing.name, kind, trial.about, number, thing, trial.stood)
                break


def _placed(room: Room, number: int, thing: Thing, space: ShakingInSpace) -> Iterator[Change]:
    """Turned about its middle, or moved by half a metre, where the plan allows it."""
    facing = thing.item.facing or 0.0
    tried: list[tuple[Placed, dict[str, float], Thing]] = []
    for degrees in QUARTERS if not _is_round(thing) else ():
        item = replace(thing.item, facing=facing + radians(degrees))
        tried.append((Placed.TURN, {"clockwise_deg": degrees}, replace(thing, item=item)))
    for x, y in MOVES:
        at = (thing.at[0] + x, thing.at[1] + y)
        tried.append((Placed.MOVE, {"x_m": x, "y_m": y}, replace(thing, at=at)))
    for kind, about, after in tried:
        things = tuple(after if each is thing else each for each in room.things)
        if not faults_of(replace(room, things=things)):
            yield Change(thing.name, kind, about, number, after, stands(room, after, space))


def _is_round(thing: Thing) -> bool:
    return thing.item.shape is BaseShape.CYLINDER
