"""The notes that blocks are done: which there are, and whether they say what they must."""

from __future__ import annotations

import json
import re
import zlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from shaketable.campaign import arrays
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.campaign.work import DONE, done_name

T = TypeVar("T")

AT_ONCE = 256  # objects that are asked for together
_NOTE = re.compile(r"(\d{8,})\.json")


def numbers_in(below: str, objects: Objects) -> list[int]:
    """The numbers of the blocks of which there is a note; other files are none."""
    found = (_NOTE.fullmatch(name) for name in objects.names(below))
    return [int(name[1]) for name in found if name]


def notes_of(plan: Plan, objects: Objects) -> dict[int, dict[str, Any]]:
    """The notes of the blocks that are done, by their numbers; those that are damaged left out."""
    found = {}
    blocks = int(np.prod(plan.grid))
    numbers = [number for number in numbers_in(DONE, objects) if number < blocks]
    for some in batched(numbers, AT_ONCE):
        contents = objects.get_many([done_name(number) for number in some])
        for number in some:
            note = _read(contents.get(done_name(number), b""))
            if note is not None and _is_complete(note, plan):
                found[number] = note
    return found


def _read(content: bytes) -> dict[str, Any] | None:
    try:
        note = json.loads(content)
    except ValueError:
        return None
    return note if isinstance(note, dict) else None


def faults_of(
    notes: Mapping[int, Mapping[str, Any]], objects: Objects, whole: bool
) -> dict[int, str]:
    """What is wrong with the chunks of blocks that are noted as done, by their numbers.

    Args:
        notes: of the blocks.
        objects: of the store.
        whole: whether to read the chunks, and compare their checksums, too.
    """
    sizes = objects.sizes(arrays.RESULTS) if notes else {}
    found: dict[int, str] = {}
    for number, note in notes.items():
        for name, (size, _) in note["chunks"].items():
            if sizes.get(name) != size:
                there = f"{sizes[name]} bytes" if name in sizes else "no bytes"
                found.setdefault(number, f"{name} has {there}, {size} were written")
    if not whole:
        return found
    asked = [
        (number, name, checksum)
        for number, note in notes.items()
        if number not in found
        for name, (_, checksum) in note["chunks"].items()
    ]
    for some in batched(asked, AT_ONCE):
        contents = objects.get_many([name for _, name, _ in some])
        for number, name, checksum in some:
            if zlib.crc32(contents.get(name, b"")) != checksum:
                found.setdefault(number, f"{name} is damaged, or that of another block")
    return found


def batched(values: Sequence[T], size: int) -> Iterator[Sequence[T]]:
    """Some values at a time."""
    for first in range(0, len(values), size):
        yield values[first : first + size]


def _is_complete(note: Mapping[str, Any], plan: Plan) -> bool:
    chunks = note.get("chunks")
    return (
        isinstance(note.get("key"), str)
        and isinstance(chunks, dict)
        and len(chunks) == len(arrays.layouts(plan))
        and all(isinstance(each, list) and len(each) == 2 for each in chunks.values())
    )


def endings_of(notes: Mapping[int, Mapping[str, Any]]) -> Counter[int]:
    """How many simulations of all blocks ended in which way."""
    endings: Counter[int] = Counter()
    for note in notes.values():
        endings.update({int(code): n for code, n in note.get("endings", {}).items()})
    return endings
