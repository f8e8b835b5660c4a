"""Which motions belong to one recording, and intervals that take this into account.

A recording is what one station recorded of one earthquake. Its components, and the two directions
of each, are not experiments of their own: everywhere the number n of independent experiments is
that of recordings. Shares of simulations have Wilson's interval with that n; everything else
(directions of falls, tilts, ratios, fits) has a bootstrap over recordings.

A bootstrap draws as many recordings as there are, with replacement, many times (Efron B. (1979)
Bootstrap methods: another look at the jackknife, Ann. Statist. 7(1):1-26). A draw is a row of
weights, which say how often each recording was taken; a row of ones is what was observed. What is
computed from weights of shape (k, recording) has k as its first axis.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError
from shaketable.lazy_motions import heads_of
from shaketable.motion import Motion

log = logging.getLogger(__name__)

CONFIDENCE = 0.95
FEWEST = 10  # recordings: with fewer, a warning says that intervals mean little
DRAWS = 500  # of a bootstrap


def recordings_of(motions: Sequence[Motion]) -> NDArray[np.intp]:
    """The number of each motion's recording, from 0 in order of appearance, shape (motion,).

    Motions of the same event and station belong together, else those of the same file; a motion of
    unknown origin is a recording of its own.
    """
    keys: list[object] = []
    unnamed = 0
    for index, head in enumerate(heads_of(motions)):
        origin = head.origin
        if origin is not None and origin.event.strip() and origin.station.strip():
            keys.append((_same(origin.event), _same(origin.station)))
        elif origin is not None and origin.file:
            keys.append(origin.sha256 or origin.file)
            unnamed += 1
        else:
            keys.append(index)
    if unnamed > 1:
        log.warning(
            "%d motions name no event or no station: each file counts as a recording of its own, "
            "and where files belong together intervals are too narrow",
            unnamed,
        )
    numbers = {key: number for number, key in enumerate(dict.fromkeys(keys))}
    return np.array([numbers[key] for key in keys], np.intp)


def _same(name: str) -> str:
    """A name without what makes no difference: blanks around and within it, and case."""
    return " ".join(name.split()).casefold()


def sums_of_groups(values: NDArray[np.int64], group: NDArray[np.intp]) -> NDArray[np.int64]:
    """Sums of the values that belong together, in time that grows with their number alone.

    Args:
        values: (n, ...).
        group: of each, in any numbers, (n,).

    Returns:
        A sum for each group that there is, in the order of their numbers, (group, ...).
    """
    order = np.argsort(group, kind="stable")
    first = np.unique(group[order], return_index=True)[1]
    return np.asarray(np.add.reduceat(values[order], first, axis=0))


def recording_names(motions: Sequence[Motion]) -> tuple[str, ...]:
    """What each recording is called: its event and station, or its first motion, (recording,).

    Where two would be called alike, their numbers stand behind.
    """
    first = np.unique(recordings_of(motions), return_index=True)[1].tolist()
    found = []
    for k in first:
        origin = motions[k].origin
        known = origin is not None and origin.event.strip() and origin.station.strip()
        found.append(f"{origin.event} {origin.station}" if origin and known else motions[k].name)
    if all(found) and len(set(found)) == len(found):
        return tuple(found)
    return tuple(f"{name or 'recording'} #{number}" for number, name in enumerate(found))


def resamples(recordings: int, number: int = DRAWS, seed: int = 0) -> NDArray[np.float64]:
    """Weights of what was observed, then of `number` draws, shape (1 + number, recording).

    Raises:
        InputError: a negative seed.
    """
    if seed < 0:
        raise InputError(f"a seed must not be negative, got {seed}")
    if number and recordings < FEWEST:
        log.warning(
            "intervals over so few recordings (%d) mean little: use %d or more", recordings, FEWEST
        )
    even = np.full(recordings, 1 / recordings)
    drawn = np.random.default_rng(seed).multinomial(recordings, even, size=number)
    return np.vstack([np.ones(recordings), drawn])


def events_of(
    motions: Sequence[Motion], recording: NDArray[np.intp] | None = None
) -> NDArray[np.intp]:
    """The number of each recording's event, from 0 in order of appearance, shape (recording,).

    A recording whose event is not known is an event of its own.

    Args:
        motions: of the recordings.
        recording: what `recordings_of` gives for them, where it is known.
    """
    if recording is None:
        recording = recordings_of(motions)
    keys: dict[int, object] = {}
    for number, head in zip(recording.tolist(), heads_of(motions), strict=True):
        event = _same(head.origin.event) if head.origin is not None else ""
        keys.setdefault(number, event or number)
    numbers = {key: k for k, key in enumerate(dict.fromkeys(keys.values()))}
    return np.array([numbers[keys[number]] for number in range(len(keys))], np.intp)


def nested_resamples(
    event: NDArray[np.intp], number: int = DRAWS, seed: int = 0
) -> NDArray[np.float64]:
    """Weights as `resamples` gives them, of draws of events and of recordings within each.

    Stations that recorded one earthquake are alike: a draw takes as many events as there are, with
    replacement, and of each taken event as many of its recordings as it has, with replacement
    (Davison and Hinkley 1997, Bootstrap methods and their application, section 3.8). Where
    recordings of one event are no more alike than others, intervals are too wide by up to a
    quarter.

    Args:
        event: of each recording, as `events_of` gives it, (recording,).
        number, seed: of the draws.

    Raises:
        InputError: a negative seed.
    """
    if seed < 0:
        raise InputError(f"a seed must not be negative, got {seed}")
    random = np.random.default_rng(seed)
    members = [np.flatnonzero(event == k) for k in range(int(event.max()) + 1)]
    if number and len(members) < FEWEST:
        log.warning(
            "intervals over so few events (%d) mean little: use %d or more", len(members), FEWEST
        )
    weights = np.ones((1 + number, event.size))
    weights[1:] = 0.0
    for draw in weights[1:]:
        for taken in random.integers(len(members), size=len(members)):
            ours = members[taken]
            np.add.at(draw, ours[random.integers(ours.size, size=ours.size)], 1.0)
    return weights


def ratio(count: ArrayLike, total: ArrayLike, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of `count` in `total` of every draw, (k, ...); NaN where the total is zero.

    Args:
        count, total: numbers by recording, (..., recording); their shapes are broadcast.
        weights: of the draws, (k, recording).
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(_drawn(count, weights) / _drawn(total, weights))


def _drawn(counts: ArrayLike, weights: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.moveaxis(np.asarray(counts) @ weights.T, -1, 0)


def interval(
    draws: NDArray[np.float64], level: float = CONFIDENCE
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The interval of drawn values along their first axis, NaN left out.

    Its ends are values that were drawn, not values between them, as some may be infinite.
    """
    tails = [(1.0 - level) / 2, (1.0 + level) / 2]
    count = (~np.isnan(draws)).sum(axis=0)
    ordered = np.sort(draws, axis=0)  # NaN last
    found = []
    for tail in tails:
        index = np.clip(np.ceil(tail * count).astype(np.intp) - 1, 0, draws.shape[0] - 1)
        found.append(np.take_along_axis(ordered, index[None], 0)[0])
    return found[0], found[1]


def ends(draws: NDArray[np.float64]) -> tuple[float, float]:
    """Both ends of the interval of drawn numbers."""
    low, high = interval(draws)
    return float(low), float(high)


def wilson_interval(share: ArrayLike, n: ArrayLike) -> tuple[Any, Any]:
    """Wilson's CONFIDENCE interval of a share that was seen in n independent experiments.

    For shares of simulations n is the number of recordings: components of one record and both
    directions of each are not experiments of their own. Shapes are broadcast; NaN where n is zero.
    Wilson E.B. (1927) Probable inference, the law of succession, and statistical inference.
    """
    from scipy.special import ndtri

    share, n = np.asarray(share, float), np.asarray(n)
    z = float(ndtri(0.5 + CONFIDENCE / 2))
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = 1.0 + z**2 / n
        middle = (share + z**2 / (2 * n)) / weight
        half = z * np.sqrt(share * (1.0 - share) / n + z**2 / (4 * n**2)) / weight
    low, high = middle - half, middle + half
    # round-off reaches -1e-17 at a share of 0, and leaves 1e-17 there or 1 - 1e-16 at a share of 1
    low = np.where(share == 0.0, np.where(np.isnan(low), np.nan, 0.0), low)
    high = np.where(share == 1.0, np.where(np.isnan(high), np.nan, 1.0), high)
    return np.clip(low, 0.0, 1.0), np.clip(high, 0.0, 1.0)
