"""The notes that blocks are done: which there are, and whether they say what they must."""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

from shaketable.campaign.fingerprint import key_of
from shaketable.campaign.objects import Objects
from shaketable.campaign.work import PLAN, RESULTS, Work
from shaketable.errors import InputError, SimulationError

T = TypeVar("T")

DONE, FAILED = "campaign/done", "campaign/failed"
AT_ONCE = 256  # objects that are asked for together
_NOTE = re.compile(r"(\d{8,})\.json")


def done_name(number: int) -> str:
    return f"{DONE}/{number:08d}.json"


def failed_name(number: int) -> str:
    return f"{FAILED}/{number:08d}.json"


def numbers_in(below: str, objects: Objects) -> list[int]:
    """The numbers of the blocks that have a note; other files are ignored."""
    found = (_NOTE.fullmatch(name) for name in objects.names(below))
    return [int(name[1]) for name in found if name]


def notes_of(work: Work, objects: Objects) -> dict[int, dict[str, Any]]:
    """The notes of the blocks that are done, by their numbers; those that are damaged left out."""
    found = {}
    numbers = [number for number in numbers_in(DONE, objects) if number < work.blocks]
    for some in batched(numbers, AT_ONCE):
        contents = objects.get_many([done_name(number) for number in some])
        for number in some:
            note = _read(contents.get(done_name(number), b""))
            if note is not None and _is_complete(note, work):
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
    sizes = objects.sizes(RESULTS) if notes else {}
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


def _is_complete(note: Mapping[str, Any], work: Work) -> bool:
    chunks = note.get("chunks")
    return (
        isinstance(note.get("key"), str)
        and isinstance(chunks, dict)
        and len(chunks) == work.chunks
        and all(isinstance(each, list) and len(each) == 2 for each in chunks.values())
    )


def whole_notes(
    work: Work, objects: Objects, *, partial: bool = False, check: bool = True, hint: str = ""
) -> dict[int, dict[str, Any]]:
    """The notes of all blocks, or of the finished ones if `partial`; their objects are checked.

    Args:
        work: of the store.
        objects: of the store.
        partial: whether blocks may be missing.
        check: whether to compare checksums, which reads all objects; otherwise only sizes.
        hint: what else to tell where blocks are missing.

    Raises:
        InputError: blocks are missing.
        SimulationError: an object is missing, cut short, damaged or another's.
    """
    notes = notes_of(work, objects)
    if len(notes) < work.blocks and not partial:
        failed = len(numbers_in(FAILED, objects))
        said = f" ({failed:,} failed: campaign status tells why)" if failed else ""
        raise InputError(
            f"{objects.place}: {len(notes):,} of {work.blocks:,} blocks are done; run the campaign "
            f"again to do the rest{said}{'; ' if hint else ''}{hint}"
        )
    made = (objects.get_json(PLAN) or {}).get("fingerprint", {})
    for number, note in notes.items():
        if note["key"] != key_of(made, work.parts_of(number, made)):
            raise SimulationError(
                f"{objects.place}: block {number} is of another campaign; run this one again"
            )
    for fault in faults_of(notes, objects, check).values():
        raise SimulationError(f"{objects.place}: {fault}; run the campaign again to mend it")
    return notes
