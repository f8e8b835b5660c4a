"""Resampling of uneven (time, value) pairs at even steps."""

from __future__ import annotations

import logging
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.language import tell
from shaketable.records.stated import require_two
from shaketable.records.text import RecordText

log = logging.getLogger(__name__)

LONGEST_GAP = 10  # median steps: a longer gap is missing data, not uneven digitising
LONGEST_OF_FILM = 0.05  # s: between points where a trace on film is straight
MOST_SAMPLES = 1e7  # of a file
MOST_DOUBLED = 0.1  # of the times: some digitisers print an instant twice, rarely
EVEN_SHARE = 0.9  # of steps: where so many are even, an uneven one is a hole in the record


class Even(NamedTuple):
    """Values at even steps.

    Attributes:
        values: shape (n,).
        step: [s].
        lines: the line of the pair at or before each, (n,).
        said: what was done, in words.
    """

    values: NDArray[np.float64]
    step: float
    lines: NDArray[np.int32]
    said: str


def resampled(
    text: RecordText,
    time: NDArray[np.float64],
    values: NDArray[np.float64],
    lines: NDArray[np.int32],
    columns: int = 1,
    *,
    spliced: bool = False,
) -> Even:
    """Values at even steps, linear between the pairs.

    The step is the one that the caller gave, or else the median step of the pairs, rounded to 1,
    2 or 5 times a power of ten.

    Args:
        time: [s], shape (n,); the even steps begin at the first.
        values: shape (n,).
        lines: the line of each pair, (n,).
        columns: how many series of these times there are in the file.
        spliced: whether pieces of a film may be joined: then a lone short step is no damage.

    Raises:
        InputError: times that fall, a gap of more than LONGEST_GAP median steps, an even record
            with holes, or times that are printed too coarsely.
    """
    require_two(text, time.size, "pairs of time and value")
    steps = np.diff(time)
    # a time printed twice is one instant: its last value counts
    falls = int(np.argmin(steps))
    if steps[falls] < 0.0:
        raise text.fault(
            tell(
                "the time falls from {before:g} s to {after:g} s",
                before=time[falls],
                after=time[falls + 1],
            ),
            int(lines[falls + 1]),
        )
    median = float(np.median(steps[steps > 0.0])) if (steps > 0.0).any() else 0.0
    if median == 0.0:
        raise text.fault(tell("the time column does not rise"))
    widest = int(np.argmax(steps))
    if steps[widest] > max(LONGEST_GAP * median, LONGEST_OF_FILM):
        raise text.fault(
            tell(
                "a gap of {gap:g} s, where steps of {median:g} s are usual; data are "
                "missing; cut the record there",
                gap=steps[widest],
                median=median,
            ),
            int(lines[widest + 1]),
        )
    off = np.abs(steps - median) > 0.5 * median
    if spliced:
        off &= ~_lone_short(steps, off)
    if off.any() and np.mean(np.isclose(steps, median, rtol=1e-3)) >= EVEN_SHARE:
        hole = int(np.argmax(off))
        raise text.fault(
            tell(
                "mixed time steps: {here:g} s here, {median:g} s elsewhere; samples are "
                "missing, or there are too many",
                here=steps[hole],
                median=median,
            ),
            int(lines[hole + 1]),
        )
    step = text.time_step or text.step(rounded(median))
    if columns * (time[-1] - time[0]) / step > MOST_SAMPLES:
        raise text.fault(
            tell(
                "a time step of {step:g} s would make more than {most:g} samples",
                step=step,
                most=MOST_SAMPLES,
            )
        )
    doubled = float(np.mean(steps == 0.0))
    if doubled > MOST_DOUBLED:
        raise text.fault(
            tell(
                "{share:.0f} % of the times are equal to the one before: they are "
                "printed with too few digits; give one column of accelerations and the "
                "time step",
                share=100 * doubled,
            )
        )
    keep = np.append(steps > 0.0, True)
    even = time[0] + step * np.arange(math.floor((time[-1] - time[0]) / step + 1e-6) + 1)
    said = f"{time.size} uneven pairs resampled linearly to steps of {step:g} s"
    log.warning("%s: %s", text.path, said)
    before = np.searchsorted(time[keep], even, side="right") - 1
    return Even(np.interp(even, time[keep], values[keep]), step, lines[keep][before], said)


def _lone_short(steps: NDArray[np.float64], off: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which steps are shorter than usual, between steps as usual: where two films are joined."""
    beside = np.append(off[1:], False) | np.append(False, off[:-1])
    lone: NDArray[np.bool_] = off & ~beside & (steps < np.median(steps))
    return lone


def rounded(step: float) -> float:
    """The nearest of 1, 2 and 5 times a power of ten, by ratio."""
    decade = 10.0 ** math.floor(math.log10(step))
    nice = [decade, 2.0 * decade, 5.0 * decade, 10.0 * decade]
    return float(f"{min(nice, key=lambda one: abs(math.log(one / step))):.6g}")
