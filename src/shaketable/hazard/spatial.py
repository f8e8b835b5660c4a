"""How many pieces fall in all: places of one earthquake are shaken alike.

What the shaking of a place departs from its median by has a part that all places of the earthquake
share, and one that near places share: their correlation falls with the distance h as exp(-3h/b).
What an object withstands of one measure departs from the median of its function from motion to
motion, too: for alike objects at a place together, for others there in part, and alike at near
places.

Jayaram N., Baker J.W. (2009) Correlation model for spatially distributed ground-motion intensities,
Earthquake Eng. Struct. Dyn. 38(15):1687-1708, eqs. 18 to 20: b [km] for sites on similar ground.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.resampling import ends

#: Share of the variance that all places have in common: τ²/(τ² + φ²) of PGV in BSSA14, M 5.5 on.
EVENT_SHARE = 0.3
#: Share of β² that different kinds at a place have in common, and near places with them: the median
#: correlation of what the example hospital's kinds withstand (`python -m benchmarks.scenario`).
COMMON = 0.7
DRAWS = 500
MOST_NODES = 1500  # places that are drawn by themselves; more of them are put together
KM_PER_DEGREE = 111.2
PGV_PERIOD = 1.0  # s: the peak velocity is correlated like the spectral acceleration there


class Fall(NamedTuple):
    """Pieces of one kind at one place.

    Attributes:
        place: its number.
        quantity: of pieces.
        median, beta: of its fragility function [SI].
    """

    place: int
    quantity: int
    median: float
    beta: float


def correlation_length(measure: str) -> float:
    """The distance b [km] at which the correlation of PGA, PGV or SA(T) has fallen to 5 %."""
    period = {"PGA": 0.0, "PGV": PGV_PERIOD}.get(measure)
    if period is None:
        period = float(measure[3:-1])
    return 40.7 - 15.0 * period if period < 1.0 else 22.0 + 3.7 * period


def residuals(
    sites: NDArray[np.float64],
    measure: str,
    draws: int,
    random: np.random.Generator,
    *,
    event_share: float = EVENT_SHARE,
) -> NDArray[np.float64]:
    """Departures of ln shaking from its median in standard deviations, (draw, site).

    Args:
        sites: longitudes and latitudes [degrees], (site, 2).
        measure: PGA, PGV or SA(T).
        draws: how many earthquakes.
        random: generator.
        event_share: of the variance, which all sites have in common.
    """
    nodes, of_site = _nodes(sites)
    lat = np.radians(nodes[:, 1])
    east = np.subtract.outer(nodes[:, 0], nodes[:, 0])
    east = (east + 180.0) % 360.0 - 180.0  # the shorter way round
    north = np.subtract.outer(nodes[:, 1], nodes[:, 1])
    distance = KM_PER_DEGREE * np.hypot(east * np.cos(lat.mean()), north)
    within = np.exp(-3.0 * distance / correlation_length(measure))
    root = np.linalg.cholesky(within + 1e-9 * np.eye(len(nodes)))
    event = random.standard_normal((draws, 1))
    near = random.standard_normal((draws, len(nodes))) @ root.T
    found = np.sqrt(event_share) * event + np.sqrt(1.0 - event_share) * near
    return np.asarray(found[:, of_site])


def _nodes(
    sites: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Sites that are drawn, (node, 2), and the node of each site: near ones are put together."""
    cell = 0.001  # degrees, 0.1 km
    while True:
        nodes, of_site = np.unique(np.round(sites / cell) * cell, axis=0, return_inverse=True)
        if len(nodes) <= MOST_NODES:
            return nodes, of_site.reshape(-1)
        cell *= 2.0


def total_falls(
    falls: Sequence[Fall],
    shaken: Sequence[tuple[float, float]],
    sites: Sequence[tuple[float, float] | None],
    measure: str,
    *,
    draws: int = DRAWS,
    seed: int = 0,
) -> tuple[float, float]:
    """The 95 % range of how many pieces fall in all, from earthquake to earthquake.

    A piece falls where the shaking of its place is above what it withstands there. As one motion
    shakes all that stands at a place, alike pieces there fall together.

    Args:
        falls: what stands where.
        shaken: mean and standard deviation of ln of the measure of each place [SI].
        sites: longitude and latitude of each place; where one is None, all are one site.
        measure: PGA, PGV or SA(T).
        draws: how many earthquakes.
        seed: of them.
    """
    random = np.random.default_rng(seed)
    known = [site for site in sites if site is not None]
    where = np.array(known) if len(known) == len(sites) else np.zeros((len(sites), 2))
    z = residuals(where, measure, draws, random)
    withstood = residuals(where, measure, draws, random, event_share=0.0)
    mean, sigma = np.array(shaken).T
    alike: Mapping[tuple[int, float, float], int] = _counted(falls)
    place = np.array([key[0] for key in alike], np.intp)
    median, beta = np.array([key[1:] for key in alike]).T
    quantity = np.array(list(alike.values()), np.float64)
    shared, own = np.sqrt(COMMON), np.sqrt(1.0 - COMMON)
    totals = np.empty(draws)
    for d in range(draws):
        deviate = shared * withstood[d, place] + own * random.standard_normal(place.size)
        fell = (mean + sigma * z[d])[place] > np.log(median) + beta * deviate
        totals[d] = quantity @ fell
    low, high = ends(totals)
    return low, high


def _counted(falls: Sequence[Fall]) -> dict[tuple[int, float, float], int]:
    """Pieces of the same function at the same place."""
    found: dict[tuple[int, float, float], int] = {}
    for one in falls:
        key = (one.place, one.median, one.beta)
        found[key] = found.get(key, 0) + one.quantity
    return found
