"""Simulations of profiles with one scale and model: what falls, and how far it slides."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from shaketable.assess.item_result import ProfileResult, governing_share_of
from shaketable.assess.profiles import Profile
from shaketable.assess.results import REACHED, ROLLS_FAR, Sliding
from shaketable.assess.shares import Share, observed, observed_quartiles, share_of
from shaketable.engine.endings import Ending
from shaketable.outcome import Outcome
from shaketable.simulate import ShakingSet, count_by_recording, simulated
from shaketable.tilting import SLIDES, TiltCounts, downhill_interval, downhill_share

S = TypeVar("S")
T = TypeVar("T")
Done = Callable[[int], None]


def uncounted(more: int) -> None:
    """In place of a Done, for a plane beside solids: it is a hundred times as quick."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ProfileRuns:
    """Simulations of one profile.

    Attributes:
        counts: outcomes by recording, of one body on one tilt.
        peak_rotation: [rad], (simulation,); both polarities of a motion are side by side.
        stands: whether the body is upright at the end, likewise.
        settled: whether it has fallen, or come to rest, when the run ends, likewise.
        slip_downhill, slip_uphill: farthest slip [m], both >= 0; None where the model does not
            slide.
    """

    counts: TiltCounts
    peak_rotation: NDArray[np.float64]
    stands: NDArray[np.bool_]
    settled: NDArray[np.bool_]
    slip_downhill: NDArray[np.float64] | None
    slip_uphill: NDArray[np.float64] | None

    @property
    def falls(self) -> int:
        return int((~self.stands).sum())

    @property
    def fall(self) -> Share:
        """Share of the simulations that overturn it."""
        return share_of(~self.stands, self.counts.recordings)

    def sliding(self, profile: Profile) -> Sliding | None:
        """How far it slides; None where the model does not slide."""
        if self.slip_downhill is None or self.slip_uphill is None:
            return None
        recordings = self.counts.recordings
        return sliding_of(profile, self.stands, self.slip_downhill, self.slip_uphill, recordings)

    def governing_share(self, profile: Profile) -> Share:
        """What `governing_share_of` says."""
        return governing_share_of(profile.item, self.fall, self.sliding(profile))


def run_profiles(profiles: Sequence[Profile], trial: ShakingSet, done: Done) -> list[ProfileRuns]:
    """Simulate profiles on their own tilts.

    Args:
        profiles: some.
        trial: motions, their scale, and the model.
        done: is told how many more simulations were made.
    """

    def run(some: list[Profile]) -> list[ProfileRuns]:
        tilt = some[0].tilt
        runs = trial.run([profile.body for profile in some], [tilt], done)
        names = ["peak_rotation", "outcome", "ending"]
        if trial.model.slides:
            names += ["slip_downhill", "slip_uphill"]
        each = {name: simulated(runs[name])[:, 0] for name in names}
        counts = TiltCounts.of(np.array([tilt]), count_by_recording(runs, trial.recording))
        return [
            ProfileRuns(
                counts=counts.body(k),
                peak_rotation=each["peak_rotation"][k],
                stands=each["outcome"][k] == Outcome.STANDING,
                settled=np.isin(each["ending"][k], (Ending.STANDING, Ending.OVERTURNED)),
                slip_downhill=each["slip_downhill"][k] if trial.model.slides else None,
                slip_uphill=each["slip_uphill"][k] if trial.model.slides else None,
            )
            for k in range(len(some))
        ]

    return grouped(profiles, lambda profile: profile.tilt, run)


def grouped(
    things: Sequence[S], key: Callable[[S], Hashable], run: Callable[[list[S]], Sequence[T]]
) -> list[T]:
    """What `run` gives for things, profiles mostly, that have the same key, in the order of all."""
    groups: dict[Hashable, list[int]] = {}
    for k, thing in enumerate(things):
        groups.setdefault(key(thing), []).append(k)
    found: dict[int, T] = {}
    for members in groups.values():
        found |= dict(zip(members, run([things[k] for k in members]), strict=True))
    return [found[k] for k in range(len(things))]


def result_of(profile: Profile, now: ProfileRuns, draws: NDArray[np.float64]) -> ProfileResult:
    """What the simulations of a profile say, with `draws` as `resamples` gives them."""
    shares = downhill_share(now.counts, draws)
    low, high = downhill_interval(now.counts, shares)
    return ProfileResult(
        profile=profile,
        simulations=now.stands.size,
        recordings=now.counts.recordings,
        falls=now.falls,
        falls_downhill=int(now.counts.downhill.sum()),
        fall=now.fall,
        downhill=Share(*(float(each[0, 0]) for each in (shares[0], low, high))),
        peak_rotation=observed_quartiles(now.peak_rotation),
        sliding=now.sliding(profile),
        not_settled=int((~now.settled).sum()),
    )


def sliding_of(
    profile: Profile,
    stands: NDArray[np.bool_],
    slip_downhill: NDArray[np.float64],
    slip_uphill: NDArray[np.float64],
    recordings: int,
) -> Sliding:
    """Sliding of a profile in the simulations in which it stays upright.

    An item that falls also slips as it falls, and that does not count.

    Args:
        profile: the item in one direction.
        stands: whether it is upright at the end, (simulation,).
        slip_downhill, slip_uphill: farthest slip [m], both >= 0, (simulation,).
        recordings: how many independent ones the simulations come from.
    """
    farthest = np.maximum(slip_downhill, slip_uphill)
    left, right = room(profile)
    off = stands & ((slip_downhill > left) | (slip_uphill > right))
    return Sliding(
        share=float((stands & (farthest > SLIDES)).mean()),
        slip=observed_quartiles(farthest[stands]),
        reach=observed(farthest[stands], REACHED),
        far=share_of(stands & (farthest > ROLLS_FAR), recordings),
        falls_or_far=share_of(~stands | (farthest > ROLLS_FAR), recordings),
        walks_off=np.nan if np.isnan(left) else float(off.mean()),
        falls_or_off=share_of(~stands | off, recordings),  # nothing compares as off without length
    )


def room(profile: Profile) -> tuple[float, float]:
    """How far it may slide downhill and uphill [m] before its centre of gravity passes the edge.

    Its base starts in the middle of the support. NaN where the support's length is not known.
    """
    if profile.support_length is None:
        return np.nan, np.nan
    off_centre = profile.body.left - profile.body.base / 2
    return profile.support_length / 2 + off_centre, profile.support_length / 2 - off_centre
