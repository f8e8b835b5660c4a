"""Measures tried on the objects that come first: what each leaves of their falls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from shaketable.assess.item_result import ItemResult
from shaketable.assess.mitigation import larger_base
from shaketable.assess.mitigation.premises import Premises
from shaketable.assess.mitigation.trials import TRIALS, Asked, Trial
from shaketable.assess.plane import Plane, curves_among, with_bases
from shaketable.assess.results import ACCEPTED_FALLS, Mitigation, MitigationKind
from shaketable.assess.runs import Done
from shaketable.assess.shares import share_of
from shaketable.assess.solid_runs import SolidRuns, halves, run_solids
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.straps import SLACKS, STIFFNESSES

MOST_TRIED = 4  # measures for each of them

#: How the objects of a floor are shaken in a plane, and in three dimensions.
Shaken = Mapping[str, tuple[Plane, ShakingInSpace]]


def what_is_tried(
    result: ItemResult, premises: Premises, kinds: Sequence[MitigationKind], storeys: Sequence[str]
) -> list[MitigationKind]:
    """The kinds of measures that are tried on an object: those that make sense of it.

    Args:
        result: of the object.
        premises: where it stands.
        kinds: those that are asked for; none for the first MOST_TRIED.
        storeys: floors of its building from the lowest up; one where there is no building.
    """
    ordered = premises.rolling if result.item.rolls else premises.standing
    rest = [kind for kind in MitigationKind if kind not in ordered]
    fits = [kind for kind in (*ordered, *rest) if _fits(kind, result, storeys)]
    return [kind for kind in fits if kind in kinds] if kinds else fits[:MOST_TRIED]


def trials_of(kind: MitigationKind, wholly: bool) -> int:
    """How often an object is about to be simulated for a kind of measure."""
    if kind is MitigationKind.BASE:
        return larger_base.ROUNDS
    if kind is MitigationKind.STRAP:
        return 2 * (len(STIFFNESSES) * len(SLACKS) if wholly else 1)
    return 1


def with_mitigation(
    results: Sequence[tuple[str, ItemResult]],
    kinds: Sequence[Sequence[MitigationKind]],
    shaken: Shaken,
    wholly: bool,
    done: Done,
) -> list[ItemResult]:
    """Results with what becomes of each object after its measures.

    Args:
        results: each with the floor on which it stands.
        kinds: of measures, for each.
        shaken: by floor, the lowest first.
        wholly: whether every variant of a measure is tried.
        done: is told how many more simulations were made.
    """
    asked = []
    for (floor, result), some in zip(results, kinds, strict=True):
        plane, space = shaken[floor]
        stood = space.stood(result.item)
        assert stood is not None
        proposed = _proposals(result, some, plane, done)
        asked.append(Asked(proposed, stood, space, wholly))
    lowest = next(iter(shaken.values()))[1]
    trials = [
        (k, trial)
        for k, (each, some) in enumerate(zip(asked, kinds, strict=True))
        for kind in some
        if kind in TRIALS
        for trial in TRIALS[kind](each)
    ]
    found: list[list[Mitigation]] = [[] for _ in asked]
    for (k, _), measure in zip(trials, _tried(trials, asked, lowest, done), strict=True):
        found[k].append(measure)
    for k, base in _bases(asked, kinds, lowest, done).items():
        found[k].append(base)
    return [
        replace(each.result, mitigations=tuple(tried))
        for each, tried in zip(asked, found, strict=True)
    ]


def _fits(kind: MitigationKind, result: ItemResult, storeys: Sequence[str]) -> bool:
    """Whether a kind of measure makes sense of an object."""
    item = result.item
    around = item.surroundings
    walls = bool(around and around.walls)
    if kind in (MitigationKind.LOCK, MitigationKind.TETHER):
        return item.rolls and not (kind is MitigationKind.LOCK and item.castors == "locked")
    if kind is MitigationKind.MOVE:
        return bool(item.floor) and item.floor != storeys[0]
    if kind is MitigationKind.TURN:
        return item.facing is not None and not around and not item.rolls
    if item.rolls:
        return False
    if kind is MitigationKind.WALL:
        return not walls and item.shape != "cylinder"
    if kind is MitigationKind.TILT:
        return item.shape != "cylinder" and not item.must_not_fall
    if kind is MitigationKind.PAD:
        return not (around and around.pad)
    return True


def _proposals(
    result: ItemResult, kinds: Sequence[MitigationKind], plane: Plane, done: Done
) -> ItemResult:
    """The result with what a plane proposes for the measures that ask for it."""
    if MitigationKind.BASE in kinds:
        (result,) = with_bases([result], plane, done)
    if MitigationKind.TILT in kinds and not result.item.rolls:
        (curves,) = curves_among([result.profile], plane, done)
        result = replace(result, curves=curves)
    return result


def _bases(
    asked: Sequence[Asked],
    kinds: Sequence[Sequence[MitigationKind]],
    lowest: ShakingInSpace,
    done: Done,
) -> dict[int, Mitigation]:
    """The smallest base that was found to do for each object, or the largest that was tried."""
    searches = {
        k: search
        for k, (each, some) in enumerate(zip(asked, kinds, strict=True))
        if MitigationKind.BASE in some and (search := larger_base.begin(each)) is not None
    }
    best: dict[int, Mitigation] = {}
    for _ in range(larger_base.ROUNDS):
        trials = [(k, search.trial()) for k, search in searches.items()]
        for (k, _), measure in zip(trials, _tried(trials, asked, lowest, done), strict=True):
            enough = measure.left.value <= ACCEPTED_FALLS
            search = searches[k]
            if enough or search.does == float("inf"):
                best[k] = measure
            searches[k] = search.after(search.share, enough)
    return best


def _tried(
    trials: Sequence[tuple[int, Trial]],
    asked: Sequence[Asked],
    lowest: ShakingInSpace,
    done: Done,
) -> list[Mitigation]:
    """What each trial leaves, in half of the turns."""
    spaces = [lowest if trial.lowest else asked[k].space for k, trial in trials]
    found: dict[int, Mitigation] = {}
    for space in {id(each): each for each in spaces}.values():
        some = [n for n, each in enumerate(spaces) if each is space]
        stood = [trials[n][1].stood for n in some]
        ways = [halves(each.ways(space.trial.motions))[0] for each in stood]
        for n, runs in zip(some, run_solids(stood, ways, space.trial, done), strict=True):
            found[n] = _measure(trials[n][1], runs, space.recordings)
    return [found[n] for n in range(len(trials))]


def _measure(trial: Trial, runs: SolidRuns, recordings: int) -> Mitigation:
    around = trial.stood.around
    pulls = trial.kind in (MitigationKind.STRAP, MitigationKind.TETHER)
    assert not pulls or (around is not None and around.straps)
    return Mitigation(
        kind=trial.kind,
        about=dict(trial.about),
        simulations=runs.fell.size,
        fall=share_of(runs.fell, recordings),
        leans=share_of(runs.leans, recordings),
        left=share_of(runs.lost(trial.stood.item.rolls), recordings),
        force=runs.strap_force if pulls else None,
    )
