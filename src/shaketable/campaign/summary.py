"""What is left of a block where not every simulation is kept: counts that can be added up.

Falls are counted by body, tilt and scale. For their intervals the squares of the counts of each
recording, and of each event, are summed: what varies between recordings is not between simulations.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.campaign import sketch
from shaketable.outcome import Outcome
from shaketable.resampling import sums_of_groups
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.result_fields import Part

LEVELS = ("recording", "event")
#: Sums over the recordings or events, of d downhill falls and u uphill ones in n simulations.
MOMENTS = ("dd", "uu", "du", "dn", "un", "nn")


@dataclass(frozen=True, eq=False)
class Summary:
    """Counts of a block; over (body, tilt, scale) but for what is said.

    Attributes:
        downhill, uphill: falls.
        held: counts of `Ensemble.held_field`.
        moments: (level, moment, body, tilt, scale), see LEVELS and MOMENTS.
        peaks: sketch of the peak rotations, (body, tilt, scale, bin).
        by_recording: falls downhill and uphill, (direction, recording, body, tilt, scale).
    """

    downhill: NDArray[np.int64]
    uphill: NDArray[np.int64]
    held: NDArray[np.int64]
    moments: NDArray[np.int64]
    peaks: NDArray[np.uint32]
    by_recording: NDArray[np.int32]


class SummaryTally:
    """Counts the results of a block as they come."""

    def __init__(
        self, ensemble: Ensemble, recording: NDArray[np.intp], event: NDArray[np.intp]
    ) -> None:
        """Nothing counted yet.

        Args:
            ensemble: of the block.
            recording, event: of each of its motions, in any numbers, (motion,).
        """
        self._ensemble = ensemble
        _, self._recording = np.unique(recording, return_inverse=True)
        self._recordings = int(self._recording.max()) + 1
        events = np.zeros(self._recordings, np.intp)
        events[self._recording] = np.unique(event, return_inverse=True)[1]
        self._event = events
        self._each = ensemble.repeats * np.bincount(self._recording)
        cells = (len(ensemble.bodies), ensemble.tilts.size, ensemble.scales.size)
        self._falls = np.zeros((2, self._recordings, *cells), np.int32)
        self._held = np.zeros(cells, np.int64)
        self._peaks = np.zeros((*cells, sketch.BINS), np.uint32)

    def store(self, part: Part) -> None:
        """Count the results of some members, as `ensemble.run` hands them over."""
        motion, scale, body, tilt, outcome, peak = self._ensemble.falls_of(part)
        fallen = outcome != Outcome.STANDING
        for k, which in enumerate((Outcome.DOWNHILL, Outcome.UPHILL)):
            here = outcome == which
            where = (k, self._recording[motion[here]], body[here], tilt[here], scale[here])
            np.add.at(self._falls, where, 1)
        if self._ensemble.held_field in part.results:
            held = part.results[self._ensemble.held_field]
            np.add.at(self._held, (body, tilt, scale), held)
        np.add.at(self._peaks, (body, tilt, scale, sketch.bins_of(peak, fallen)), 1)

    @property
    def summary(self) -> Summary:
        """Of all members, once all are entered."""
        down, up = self._falls.astype(np.int64)
        number = np.arange(self._recordings)
        return Summary(
            downhill=down.sum(axis=0),
            uphill=up.sum(axis=0),
            held=self._held,
            moments=_moments_of(down, up, self._each, number, self._event),
            peaks=self._peaks,
            by_recording=self._falls,
        )


def moments_of(
    down: NDArray[np.int64],
    up: NDArray[np.int64],
    recording: NDArray[np.intp],
    event: NDArray[np.intp],
    each: int,
) -> NDArray[np.int64]:
    """MOMENTS over recordings and over events, (level, moment, ...).

    Args:
        down, up: falls under each motion, (motion, ...).
        recording, event: of each motion, (motion,).
        each: simulations under each motion.
    """
    return _moments_of(down, up, np.full(recording.size, each), recording, event)


def _moments_of(
    down: NDArray[np.int64],
    up: NDArray[np.int64],
    number: NDArray[np.int64],
    recording: NDArray[np.intp],
    event: NDArray[np.intp],
) -> NDArray[np.int64]:
    found = []
    for level in (recording, event):
        d, u = (sums_of_groups(one, level) for one in (down, up))
        n = sums_of_groups(number, level).reshape(-1, *(1,) * (down.ndim - 1)) + np.zeros_like(d)
        pairs = ((d, d), (u, u), (d, u), (d, n), (u, n), (n, n))
        found.append([(one * other).sum(axis=0) for one, other in pairs])
    return np.array(found)
