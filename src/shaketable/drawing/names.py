"""Names in pictures."""

from __future__ import annotations

from shaketable.errors import printable


def drawn(name: str) -> str:
    """A name as matplotlib shows it: no formula between dollar signs, no control character."""
    return printable(name).replace("$", r"\$")
