"""Which objects measures are tried on, and which measures: those that come first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from shaketable.assess.alike import alike
from shaketable.assess.assessment import FloorAssessment
from shaketable.assess.floor import Floor
from shaketable.assess.item_result import ItemResult
from shaketable.assess.mitigation import Premises, Shaken, kinds_for, with_mitigation, work_of
from shaketable.assess.ranking import Weights, ranked
from shaketable.assess.results import MitigationKind
from shaketable.language import tell
from shaketable.progress import AtMost, Progress, duration, meter
from shaketable.tilting import TURNS


def with_advice(
    floors: Sequence[FloorAssessment],
    shaken: Mapping[str, Floor],
    lowest: str,
    premises: Premises,
    weights: Weights,
    kinds: Sequence[MitigationKind],
    leading: int,
    seconds: float,
    progress: Progress,
) -> list[FloorAssessment]:
    """The floors with what measures leave of those that come first, each where it is worst.

    What is alike on the same floor shares what was found.

    Args:
        floors: without.
        shaken: how, by floor.
        lowest: the floor to which objects may be moved; "" if there is none.
        premises, weights: for the choice of measures, and of objects.
        kinds: of measures, for all kinds of object; none for the usual ones of `leading` of them.
        leading: kinds of object on which measures are tried.
        seconds: that a simulation took so far, to tell how long this may take.
        progress: as for `assess`.
    """
    at = {each.number: floor.floor for floor in floors for each in floor.results}
    known = {label: (floor.plane, floor.space) for label, floor in shaken.items() if floor.space}
    every = Shaken(known, lowest if lowest in known else "")
    chosen: dict[object, ItemResult] = {}
    for each in ranked([each for floor in floors for each in floor.results], weights):
        if each.solid is not None and each.before.value > 0.0 and not each.item.stands_on:
            chosen.setdefault(alike(each.item), each)
    some = list(chosen.values())[: None if kinds else leading]
    asked = [(at[each.number], every.asked(at[each.number], each, bool(kinds))) for each in some]
    wanted = [kinds_for(each, premises, kinds) for _, each in asked]
    if not any(wanted):
        return list(floors)
    pairs = max(len(space.trial.motions) for _, space in known.values())
    work = [[work_of(kind, bool(kinds)) for kind in row] for row in wanted]
    # every measure in half of the runs that are asked of the first one, which has the others too
    total = pairs * TURNS // 2 * sum(sum(row) + max(row, default=0) for row in work)
    title = tell("trying what helps (about {time})", time=duration(seconds * total))
    with meter(title, total, progress) as done:
        foreseen = AtMost(total, done)
        found = with_mitigation(asked, wanted, every, foreseen)
        foreseen.end()
    tried = {(at[one.number], alike(one.item)): each for one, each in zip(some, found, strict=True)}
    return [
        replace(
            floor,
            results=[
                _of_one_alike(each, tried.get((floor.floor, alike(each.item))))
                for each in floor.results
            ],
        )
        for floor in floors
    ]


def _of_one_alike(result: ItemResult, tried: ItemResult | None) -> ItemResult:
    """The result with what was found about one that is alike, if anything was."""
    if tried is None:
        return result
    return replace(
        result,
        mitigations=tried.mitigations,
        curves=tried.curves,
        safe_base=tried.safe_base,
    )
