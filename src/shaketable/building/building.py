"""A building: the motions of its floors, each with both horizontal components where known."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from shaketable.errors import InputError, named
from shaketable.motion import Motion
from shaketable.signal import IntensityMeasure

MOST_NAMED = 10  # motions in an error


@dataclass(frozen=True, kw_only=True, eq=False)
class Building:
    """Floors and their motions.

    Attributes:
        name: what to call it.
        floors: motions of each floor by its label, from the lowest to the highest; both horizontal
            components of a recording are one motion where their directions are known.
        told: where the motions come from, in words.
        files: what they were read from.
        computed: whether motion k of every floor comes from motion k of the ground, the lowest.
        variants: the buildings that it may be, by their first periods in words, where that is not
            known; it is then the one that is typical.
    """

    name: str
    floors: Mapping[str, Sequence[Motion]]
    told: str
    files: Sequence[Path] = ()
    computed: bool = False
    variants: Mapping[str, Building] = field(default_factory=dict)

    @property
    def ground(self) -> Sequence[Motion]:
        """The motions of its lowest floor."""
        return next(iter(self.floors.values()))

    def in_components(self) -> Building:
        """The same with each horizontal component by itself, as planar bodies take them."""
        floors = {
            label: [part for motion in motions for part in motion.components()]
            for label, motions in self.floors.items()
        }
        variants = {name: each.in_components() for name, each in self.variants.items()}
        return replace(self, floors=floors, variants=variants)

    def scaled_to(self, measure: IntensityMeasure) -> Building:
        """The building with every motion of its lowest floor scaled to 1 of a measure.

        The other floors are scaled with it: motion by motion where they were computed, otherwise
        earthquake by earthquake, so that the largest component of the lowest floor has it.

        Raises:
            InputError: several recorded motions of the ground of which one does not name its
                earthquake, or a floor's motion of an earthquake that the ground did not record.
        """
        if self.computed:
            factors = [measure.factor(motion) for motion in self.ground]
            floors = {
                label: [m.scaled(f) for m, f in zip(motions, factors, strict=True)]
                for label, motions in self.floors.items()
            }
            variants = {name: each.scaled_to(measure) for name, each in self.variants.items()}
            return replace(self, floors=floors, variants=variants)
        by_event = self._factors_by_event(measure)
        floors = {
            label: [motion.scaled(by_event[_event_of(motion)]) for motion in motions]
            for label, motions in self.floors.items()
        }
        return replace(self, floors=floors)

    def _factors_by_event(self, measure: IntensityMeasure) -> dict[str, float]:
        ground = [part for motion in self.ground for part in motion.components()]
        nameless = [
            motion.name or "one without a name" for motion in ground if not _event_of(motion)
        ]
        if len(ground) > 1 and nameless:
            raise InputError(
                f"{self.name}: cannot be scaled to a level of the ground, as these of its motions "
                f"do not name their earthquake: {named(nameless, MOST_NAMED)}"
            )
        factors: dict[str, float] = {}
        for motion in ground:
            event = _event_of(motion)
            factors[event] = min(factors.get(event, math.inf), measure.factor(motion))
        lost = [
            f"{label}: {motion.name}"
            for label, motions in self.floors.items()
            for motion in motions
            if _event_of(motion) not in factors
        ]
        if lost:
            raise InputError(
                f"{self.name}: cannot be scaled to a level of the ground, as its lowest floor did "
                f"not record the earthquakes of {named(lost, MOST_NAMED)}"
            )
        return factors


def _event_of(motion: Motion) -> str:
    return motion.origin.event.strip() if motion.origin else ""
