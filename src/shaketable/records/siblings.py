"""The vertical component beside a horizontal one, whose file name differs only in the component.

`…EW` and `…UD`, `…NS2` and `…UD2`, `…-E` and `…-V`, `…228` and `…UP`, `…HNE…` and `…HNZ…` are
recognised by their names; `0111a` and `0111b` are recognised by their headers.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

from shaketable.errors import Fault, InputError, refusal
from shaketable.language import tell
from shaketable.records.component import Component, names_horizontal, names_vertical

#: Reads the components of a file.
Reader = Callable[[Path], list[Component]]


class NoVerticalError(InputError):
    """A record without a vertical component."""


def no_vertical(path: Path, text: str) -> NoVerticalError:
    """The error for a component whose vertical one cannot be told."""
    return refusal([Fault(path, "", "", "no vertical", text)], NoVerticalError)


def vertical_beside(horizontal: Component, read: Reader) -> Component:
    """The vertical component in the same folder as `horizontal`.

    Raises:
        InputError: none, or several.
    """
    path = horizontal.path
    folder = path.parent
    while not folder.is_dir():  # a member of an archive, or of one in it
        folder, path = folder.parent, folder
    names = sorted(entry.name for entry in os.scandir(folder) if entry.is_file())
    names = [name for name in names if name != path.name]
    told = [name for name in names if told_by_name(path.name, name)]
    found = [_vertical(folder / name, read, trust=True) for name in told]
    if not told:
        near = [name for name in names if _one_letter_apart(path.name, name)]
        found = [_vertical(folder / name, read, trust=False) for name in near]
    components = [one for one in found if one is not None]
    if len(components) == 1:
        return components[0]
    if components:
        several = ", ".join(one.path.name for one in components)
        raise no_vertical(
            path,
            tell("several vertical components beside it ({several}); name one", several=several),
        )
    raise no_vertical(
        path, tell("no vertical component in it or beside it; name its file, or do without")
    )


def told_by_name(horizontal: str, other: str) -> bool:
    """Whether two names are equal but for the words of a horizontal and a vertical component."""
    return any(
        names_horizontal(a) and names_vertical(b) and _same_number(a, b)
        for a, b in _words_apart(horizontal, other)
    )


def beside_by_name(horizontal: str, other: str) -> bool:
    """Whether two names are equal but for one letter, or the words of horizontal components."""
    return _one_letter_apart(horizontal, other) or any(
        names_horizontal(a) and names_horizontal(b) for a, b in _words_apart(horizontal, other)
    )


def _words_apart(one: str, other: str) -> Iterator[tuple[str, str]]:
    """Yield the differing part of two file names, widened step by step."""
    start = _shared(one, other)
    end = _shared(one[start:][::-1], other[start:][::-1])
    # where names share letters of the word (HNE and HNZ), take the whole word
    for back in range(4):
        for ahead in range(3):
            a, b = (_word(name, start - back, end - ahead) for name in (one, other))
            if a and b:
                yield a, b


def _same_number(a: str, b: str) -> bool:
    """Whether the vertical's number, if it has one, is the horizontal's: UD2 goes with NS2."""
    return not b[-1].isdigit() or a[-1] == b[-1]


def _shared(a: str, b: str) -> int:
    """How many characters two names share at their start."""
    return next(
        (n for n, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b))
    )


def _word(name: str, start: int, end: int) -> str:
    if start < 0 or end < 0:
        return ""
    return name[start : len(name) - end].strip("-_.")


def _one_letter_apart(a: str, b: str) -> bool:
    return len(a) == len(b) and sum(x != y for x, y in zip(a, b, strict=True)) == 1


def _vertical(path: Path, read: Reader, *, trust: bool) -> Component | None:
    """The file's vertical component, or its only component if its name may be trusted."""
    try:
        components = read(path)
    except InputError:
        if trust:
            raise
        return None
    vertical = [one for one in components if one.is_vertical]
    if not vertical and trust and len(components) == 1:
        return components[0]
    return vertical[0] if len(vertical) == 1 else None
