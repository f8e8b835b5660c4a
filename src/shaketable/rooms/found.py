"""What becomes of a room with one friction, from its runs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.shares import share_of
from shaketable.rooms.prepared import Prepared
from shaketable.rooms.results import (
    PlaceResult,
    RoomAssessment,
    ThingResult,
    WayResult,
    WorstShaking,
)


def found_of(prepared: Prepared) -> RoomAssessment:
    """What becomes of a room that has been shaken with one friction."""
    judged = prepared.judge.judged(prepared.grounds)
    room, grid, grounds = prepared.room, prepared.grid, prepared.grounds
    names, recordings = [thing.name for thing in prepared.shaken], prepared.space.recordings
    judge, runs, friction = prepared.judge, prepared.runs, prepared.friction
    covered = np.zeros(grid.shape)
    for run in range(runs):
        lying = [ground.after[run] for ground in grounds if ground.fell[run]]
        if lying:
            covered.flat[np.unique(np.concatenate(lying))] += 1 / runs
    things = tuple(
        ThingResult(
            name, share_of(ground.fell, recordings), sides, lean,
            grid.area * sum(ground.after[run].size for run in np.flatnonzero(ground.fell)) / runs,
            friction, friction,
        )
        for name, ground, sides, lean in zip(
            names, grounds, prepared.sides, prepared.held_up, strict=True
        )
    )  # fmt: skip
    places = []
    for row, place in enumerate(room.places):
        hit = share_of(judged.hit[row].any(axis=0), recordings)
        by = _worst(names, judged.hit[row])
        places.append(PlaceResult(place, hit, by, place.people * hit.value, friction))
    before = judge.open_at_rest(grounds)
    exits = [room.doors[k].name for k in judge.ways.exits]
    ways = []
    for row, name in enumerate(judge.ways.names):
        for column, door in enumerate(exits):
            ways.append(
                WayResult(
                    name, door, share_of(judged.closed[row, column], recordings),
                    _worst(names, judged.by[row, column]), bool(before[row, column]), friction,
                )
            )  # fmt: skip
        if len(exits) > 1:
            shut = judged.closed[row].all(axis=0)
            by = _worst(names, judged.by[row].any(axis=0) & shut)
            open_before = bool(before[row].any())
            ways.append(WayResult(name, "", share_of(shut, recordings), by, open_before, friction))
    return RoomAssessment(
        room, grid, sum(each.hits for each in places), covered, things, tuple(places), tuple(ways),
        prepared.left_out, recordings, runs,
        tuple(motion.name for motion in prepared.space.trial.motions), _worst_run(prepared),
        friction,
    )  # fmt: skip


def _worst_run(prepared: Prepared) -> WorstShaking:
    falls = np.sum([ground.fell for ground in prepared.grounds], axis=0)
    run = int(falls.argmax())
    motion, polarity, turn = map(int, np.unravel_index(run, prepared.ways.shape))
    name = prepared.space.trial.motions[motion].name
    along = -float(prepared.ways[motion, polarity, turn])
    return WorstShaking(name, polarity == 1, along, int(falls[run]), prepared.friction)


def _worst(names: Sequence[str], happened: NDArray[np.bool_]) -> tuple[tuple[str, float], ...]:
    """Names and shares of what happens at all, (thing, run), the most frequent first."""
    shares = happened.mean(axis=1) if happened.size else np.zeros(len(names))
    order = sorted(range(len(names)), key=lambda k: -shares[k])
    return tuple((names[k], float(shares[k])) for k in order if not math.isclose(shares[k], 0.0))
