"""A campaign's motions in its store: a file holds some, and only those that are needed are read.

A worker that held all of them would need 4 GB for 50,000 records; it needs those of its block.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any
from zipfile import BadZipFile

import numpy as np

from shaketable.campaign.fingerprint import motion_hash
from shaketable.campaign.objects import Objects
from shaketable.errors import SimulationError
from shaketable.lazy_motions import Head, LazyMotions
from shaketable.motion import Motion

MOTIONS = "campaign/motions"
AT_ONCE = 64  # motions of a file
KEPT = 4  # files in memory


class StoredMotions(LazyMotions):
    """The motions of a store."""

    def __init__(
        self, objects: Objects, told: Sequence[dict[str, Any]], hashes: Sequence[str]
    ) -> None:
        """The motions of a store.

        Args:
            objects: of the store.
            told: of each, what `Head.as_dict` said.
            hashes: of each, against which those that are read are held.
        """
        if len(told) != len(hashes):
            raise ValueError("its motions are not those that it was begun with")
        self.heads = [Head.from_dict(each) for each in told]
        self._objects, self._hashes = objects, hashes
        self._read: dict[int, list[Motion]] = {}

    def read(self, k: int) -> Motion:
        """The motion of a number from 0.

        Raises:
            SimulationError: its file is missing or damaged.
        """
        number, place = divmod(k, AT_ONCE)
        found = self._read.get(number)
        if found is None:
            found = self._file(number)
            while len(self._read) >= KEPT:
                self._read.pop(next(iter(self._read)), None)
            self._read[number] = found
        return found[place]

    def _file(self, number: int) -> list[Motion]:
        which = range(number * AT_ONCE, min((number + 1) * AT_ONCE, len(self)))
        place, name = self._objects.place, _name(number)
        content = self._objects.get(name)
        if content is None:
            raise SimulationError(f"{place}: {name} is missing")
        try:
            with np.load(io.BytesIO(content), allow_pickle=False) as series:
                found = [_motion(self.heads[k], k, series) for k in which]
        except (KeyError, TypeError, ValueError, OSError, EOFError, BadZipFile) as error:
            raise SimulationError(f"{place}: {name} is damaged ({error})") from None
        if [motion_hash(motion) for motion in found] != [self._hashes[k] for k in which]:
            raise SimulationError(
                f"{place}: {name} holds other motions than those that it was begun with"
            )
        return found


def save_motions(motions: Sequence[Motion], objects: Objects) -> None:
    """Write the series of motions, some in each file."""
    for number, first in enumerate(range(0, len(motions), AT_ONCE)):
        series = {
            f"{name[0]}{k}": getattr(motion, name)
            for k, motion in enumerate(motions[first : first + AT_ONCE], first)
            for name in Head.of(motion).series
        }
        file = io.BytesIO()
        np.savez(file, **series)
        objects.put(_name(number), file.getvalue())


def _name(number: int) -> str:
    return f"{MOTIONS}/{number:06d}.npz"


def _motion(head: Head, k: int, series: Any) -> Motion:
    return head.motion({name: series[f"{name[0]}{k}"] for name in head.series})
