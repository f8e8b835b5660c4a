"""The bookcase, and how it is shaken."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.models import General
from shaketable.resampling import interval, ratio
from shaketable.simulate import simulate_many
from shaketable.solid import Solid
from shaketable.surroundings import Strap, Surroundings, Wall
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.shaketable_2026_solids.setting import Pairs

WIDTH, DEPTH, HEIGHT, MASS = 0.32, 0.90, 1.80, 100.0  # m, kg
BOOKCASE = Solid.box(WIDTH, DEPTH, HEIGHT, mass=MASS, name="bookcase")
WEIGHT = MASS * STANDARD_GRAVITY
MODEL = General(static_friction=0.5)
SCALES = (1.0, 2.0)
FRICTION = 0.3  # of the wall
#: The wall stands toward +x: a fall is away from it where its azimuth is nearer to -x.
AWAY, NEAR_WALL = 1, -1


class Runs(NamedTuple):
    """One case, over (recording, scale, polarity).

    Attributes:
        away: fell away from the wall, or toward -x where there is none.
        toward: fell to its side.
        held_up: did not fall, and would without wall and strap.
        force: of a strap, by the weight; none without.
        broke: whether it broke; none without.
    """

    away: NDArray[np.bool_]
    toward: NDArray[np.bool_]
    held_up: NDArray[np.bool_]
    force: NDArray[np.float64] | None
    broke: NDArray[np.bool_] | None

    @property
    def fell(self) -> NDArray[np.bool_]:
        return self.away | self.toward


def wall_at(gap: float, restitution: float, vertical: bool = True) -> Wall:
    return Wall(gap=gap, restitution=restitution, friction=FRICTION, vertical=vertical)


def strap_of(stiffness: float, slack: float, anchor: float, strength: float = np.inf) -> Strap:
    """From the top of the back, level.

    Args:
        stiffness: by the mass [1/s²]; 1/s of damping by the mass goes with it.
        slack: [m].
        anchor: how far behind its point it ends [m].
        strength: by the weight.
    """
    return Strap(
        point=(WIDTH / 2, 0.0, HEIGHT),
        anchor=(WIDTH / 2 + anchor, 0.0, HEIGHT),
        stiffness=stiffness * MASS,
        slack=slack,
        damping=1.0 * MASS,
        strength=strength * WEIGHT,
    )


def shaken(
    pairs: Pairs,
    around: Surroundings | None,
    done: Callable[[int], None],
    *,
    tilt: float = 0.0,
    scales: tuple[float, ...] = SCALES,
) -> Runs:
    """The bookcase under all pairs and both polarities; tilted toward the wall [rad]."""
    found = simulate_many(
        [BOOKCASE], pairs.motions, model=MODEL, scales=scales, tilts=[tilt], azimuth=0.0,
        surroundings=around, progress=done,
    ).isel(body=0, tilt=0, orientation=0)  # fmt: skip
    found = found.transpose("motion", "scale", "polarity", ...)
    first = np.unique(pairs.recording, return_index=True)[1]
    outcome = found.outcome.values[first]
    straps = around.straps if around else ()
    # downhill is toward the wall, whatever the tilt
    return Runs(
        away=outcome == AWAY,
        toward=outcome == NEAR_WALL,
        held_up=found.held_up.values[first] if around else np.zeros(outcome.shape, np.bool_),
        force=found.strap_force.values[first, ..., 0] / WEIGHT if straps else None,
        broke=np.isfinite(found.strap_broke_at.values[first, ..., 0]) if straps else None,
    )


def simulations(pairs: int, scales: int = len(SCALES)) -> int:
    """Of one case."""
    return 2 * pairs * scales


def share_of(
    falls: NDArray[np.bool_] | NDArray[np.int64], pairs: Pairs
) -> tuple[float, float, float]:
    """The share of some falls, (recording, polarity), with its interval over earthquakes."""
    counts = falls.sum(axis=1).astype(np.float64)
    share = ratio(counts, np.full(counts.shape, falls.shape[1]), pairs.weights)
    low, high = interval(share[1:])
    return float(share[0]), float(low), float(high)
