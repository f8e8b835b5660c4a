"""What the formats have in common that came from the volumes of Caltech and the CDMG."""

from __future__ import annotations

import re

from shaketable.language import tell
from shaketable.records.text import RecordText

_OF_CHANNELS = re.compile(r"\(\s*(\d+)\s+CHNS OF", re.IGNORECASE)
_GAP = re.compile(r"\s{2,}")


def channels(text: RecordText, *, ended: bool = True) -> list[tuple[int, int]]:
    """Start and end of each channel, as indices of lines; a line "/&" ends a channel.

    Args:
        ended: whether the last channel must have an end line; if not, and no channel has one,
            all lines are one channel.

    Raises:
        InputError: text after the last end line.
    """
    ends = [n for n, line in enumerate(text.lines) if line.startswith("/&")]
    if not ends and not ended:
        return [(0, len(text.lines))]
    if text.after(ends[-1] + 1 if ends else 0) is not None:
        raise text.fault(tell("cut short: the last channel has no end '/&'"), len(text.lines))
    return list(zip([0, *(end + 1 for end in ends[:-1])], ends, strict=True))


def warn_if_fewer(text: RecordText, found: int, start: int, stop: int) -> None:
    """Warn if a file holds fewer channels than its recorder has, as the lines of a header say."""
    recorded = text.search(_OF_CHANNELS, start, stop)
    if recorded:
        text.warn_if_cut(found, text.whole(*recorded.word()), "its recorder has")


def station_of(text: RecordText, number: re.Pattern[str], start: int, stop: int) -> str:
    """Station number and name; the name is on the line after the number.

    Args:
        number: pattern of the first, with the number as its group.
        start, stop: indices of the header's lines.
    """
    found = text.search(number, start, stop - 1)
    if found is None:
        return ""
    name = text.lines[found.line]  # lines count from 1, indices from 0: this is the next one
    return f"{found.match.group(1) or ''} {_GAP.split(name.strip())[0]}".strip()
