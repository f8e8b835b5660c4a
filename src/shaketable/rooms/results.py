"""What becomes of a room that is shaken: of its things, its places and its ways out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.results import Sides
from shaketable.assess.shares import Share
from shaketable.rooms.grid import Grid
from shaketable.rooms.room import Place, Room, Thing


@dataclass(frozen=True)
class ThingResult:
    """How often an object of a room falls, to which side, and what it covers.

    Attributes:
        name: of it.
        falls: in how many of all runs.
        sides: to which of its own sides the falls go.
        held_up: in how many its walls and straps alone hold it up.
        covers: the ground that it covers when it has fallen, on an average over all runs [m²].
        friction: of what stands on its feet, with which its falls were found.
        friction_held_up: likewise, of being held up.
    """

    name: str
    falls: Share
    sides: Sides
    held_up: Share
    covers: float
    friction: float
    friction_held_up: float


@dataclass(frozen=True)
class PlaceResult:
    """How often something falls on a place of a room, and whom it hits.

    Attributes:
        place: of the room.
        hit: the share of runs in which something falls on it.
        by: what does, and in what share of all runs, the worst first.
        hits: how many people are hit, on an average over all runs, if they do not move away.
        friction: with which that was found.
    """

    place: Place
    hit: Share
    by: tuple[tuple[str, float], ...]
    hits: float
    friction: float

    @property
    def often(self) -> Share:
        """What is compared between frictions."""
        return self.hit


@dataclass(frozen=True)
class WayResult:
    """How often a way out of a room is closed, and by which objects.

    Attributes:
        place: where it begins.
        exit: the door to which it goes, "" for all of them at once.
        closed: the share of runs in which it is closed: of all doors, in which none is reached.
        by: what closes it alone, and in what share of all runs, the worst first.
        open_before: whether it is open before anything is shaken.
        friction: with which that was found.
    """

    place: str
    exit: str
    closed: Share
    by: tuple[tuple[str, float], ...]
    open_before: bool
    friction: float

    @property
    def often(self) -> Share:
        """What is compared between frictions."""
        return self.closed


@dataclass(frozen=True)
class WorstShaking:
    """The run in which most things fall; of several the first.

    Attributes:
        motion: its name.
        reversed: whether its signs were changed.
        along: direction of its first component in the plan [rad].
        falls: how many things fall.
        friction: of what stands on its feet.
    """

    motion: str
    reversed: bool
    along: float
    falls: int
    friction: float


@dataclass(frozen=True, eq=False)
class RoomAssessment:
    """A room under recorded motions.

    What is found of a thing, a place or a way is that with the room's own friction, or with
    another with which more happens, where either share lies outside the other's interval.

    Attributes:
        room: that was shaken.
        grid: its cells.
        hits: how many people are hit, on an average over all runs; with the friction with which
            most are.
        covered: the share of runs in which something that fell covers each cell, (y, x); of those
            frictions that lead anywhere the largest.
        things: of those that were simulated.
        places: of all places.
        ways: from each bed and desk to each exit, and to all of them.
        left_out: things that were drawn and not simulated.
        recordings: independent ones, from which intervals are.
        runs: in all: motions, polarities and directions.
        motions: their names.
        worst: run, to look at with `shake_once`.
        friction: the room's own, of things that stand on their feet; infinite where they cannot
            slide.
        tried: other frictions.
    """

    room: Room
    grid: Grid
    hits: float
    covered: NDArray[np.float64]
    things: tuple[ThingResult, ...]
    places: tuple[PlaceResult, ...]
    ways: tuple[WayResult, ...]
    left_out: tuple[Thing, ...]
    recordings: int
    runs: int
    motions: tuple[str, ...]
    worst: WorstShaking
    friction: float
    tried: tuple[float, ...] = ()

    @property
    def frictions(self) -> set[float]:
        """Those with which anything that is told of things, places and ways was found."""
        return {
            *(each.friction for each in self.things),
            *(each.friction_held_up for each in self.things),
            *(each.friction for each in self.places),
            *(each.friction for each in self.ways),
        }
