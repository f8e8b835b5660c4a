"""Whether things stand against a wall, where a list does not say it of each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from enum import StrEnum

from shaketable.errors import InputError, quoted
from shaketable.inventory import RESTITUTION, Item, solid_of
from shaketable.surroundings import Surroundings, Wall

WALL_GAP = 0.01  # m: between an object and a wall that it is pushed to, for its skirting board


class Walls(StrEnum):
    """The answer to whether most things of a list stand against a wall."""

    UNKNOWN = ""  # nobody was asked: they stand free, and what a wall does is told beside
    YES = "yes"
    NO = "no"
    EACH = "each"  # the list says it of each


def walls_of(given: Walls | str | None, items: Iterable[Item]) -> Walls:
    """The answer that a word means; EACH where it is left out and the list gives walls.

    Raises:
        InputError: another word, or EACH of a list that gives no walls.
    """
    told = any(item.surroundings and item.surroundings.walls for item in items)
    if not given:
        return Walls.EACH if told else Walls.UNKNOWN
    if given not in list(Walls):
        raise InputError(f"whether things stand against a wall is yes, no or each, found "
                         f"{quoted(str(given))}")  # fmt: skip
    if given == Walls.EACH and not told:
        raise InputError(
            "each: the list says of nothing how far it stands from a wall; give it a column "
            "wall_gap_mm, or answer yes or no"
        )
    return Walls(given)


def beside_a_wall(around: Surroundings | None, gap: float = WALL_GAP) -> Surroundings:
    """The same with a wall at the back [m]."""
    wall = Wall(azimuth=0.0, gap=gap, restitution=RESTITUTION)
    return replace(around or Surroundings(), walls=(wall,))


def may_stand_at_a_wall(item: Item) -> bool:
    """Whether a wall is put behind an item where most things stand against one."""
    around = item.surroundings
    open_ = around is None or not (around.walls or around.edge)
    stays = item.loose and not (item.rolls or item.stands_on)
    return open_ and stays and solid_of(item, 0.0) is not None


def at_their_walls(items: Iterable[Item], walls: Walls) -> list[Item]:
    """Items as they stand: with a wall behind each that may, if most have one."""
    return [
        replace(item, surroundings=beside_a_wall(item.surroundings))
        if walls is Walls.YES and may_stand_at_a_wall(item)
        else item
        for item in items
    ]
