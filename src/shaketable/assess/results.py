"""What an assessment finds about one item; page, terminal, CSV and words are views of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from shaketable.assess.classes import (
    CLASSES,
    FEW_FALLS,
    FEWEST_RECORDINGS,
    LOW,
    NOT_CLASSED,
    class_of,
)
from shaketable.assess.profiles import Profile
from shaketable.assess.shares import Quartiles, Share, apart
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.tilting import TiltCurves

ACCEPTED_FALLS = 0.10  # share of motions that may still overturn an object that has been made safer
REACHED = 0.9  # share of the simulations that a clearance must do for
ROLLS_FAR = 0.5  # m: what goes farther may hit somebody, or come off its hoses
SQUARE = 1.5  # a base is nearly square where one side is no longer than so many times the other


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
    reach: float  # m: it goes no farther in REACHED of those that leave it upright; NaN likewise
    far: Share  # of all simulations: it stays upright and goes farther than ROLLS_FAR
    falls_or_far: Share  # of all simulations: that, or it falls
    walks_off: float  # share of all simulations; NaN where the support's length is not known
    falls_or_off: Share  # of all simulations: it falls, or walks off a support of known length


class FrictionResult(NamedTuple):
    """What becomes of an item where friction may give way."""

    friction: float  # static and kinetic
    fall: Share
    slip: float  # m, median of the farthest where it stays upright
    falls_or_leans: Share | None = None  # of a solid in surroundings: as in SurroundedResult


class LevelResult(NamedTuple):
    """What becomes of an item at one level of shaking, in the worse of its directions."""

    fall: Share  # in three dimensions where that is known
    governing_share: (
        Share  # as `governing_share_of` says; the worse of a plane and three dimensions
    )


class Sides(NamedTuple):
    """Shares of the falls of a solid that go toward a side, within 45°; NaN without falls."""

    forward: float
    backward: float
    left: float  # of somebody who looks at its front
    right: float


class StrapForce(NamedTuple):
    """The largest force in any strap of an item over its weight, in each simulation."""

    median: float
    high: float  # STRAP_SHARE of the simulations ask for no more
    largest: float


class SurroundedResult(NamedTuple):
    """What the surroundings of an item do in three dimensions; none of it is counted as a fall.

    Attributes:
        leans: share of the simulations at whose end it stands, but leaning on a wall or in straps,
            or still swings in straps: it is no place to stand under.
        falls_or_leans: share of those in which it falls or ends leaning.
        force: of its straps; None where it has none.
        broke: share of the simulations in which a strap broke; None likewise.
        off: share of those in which it went over the edge of its support; None without an edge.
    """

    leans: Share
    falls_or_leans: Share
    force: StrapForce | None = None
    broke: Share | None = None
    off: Share | None = None


class StrapTrial(NamedTuple):
    """What becomes of an item in one strap, from the middle of its top, that does not break."""

    stiffness: float  # per mass of the item [1/s²]
    slack: float  # m
    fall: Share
    leans: Share  # as in SurroundedResult
    force: StrapForce


class SolidResult(NamedTuple):
    """What becomes of an item in three dimensions, shaken by both components at once.

    Attributes:
        simulations: how many, with every motion as recorded and reversed, in all turns.
        recordings: how many independent recordings the motions come from.
        falls: how many of the simulations.
        level: shares of falls, and of what is of concern.
        sides: where the falls go.
        turned: shares of falls, for each way in which it was turned to the motions.
        frictions: other frictions; of their slips the median distance at the end [m].
        moved: distance at the end from where it stood, where it stands [m].
        yaw: by how much it is turned at the end, where it stands [rad].
        not_settled: how many simulations ended while it still moved, and had not fallen.
        on_ground: whether it was simulated on the ground while it stands on a floor of a building,
            whose motions have one component: there it may fare worse.
        surrounded: what its surroundings do; None where it stands alone.
    """

    simulations: int
    recordings: int
    falls: int
    level: LevelResult
    sides: Sides
    turned: Sequence[Share]
    frictions: Sequence[FrictionResult]
    moved: Quartiles
    yaw: Quartiles
    not_settled: int
    on_ground: bool = False
    surrounded: SurroundedResult | None = None

    @property
    def fall(self) -> Share:
        """Share of the simulations that overturn it, with Wilson's interval."""
        return self.level.fall

    @property
    def falls_or_leans(self) -> Share:
        """The same, with those at whose end it leans on what surrounds it."""
        return self.surrounded.falls_or_leans if self.surrounded else self.fall

    @property
    def shares(self) -> list[Share]:
        """Of falls, and leaning; with other frictions, where these make a difference.

        Beside an edge all of them, as what cannot slide seldom comes there.
        """
        own = self.falls_or_leans
        others = [each.falls_or_leans or each.fall for each in self.frictions]
        edge = self.surrounded is not None and self.surrounded.off is not None
        return [own, *(each for each in others if edge or apart(each, own))]


class UncertainResult(NamedTuple):
    """What becomes of objects like an item, whose sizes and support are not known exactly."""

    kind: str  # of furniture, which says how uncertain it is
    fall: Share  # the probability of a fall under one of the motions
    by_object: float  # standard deviation of the share from object to object
    by_motion: float  # and from motion to motion

    @property
    def matters_more(self) -> str:
        """Whether the object or the motion makes the larger difference, if any does."""
        if self.by_object == self.by_motion:
            return "neither"
        return "object" if self.by_object > self.by_motion else "motion"


class AnchorForce(NamedTuple):
    """The least force along the support, at a height, that keeps a corner from lifting [N/kg]."""

    height: float  # m
    median: float  # over the motions
    high: float  # ANCHOR_SHARE of the motions need no more
    largest: float  # of all motions


def governing_share_of(item: Item, fall: Share, sliding: Sliding | None) -> Share:
    """The share that orders objects: of falls and of walking off, on castors also of going far."""
    if sliding is None:
        return fall
    return max(sliding.falls_or_far, sliding.falls_or_off) if item.rolls else sliding.falls_or_off


@dataclass(frozen=True, kw_only=True, eq=False)
class ProfileResult:
    """One direction of an item under the motions of its place.

    Attributes:
        profile: the item, seen in this direction.
        simulations: how many, with every motion as recorded and reversed.
        recordings: how many independent recordings the motions come from.
        falls, falls_downhill: how many of the simulations; downhill is toward -x.
        fall: share of the simulations that overturn it, with Wilson's interval.
        downhill: share of the falls that go downhill, with its interval by bootstrap, or Wilson's
            where all go one way; NaN where there are fewer than tilting.FEWEST_FALLS.
        peak_rotation: [rad]; a fall counts as π/2.
        safe_width: base width in this direction from which on few simulations overturn it [m], NaN
            if there is none or none was sought.
        sliding: None where the model does not slide.
        not_settled: how many simulations ended while it still moved, and had not fallen.
    """

    profile: Profile
    simulations: int
    recordings: int
    falls: int
    falls_downhill: int
    fall: Share
    downhill: Share
    peak_rotation: Quartiles
    safe_width: float = math.nan
    sliding: Sliding | None = None
    not_settled: int = 0

    @property
    def governing_share(self) -> Share:
        """What `governing_share_of` says."""
        return governing_share_of(self.profile.item, self.fall, self.sliding)


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult(ProfileResult):
    """One item under the motions of its place, in the direction in which it fares worse.

    Attributes:
        number: the item's place among those that were assessed, anchored ones included, from 1 on;
            by it results of an item are found again.
        other: the other direction; None where it is not known, or alike.
        friction: with which it was simulated; infinite where it cannot slide.
        curves: shares over the tilts tried, with the tilt that controls the direction; None for
            what rolls.
        locked: what rolls freely, if its castors were locked, at the worst of several frictions.
        criteria: results by the criterion's name; None on a tilted support and for what rolls, for
            which criteria do not hold.
        floor_ratios: likewise.
        frictions: other frictions, in the general model.
        rocking_friction: with which REACHED of the motions that rock it do so without sliding; NaN
            where none rocks it, and for what rolls.
        anchor_forces: at its top and at two thirds of its height.
        levels: for each level of the assessment.
        uncertain: the same for objects like it, if that was asked for; None for what rolls.
        solid: the same in three dimensions, with its surroundings; None where its base or the
            second component of the motions is not known.
        straps: what becomes of it in each of some straps; empty where it is not simulated in three
            dimensions, on castors, and where it has straps that do not break.
    """

    number: int = 0
    other: ProfileResult | None = None
    friction: float = math.inf
    curves: TiltCurves | None = None
    locked: ProfileResult | None = None
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None
    frictions: Sequence[FrictionResult] = ()
    rocking_friction: float = math.nan
    anchor_forces: Sequence[AnchorForce] = ()
    levels: Sequence[LevelResult] = ()
    uncertain: UncertainResult | None = None
    solid: SolidResult | None = None
    straps: Sequence[StrapTrial] = ()

    @property
    def item(self) -> Item:
        return self.profile.item

    @property
    def governing_3d(self) -> SolidResult | None:
        """The result in three dimensions, or None if it rests on too few recordings.

        Of fewer than FEWEST_RECORDINGS it counts only where the plane has no more either.
        """
        solid = self.solid
        enough = solid and solid.recordings >= min(FEWEST_RECORDINGS, self.recordings)
        return solid if enough else None

    @property
    def as_it_stands(self) -> SolidResult | None:
        """The result in three dimensions with its surroundings, which then decides alone.

        None where it has none, and where they are not known where it stands: in a plane every
        object is simulated alone.
        """
        solid = self.governing_3d
        return solid if solid and solid.surrounded and not solid.on_ground else None

    @property
    def _walks_off(self) -> list[Share]:
        """The share that falls or walks off, if the length of its support is known."""
        support = self.along_support
        known = support.profile.support_length is not None
        return [support.sliding.falls_or_off] if known and support.sliding else []

    @property
    def moves_on(self) -> bool:
        """Whether so many simulations ended while it moved that it gets no good class."""
        solid, each = self.governing_3d, []
        if self.as_it_stands is None:
            each.append(self.not_settled / self.simulations)
        if solid is not None:
            each.append(solid.not_settled / solid.simulations)
        return max(each) >= RISK_CLASSES[LOW]

    @property
    def left_alone(self) -> bool:
        """Whether some of what surrounds it was not simulated."""
        around = self.item.surroundings
        if around is None:
            return False
        lip = around.edge is not None and around.edge.lip > 0.0
        return self.as_it_stands is None or lip

    @property
    def overturns(self) -> Share:
        """The share that overturns it: in three dimensions, or in a plane if only that is known.

        Where three dimensions are known of the ground alone, the larger of both.
        """
        solid = self.governing_3d
        if solid is None:
            return self.fall
        return max(self.fall, solid.fall) if solid.on_ground else solid.fall

    @property
    def governing_share(self) -> Share:
        """The worse of both directions and of three dimensions, as `governing_share_of` says.

        Where it stands in surroundings three dimensions alone count, and walking off a support of
        known length, which they do not know.
        """
        if self.as_it_stands is not None:
            return max([self.as_it_stands.level.governing_share, *self._walks_off])
        sides = (self, self.along_support)
        found = [governing_share_of(side.profile.item, side.fall, side.sliding) for side in sides]
        return max(
            found
            if self.governing_3d is None
            else [*found, self.governing_3d.level.governing_share]
        )

    @property
    def ranking_share(self) -> Share:
        """What ranks the objects: their governing share, of uncertain objects where that is known.

        Where walking off is of concern too, which is known of the sizes as given alone, it is the
        larger of both.
        """
        if self.uncertain is None:
            return self.governing_share
        falls = self.uncertain.fall
        return falls if self.governing_share == self.fall else max(self.governing_share, falls)

    @property
    def along_support(self) -> ProfileResult:
        """The direction in which the length of its support is known, if it is in one."""
        other = self.other
        known = other is not None and other.profile.support_length is not None
        return other if other is not None and known else self

    @property
    def friction_decides(self) -> bool:
        """Whether a friction gives another share of falls, by more than the interval."""
        return any(self.differs(each) for each in self.frictions)

    def differs(self, other: FrictionResult) -> bool:
        """Whether another friction gives another share of falls, as `apart` says."""
        return apart(self.fall, other.fall)

    @property
    def falls_either_way(self) -> bool:
        """Whether it falls often in both directions, so that what helps in one does not do."""
        other = self.other
        return self.profile.alike or (other is not None and other.fall.value > ACCEPTED_FALLS)

    @property
    def plane_says_too_little(self) -> bool:
        """Whether it falls far more often in three dimensions, and these are not known.

        What is round, nearly square or on feet leaves the plane: it rolls on its rim or a corner.
        """
        return self.governing_3d is None and self.leaves_its_plane

    @property
    def base_holds_in_space(self) -> bool:
        """Whether the bases that were found in a plane do in three dimensions, as far as is known.

        Not of what is round, nor where it falls too often in three dimensions on a base as wide.
        """
        if (solid := self.governing_3d) is None:
            return True
        enough = [
            side.safe_width <= side.profile.body.width
            for side in (self, self.other)
            if side is not None
        ]
        falls = solid.fall.value > ACCEPTED_FALLS and any(enough)
        return self.item.shape is not BaseShape.CYLINDER and not falls

    @property
    def leaves_its_plane(self) -> bool:
        """Whether it is round, nearly square or on feet."""
        item, across = self.item, self.item.sideways
        if item.shape is not BaseShape.BOX or item.rolls:
            return True
        return (
            across is not None
            and max(across.width / item.body.width, item.body.width / across.width) <= SQUARE
        )

    @property
    def classed_by(self) -> int:
        """How many independent recordings its class rests on: the fewest of all that decide."""
        solid = self.governing_3d
        if self.as_it_stands is not None:
            return self.as_it_stands.recordings
        return self.recordings if solid is None else min(self.recordings, solid.recordings)

    @property
    def risk(self) -> str:
        """One of CLASSES, those of Kaneko and Hayashi (2004), or NOT_CLASSED.

        As `class_of` says, the worst of all frictions that make a difference, in a plane and in
        three dimensions. What walks off its support counts as fallen. What stands on castors is
        classed only if it falls. Nothing is classed while a column of the inventory that may speak
        of castors, anchors or shapes is not understood; what a plane says too little of, and what
        may be round, is classed only where no class is worse. No good class is given where that may
        be too good: on castors, of unknown depth, where simulations ended in motion, and to what
        leaves its plane on a floor whose motions have one component.

        In surroundings three dimensions decide alone, and leaning counts as falling; where some of
        what surrounds an object was not simulated, no good class is given.
        """
        item = self.item
        if self.classed_by < FEWEST_RECORDINGS or item.castors is Castors.UNKNOWN or item.unread:
            return NOT_CLASSED
        shares = []
        solid = self.governing_3d
        if self.as_it_stands is None:
            lost = [
                each.sliding.falls_or_off for each in (self, self.along_support) if each.sliding
            ]
            frictions = [each.fall for each in self.frictions if self.differs(each)]
            shares += [(each, self.recordings) for each in (self.fall, *lost, *frictions)]
        else:
            shares += [(each, self.recordings) for each in self._walks_off]
        if solid is not None:
            shares += [(each, solid.recordings) for each in solid.shares]
        worst = max((class_of(*each) for each in shares), key=CLASSES.index)
        unsure = item.rolls or not item.depth_known or self.moves_on
        unsure |= self.left_alone
        unsure |= solid is not None and solid.on_ground and self.leaves_its_plane
        if unsure and worst in (LOW, FEW_FALLS):
            return NOT_CLASSED
        too_little = self.plane_says_too_little or item.may_be_round
        too_little |= item.surroundings is not None and self.as_it_stands is None
        return NOT_CLASSED if too_little and worst != CLASSES[-1] else worst
