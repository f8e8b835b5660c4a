"""Whether a component's samples can be a recorded acceleration."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import refused, remark
from shaketable.records.component import Component
from shaketable.records.text import STEPS
from shaketable.units import STANDARD_GRAVITY

log = logging.getLogger(__name__)

LOUDEST = 100 * STANDARD_GRAVITY  # m/s²: no ground and no floor accelerates this much
#: A sample is warned of if it is this many times as far from the median as both its neighbours, and
#: as every sample that does not stand out from its own neighbours so. In 300 recorded components
#: the largest such ratio is 1.6.
SPIKE = 5.0
FEWEST = 20  # samples, below which none is said to stand out


def require_plausible(path: Path, component: Component) -> None:
    """Raise an error for a time step or accelerations that no record has.

    Raises:
        InputError: names what was found and, of a sample, its line.
    """
    if not STEPS[0] <= component.time_step <= STEPS[1]:
        raise refused(
            path,
            f"a time step of {component.time_step:g} s; accepted: {STEPS[0]:g} to {STEPS[1]:g} s",
        )
    size = np.abs(component.acceleration)
    loudest = float(size.max())
    if not loudest <= LOUDEST:
        at = int(np.argmax(size))
        raise refused(
            path,
            f"sample {at + 1} of component {component.code or 1} is "
            f"{loudest / STANDARD_GRAVITY:.3g} g; is the unit wrong, or a number damaged?",
            where=_where(component, at),
        )


def warn_of_spikes(path: Path, component: Component) -> None:
    """Warn of samples far from all others, with their lines."""
    for at in spikes(component.acceleration):
        text = (
            f"sample {at + 1} of component {component.code or 1}, "
            f"{component.acceleration[at] / STANDARD_GRAVITY:.3g} g, is a lonely spike; is the "
            "number damaged?"
        )
        log.warning(remark(path, text)._replace(where=_where(component, at)))


def spikes(acceleration: NDArray[np.float64]) -> list[int]:
    """Indices of the samples that SPIKE describes; none in fewer than FEWEST."""
    if acceleration.size < FEWEST:
        return []
    size = np.abs(acceleration - np.median(acceleration))
    beside = np.maximum(np.r_[0.0, size[:-1]], np.r_[size[1:], 0.0])
    lonely = size > SPIKE * beside
    rest = float(size[~lonely].max(initial=0.0))
    return [int(at) for at in np.flatnonzero(lonely & (size > SPIKE * rest))] if rest > 0.0 else []


def _where(component: Component, at: int) -> str:
    return "" if component.lines is None else f"line {component.lines[at]}"
