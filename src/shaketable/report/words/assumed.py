"""Which sizes of an object nobody gave, and what was assumed for them."""

from __future__ import annotations

from collections.abc import Sequence

from shaketable.inventory.catalogue import catalogue
from shaketable.inventory.item import Assumed, Item
from shaketable.language import number, spoken, tell, translated
from shaketable.report.words.numbers import counted


def what_is_assumed(item: Item) -> list[str]:
    """A sentence of an object whose sizes were taken from the catalogue."""
    if not item.assumed:
        return []
    thing = catalogue()[item.assumed_as]
    return [
        tell(
            "Not all of its sizes are in the list. It is taken for a common thing, {thing}, and of "
            "what is usual for such a thing for the one that tips most easily: {sizes}. These "
            "ranges are assumed, and were not read in a source. Measure it, and fill them in.",
            thing=f"“{thing.names[spoken()][0]}”",
            sizes=", ".join(map(_of_range, item.assumed)),
        )
    ]


def _of_range(one: Assumed) -> str:
    """As "depth 25 cm (of 25 to 40)"."""
    factor, unit = (1.0, "kg") if one.what == "mass" else (100.0, "cm")
    value, least, most = (number(factor * each, ".3g") for each in one[1:])
    return tell(
        "{what} {value} {unit} (of {least} to {most})",
        what=translated(one.what.replace("_", " ")),
        value=value,
        unit=unit,
        least=least,
        most=most,
    )


def how_many_are_assumed(items: Sequence[Item]) -> list[str]:
    """A sentence about all whose sizes were taken from the catalogue."""
    some = sum(bool(item.assumed) for item in items)
    if not some:
        return []
    return [
        tell(
            "For {kinds} the list gives no size, or not all: they were taken from a catalogue of "
            "common things, whose ranges are assumed. Each card says which.",
            kinds=counted(some, "kind of object"),
        )
    ]
