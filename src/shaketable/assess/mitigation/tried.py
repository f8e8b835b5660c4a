"""Measures simulated: in one turn a motion, and what comes first in half of the ways."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from shaketable.assess.mitigation.trials import Asked, Trial
from shaketable.assess.results import Mitigation, MitigationKind
from shaketable.assess.runs import Done
from shaketable.assess.shares import share_of
from shaketable.assess.solid_runs import SolidRuns, require_possible, run_solids
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.stood import Ways, halves, in_turn
from shaketable.errors import InputError

#: How many times as long a simulation takes as one of an object that stands alone, about.
COSTS = {
    MitigationKind.STRAP: 9,
    MitigationKind.TETHER: 15,
    MitigationKind.LOCK: 2,
    MitigationKind.WALL: 5,
    MitigationKind.TILT: 5,
}


class Tried(NamedTuple):
    """A trial, and what became of the object.

    Attributes:
        space: how it was shaken.
        told: what is told of it.
        whole: whether in half of the ways, as what comes first is; the others in one turn a motion.
    """

    trial: Trial
    space: ShakingInSpace
    runs: SolidRuns
    told: Mitigation
    whole: bool


def try_once(
    trials: Sequence[tuple[int, Trial]],
    asked: Sequence[Asked],
    lowest: ShakingInSpace | None,
    done: Done,
) -> list[Tried | None]:
    """What each trial leaves, in one turn a motion; None of what cannot stand there."""
    shaken = [(trial, lowest if trial.lowest and lowest else asked[k].space) for k, trial in trials]
    fits = [n for n, (trial, space) in enumerate(shaken) if _is_possible(trial, space)]
    some = [shaken[n] for n in fits]
    runs = _run(some, [_ways(*each)[0] for each in some], done)
    found = {
        n: Tried(trial, space, each, _measure(trial, each, space.recordings), whole=False)
        for n, (trial, space), each in zip(fits, some, runs, strict=True)
    }
    return [found.get(n) for n in range(len(trials))]


def try_wholly(some: Sequence[Tried], done: Done) -> list[Tried]:
    """The same in what is left of half of the ways."""
    rest = [each for each in some for _ in _ways(each.trial, each.space)[1:]]
    ways = [more for each in some for more in _ways(each.trial, each.space)[1:]]
    runs = iter(_run([(each.trial, each.space) for each in rest], ways, done))
    found = []
    for each in some:
        whole = each.runs
        for _ in _ways(each.trial, each.space)[1:]:
            whole = whole.beside(next(runs))
        told = _measure(each.trial, whole, each.space.recordings)
        found.append(each._replace(runs=whole, told=told, whole=True))
    return found


def _ways(trial: Trial, space: ShakingInSpace) -> list[Ways]:
    """Half of the ways in which an object meets the motions, one turn for each motion by itself."""
    return in_turn(halves(trial.stood.ways(space.trial.motions))[0])


def _is_possible(trial: Trial, space: ShakingInSpace) -> bool:
    """Whether what a measure makes of an object can stand where it does."""
    try:
        require_possible(trial.stood, space.trial.motions)
    except InputError:
        return False
    return True


def _run(
    shaken: Sequence[tuple[Trial, ShakingInSpace]], ways: Sequence[Ways], done: Done
) -> list[SolidRuns]:
    """The runs of trials, each in some ways."""
    groups: dict[tuple[int, int], list[int]] = {}
    for n, (trial, space) in enumerate(shaken):
        groups.setdefault((id(space), COSTS.get(trial.kind, 1)), []).append(n)
    found: dict[int, SolidRuns] = {}
    for (_, cost), some in groups.items():
        stood = [shaken[n][0].stood for n in some]
        motions = shaken[some[0]][1].trial
        runs = run_solids(stood, [ways[n] for n in some], motions, _times(cost, done))
        found |= zip(some, runs, strict=True)
    return [found[n] for n in range(len(shaken))]


def _times(cost: int, done: Done) -> Callable[[int], None]:
    return lambda more: done(cost * more)


def _measure(trial: Trial, runs: SolidRuns, recordings: int) -> Mitigation:
    around, rolls = trial.stood.around, trial.stood.item.rolls
    pulls = trial.kind in (MitigationKind.STRAP, MitigationKind.TETHER)
    assert not pulls or (around is not None and around.straps)
    return Mitigation(
        kind=trial.kind,
        about=dict(trial.about),
        simulations=runs.fell.size,
        fall=share_of(runs.fell, recordings),
        held_up=share_of(runs.held_up, recordings),
        left=share_of(runs.lost(rolls), recordings),
        force=runs.strap_force if pulls else None,
    )
