"""Motions whose samples are elsewhere: what is known of each, and sequences that read them.

Fifty thousand records are 3 GB of samples; a campaign needs those of one block at a time.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any, NamedTuple, overload

from numpy.typing import NDArray

from shaketable.motion import Motion
from shaketable.origin import Origin

#: The series of a motion, in the order in which they are kept.
SERIES = ("horizontal", "vertical", "transverse")


class Head(NamedTuple):
    """A motion without its samples."""

    name: str
    time_step: float
    samples: int
    has_vertical: bool
    has_transverse: bool
    origin: Origin | None
    vertical_origin: Origin | None
    transverse_origin: Origin | None

    @classmethod
    def of(cls, motion: Motion) -> Head:
        """What is known of a motion."""
        return cls(
            name=motion.name,
            time_step=float(motion.time_step),
            samples=motion.horizontal.size,
            has_vertical=motion.vertical is not None,
            has_transverse=motion.transverse is not None,
            origin=motion.origin,
            vertical_origin=motion.vertical_origin,
            transverse_origin=motion.transverse_origin,
        )

    @classmethod
    def from_dict(cls, told: Mapping[str, Any]) -> Head:
        """What `as_dict` gave, from JSON.

        Raises:
            KeyError, TypeError: it is not.
        """
        origins = {name: _origin(told[name]) for name in cls._fields if name.endswith("origin")}
        return cls(**{**told, **origins})

    def as_dict(self) -> dict[str, Any]:
        """All of it, as JSON can hold it."""
        return {
            name: asdict(value) if isinstance(value, Origin) else value
            for name, value in self._asdict().items()
        }

    @property
    def series(self) -> tuple[str, ...]:
        """Those of SERIES that the motion has."""
        has = (True, self.has_vertical, self.has_transverse)
        return tuple(name for name, there in zip(SERIES, has, strict=True) if there)

    def motion(self, series: Mapping[str, NDArray[Any]]) -> Motion:
        """The motion with its samples, by the names of `series`."""
        return Motion(
            series["horizontal"],
            self.time_step,
            vertical=series.get("vertical"),
            transverse=series.get("transverse"),
            name=self.name,
            origin=self.origin,
            vertical_origin=self.vertical_origin,
            transverse_origin=self.transverse_origin,
        )


class LazyMotions(Sequence[Motion]):
    """Motions that are read when they are asked for.

    Attributes:
        heads: of all of them.
    """

    heads: Sequence[Head]

    @abstractmethod
    def read(self, k: int) -> Motion:
        """The motion of a number from 0."""

    def in_order(self, numbers: Sequence[int]) -> LazyMotions:
        """Those of some numbers, in that order."""
        return _Chosen(self, numbers)

    def __len__(self) -> int:
        return len(self.heads)

    @overload
    def __getitem__(self, k: int) -> Motion: ...

    @overload
    def __getitem__(self, k: slice) -> list[Motion]: ...

    def __getitem__(self, k: int | slice) -> Motion | list[Motion]:
        if isinstance(k, slice):
            return [self.read(j) for j in range(*k.indices(len(self)))]
        if not -len(self) <= k < len(self):
            raise IndexError(k)
        return self.read(k % len(self))


class _Chosen(LazyMotions):
    """Some of others."""

    def __init__(self, motions: LazyMotions, numbers: Sequence[int]) -> None:
        self.heads = [motions.heads[k] for k in numbers]
        self._motions, self._numbers = motions, numbers

    def read(self, k: int) -> Motion:
        return self._motions.read(self._numbers[k])


def heads_of(motions: Iterable[Motion]) -> Sequence[Head]:
    """What is known of motions; no samples are read for that."""
    if isinstance(motions, LazyMotions):
        return motions.heads
    return [Head.of(motion) for motion in motions]


def in_order(motions: Sequence[Motion], numbers: Sequence[int]) -> Sequence[Motion]:
    """Motions of some numbers, in that order, lazy where they are."""
    if isinstance(motions, LazyMotions):
        return motions.in_order(numbers)
    return [motions[k] for k in numbers]


def _origin(told: Mapping[str, Any] | None) -> Origin | None:
    if told is None:
        return None
    return Origin(**{**told, "processing": tuple(told["processing"])})
