"""What becomes of an object: one answer, in three dimensions or, if only that is known, a plane."""

from __future__ import annotations

from shaketable.assess import ItemResult
from shaketable.language import tell, translated
from shaketable.report.words import carried, findings, space
from shaketable.report.words.assumed import what_is_assumed
from shaketable.report.words.numbers import in_hundred, likely


def what_happens(result: ItemResult, sources: str = "recordings") -> list[str]:
    """What becomes of an object, in sentences.

    Args:
        result: of an item.
        sources: what the independent motions are.
    """
    if result.item.stands_on:
        said = carried.what_happens(result)
        return [*said, *what_is_assumed(result.item), *_works_on(result)]
    if result.solid is None:
        said = findings.in_a_plane(result, sources)
    else:
        said = [findings.on_condition(result) + space.what_happens(result)]
    return [
        *_locks(result),
        *said,
        *what_is_assumed(result.item),
        *_like_it(result),
        *_works_on(result),
    ]


def _works_on(result: ItemResult) -> list[str]:
    """That of what has to work afterwards only falls are known."""
    if not result.item.critical:
        return []
    return [tell("Not considered: whether it works afterwards.")]


def _locks(result: ItemResult) -> list[str]:
    """That the worse of locked and free castors is told, where it is not known which it has."""
    if result.item.lock_known:
        return []
    return [
        tell(
            "Whether its castors are locked is not known: both were simulated, and what follows is "
            "the worse, {state} castors.",
            state=translated(str(result.item.castors)),
        )
    ]


def _like_it(result: ItemResult) -> list[str]:
    """How often objects like it fall, if that was asked for."""
    if result.uncertain is None:
        return []
    fall = result.uncertain.fall
    return [
        tell(
            "Objects like it, whose size, contents and support are not known exactly, fall in "
            "{often} of 100 ({likely}).",
            often=in_hundred(fall.value),
            likely=likely(fall),
        )
    ]
