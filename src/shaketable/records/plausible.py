"""Whether a component's samples can be a recorded acceleration."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import refused, remark
from shaketable.language import tell
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
            tell(
                "a time step of {time_step:g} s; accepted: {least:g} to {most:g} s",
                time_step=component.time_step,
                least=STEPS[0],
                most=STEPS[1],
            ),
        )
    size = np.abs(component.acceleration)
    loudest = float(size.max())
    if not loudest <= LOUDEST:
        at = int(np.argmax(size))
        raise refused(
            path,
            tell(
                "sample {number} of component {component} is {loudest:.3g} g; is the unit "
                "wrong, or a number damaged?",
                number=at + 1,
                component=component.code or 1,
                loudest=loudest / STANDARD_GRAVITY,
            ),
            where=_where(component, at),
        )


def warn_of_spikes(path: Path, component: Component) -> None:
    """Warn of samples far from all others, with their lines."""
    for at in spikes(component.acceleration):
        text = tell(
            "sample {number} of component {component}, {size:.3g} g, is a lonely spike; is the "
            "number damaged?",
            number=at + 1,
            component=component.code or 1,
            size=component.acceleration[at] / STANDARD_GRAVITY,
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
    return "" if component.lines is None else tell("line {line}", line=component.lines[at])
