"""The notes that blocks are done: which there are, and whether they say what they must."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np

from shaketable.campaign import arrays
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.campaign.work import DONE, done_name
from shaketable.errors import SimulationError

_NOTE = re.compile(r"(\d{8,})\.json")


def numbers_in(below: str, objects: Objects) -> list[int]:
    """The numbers of the blocks of which there is a note; other files are none."""
    found = (_NOTE.fullmatch(name) for name in objects.names(below))
    return [int(name[1]) for name in found if name]


def notes_of(plan: Plan, objects: Objects) -> dict[int, dict[str, Any]]:
    """The notes of the blocks that are done, by their numbers; those that are damaged left out."""
    found = {}
    for number in numbers_in(DONE, objects):
        if number >= int(np.prod(plan.grid)):
            continue
        try:
            note = objects.get_json(done_name(number))
        except SimulationError:
            continue
        if note is not None and _is_complete(note, plan):
            found[number] = note
    return found


def _is_complete(note: Mapping[str, Any], plan: Plan) -> bool:
    chunks = note.get("chunks")
    return (
        isinstance(note.get("key"), str)
        and isinstance(chunks, dict)
        and len(chunks) == len(arrays.layouts(plan))
    )


def endings_of(notes: Mapping[int, Mapping[str, Any]]) -> Counter[float]:
    """How many simulations of all blocks ended in which way."""
    endings: Counter[float] = Counter()
    for note in notes.values():
        endings.update({float(code): n for code, n in note.get("endings", {}).items()})
    return endings
