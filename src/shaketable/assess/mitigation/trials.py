"""Objects as they stand after a measure; each function gives what is to be simulated for one kind.

None of the numbers here is measured: they are of what is sold and done, and told with the result.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.item_result import ItemResult
from shaketable.assess.results import MitigationKind
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.stood import Stood
from shaketable.assess.straps import SLACKS, STIFFNESSES, asks_for_trial, in_strap
from shaketable.assess.walls import WALL_GAP, beside_a_wall
from shaketable.inventory import BaseShape, Castors, Item, solid_of
from shaketable.spelled_surroundings import AWAY
from shaketable.surroundings import Pad, Strap, Surroundings, Wall
from shaketable.units import STANDARD_GRAVITY, degrees, radians

#: The strap that is tried first: the stiffer and the slacker one, which mostly bears most.
STATED = (STIFFNESSES[-1], SLACKS[-1])
PAD_HOLDS = 0.25  # of the weight: what an adhesive foot holds against a pull, each of them
LOWERED = 0.75  # times the height of the centre of gravity: heavy things at the bottom
ABOVE = 1.1  # times that height: where a tether is fastened
USUAL_TILT = radians(2.0)  # toward a wall, where a plane proposes none


class Trial(NamedTuple):
    """An object after a measure.

    Attributes:
        about: numbers of the measure, as in `Mitigation`.
        stood: how it then stands.
        lowest: whether on the lowest floor of its building.
    """

    kind: MitigationKind
    about: Mapping[str, float]
    stood: Stood
    lowest: bool = False


class Asked(NamedTuple):
    """An object about which something is to be done.

    Attributes:
        stood: how it stands now.
        space: how it is shaken.
        wholly: whether every variant is tried, rather than the stiffer and slacker strap.
        moves: whether there is a lowest floor that it can be moved to.
        result: what becomes of it as it stands, with what a plane proposes; None if nothing is
            known of that.
    """

    stood: Stood
    space: ShakingInSpace
    wholly: bool = False
    moves: bool = False
    result: ItemResult | None = None

    @property
    def item(self) -> Item:
        """The object as it is now."""
        return self.stood.item


def _strapped(asked: Asked, kind: MitigationKind, height: float) -> list[Trial]:
    """In a strap at a height: as it stands, and pushed to a wall if it has none.

    What rolls without a wall would roll beyond the point to which it is fastened: for it that point
    is on a wall.
    """
    if not asks_for_trial(asked.stood.around):
        return []
    beside: list[Surroundings | None] = [asked.stood.around]
    if not _walls(asked.stood):
        if asked.item.rolls:
            beside = [beside_a_wall(asked.stood.around, AWAY)]
        else:
            beside.append(beside_a_wall(asked.stood.around))
    found = []
    variants = product(STIFFNESSES, SLACKS) if asked.wholly else [STATED]
    for (stiffness, slack), around in product(variants, beside):
        solid, held = in_strap(asked.stood.solid, around, stiffness, slack, height)
        gap = held.walls[0].gap if held.walls else math.nan
        about = {
            "stiffness_per_mass": stiffness, "slack_m": slack, "height_m": height, "wall_gap_m": gap
        }  # fmt: skip
        found.append(Trial(kind, about, asked.stood._replace(solid=solid, around=held)))
    return found


def strap(asked: Asked) -> list[Trial]:
    """From the middle of its top."""
    if asked.item.rolls:
        return []
    return _strapped(asked, MitigationKind.STRAP, asked.item.height)


def tether(asked: Asked) -> list[Trial]:
    """What stands on castors, from above its centre of gravity."""
    item = asked.item
    if not item.rolls:
        return []
    height = min(ABOVE * item.body.cg_height, item.height)
    return _strapped(asked, MitigationKind.TETHER, height)


def lock(asked: Asked) -> list[Trial]:
    """The castors, with the friction assumed for locked ones and with more."""
    item = asked.item
    if item.castors is not Castors.FREE:
        return []
    locked = replace(item, castors=Castors.LOCKED)
    least = asked.space.castors.locked
    solid = solid_of(locked, asked.space.castors.free)
    assert solid is not None
    return [
        Trial(
            MitigationKind.LOCK,
            {"friction": friction},
            asked.stood._replace(item=locked, solid=solid, friction=friction),
        )
        for friction in (least, *(each for each in FRICTIONS if each > least))
    ]


def pad(asked: Asked) -> list[Trial]:
    """Feet that hold down, under each of its corners."""
    stood = asked.stood
    around = stood.around or Surroundings()
    if asked.item.rolls or around.pad is not None:
        return []
    solid = replace(stood.solid, mass=1.0)
    straps = _of_one_kilogram(around.straps, stood.solid.mass or 1.0)
    pads = Pad(pull_off=PAD_HOLDS * STANDARD_GRAVITY)
    held = replace(around, pad=pads, straps=straps)
    about = {"holds_weights": PAD_HOLDS}
    return [Trial(MitigationKind.PAD, about, stood._replace(solid=solid, around=held))]


def lower(asked: Asked) -> list[Trial]:
    """Heavy things taken down: the centre of gravity lower, the base and the size as they are."""
    item = asked.item
    height = LOWERED * item.body.cg_height
    below = replace(
        item,
        body=replace(item.body, cg_height=height),
        sideways=item.sideways and replace(item.sideways, cg_height=height),
    )
    return [Trial(MitigationKind.LOWER, {"cg_height_m": height}, with_item(asked, below))]


def wall(asked: Asked) -> list[Trial]:
    """Pushed back to a wall."""
    item = asked.item
    if _walls(asked.stood) or item.rolls or item.shape is BaseShape.CYLINDER:
        return []
    around = beside_a_wall(asked.stood.around)
    return [
        Trial(MitigationKind.WALL, {"wall_gap_m": WALL_GAP}, asked.stood._replace(around=around))
    ]


def turn(asked: Asked) -> list[Trial]:
    """Turned by 90°, where it is known how it stands to the motions, and nothing is beside it."""
    item, stood = asked.item, asked.stood
    one_way = stood.turns(asked.space.trial.motions).shape[1] == 1
    if item.facing is None or stood.around or stood.solid.round or not one_way:
        return []
    about = {"turned_deg": 90.0}
    return [Trial(MitigationKind.TURN, about, stood._replace(turned=math.pi / 2))]


def move(asked: Asked) -> list[Trial]:
    """To the lowest floor of its building."""
    return [Trial(MitigationKind.MOVE, {}, asked.stood, lowest=True)] if asked.moves else []


def tilt(asked: Asked) -> list[Trial]:
    """Tilted toward a wall that catches it, by what sends most falls one way in a plane."""
    item, stood = asked.item, asked.stood
    if item.rolls or item.shape is BaseShape.CYLINDER or stood.tilt:
        return []
    curves = asked.result.curves if asked.result else None
    proposed = curves.control_tilt if curves else math.nan
    angle = proposed if 0.0 < proposed < math.inf else USUAL_TILT
    if angle >= 0.9 * math.atan2(item.body.right, item.body.cg_height):
        return []
    around = stood.around if _walls(stood) else beside_a_wall(stood.around)
    if around is None or any(each.azimuth != 0.0 for each in around.walls):
        return []  # its wall does not stand behind it
    about = {"tilt_deg": degrees(angle), "wall_gap_m": around.walls[0].gap}
    return [Trial(MitigationKind.TILT, about, stood._replace(tilt=-angle, around=around))]


#: Each kind but the base, which is searched for.
TRIALS: Mapping[MitigationKind, Callable[[Asked], Sequence[Trial]]] = {
    MitigationKind.STRAP: strap,
    MitigationKind.TETHER: tether,
    MitigationKind.LOCK: lock,
    MitigationKind.PAD: pad,
    MitigationKind.LOWER: lower,
    MitigationKind.WALL: wall,
    MitigationKind.TURN: turn,
    MitigationKind.MOVE: move,
    MitigationKind.TILT: tilt,
}


def with_item(asked: Asked, item: Item) -> Stood:
    """How an item that was changed stands in the place of the one that it was."""
    solid = solid_of(item, asked.space.castors.free)
    assert solid is not None
    return asked.stood._replace(item=item, solid=solid)


def _of_one_kilogram(straps: Sequence[Strap], mass: float) -> tuple[Strap, ...]:
    """Straps of an object of some mass [kg], as if that were 1 kg."""
    names = ("stiffness", "damping", "pretension", "strength")
    return tuple(
        replace(each, **{name: getattr(each, name) / mass for name in names}) for each in straps
    )


def _walls(stood: Stood) -> Sequence[Wall]:
    return stood.around.walls if stood.around else ()
