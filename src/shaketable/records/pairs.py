"""Both horizontal components of a recording as one motion.

Which of two components is the transverse one is told by their azimuths, see `transverse`.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from dataclasses import replace

from shaketable.errors import named, quoted
from shaketable.lazy_motions import Head, heads_of
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.records.motions import at_step, padded
from shaketable.records.transverse import is_left_of

log = logging.getLogger(__name__)

MOST_NAMED = 10


def paired(motions: Sequence[Motion]) -> list[Motion]:
    """A motion for each recording, with its transverse component.

    A recording without a second component, of unknown azimuths, or with several that would fit
    stays as it is, each of its components by itself, and a warning names them. Where time steps
    differ, the coarser component is interpolated; the shorter one is padded with zeros.

    Args:
        motions: horizontal components, each by itself, with their origins.

    Returns:
        Pairs in the order of their horizontal components, named like these.
    """
    return list(each_paired(motions))


def each_paired(motions: Sequence[Motion]) -> Iterator[Motion]:
    """What `paired` gives, one by one."""
    heads = heads_of(motions)
    couples = _couples(heads)
    alone = [
        heads[one].name for one, other in couples
        if other is None and not heads[one].has_transverse
    ]  # fmt: skip
    if alone:
        log.warning(
            "%d of %d motions have no transverse component: no second one of their recording is at "
            "a right angle and begins with them, as far as their azimuths are known: %s",
            len(alone), len(motions), named([quoted(name) for name in alone], MOST_NAMED),
        )  # fmt: skip
    return _joined_each(motions, couples)


def joined_pairs(motions: Sequence[Motion]) -> list[Motion]:
    """What `paired` gives, without a warning."""
    return list(_joined_each(motions, _couples(heads_of(motions))))


def pairs_among(motions: Sequence[Motion]) -> list[Motion]:
    """Both horizontal components of a recording as one motion, where both are known."""
    return [motion for motion in joined_pairs(motions) if motion.transverse is not None]


def with_both_directions(motions: Sequence[Motion]) -> list[Motion]:
    """The components, each by itself, whose recording has a known second one."""
    couples = _couples(heads_of(motions))
    return [motions[k] for pair in couples if None not in pair for k in pair if k is not None]


def _joined_each(
    motions: Sequence[Motion], couples: Sequence[tuple[int, int | None]]
) -> Iterator[Motion]:
    for one, other in couples:
        yield motions[one] if other is None else joined_pair(motions[one], motions[other])


def _couples(heads: Sequence[Head]) -> list[tuple[int, int | None]]:
    """The numbers of a horizontal component and of its transverse one, None where none is known."""
    groups: dict[object, list[int]] = {}
    for k, head in enumerate(heads):
        groups.setdefault(_recording(head, k), []).append(k)
    found: list[tuple[int, int | None]] = []
    for group in groups.values():
        couples = [
            (one, other)
            for one in group
            for other in group
            if _is_right_handed(heads[one], heads[other])
        ]
        if len(group) == 2 and len(couples) == 1:
            found += couples
        else:
            found += [(one, None) for one in group]
    return found


def couples_on_floor(motions: Sequence[Motion]) -> list[tuple[int, int]]:
    """The numbers of horizontal components of one floor and of those at a right angle to them.

    Here one component may belong to several couples, and the instruments of an earthquake may stand
    anywhere on the floor. Those that do not name their earthquake belong together where there is
    one of them for each direction.
    """
    heads = heads_of(motions)
    events = [_event(head) for head in heads]
    nameless = [head for head, event in zip(heads, events, strict=True) if not event]
    directions = {head.origin.azimuth for head in nameless if head.origin}
    couples = [
        (one, other)
        for one, head in enumerate(heads)
        for other, across in enumerate(heads)
        if events[one] == events[other] and _is_right_handed(head, across)
    ]
    if len(directions) < len(nameless):
        return [(one, other) for one, other in couples if events[one]]
    return couples


def _event(head: Head) -> str:
    return head.origin.event.strip().casefold() if head.origin else ""


def _recording(head: Head, number: int) -> object:
    """What two components of one instrument have in common; the number where nothing is known."""
    origin = head.origin
    if origin is None:
        return number
    if origin.event.strip() and origin.station.strip():
        return origin.event, origin.station, origin.location
    return (origin.sha256 or origin.file, origin.location) if origin.file else number


def _is_right_handed(horizontal: Head, transverse: Head) -> bool:
    """Whether two components are at a right angle, the second to the left, and begin together."""
    one, other = horizontal.origin, transverse.origin
    if one is None or other is None:
        return False
    if horizontal.has_transverse or transverse.has_transverse:
        return False
    step = min(horizontal.time_step, transverse.time_step)
    return is_left_of(other.azimuth, one.azimuth) and abs(one.start - other.start) <= step / 2


def joined_pair(horizontal: Motion, transverse: Motion) -> Motion:
    """Two components as one motion, with the vertical component of the first, or the other's."""
    step = min(horizontal.time_step, transverse.time_step)
    above = horizontal if horizontal.vertical is not None else transverse
    parts = {
        "horizontal": (horizontal.horizontal, horizontal.origin, horizontal.time_step),
        "transverse": (transverse.horizontal, transverse.origin, transverse.time_step),
    }
    if above.vertical is not None:
        parts["vertical"] = (above.vertical, above.vertical_origin, above.time_step)
    even = {
        name: at_step(series, origin or Origin(), own, step)
        for name, (series, origin, own) in parts.items()
    }
    count = max(series.size for series, _ in even.values())
    done = {name: padded(series, origin, count) for name, (series, origin) in even.items()}
    vertical, vertical_origin = done.get("vertical", (None, None))
    return replace(
        horizontal,
        horizontal=done["horizontal"][0],
        time_step=step,
        vertical=vertical,
        transverse=done["transverse"][0],
        origin=done["horizontal"][1],
        vertical_origin=vertical_origin,
        transverse_origin=done["transverse"][1],
    )
