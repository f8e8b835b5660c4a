"""What an assessment finds about one item; page, terminal, CSV and words are views of it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from shaketable.assess.carried import Kick
from shaketable.assess.classes import (
    CLASSES,
    FEW_FALLS,
    FEWEST_RECORDINGS,
    LOW,
    NOT_CLASSED,
    class_of,
)
from shaketable.assess.profiles import Profile
from shaketable.assess.results import (
    ACCEPTED_FALLS,
    AnchorForce,
    CriterionResult,
    FloorRatios,
    FrictionResult,
    LevelResult,
    Mitigation,
    MitigationKind,
    Sliding,
    SolidResult,
    UncertainResult,
)
from shaketable.assess.shares import Quartiles, Share, apart
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.tilting import TiltCurves

CLEARLY = 0.5  # of what there was: what leaves less helps
MOSTLY = 0.75  # of what there was: what leaves more is no help, however sure that is
SQUARE = 1.5  # a base is nearly square where one side is no longer than so many times the other


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
        safe_base: base in this direction from which on few simulations overturn it [m], NaN
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
    safe_base: float = math.nan
    sliding: Sliding | None = None
    not_settled: int = 0

    @property
    def governing_share(self) -> Share:
        """What `governing_share_of` says."""
        return governing_share_of(self.profile.item, self.fall, self.sliding)


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult(ProfileResult):
    """One item under the motions of its place; what is planar, in the direction where it is worse.

    Where it was simulated in three dimensions these decide, and of the plane no share, class or
    order is taken; the plane is what simple criteria know, and what proposes measures.

    Attributes:
        number: the item's place among those that were assessed, anchored ones included, from 1 on;
            by it results of an item are found again.
        other: the other direction; None where it is not known, or alike.
        friction: with which it was simulated; infinite where it cannot slide.
        curves: shares over the tilts tried, with the tilt that controls the direction; None for
            what rolls, and where none was sought.
        locked: what rolls freely, if its castors were locked, at the worst of several frictions;
            None where three dimensions decide.
        criteria: results by the criterion's name; None on a tilted support and for what rolls, for
            which criteria do not hold.
        floor_ratios: likewise.
        frictions: other frictions, in the general model; none where three dimensions decide.
        rocking_friction: with which REACHED of the motions that rock it do so without sliding; NaN
            where none rocks it, for what rolls, and where three dimensions decide.
        anchor_forces: at its top and at two thirds of its height.
        levels: for each level of the assessment.
        uncertain: the same for objects like it, if that was asked for; None for what rolls.
        solid: the same in three dimensions, with its surroundings; None where its base or the
            second component of the motions is not known.
        mitigations: what becomes of it after something is done about it, in three dimensions.
        kick: what the furniture does to it on which it stands, where the list has that.
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
    mitigations: Sequence[Mitigation] = ()
    kick: Kick | None = None

    @property
    def item(self) -> Item:
        return self.profile.item

    @property
    def as_it_stands(self) -> SolidResult | None:
        """The result in three dimensions where it was simulated with its surroundings."""
        return self.solid if self.solid and self.solid.surrounded else None

    @property
    def straps(self) -> list[Mitigation]:
        """The straps that were tried on it, and what they bear."""
        return [each for each in self.mitigations if each.force is not None]

    @property
    def tried(self) -> list[Mitigation]:
        """One measure of each kind, the one that leaves most; those that leave least come first.

        Of straps those beside a wall count, where some were tried: what they hold is told of these.
        """
        walled = {each.kind for each in self.straps if not each.to_a_post}
        worst: dict[MitigationKind, Mitigation] = {}
        for each in self.mitigations:
            if each.to_a_post and each.kind in walled:
                continue
            known = worst.get(each.kind)
            if known is None or self._order(each) > self._order(known):
                worst[each.kind] = each
        return sorted(worst.values(), key=self._order)

    @property
    def at_a_wall(self) -> Share | None:
        """What is left of its share against a wall, where that was tried; None if it was not."""
        found = [each.left for each in self.mitigations if each.kind is MitigationKind.WALL]
        return max(found, default=None)

    def _order(self, each: Mitigation) -> tuple[Share, Share]:
        return each.left, each.held_up

    @property
    def before(self) -> Share:
        """What measures are compared with: as `Mitigation.left`, without any."""
        return self.solid.level.governing_share if self.solid else self.overturns

    @property
    def helpful(self) -> list[Mitigation]:
        """Of those that were tried what leaves clearly less, and not clearly more falls.

        They are simulated in a quarter of the ways in which the item stands to the motions, the
        first of these in half: what leaves less than half is no chance of these, nor what leaves
        MOSTLY and an interval below what there is.
        """
        now = self.before.value

        def helps(each: Mitigation) -> bool:
            left = each.left
            clearly = self.halved_by(each) or (left.high < now and left.value < MOSTLY * now)
            trips = each.fall > self.overturns and apart(each.fall, self.overturns)
            return clearly and not trips

        return [each for each in self.tried if helps(each)]

    def halved_by(self, measure: Mitigation) -> bool:
        """Whether a measure leaves less than half of what there is."""
        return measure.left.value < CLEARLY * self.before.value

    @property
    def goes_far(self) -> float:
        """Share of simulations in which, on castors, it goes far and stays upright.

        Of three dimensions where these decide.
        """
        if self.solid is not None:
            return self.solid.level.governing_share.value - self.solid.falls_or_held_up.value
        return self.sliding.far.value if self.sliding else 0.0

    @property
    def walks_off(self) -> list[Share]:
        """The share that falls or walks off in a plane, if the length of its support is known."""
        support = self.along_support
        known = support.profile.support_length is not None
        return [support.sliding.falls_or_off] if known and support.sliding else []

    @property
    def moves_on(self) -> bool:
        """Whether so many simulations ended while it moved that it gets no good class.

        What swings at a wall or in straps is judged by whether these alone hold it up.
        """
        around = self.item.surroundings
        if self.as_it_stands and around and (around.walls or around.straps):
            return False
        found = self.solid or self
        return found.not_settled / found.simulations >= RISK_CLASSES[LOW]

    @property
    def left_alone(self) -> bool:
        """Whether some of what surrounds it was not simulated."""
        return self.item.surroundings is not None and self.as_it_stands is None

    @property
    def overturns(self) -> Share:
        """The share that overturns it: in three dimensions, or in a plane if only that is known."""
        return self.solid.fall if self.solid else self.fall

    @property
    def by(self) -> int:
        """How many independent recordings its share and its class rest on."""
        return self.solid.recordings if self.solid else self.recordings

    @property
    def governing_share(self) -> Share:
        """What orders objects, as `governing_share_of` says.

        Walking off a support of known length, which is known of the plane, counts if it is more.
        """
        if self.solid:
            return max([self.solid.level.governing_share, *self.walks_off])
        sides = (self, self.along_support)
        return max(governing_share_of(side.profile.item, side.fall, side.sliding) for side in sides)

    @property
    def ranking_share(self) -> Share:
        """What ranks the objects: the governing share, or that of uncertain objects if more."""
        if self.uncertain is None:
            return self.governing_share
        return max(self.governing_share, self.uncertain.fall)

    @property
    def along_support(self) -> ProfileResult:
        """The direction in which the length of its support is known, if it is in one."""
        other = self.other
        known = other is not None and other.profile.support_length is not None
        return other if other is not None and known else self

    @property
    def friction_decides(self) -> bool:
        """Whether a friction gives another share of falls in a plane, by more than the interval."""
        return any(self.differs(each) for each in self.frictions)

    def differs(self, other: FrictionResult) -> bool:
        """Whether another friction gives another share of falls, as `apart` says."""
        return apart(self.fall, other.fall)

    @property
    def shares(self) -> list[Share]:
        """Of what falls or is held up alone: its own, and with other frictions that differ."""
        if self.solid:
            return self.solid.shares
        return [self.fall, *(each.fall for each in self.frictions if self.differs(each))]

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
        return self.solid is None and self.leaves_its_plane

    @property
    def leaves_its_plane(self) -> bool:
        """Whether it is round, nearly square or on feet."""
        item, across = self.item, self.item.sideways
        if item.shape is not BaseShape.BOX or item.rolls:
            return True
        return (
            across is not None
            and max(across.base / item.body.base, item.body.base / across.base) <= SQUARE
        )

    @property
    def risk(self) -> str:
        """One of CLASSES, those of Kaneko and Hayashi (2004), or NOT_CLASSED.

        As `class_of` says, the worst of all frictions that make a difference: in three dimensions,
        with what surrounds it, where what that alone holds up counts as fallen; in a plane if only
        that is known. What walks off its support counts as fallen. What stands on castors is
        classed only if it falls. Nothing is classed while a column of the inventory that may speak
        of castors, anchors or shapes is not understood; what a plane says too little of, and what
        may be round, is classed only where no class is worse. No good class is given where that may
        be too good: on castors, of unknown depth, where simulations ended in motion, and where some
        of what surrounds it was not simulated. What stands on furniture has no class.
        """
        item = self.item
        if self.by < FEWEST_RECORDINGS or item.castors is Castors.UNKNOWN or item.unread:
            return NOT_CLASSED
        if item.stands_on:
            return NOT_CLASSED
        shares = [*self.shares, *self.walks_off]
        if self.solid is None and self.sliding:
            shares.append(self.sliding.falls_or_off)
        worst = max((class_of(each, self.by) for each in shares), key=CLASSES.index)
        unsure = item.rolls or not item.depth_known or self.moves_on or self.left_alone
        if unsure and worst in (LOW, FEW_FALLS):
            return NOT_CLASSED
        too_little = self.plane_says_too_little or item.may_be_round
        too_little |= item.surroundings is not None and self.as_it_stands is None
        return NOT_CLASSED if too_little and worst != CLASSES[-1] else worst
