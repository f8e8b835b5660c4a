"""What an assessment finds about one item; page, terminal, CSV and words are views of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from shaketable.assess.profiles import Profile
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES, risk_class
from shaketable.inventory import Castors, Item
from shaketable.tilting import TiltCurves

FEWEST_RECORDINGS = 10  # with fewer nothing is classed
ENOUGH_RECORDINGS = 125  # zero falls of so many exclude RISK_CLASSES["low"]: Wilson's upper limit
ROLLS_FAR = 0.5  # m: what goes farther may hit somebody, or come off its hoses
NOT_CLASSED = "not classed"


class Share(NamedTuple):
    """A share in [0, 1] with its 95 % interval; NaN where it cannot be told."""

    value: float
    low: float
    high: float


class Quartiles(NamedTuple):
    """Observed values: a quarter, a half and three quarters of all are at most that large."""

    lower: float
    median: float
    upper: float


class CriterionResult(NamedTuple):
    """What a simple criterion says about an item."""

    share: float  # of the motions under which it says that the item may overturn
    missed: int  # simulated falls under motions that it calls safe


class FloorRatios(NamedTuple):
    """Mean overturning ratios by the formulas for floors."""

    kaneko_hayashi: float
    cimellaro: float
    cimellaro_out_of_range: float  # share of the motions


class Sliding(NamedTuple):
    """How far an item slides or rolls in the simulations that leave it upright."""

    share: float  # of all simulations: it stays upright and slides more than tilting.SLIDES
    slip: Quartiles  # m, the farthest in either direction; NaN if it always falls
    far: Share  # of all simulations: it stays upright and goes farther than ROLLS_FAR
    walks_off: float  # share of all simulations; NaN where the support's length is not known


class FrictionResult(NamedTuple):
    """What becomes of an item where friction may give way."""

    friction: float  # static and kinetic
    fall: Share
    slip: float  # m, median of the farthest where it stays upright


class LevelResult(NamedTuple):
    """What becomes of an item at one level of shaking, in the worse of its directions."""

    fall: Share
    concern: Share  # how often it falls, or, on castors, goes far


class Hold(NamedTuple):
    """The least horizontal force at a height that keeps an item from lifting, per mass [N/kg]."""

    height: float  # m
    median: float  # over the motions
    high: float  # 90 % of the motions need no more


def concern_of(item: Item, fall: Share, sliding: Sliding | None) -> Share:
    """How often an item falls, or, on castors, goes farther than ROLLS_FAR."""
    return max(fall, sliding.far) if item.rolls and sliding else fall


@dataclass(frozen=True, kw_only=True, eq=False)
class ProfileResult:
    """One direction of an item under the motions of its place.

    Attributes:
        profile: the item, seen in this direction.
        simulations: how many, with every motion in both senses.
        recordings: how many independent recordings the motions come from.
        falls, falls_downhill: how many of the simulations; downhill is toward -x.
        fall: share of the simulations that overturn it, with Wilson's interval.
        downhill: share of the falls that go downhill, with its interval by bootstrap, or Wilson's
            where all go one way; NaN where there are fewer than tilting.FEWEST_FALLS.
        peak_rotation: [rad]; a fall counts as π/2.
        sliding: None where the model does not slide.
    """

    profile: Profile
    simulations: int
    recordings: int
    falls: int
    falls_downhill: int
    fall: Share
    downhill: Share
    peak_rotation: Quartiles
    sliding: Sliding | None = None

    @property
    def concern(self) -> Share:
        """How often it falls, or, on castors, goes far."""
        return concern_of(self.profile.item, self.fall, self.sliding)


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult(ProfileResult):
    """One item under the motions of its place, in the direction in which it fares worse.

    Attributes:
        other: the other direction; None where it is not known, or alike.
        curves: shares over the tilts tried, with the tilt that controls the direction; None for
            what rolls.
        safe_width: base width from which on few simulations overturn it [m], NaN if there is none.
        criteria: results by the criterion's name; None on a tilted support and for what rolls, for
            which criteria do not hold.
        floor_ratios: likewise.
        frictions: with the general model in place of the rocking model.
        holds: forces at its top and at two thirds of its height; none for what rolls.
        levels: for each level of the assessment.
    """

    other: ProfileResult | None = None
    curves: TiltCurves | None = None
    safe_width: float = math.nan
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None
    frictions: Sequence[FrictionResult] = ()
    holds: Sequence[Hold] = ()
    levels: Sequence[LevelResult] = ()

    @property
    def item(self) -> Item:
        return self.profile.item

    @property
    def friction_decides(self) -> bool:
        """Whether a friction gives another share of falls, by more than the interval."""
        return any(self.differs(each) for each in self.frictions)

    def differs(self, other: FrictionResult) -> bool:
        """Whether a share with friction lies outside the interval without, or the reverse."""
        return not (
            self.fall.low <= other.fall.value <= self.fall.high
            and other.fall.low <= self.fall.value <= other.fall.high
        )

    @property
    def risk(self) -> str:
        """Risk class of Kaneko and Hayashi (2004), or NOT_CLASSED where nothing can be said.

        Of fewer than ENOUGH_RECORDINGS independent recordings the class is that of the share,
        of more that of its upper limit: so many can exclude falls. It is the worst of all
        frictions that make a difference.
        """
        item = self.item
        if self.recordings < FEWEST_RECORDINGS or item.rolls or item.castors is Castors.UNKNOWN:
            return NOT_CLASSED
        shares = [self.fall, *(each.fall for each in self.frictions if self.differs(each))]
        enough = self.recordings >= ENOUGH_RECORDINGS
        found = risk_class(max(share.high if enough else share.value for share in shares))
        lowest = next(iter(RISK_CLASSES))
        return NOT_CLASSED if found == lowest and not item.depth_known else found
