"""Headers of "key: value" lines, every value with the line that it stands on."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from shaketable.errors import quoted
from shaketable.language import tell
from shaketable.records.text import RecordText


class Header:
    """The values of a header by their keys.

    Args:
        text: the file.
        rows: (line number, key, value); see `keyed`.
    """

    def __init__(self, text: RecordText, rows: Iterable[tuple[int, str, str]]) -> None:
        self._text = text
        self._found: dict[str, list[tuple[str, int]]] = {}
        for line, key, value in rows:
            self._found.setdefault(key, []).append((value, line))

    def get(self, key: str, default: str = "") -> str:
        """The value, the first of several; `default` if there is none."""
        return self._found[key][0][0] if key in self._found else default

    def starting(self, start: str) -> str:
        """The value of the first key that begins so, "" if there is none."""
        return next((self.get(key) for key in self._found if key.startswith(start)), "")

    def required(self, key: str) -> tuple[str, int]:
        """The value and its line.

        Raises:
            InputError: none, an empty one, or several that differ.
        """
        values = self._found.get(key, [])
        if not values or not values[0][0]:
            raise self._text.fault(tell("the header has no value for {key!r}", key=key))
        if any(value != values[0][0] for value, _ in values):
            raise self._text.fault(
                tell(
                    "{key!r} is given twice: {found} and, on line {line}, {other}",
                    key=key,
                    found=quoted(values[0][0]),
                    line=values[1][1],
                    other=quoted(values[1][0]),
                ),
                values[0][1],
            )
        return values[0]

    def positive(self, *keys: str) -> float | None:
        """The first of these values that begins with a number above 0, None if there is none."""
        for key in keys:
            try:
                found = float(self.get(key).partition(" ")[0])
            except ValueError:
                continue
            if 0.0 < found < math.inf:
                return found
        return None

    def number(self, key: str) -> float:
        return self._text.number(*self.required(key))

    def whole(self, key: str) -> int:
        return self._text.whole(*self.required(key))

    def step(self, key: str) -> float:
        """The time step [s]."""
        return self._text.step(self.number(key), self.required(key)[1])


def keyed(rows: Iterable[tuple[int, str]]) -> Iterator[tuple[int, str, str]]:
    """(line number, key, value) of every row (line number, line) that has a colon."""
    for n, line in rows:
        key, found, value = line.partition(":")
        if found:
            yield n, key.strip(), value.strip()
