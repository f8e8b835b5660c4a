"""What an assessment finds of one item; page, terminal, CSV and words are views of it."""

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
    """What a simple criterion says of an item."""

    share: float  # of the motions under which it says that the item may overturn
    missed: int  # simulated falls under motions that it calls safe


class FloorRatios(NamedTuple):
    """Mean overturning ratios by formulas for floors."""

    kaneko_hayashi: float
    cimellaro: float
    cimellaro_out_of_range: float  # share of the motions


class Sliding(NamedTuple):
    """How far an item slides in the simulations that leave it upright."""

    share: float  # of all simulations: it stays upright and slides more than tilting.SLIDES
    slip: Quartiles  # m, the farthest in either direction; NaN of none
    walks_off: float  # share of all simulations; NaN where the support's length is not known


@dataclass(frozen=True, kw_only=True, eq=False)
class ItemResult:
    """One item under the motions of its place.

    Attributes:
        item: what it is.
        simulations: how many; every motion in both directions.
        recordings: how many independent ones the motions are of.
        falls, falls_downhill: of the simulations.
        fall: share of the simulations that overturn it, with Wilson's interval.
        downhill: share of the falls that go downhill, with its interval by bootstrap.
        peak_rotation: [rad]; a fall counts as π/2.
        curves: over the tilts tried, with the one that controls the direction.
        safe_width: base width from which on few overturn it [m], NaN if none does.
        criteria: by the criterion's name; None on a tilted support, which they do not know.
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
        """Class of Kaneko and Hayashi (2004)."""
        return risk_class(self.fall.value)
