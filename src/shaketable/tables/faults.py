"""Many faults of a table in few lines."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from shaketable.errors import Fault
from shaketable.language import tell

MOST_ALIKE = 3  # faults of one kind in one column that are shown


def condensed(faults: Iterable[Fault]) -> list[Fault]:
    """Of many faults of one kind the first few, and how many more there are."""
    kinds: Counter[tuple[str, str]] = Counter()
    found, more = [], 0
    for fault in faults:
        kinds[fault.kind, fault.column] += 1
        if kinds[fault.kind, fault.column] <= MOST_ALIKE:
            found.append(fault)
        else:
            more += 1
    if not more:
        return found
    text = tell("... and {more:,} more faults like these", more=more)
    return [*found, Fault("", "", "", "more", text)]
