"""What an assessment finds about one item; page, terminal, CSV and words are views of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from shaketable.criteria.kaneko_hayashi_2004 import risk_class
from shaketable.inventory import Item
from shaketable.tilting import TiltCurves


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
    """How far an item slides in the simulations that leave it upright."""

    share: float  # of all simulations: it stays upright and slides more than tilting.SLIDES
    slip: Quartiles  # m, the farthest in either direction; NaN if it always falls
    walks_off: float  # share of all simulations; NaN where the support's length is not known


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult:
    """One item under the motions of its place.

    Attributes:
        item: what it is.
        simulations: how many, with every motion in both directions.
        recordings: how many independent recordings the motions come from.
        falls, falls_downhill: how many of the simulations.
        fall: share of the simulations that overturn it, with Wilson's interval.
        downhill: share of the falls that go downhill, with its interval by bootstrap; NaN where
            there are fewer than tilting.FEWEST_FALLS.
        peak_rotation: [rad]; a fall counts as π/2.
        curves: shares over the tilts tried, with the tilt that controls the direction.
        safe_width: base width from which on few simulations overturn it [m], NaN if there is none.
        criteria: results by the criterion's name; None on a tilted support, for which criteria
            do not hold.
        floor_ratios: likewise.
        sliding: None where the model does not slide.
    """

    item: Item
    simulations: int
    recordings: int
    falls: int
    falls_downhill: int
    fall: Share
    downhill: Share
    peak_rotation: Quartiles
    curves: TiltCurves
    safe_width: float
    criteria: Mapping[str, CriterionResult] | None = None
    floor_ratios: FloorRatios | None = None
    sliding: Sliding | None = None

    @property
    def risk(self) -> str:
        """Risk class of Kaneko and Hayashi (2004)."""
        return risk_class(self.fall.value)
