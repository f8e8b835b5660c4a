"""Motions in one file: appended one by one, and read again as they are asked for.

The file is the samples of every series, 8 bytes each, one after the other. What is known of the
motions is kept by whoever made it.
"""

from __future__ import annotations

import tempfile
import weakref
from collections.abc import Iterable, Sequence
from itertools import accumulate
from threading import Lock
from typing import IO

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, SimulationError
from shaketable.lazy_motions import Head, LazyMotions
from shaketable.motion import Motion
from shaketable.progress import size

SAMPLE = np.dtype("<f8")
IN_MEMORY = 2**24  # bytes of a temporary file before it goes to the disk


class MotionFile(LazyMotions):
    """The motions of an open file."""

    def __init__(self, file: IO[bytes], heads: Sequence[Head]) -> None:
        """A file to which `append` wrote the motions of these heads, and nothing else before."""
        self.heads = heads
        self._file = file
        self._starts = [0, *accumulate(bytes_of(head) for head in heads)]
        self._one = Lock()  # threads share the place in the file

    def read(self, k: int) -> Motion:
        """The motion of a number from 0.

        Raises:
            SimulationError: the file has lost it.
        """
        head, length = self.heads[k], self._starts[k + 1] - self._starts[k]
        with self._one:
            self._file.seek(self._starts[k])
            content = self._file.read(length)
        if len(content) < length:
            raise SimulationError(f"the file of motions ends before {head.name or f'motion {k}'}")
        names = head.series
        series: NDArray[np.float64] = np.frombuffer(content, SAMPLE).reshape(len(names), -1)
        return head.motion(dict(zip(names, series, strict=True)))


def append(motion: Motion, file: IO[bytes]) -> Head:
    """Write a motion at the end of a file."""
    head = Head.of(motion)
    for name in head.series:
        file.write(getattr(motion, name).astype(SAMPLE).tobytes())
    return head


def bytes_of(head: Head) -> int:
    """Of a motion's samples."""
    return SAMPLE.itemsize * head.samples * len(head.series)


def in_temporary_file(motions: Iterable[Motion]) -> MotionFile:
    """Motions, taken one by one, in a file that goes with what is returned.

    Small ones stay in memory.

    Raises:
        InputError: something that is not a motion.
        SimulationError: the disk is full.
    """
    file = tempfile.SpooledTemporaryFile(IN_MEMORY)  # noqa: SIM115  it is read later
    try:
        return _filled(file, motions)
    except BaseException:
        file.close()
        raise


def _filled(file: IO[bytes], motions: Iterable[Motion]) -> MotionFile:
    heads: list[Head] = []
    for motion in motions:
        if not isinstance(motion, Motion):
            raise InputError(f"motions[{len(heads)}] must be a Motion; got {type(motion).__name__}")
        try:
            heads.append(append(motion, file))
        except OSError as error:
            held = size(sum(map(bytes_of, heads)))
            raise SimulationError(
                f"{tempfile.gettempdir()}: {error.strerror or error} after {len(heads):,} motions, "
                f"{held}; the variable TMPDIR names another folder"
            ) from None
    found = MotionFile(file, heads)
    weakref.finalize(found, file.close)
    return found
