"""The bodies, and how they are shaken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.records.pairs import paired
from shaketable.resampling import events_of, nested_resamples, recordings_of
from shaketable.solid import Solid
from shaketable_studies.boroschek_iruretagoyena_2006.printed import TABLE_1, PrintedSize

MODEL = General(static_friction=0.5)
OBLONG = 2.0  # the long side of an oblong base over the short one
SIZES: Sequence[PrintedSize] = TABLE_1


class Pairs(NamedTuple):
    """Both horizontal components of each recording.

    Attributes:
        motions: with transverse components.
        recording: of each, (motion,).
        weights: of what was observed and of draws over events and recordings, (k, recording).
        events: how many.
    """

    motions: list[Motion]
    recording: NDArray[np.intp]
    weights: NDArray[np.float64]
    events: int


def pairs_of(motions: Sequence[Motion], seed: int) -> Pairs:
    """The recordings of which both components, and their azimuths, are known.

    Raises:
        InputError: there are none.
    """
    found = [motion for motion in paired(motions) if motion.transverse is not None]
    if not found:
        raise InputError(
            "the study needs both horizontal components of recordings, with their azimuths; none "
            f"of {len(motions)} motions has a second one"
        )
    events = events_of(found)
    weights = nested_resamples(events, seed=seed)
    return Pairs(found, recordings_of(found), weights, int(events.max()) + 1)


def components(pairs: Pairs) -> tuple[list[Motion], list[Motion]]:
    """The horizontal components of all pairs by themselves, and the transverse ones."""
    split = [motion.components() for motion in pairs.motions]
    return [each[0] for each in split], [each[1] for each in split]


def square(size: PrintedSize) -> Solid:
    return Solid.box(size.base, size.base, size.height, name=f"square {size.body.name}")


def oblong(size: PrintedSize) -> Solid:
    """A box as slender, and longer across."""
    length = OBLONG * size.base
    return Solid.box(size.base, length, size.height, name=f"oblong {size.body.name}")


def cylinder(size: PrintedSize) -> Solid:
    return Solid.cylinder(size.base, size.height, name=f"round {size.body.name}")
