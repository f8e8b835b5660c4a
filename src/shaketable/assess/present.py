"""The items as they stand now: every single simulation, and its counts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.results import Quartiles
from shaketable.body import Body
from shaketable.outcome import Outcome
from shaketable.simulate import Trial, count_by_recording, simulated
from shaketable.tilting import TiltCounts

QUARTERS = (0.25, 0.5, 0.75)


@dataclass(frozen=True, kw_only=True, eq=False)
class Present:
    """Simulations of each item on its own tilt.

    Attributes:
        counts: outcomes by recording.
        peak_rotation: [rad], (body, simulation); the two directions of a motion are side by side.
        stands: whether the body is upright at the end, likewise.
        slip_downhill, slip_uphill: farthest slip [m], both >= 0; None where the model does not
            slide.
    """

    counts: TiltCounts
    peak_rotation: NDArray[np.float64]
    stands: NDArray[np.bool_]
    slip_downhill: NDArray[np.float64] | None
    slip_uphill: NDArray[np.float64] | None

    @property
    def simulations(self) -> int:
        """How many there are of each body."""
        return int(self.stands.shape[1])

    def peak_quartiles(self, body: int) -> Quartiles:
        """Quartiles of the peak rotation [rad]."""
        return observed_quartiles(self.peak_rotation[body])


def observed_quartiles(values: NDArray[np.float64]) -> Quartiles:
    """Quartiles that were observed; NaN if there are no values.

    They are not interpolated, as nothing was ever half way between a rotation that stood and 90°.
    """
    if not values.size:
        return Quartiles(np.nan, np.nan, np.nan)
    found = np.quantile(values, QUARTERS, method="inverted_cdf")
    return Quartiles(*(float(value) for value in found))


def present_runs(
    bodies: Sequence[Body],
    trial: Trial,
    tilt: float,
    done: Callable[[int], None],
) -> Present:
    """Simulate bodies on a tilt [rad]."""
    runs = trial.run(bodies, [tilt], done)
    names = ["peak_rotation", "outcome"]
    if trial.model.slides:
        names += ["slip_downhill", "slip_uphill"]
    each = {name: simulated(runs[name])[:, 0] for name in names}
    return Present(
        counts=TiltCounts.of(np.array([tilt]), count_by_recording(runs, trial.recording)),
        peak_rotation=each["peak_rotation"],
        stands=each["outcome"] == Outcome.STANDING,
        slip_downhill=each.get("slip_downhill"),
        slip_uphill=each.get("slip_uphill"),
    )
