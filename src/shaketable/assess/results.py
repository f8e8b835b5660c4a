"""The parts of what an assessment finds about one item."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import NamedTuple

from shaketable.assess.shares import Quartiles, Share, apart

ACCEPTED_FALLS = 0.10  # share of motions that may still overturn an object that has been made safer
REACHED = 0.9  # share of the simulations that a clearance must do for
ROLLS_FAR = 0.5  # m: what goes farther may hit somebody, or come off its hoses


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
    falls_or_held_up: Share | None = None  # of a solid in surroundings: as in SurroundedResult


class LevelResult(NamedTuple):
    """What becomes of an item at one level of shaking, in the worse of its directions."""

    fall: Share  # in three dimensions where that is known
    governing_share: Share  # as `governing_share_of` says


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
        held_up: share of the simulations in which it does not fall, and would, were it not for its
            wall or straps at the end: it is no place to stand under.
        falls_or_held_up: share of those in which it falls or is held up by them alone.
        force: of its straps; None where it has none.
        broke: share of the simulations in which a strap broke; None likewise.
        off: share of those in which it went over the edge of its support; None without an edge.
    """

    held_up: Share
    falls_or_held_up: Share
    force: StrapForce | None = None
    broke: Share | None = None
    off: Share | None = None


class MitigationKind(StrEnum):
    """What may be done about an object; its value is what the command line calls it."""

    STRAP = "strap"  # from the middle of its top, at its back or toward its wall
    TETHER = "tether"  # what stands on castors, by a strap above its centre of gravity
    LOCK = "lock"  # its castors
    BASE = "base"  # a larger one
    PAD = "pad"  # adhesive feet
    LOWER = "lower"  # its centre of gravity, by weight taken down
    WALL = "wall"  # moved back to a wall
    TURN = "turn"  # by 90°
    MOVE = "move"  # to the lowest floor
    TILT = "tilt"  # toward a wall, which catches it


class Mitigation(NamedTuple):
    """What becomes of an item after something is done about it, in three dimensions.

    Attributes:
        kind: what is done.
        about: its numbers, by their names with units; see `assess.mitigation`.
        simulations: how many.
        fall: share of them that overturn it.
        held_up: as in SurroundedResult.
        left: share in which it falls or is held up alone; on castors, or goes far.
        force: of its strap; None where none was added.
    """

    kind: MitigationKind
    about: Mapping[str, float]
    simulations: int
    fall: Share
    held_up: Share
    left: Share
    force: StrapForce | None = None

    @property
    def to_a_post(self) -> bool:
        """Whether it is a strap to a post or a ceiling, without a wall behind the object."""
        return self.force is not None and math.isnan(self.about["wall_gap_m"])


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
    surrounded: SurroundedResult | None = None

    @property
    def fall(self) -> Share:
        """Share of the simulations that overturn it, with Wilson's interval."""
        return self.level.fall

    @property
    def falls_or_held_up(self) -> Share:
        """The same, with those in which what surrounds it alone holds it up."""
        return self.surrounded.falls_or_held_up if self.surrounded else self.fall

    @property
    def shares(self) -> list[Share]:
        """Of what falls or is held up alone; with other frictions, where these make a difference.

        Beside an edge all of them, as what cannot slide seldom comes there.
        """
        own = self.falls_or_held_up
        others = [each.falls_or_held_up or each.fall for each in self.frictions]
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
