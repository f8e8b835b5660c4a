"""Measures tried on some objects: what each leaves of their falls."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from shaketable.assess.item_result import ItemResult
from shaketable.assess.mitigation import larger_base
from shaketable.assess.mitigation.premises import Premises
from shaketable.assess.mitigation.trials import TRIALS, Asked
from shaketable.assess.mitigation.tried import COSTS, Tried, try_once, try_wholly
from shaketable.assess.plane import Plane, curves_among, with_bases
from shaketable.assess.profiles import profiles_of
from shaketable.assess.results import ACCEPTED_FALLS, Mitigation, MitigationKind
from shaketable.assess.runs import Done, uncounted
from shaketable.assess.solids import ShakingInSpace
from shaketable.assess.straps import SLACKS, STIFFNESSES

MOST_TRIED = 4  # measures for each object, unless more is asked for


class Shaken(NamedTuple):
    """How the objects of a building are shaken.

    Attributes:
        floors: in a plane, and in three dimensions, of each floor of which both are known.
        lowest: the floor to which an object may be moved: its motions are those of the same
            earthquakes; "" if there is none.
    """

    floors: Mapping[str, tuple[Plane, ShakingInSpace]]
    lowest: str = ""

    def asked(self, floor: str, result: ItemResult, wholly: bool) -> Asked:
        """What is to be done about an object."""
        space = self.floors[floor][1]
        stood = space.stood(result.item)
        assert stood is not None
        moves = bool(self.lowest) and floor != self.lowest
        return Asked(stood, space, wholly, moves, result)


def kinds_for(
    asked: Asked, premises: Premises, kinds: Sequence[MitigationKind]
) -> list[MitigationKind]:
    """The kinds of measures that are tried on an object: those that make sense of it.

    Args:
        asked: the object.
        premises: where it stands.
        kinds: those that are asked for; none for the first MOST_TRIED.
    """
    item = asked.item
    ordered = premises.rolling if item.rolls else premises.standing
    rest = [kind for kind in MitigationKind if kind not in ordered]
    # what must not fall is not tilted to choose where it falls
    left_out = [MitigationKind.TILT] if item.must_not_fall else []
    wanted = [kind for kind in (*ordered, *rest) if kind not in left_out]
    fits = [kind for kind in wanted if (not kinds or kind in kinds) and _fits(kind, asked)]
    return fits if kinds else fits[:MOST_TRIED]


def work_of(kind: MitigationKind, wholly: bool) -> int:
    """How long a kind of measure takes for an object, in times of one simulation in all ways."""
    variants = len(STIFFNESSES) * len(SLACKS) if wholly else 1
    times = {
        MitigationKind.BASE: larger_base.ROUNDS,
        MitigationKind.STRAP: 2 * variants,
        MitigationKind.TETHER: variants,
        MitigationKind.LOCK: 3,
    }
    return times.get(kind, 1) * COSTS.get(kind, 1)


def with_mitigation(
    asked: Sequence[tuple[str, Asked]],
    kinds: Sequence[Sequence[MitigationKind]],
    shaken: Shaken,
    done: Done,
) -> list[ItemResult]:
    """Results with what becomes of each object after its measures.

    Args:
        asked: objects, each with the floor on which it stands.
        kinds: of measures, for each.
        shaken: how.
        done: is told how much more was done, as `work_of` counts.
    """
    results, proposed = [], []
    for (floor, each), some in zip(asked, kinds, strict=True):
        assert each.result is not None
        results.append(_with_proposals(each.result, some, shaken.floors[floor][0]))
        proposed.append(each._replace(result=results[-1]))
    lowest = shaken.floors[shaken.lowest][1] if shaken.lowest else None
    trials = [
        (k, trial)
        for k, (each, some) in enumerate(zip(proposed, kinds, strict=True))
        for kind in some
        if kind in TRIALS
        for trial in TRIALS[kind](each)
    ]
    found: list[list[Tried]] = [[] for _ in proposed]
    for (k, _), one in zip(trials, try_once(trials, proposed, lowest, done), strict=True):
        found[k] += [one] if one else []
    for k, base in _bases(proposed, kinds, done).items():
        found[k].append(base)
    return _confirmed(results, found, done)


def _confirmed(
    results: Sequence[ItemResult], found: Sequence[Sequence[Tried]], done: Done
) -> list[ItemResult]:
    """Results with their measures, of which what comes first is simulated in half of the ways."""
    while True:
        told = [
            replace(result, mitigations=tuple(each.told for each in some))
            for result, some in zip(results, found, strict=True)
        ]
        first = [
            {n for n, each in enumerate(some) if each.told is _first(one) and not each.whole}
            for one, some in zip(told, found, strict=True)
        ]
        if not any(first):
            return told
        more = iter(try_wholly([found[k][n] for k, some in enumerate(first) for n in some], done))
        found = [
            [next(more) if n in some else each for n, each in enumerate(tried)]
            for tried, some in zip(found, first, strict=True)
        ]


def _first(result: ItemResult) -> Mitigation | None:
    """The measure that is recommended first."""
    return result.helpful[0] if result.helpful else None


def _fits(kind: MitigationKind, asked: Asked) -> bool:
    """Whether there is something to simulate for a kind of measure."""
    if kind is MitigationKind.BASE:
        return larger_base.begin(asked) is not None
    return bool(TRIALS[kind](asked))


def _with_proposals(
    result: ItemResult, kinds: Sequence[MitigationKind], plane: Plane
) -> ItemResult:
    """The result with what a plane proposes for the measures that ask for it."""
    if MitigationKind.BASE in kinds:
        (result,) = with_bases([result], plane, uncounted)
    if MitigationKind.TILT in kinds:
        front = profiles_of(result.item, plane.tilt)[0]  # a tilt is front to back
        (curves,) = curves_among([front], plane, uncounted)
        result = replace(result, curves=curves)
    return result


def _does(base: Tried) -> bool:
    """Whether few enough fall on a base."""
    return base.told.left.value <= ACCEPTED_FALLS


def _bases(
    asked: Sequence[Asked], kinds: Sequence[Sequence[MitigationKind]], done: Done
) -> dict[int, Tried]:
    """The smallest base that was found to do for each object, or the largest that was tried."""
    searches = {
        k: search
        for k, (each, some) in enumerate(zip(asked, kinds, strict=True))
        if MitigationKind.BASE in some and (search := larger_base.begin(each)) is not None
    }
    best: dict[int, Tried] = {}
    for _ in range(larger_base.ROUNDS):
        trials = [(k, search.trial()) for k, search in searches.items()]
        once = try_once(trials, asked, None, done)
        seem = [one for one in once if one and _does(one)]
        wholly = iter(try_wholly(seem, done))  # so that what is told to do does
        for (k, _), one in zip(trials, once, strict=True):
            if one is None:
                del searches[k]
                continue
            tried = next(wholly) if _does(one) else one
            search, enough = searches[k], _does(tried)
            if enough or math.isinf(search.does):
                best[k] = tried
            searches[k] = search.after(search.share, enough)
    return best
