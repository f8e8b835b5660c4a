"""What a campaign simulates, and the blocks in which it does so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError, require_whole
from shaketable.lazy_motions import in_order
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.resampling import events_of, recordings_of
from shaketable.simulate.around import Around
from shaketable.simulate.checks import motions_of
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.kinds import DOWNHILL, are_solids, require_device
from shaketable.solid import Solid

ALL, SUMMARY = "all", "summary"
KEEP = (ALL, SUMMARY)
#: Simulations of a block, about: some seconds of two cores. What is kept of a summary grows with
#: its blocks, not with its motions.
BLOCKS = {ALL: 2**18, SUMMARY: 2**20}
#: Of solids, which take some hundred times as long.
BLOCKS_OF_SOLIDS = {ALL: 2**11, SUMMARY: 2**12}
ROWS = 512  # bodies times polarities times tilts under one motion, from which on more gain nothing


class BlockSpan(NamedTuple):
    """A part of a campaign that is simulated at once: some bodies, some motions, all the rest."""

    number: int
    first_body: int
    end_body: int
    first_motion: int
    end_motion: int


class Motions(NamedTuple):
    """Which recording and event each motion is of, (motion,)."""

    recording: NDArray[np.intp]
    event: NDArray[np.intp]


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """A campaign; `of` makes and checks one.

    Attributes:
        ensemble: its simulations. Where a summary is kept, motions of one event are side by side.
        keep: ALL, what `simulate_many` returns; or SUMMARY, counts by body, tilt and scale.
        recordings: whether a summary also keeps counts by recording.
        device: where it runs.
        bodies_per_block: of all blocks but the last bodies'.
        motion_parts: first and end motion of the blocks; those of a summary hold whole events.
    """

    ensemble: Ensemble
    keep: str
    recordings: bool
    device: str
    bodies_per_block: int
    motion_parts: tuple[tuple[int, int], ...]

    @classmethod
    def of(
        cls,
        bodies: Sequence[Body] | Sequence[Solid],
        motions: Iterable[Motion],
        *,
        tilts: ArrayLike = (0.0,),
        scales: ArrayLike = (1.0,),
        polarities: ArrayLike = (1, -1),
        azimuth: float = DOWNHILL,
        orientations: ArrayLike = (0.0,),
        model: Model | str | None = None,
        surroundings: Around = None,
        keep: str = ALL,
        recordings: bool = False,
        device: str = "cpu",
        block: int | None = None,
    ) -> Plan:
        """What a user asks for, as for `run_campaign`; `block` is the simulations of a block.

        Raises:
            InputError: what `run_campaign` says.
        """
        if keep not in KEEP:
            raise InputError(f"keep= must be one of {', '.join(map(repr, KEEP))}, got {keep!r}")
        if recordings and keep != SUMMARY:
            raise InputError(f"recordings= is for keep={SUMMARY!r}; keep={ALL!r} has every motion")
        motions, event = motions_of(motions), None
        if keep == SUMMARY:
            sources = _sources(motions)
            # those of an event, and of each of its recordings, side by side
            order = np.lexsort((sources.recording, sources.event))
            motions, event = in_order(motions, order.tolist()), sources.event[order]
        ensemble = Ensemble.of(
            bodies,
            motions,
            tilts=tilts,
            scales=scales,
            polarities=polarities,
            azimuth=azimuth,
            orientations=orientations,
            model=model,
            surroundings=surroundings,
        )
        require_device(device, ensemble.kind)
        if block is None:
            block = (BLOCKS_OF_SOLIDS if are_solids(bodies) else BLOCKS)[keep]
        require_whole("block", block)
        per_body = ensemble.repeats * ensemble.tilts.size
        count, factors = len(ensemble.bodies), ensemble.scales
        some = min(count, max(1, ROWS // per_body))
        wanted = max(1, block // (some * per_body * factors.size))
        parts = _parts(len(motions), wanted, event)
        most = max(end - first for first, end in parts)
        # few motions leave room for more bodies, a large event for fewer
        some = min(count, max(1, block // (most * per_body * factors.size)))
        return cls(
            ensemble=ensemble,
            keep=keep,
            recordings=recordings,
            device=device,
            bodies_per_block=some,
            motion_parts=parts,
        )

    @property
    def simulations(self) -> int:
        """How many, of all blocks."""
        return int(np.prod([int(n) for n in self.ensemble.shape], dtype=object))

    @property
    def grid(self) -> tuple[int, int]:
        """How many blocks there are, along bodies and along motions."""
        return -(-len(self.ensemble.bodies) // self.bodies_per_block), len(self.motion_parts)

    def block(self, number: int) -> BlockSpan:
        """The block of a number."""
        row, part = divmod(number, len(self.motion_parts))
        first = row * self.bodies_per_block
        end = min(first + self.bodies_per_block, len(self.ensemble.bodies))
        return BlockSpan(number, first, end, *self.motion_parts[part])

    def part_of(self, block: BlockSpan) -> int:
        """Which of the motion parts a block takes."""
        return block.number % len(self.motion_parts)

    def ensemble_of(self, block: BlockSpan) -> Ensemble:
        """The simulations of a block."""
        return self.ensemble.some(
            range(block.first_body, block.end_body), range(block.first_motion, block.end_motion)
        )

    def strongest_first(self) -> list[int]:
        """The numbers of all blocks, those with the most work first."""
        energy = np.array(
            [
                sum(
                    float(np.square(motion.horizontal).sum())
                    for motion in self.ensemble.motions[first:end]
                )
                for first, end in self.motion_parts
            ]
        )
        rows, _ = self.grid
        heavy = np.argsort(-np.tile(energy, rows), kind="stable")
        return [int(k) for k in heavy]

    @cached_property
    def sources(self) -> Motions:
        """The recording and the event of each motion."""
        return _sources(self.ensemble.motions)


def _sources(motions: Sequence[Motion]) -> Motions:
    """The recording and the event of each motion."""
    recording = recordings_of(motions)
    return Motions(recording, events_of(motions, recording)[recording])


def _parts(count: int, wanted: int, event: NDArray[np.intp] | None) -> tuple[tuple[int, int], ...]:
    """First and end motion of each part of about so many motions, in whole events if any."""
    if event is None:
        return tuple((k, min(k + wanted, count)) for k in range(0, count, wanted))
    begins = [0, *(np.flatnonzero(np.diff(event)) + 1).tolist(), count]
    parts = []
    first = 0
    for end, following in zip(begins[1:], [*begins[2:], None], strict=True):
        if following is None or following - first > wanted:
            parts.append((first, end))
            first = end
    return tuple(parts)
