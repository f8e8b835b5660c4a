"""What a header states of its numbers, held against them."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import quoted
from shaketable.language import tell, translated
from shaketable.records.text import RecordText

PEAK_SHARE = 0.01  # by which the largest value may differ from the one that the header states
#: The same, where the values hold an offset that their maximum may not.
OFFSET_SHARE = 0.02

_DECIMALS = re.compile(r"\.(\d*)(?:[EeDd]([-+]?\d{1,3}))?")


def require_count(text: RecordText, stated: int, found: int, what: str = "values") -> None:
    """Raise an error unless as many values were found as the header says, and two or more."""
    if found != stated:
        short = translated("cut short: ") if found < stated else ""
        raise text.fault(
            tell(
                "{short}the header says {stated:.12g} {what}, found {found}",
                short=short,
                stated=stated,
                what=translated(what),
                found=found,
            )
        )
    require_two(text, found, what)


def require_two(text: RecordText, found: int, what: str = "values") -> None:
    """Raise an error for fewer than two values, between which nothing moves."""
    if found < 2:
        raise text.fault(
            tell("holds {found} {what}; at least 2 are needed", found=found, what=translated(what))
        )


def require_peak(
    text: RecordText,
    stated: str,
    line: int,
    values: NDArray[np.float64],
    *,
    per: float = 1.0,
    share: float = PEAK_SHARE,
    what: str = "values",
) -> None:
    """Raise an error if the largest value is not the one that the header states.

    Args:
        stated, line: the header's word and its line; zero states nothing.
        values: in any unit.
        per: one unit of the header in units of the values.
        share: by which they may differ, beside the rounding of the word.
    """
    peak = abs(text.number(stated, line)) * per
    found = float(np.abs(values).max())
    decimals = _DECIMALS.search(stated)
    digits = len(decimals[1]) - int(decimals[2] or 0) if decimals else 0
    if peak > 0.0 and not abs(found - peak) <= 0.51 * per * 10.0**-digits + share * peak:
        raise text.fault(
            tell(
                "the header says a peak of {found}, {peak:.6g} in the unit of the "
                "{what}, but the largest of them is {largest:.6g}: one of the two is "
                "damaged",
                found=quoted(stated.strip()),
                peak=peak,
                what=what,
                largest=found,
            ),
            line,
        )


def require_duration(
    text: RecordText, stated: float, line: int, count: int, step: float, *, within: float
) -> None:
    """Raise an error if count and time step do not make the duration that the header states.

    Args:
        stated: [s], of `count` or `count` - 1 steps.
        within: rounding of the header's number [s].
    """
    if min(abs(n * step - stated) for n in (count, count - 1)) > within:
        raise text.fault(
            tell(
                "the header says a duration of {stated:g} s, but {count} values with a "
                "time step of {step:g} s last {lasts:g} s",
                stated=stated,
                count=count,
                step=step,
                lasts=count * step,
            ),
            line,
        )
