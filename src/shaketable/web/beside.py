"""What stands beside the one thing of the page, and what holds it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from shaketable.assess import DAMPING, STRAP_SHARE
from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.inventory import RESTITUTION
from shaketable.motion import Motion
from shaketable.solid import Solid
from shaketable.spelled_surroundings import BodyStrap, metres, surroundings_of
from shaketable.surroundings import Surroundings
from shaketable.units import STANDARD_GRAVITY
from shaketable.web.limits import LOUDEST_BESIDE
from shaketable.web.questions import Beside

MASS = 100.0  # kg of every thing: forces are told over its weight
WEIGHT = MASS * STANDARD_GRAVITY  # N


def around(
    beside: Beside | None, body: Body | Solid, orientation: float = 0.0
) -> Surroundings | None:
    """What surrounds a thing of MASS; None where nothing does.

    Args:
        beside: what was asked.
        body: of the thing.
        orientation: of a solid [rad]; what surrounds it turns with it.

    Raises:
        InputError: a lip without an edge.
    """
    if beside is None:
        return None
    straps = []
    if beside.strap_slack_mm is not None:
        stiffness = 1e3 * beside.strap_stiffness_kn_m
        slack = 1e-3 * beside.strap_slack_mm
        numbers = {"slack": slack, "stiffness": stiffness, "damping": DAMPING * MASS}
        straps = [BodyStrap(numbers)]
    return surroundings_of(
        body,
        orientation,
        straps=straps,
        wall_gap=metres(beside.wall_gap_mm),
        wall_restitution=None if beside.wall_gap_mm is None else RESTITUTION,
        edge=metres(beside.edge_mm),
        lip=metres(beside.lip_mm) if beside.lip_mm else None,
    )


def require_mild(beside: Beside | None, motions: Sequence[Motion], scale: float = 1.0) -> None:
    """InputError for motions so strong that one run of what bangs on something takes long."""
    if beside is None:
        return
    peak = scale * max(motion.peak_ground_acceleration for motion in motions) / STANDARD_GRAVITY
    if peak > LOUDEST_BESIDE:
        raise InputError(
            f"beside walls, straps and edges a motion of at most {LOUDEST_BESIDE:g} g is taken "
            f"here; this one reaches {peak:.3g} g"
        )


def strap_at(
    time: NDArray[np.float64], forces: NDArray[np.float64], at: NDArray[np.float64]
) -> list[float]:
    """The force of a strap over the weight at the pictures; empty without one.

    Args:
        time: of the samples [s], (n,).
        forces: of the straps [N], (n, strap).
        at: times of the pictures [s].
    """
    if not forces.shape[1]:
        return []
    return [round(float(force), 4) for force in np.interp(at, time, forces[:, 0]) / WEIGHT]


def count_of(runs: xr.Dataset, name: str) -> int:
    """How many have something that is told of bodies among surroundings, such as `held_up`."""
    return int(runs[name].sum()) if name in runs else 0


def strap_share_of(runs: xr.Dataset) -> float | None:
    """What the strap bears in STRAP_SHARE of the shakings, over the weight."""
    if "strap_force" not in runs:
        return None
    forces = runs.strap_force.values.max(axis=-1).ravel()
    return float(np.quantile(forces, STRAP_SHARE, method="inverted_cdf") / WEIGHT)
