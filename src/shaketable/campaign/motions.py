"""A campaign's motions in its store: a file holds some, and only those that are needed are read.

A worker that held all of them would need 4 GB for 50,000 records; it needs those of its block.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, NamedTuple, overload
from zipfile import BadZipFile

import numpy as np

from shaketable.campaign.fingerprint import motion_hash
from shaketable.campaign.objects import Objects
from shaketable.errors import SimulationError
from shaketable.motion import Motion
from shaketable.origin import Origin

MOTIONS = "campaign/motions"
AT_ONCE = 64  # motions of a file
KEPT = 4  # files in memory


class Head(NamedTuple):
    """A motion without its samples."""

    name: str
    origin: Origin | None


class StoredMotions(Sequence[Motion]):
    """The motions of a store, read as they are asked for.

    Attributes:
        heads: of all of them; `motion.heads_of` finds them.
    """

    def __init__(
        self, objects: Objects, told: Sequence[dict[str, Any]], hashes: Sequence[str]
    ) -> None:
        """The motions of a store.

        Args:
            objects: of the store.
            told: what `told_of_motion` said of each.
            hashes: of each, against which those that are read are held.
        """
        if len(told) != len(hashes):
            raise ValueError("its motions are not those that it was begun with")
        self.heads = tuple(Head(each["name"], _origin(each["origin"])) for each in told)
        self._objects, self._told, self._hashes = objects, told, hashes
        self._read: dict[int, list[Motion]] = {}

    def __len__(self) -> int:
        return len(self._told)

    @overload
    def __getitem__(self, k: int) -> Motion: ...

    @overload
    def __getitem__(self, k: slice) -> list[Motion]: ...

    def __getitem__(self, k: int | slice) -> Motion | list[Motion]:
        if isinstance(k, slice):
            return [self[j] for j in range(*k.indices(len(self)))]
        if not -len(self) <= k < len(self):
            raise IndexError(k)
        number, place = divmod(k % len(self), AT_ONCE)
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
                found = [_motion(k, self._told[k], series) for k in which]
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
        series: dict[str, Any] = {}
        for k in range(first, min(first + AT_ONCE, len(motions))):
            motion = motions[k]
            series[f"h{k}"] = motion.horizontal
            if motion.vertical is not None:
                series[f"v{k}"] = motion.vertical
            if motion.transverse is not None:
                series[f"t{k}"] = motion.transverse
        file = io.BytesIO()
        np.savez(file, **series)
        objects.put(_name(number), file.getvalue())


def told_of_motion(motion: Motion) -> dict[str, Any]:
    """A motion without its series."""
    return {
        "name": motion.name,
        "time_step": float(motion.time_step),
        "origin": motion.origin and asdict(motion.origin),
        "vertical_origin": motion.vertical_origin and asdict(motion.vertical_origin),
        "transverse_origin": motion.transverse_origin and asdict(motion.transverse_origin),
    }


def _name(number: int) -> str:
    return f"{MOTIONS}/{number:06d}.npz"


def _motion(k: int, told: dict[str, Any], series: Any) -> Motion:
    return Motion(
        series[f"h{k}"],
        told["time_step"],
        vertical=series.get(f"v{k}"),
        transverse=series.get(f"t{k}"),
        name=told["name"],
        origin=_origin(told["origin"]),
        vertical_origin=_origin(told["vertical_origin"]),
        transverse_origin=_origin(told.get("transverse_origin")),
    )


def _origin(told: dict[str, Any] | None) -> Origin | None:
    if told is None:
        return None
    steps: Sequence[str] = told["processing"]
    return Origin(**{**told, "processing": tuple(steps)})
