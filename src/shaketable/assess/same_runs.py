"""Which objects are the same to a shaking, whatever they are called and wherever they stand."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import fields

import numpy as np

from shaketable.assess.stood import Stood, Ways
from shaketable.solid import Solid


def simulated_once(stood: Sequence[Stood], ways: Sequence[Ways]) -> tuple[list[int], list[int]]:
    """The number of the first of each kind; and for each object, which of these it is like.

    Two are alike that have the same numbers, to the last digit, whatever they are called, stand in
    the same way among the same surroundings, and meet the motions in the same turns.
    """
    firsts: dict[Hashable, int] = {}
    like = [
        firsts.setdefault(_numbers_of(each, turns), len(firsts))
        for each, turns in zip(stood, ways, strict=True)
    ]
    return [like.index(k) for k in range(len(firsts))], like


def _numbers_of(stood: Stood, ways: Ways) -> Hashable:
    """All that a run of an object depends on, but the motions and their model."""
    solid = [getattr(stood.solid, field.name) for field in fields(Solid) if field.name != "name"]
    numbers = [each.tobytes() if isinstance(each, np.ndarray) else each for each in solid]
    return (
        *numbers, stood.tilt, stood.aside, stood.around, stood.friction, ways.shape, ways.tobytes(),
    )  # fmt: skip
