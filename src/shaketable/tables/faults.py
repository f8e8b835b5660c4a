"""Many faults of a table in few lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from shaketable.language import tell

MOST_ALIKE = 3  # faults of one kind that are shown

_PARTICULARS = re.compile(r"'[^']*'|\b[A-Z]+\d+\b|[-+]?[\d.,]+(e[-+]?\d+)?")


def condensed(faults: Iterable[str]) -> list[str]:
    """Of many faults of one kind the first few, and how many more there are."""
    kinds: Counter[str] = Counter()
    found, more = [], 0
    for fault in faults:
        kind = _PARTICULARS.sub("", fault)
        kinds[kind] += 1
        if kinds[kind] <= MOST_ALIKE:
            found.append(fault)
        else:
            more += 1
    return [*found, tell("... and {more:,} more faults like these", more=more)] if more else found
