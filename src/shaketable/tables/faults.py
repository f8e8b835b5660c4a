"""Many faults of a table in few lines: one for each cause, with all its rows."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby

from shaketable.errors import Fault
from shaketable.language import tell

MOST_ALIKE = 3  # texts of one kind in one column that are shown
_PLACE = re.compile(r"(.*?)([A-Z]{0,3})(\d+)")


def condensed(faults: Iterable[Fault]) -> list[Fault]:
    """Faults of one cause as one, with the places of all.

    Where their texts differ, as each tells what was found, the first few are shown, and the others
    by their places alone.
    """
    by_text: dict[tuple[object, str, str, str], list[Fault]] = {}
    for fault in faults:
        cause = (fault.path, fault.kind, fault.column, fault.said)
        by_text.setdefault(cause, []).append(fault)
    by_cause: dict[tuple[object, str, str], list[list[Fault]]] = {}
    for (path, kind, column, _), some in by_text.items():
        by_cause.setdefault((path, kind, column), []).append(some)
    found = []
    for causes in by_cause.values():
        shown, rest = causes[:MOST_ALIKE], [each for some in causes[MOST_ALIKE:] for each in some]
        found += [some[0]._replace(where=places([each.where for each in some])) for some in shown]
        if rest:
            text = tell("the same there, {count:,} times", count=len(rest))
            text = tell("the same there") if len(rest) == 1 else text
            found.append(rest[0]._replace(where=places([each.where for each in rest]), text=text))
    return found


def places(where: Iterable[str]) -> str:
    """Places in few words: "line 3–9, 12", "cell B3–B9"."""
    told: dict[str, list[str]] = {}
    others = []
    split = []
    for place in dict.fromkeys(where):
        match = _PLACE.fullmatch(place)
        if match:
            split.append((match[1], match[2], int(match[3])))
        else:
            others.append(place)
    for (word, letters), some in groupby(sorted(split), key=lambda each: each[:2]):
        told.setdefault(word, []).extend(_spans(letters, [number for *_, number in some]))
    return ", ".join([*(f"{word}{', '.join(spans)}" for word, spans in told.items()), *others])


def _spans(letters: str, numbers: list[int]) -> list[str]:
    """Numbers with those that follow each other as one span."""
    spans: list[list[int]] = []
    for number in numbers:
        if spans and number == spans[-1][-1] + 1:
            spans[-1].append(number)
        else:
            spans.append([number])
    return [
        f"{letters}{one[0]}–{letters}{one[-1]}" if len(one) > 1 else f"{letters}{one[0]}"
        for one in spans
    ]
