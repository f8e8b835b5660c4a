"""A library: its cases, and of what its functions are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shaketable.fragility.limit_states import LimitState
from shaketable.library.case import Case


@dataclass(frozen=True, kw_only=True)
class Library:
    """What a library's file describes.

    Attributes:
        title, edition: what it is called.
        cases: each with a name of its own.
        measures: of the ground, and with a leading "floor " of the floor on which things stand.
        states: limit states, from the mildest.
        seed: of the draws.
        motions: the names of its motions, in words.
    """

    title: str
    edition: str
    cases: Sequence[Case]
    measures: tuple[str, ...]
    states: tuple[LimitState, ...]
    seed: int = 0
    motions: str = ""
