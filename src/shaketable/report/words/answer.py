"""What becomes of an object: one answer, in three dimensions or, if only that is known, a plane."""

from __future__ import annotations

from shaketable.assess import ItemResult
from shaketable.language import tell
from shaketable.report.words import findings, space
from shaketable.report.words.assumed import what_is_assumed
from shaketable.report.words.numbers import in_hundred, likely


def what_happens(result: ItemResult, sources: str = "recordings") -> list[str]:
    """What becomes of an object, in sentences.

    Args:
        result: of an item.
        sources: what the independent motions are.
    """
    if result.solid is None:
        said = findings.in_a_plane(result, sources)
    else:
        said = [findings.on_condition(result) + space.what_happens(result)]
    return [*said, *what_is_assumed(result.item), *_like_it(result)]


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
