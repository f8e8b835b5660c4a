"""What to change in a room first: every single change tried, and the best pair.

Things do not touch each other, so that a change of one leaves the others as they were under the
same motions: pairs are put together from the runs of single changes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from shaketable.assess import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.assess.shares import Share, share_of
from shaketable.errors import InputError
from shaketable.language import tell
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.rooms.changes import Change, changes_of
from shaketable.rooms.frictions import (
    WithFriction,
    leading,
    with_most_harm,
    with_other_frictions,
)
from shaketable.rooms.grid import CELL
from shaketable.rooms.grounds import Ground, ground_of
from shaketable.rooms.judged import Judge
from shaketable.rooms.prepared import Prepared, prepare
from shaketable.rooms.results import RoomAssessment
from shaketable.rooms.room import Room
from shaketable.rooms.shaken import shake
from shaketable.tilting import TURNS

PAIRED = 10  # so many of the best single changes are tried in pairs


@dataclass(frozen=True)
class Harm:
    """What shaking does to people of a room.

    Attributes:
        people: how many are hit or shut in, on an average over all runs; of a bed or desk without
            a number of people one.
        hit: the share of runs in which something falls on a place.
        shut_in: the share of runs in which somebody finds no way out.
        any: the share of runs in which either happens to anybody.
    """

    people: float
    hit: Share
    shut_in: Share
    any: Share


@dataclass(frozen=True, eq=False)
class Tried:
    """One or two changes, and what they leave.

    Attributes:
        changes: what is done.
        left: the harm then.
        saves: how many people fewer are hit or shut in.
    """

    changes: tuple[Change, ...]
    left: Harm
    saves: float


@dataclass(frozen=True, eq=False)
class RoomDesign:
    """What could be changed in a room.

    Attributes:
        as_it_is: what becomes of the room as it is.
        now: the harm then.
        singles: every single change, the one that saves most first.
        pairs: of two things, from the best single ones, likewise.
        recordings: independent ones.
        runs: of each change.
        friction: with which changes were tried: of those that were, the one with which most people
            are harmed in the room as it is.
    """

    as_it_is: RoomAssessment
    now: Harm
    singles: tuple[Tried, ...]
    pairs: tuple[Tried, ...]
    recordings: int
    runs: int
    friction: float


def design_room(
    room: Room,
    motions: Sequence[Motion] | None = None,
    *,
    scale: float = 1.0,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    frictions: Sequence[float] = FRICTIONS,
    turns: int = TURNS,
    cell: float = CELL,
    progress: Progress = True,
) -> RoomDesign:
    """Try every single change of a room, and pairs of the best.

    Things are strapped or tethered to the walls of the plan, their castors locked, put on pads,
    made lower, turned, and moved by half a metre where the plan allows it.

    Args:
        room, motions, scale, model, castors, turns, cell, progress: as for `assess_room`.
        frictions: others that are tried in the room as it is.

    Raises:
        InputError: as `assess_room`; a room without places, where nobody is harmed.
    """
    require_places(room)
    prepared = prepare(
        room, motions, scale=scale, model=model, castors=castors, turns=turns, cell=cell,
        progress=progress,
    )  # fmt: skip
    return designed(with_other_frictions(prepared, frictions, progress), progress)


def require_places(room: Room) -> None:
    """InputError for a room where nobody is."""
    if not room.places:
        raise InputError(
            tell("{room} has no places, so that nothing there harms anybody", room=repr(room.name))
        )


def designed(shaken: Sequence[WithFriction], progress: Progress) -> RoomDesign:
    """What could be changed in a room that has been shaken; `shaken` as for `leading`."""
    prepared = with_most_harm(shaken, lambda each: _harm_in(each, each.grounds).people, progress)
    room, space, judge = prepared.room, prepared.space, prepared.judge
    changes = changes_of(room, prepared.shaken, space)
    runs = prepared.runs
    with meter("simulations", runs * max(len(changes), 1), progress) as done:
        fates = shake(
            room, [(each.after, each.stood) for each in changes], space, prepared.ways, done
        )
    after = [
        ground_of(room, prepared.grid, each.after, fate)
        for each, fate in zip(changes, fates, strict=True)
    ]
    now = _harm_in(prepared, prepared.grounds)

    def tried(some: Sequence[int]) -> Tried:
        grounds: list[Ground] = list(prepared.grounds)
        for k in some:
            grounds[changes[k].number] = after[k]
        left = _harm_in(prepared, grounds)
        for k in some:
            judge.forget(after[k])
        return Tried(tuple(changes[k] for k in some), left, now.people - left.people)

    singles = {k: tried([k]) for k in range(len(changes))}
    order = sorted(singles, key=lambda k: -singles[k].saves)
    best = [k for k in order if singles[k].saves > 0.0][:PAIRED]
    pairs = [
        tried(pair)
        for pair in combinations(best, 2)
        if changes[pair[0]].number != changes[pair[1]].number
    ]
    return RoomDesign(
        leading(shaken),
        now,
        tuple(singles[k] for k in order),
        tuple(sorted(pairs, key=lambda each: -each.saves)),
        space.recordings,
        runs,
        prepared.friction,
    )


def _harm_in(prepared: Prepared, grounds: Sequence[Ground]) -> Harm:
    """Who is hit or shut in, in the same run or in another."""
    judge, recordings = prepared.judge, prepared.space.recordings
    judged = judge.judged(grounds, blame=False)
    hit = np.asarray(judged.hit.any(axis=1))  # (place, run)
    shut = np.zeros(hit.shape, np.bool_)
    closed = np.asarray(judged.closed.all(axis=1))
    people = 0.0
    for row, place in enumerate(judge.room.places):
        if place.name in judge.ways.names:
            shut[row] = closed[judge.ways.names.index(place.name)]
        there = place.people or (1.0 if place.kind.stands and not _told(judge) else 0.0)
        people += there * float((hit[row] | shut[row]).mean())
    anywhere = [np.asarray(each.any(axis=0)) for each in (hit, shut, hit | shut)]
    return Harm(people, *(share_of(each, recordings) for each in anywhere))


def _told(judge: Judge) -> bool:
    """Whether the room tells how many people are anywhere."""
    return any(place.people for place in judge.room.places)
