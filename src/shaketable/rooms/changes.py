"""What could be changed in a room: each thing held, lowered, turned or moved, one at a time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from shaketable.assess.mitigation.trials import TRIALS, Asked
from shaketable.assess.results import MitigationKind
from shaketable.assess.solid_runs import Stood
from shaketable.assess.solids import ShakingInSpace
from shaketable.inventory import BaseShape
from shaketable.rooms.faults import faults_of
from shaketable.rooms.room import Room, Thing
from shaketable.rooms.shaken import stands

STEP = 0.5  # m: by how much things are moved
#: What holds a thing, or makes it steadier, where it stands.
HOLDS = (
    MitigationKind.STRAP,
    MitigationKind.TETHER,
    MitigationKind.LOCK,
    MitigationKind.PAD,
    MitigationKind.LOWER,
)
MOVES = {"left": (-STEP, 0.0), "right": (STEP, 0.0), "up": (0.0, STEP), "down": (0.0, -STEP)}
QUARTERS = (90.0, -90.0, 180.0)


@dataclass(frozen=True, eq=False)
class Change:
    """One thing of a room, changed.

    Attributes:
        thing: its name.
        does: what is done, in words.
        number: of the thing among those that are shaken.
        after: the thing then.
        stood: how it stands then.
    """

    thing: str
    does: str
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
                yield Change(thing.name, _told(kind, trial.about), number, thing, trial.stood)
                break


def _told(kind: MitigationKind, about: Mapping[str, float]) -> str:
    if kind in (MitigationKind.STRAP, MitigationKind.TETHER):
        name = "strap it" if kind is MitigationKind.STRAP else "tether it"
        slack = 1000 * about["slack_m"]
        gap = about["wall_gap_m"]
        end = "a point beside it" if math.isnan(gap) else f"the wall {gap:.2f} m away"
        return f"{name} at {about['height_m']:.2f} m to {end}, with at most {slack:.0f} mm of slack"
    if kind is MitigationKind.LOCK:
        return f"lock its castors (friction {about['friction']:g})"
    if kind is MitigationKind.PAD:
        return f"put adhesive pads below it, each holding {about['holds_weights']:g} of its weight"
    return f"put heavy things low: its centre of gravity at {about['cg_height_m']:.2f} m"


def _placed(room: Room, number: int, thing: Thing, space: ShakingInSpace) -> Iterator[Change]:
    """Turned about its middle, or moved by half a metre, where the plan allows it."""
    facing = thing.item.facing or 0.0
    tried = []
    for degrees in QUARTERS if not _is_round(thing) else ():
        item = replace(thing.item, facing=facing + math.radians(degrees))
        way = "around" if abs(degrees) == 180.0 else f"by {abs(degrees):g}°"
        side = "" if abs(degrees) == 180.0 else " clockwise" if degrees > 0 else " anticlockwise"
        tried.append((f"turn it {way}{side}", replace(thing, item=item)))
    for name, (x, y) in MOVES.items():
        at = (thing.at[0] + x, thing.at[1] + y)
        tried.append((f"move it by {STEP:g} m ({name} on the plan)", replace(thing, at=at)))
    for does, after in tried:
        things = tuple(after if each is thing else each for each in room.things)
        if not faults_of(replace(room, things=things)):
            yield Change(thing.name, does, number, after, stands(room, after, space))


def _is_round(thing: Thing) -> bool:
    return thing.item.shape is BaseShape.CYLINDER
