"""Does Kaneko and Hayashi's switch make channels of one floor disagree?

Channels in one direction on a floor differ where the building twists. Buildings of several plans,
eccentricities and torsional frequencies are shaken by recorded pairs of components; on each floor
the channels at its edges give two ratios of one piece of furniture in one direction. If the switch
makes them disagree, they differ more where one is decided by the acceleration and the other by the
velocity than where both are decided by the same. Recorded floors with several channels in one
direction are compared in the same way.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004, shaketable_2026_floors
from shaketable.motion import Motion
from shaketable.resampling import interval, recordings_of, resamples
from shaketable.signal import Peaks, peaks
from shaketable.synthesis import TorsionalBuilding, edge_motions
from shaketable_studies.cimellaro_2020.floors import Channel

STOREYS = 3
PERIOD = 0.6  # s
PLANS = ((30.0, 15.0), (20.0, 20.0))  # m
ECCENTRICITIES = (0.05, 0.15)  # of both lengths
TORSIONAL_RATIOS = (0.8, 1.0, 1.4)
MOST_PAIRS = 12  # recordings
HEIGHTS = (1.0, 1.8)  # m of furniture with the recovered B/H
SAME = 0.1  # a spread below it is no disagreement
SPREADS = ("height_m", "mixes", "simplified_spread", "formula_spread", "logistic_spread")


def pairs_of(motions: Sequence[Motion]) -> list[tuple[Motion, Motion]]:
    """The first two components of each recording that has them with one time step."""
    found: dict[int, list[Motion]] = {}
    for recording, motion in zip(recordings_of(motions).tolist(), motions, strict=True):
        found.setdefault(recording, []).append(motion)
    return [
        (one[0], one[1])
        for one in found.values()
        if len(one) > 1 and one[0].time_step == one[1].time_step
    ]


def buildings() -> list[TorsionalBuilding]:
    """Every plan, eccentricity and torsional ratio."""
    return [
        TorsionalBuilding(
            storeys=STOREYS,
            first_period=PERIOD,
            plan=plan,
            eccentricity=(share, share),
            torsional_ratio=ratio,
            name=f"{plan[0]:g} m × {plan[1]:g} m, eccentricity {share:g}, Ω {ratio:g}",
        )
        for plan, share, ratio in itertools.product(PLANS, ECCENTRICITIES, TORSIONAL_RATIOS)
    ]


def simulations(motions: Sequence[Motion]) -> int:
    """How many buildings are shaken."""
    return len(buildings()) * min(MOST_PAIRS, len(pairs_of(motions)))


def edges(motions: Sequence[Motion], done: Callable[[int], None]) -> pd.DataFrame:
    """Two channels of one direction on every floor of every building, a row for each height.

    Ratios are Kaneko and Hayashi's with the recovered ζ_A, eq. 9 and this project's curve.
    """
    rows = []
    pairs = pairs_of(motions)
    chosen = pairs[:: max(1, len(pairs) // MOST_PAIRS)][:MOST_PAIRS]
    for building, (number, pair) in itertools.product(buildings(), enumerate(chosen)):
        found = edge_motions(building, *pair)
        measured = {(e.floor, e.direction, e.at): peaks(e.motion) for e in found}
        done(1)
        for floor, direction in itertools.product(range(1, STOREYS + 1), "xy"):
            ends = [measured[floor, direction, at] for at in "-+"]
            where = {
                "building": building.name,
                "recording": number,
                "motion": pair[0].name,
                "floor": floor,
                "direction": direction,
            }
            rows += [where | spreads(ends, height) for height in HEIGHTS]
    return pd.DataFrame(rows)


def recorded(channels: Sequence[Channel]) -> pd.DataFrame:
    """Every two channels of a recorded floor that face one way, or the opposite, for each height.

    Channels whose azimuth or floor is not known, those of the ground, and those of different
    earthquakes are not compared. A recording is a building in an earthquake.
    """
    found: dict[tuple[str, str, int, float], list[Channel]] = {}
    for channel in channels:
        origin = channel.motion.origin
        if origin is None or origin.azimuth is None or channel.storey < 1:
            continue
        key = (channel.building, origin.event, channel.storey, origin.azimuth % 180.0)
        found.setdefault(key, []).append(channel)
    shaken = list(dict.fromkeys(key[:2] for key in found))
    return pd.DataFrame(
        [
            {
                "building": key[0],
                "recording": shaken.index(key[:2]),
                "floor": key[2],
                "azimuth_deg": key[3],
                "channels": f"{one.name}, {other.name}",
            }
            | spreads([peaks(one.motion), peaks(other.motion)], height)
            for key, here in found.items()
            for one, other in itertools.combinations(here, 2)
            for height in HEIGHTS
        ],
        columns=["building", "recording", "floor", "azimuth_deg", "channels", *SPREADS],
    )


def spreads(pair: Sequence[Peaks], height: float) -> dict[str, object]:
    """By how much the ratios of furniture of one height differ between two channels of a floor."""
    ratio = kaneko_hayashi_2004.RECOVERED_RATIO
    pfa = np.array([one.acceleration for one in pair])
    pfv = np.array([one.velocity for one in pair])
    sizes = (height * ratio, height, pfa, pfv)
    a, v = kaneko_hayashi_2004.demands(*sizes)
    by_acceleration = a <= v
    risks = (
        kaneko_hayashi_2004.overturning_ratio(*sizes, zeta_a=kaneko_hayashi_2004.RECOVERED_ZETA_A),
        cimellaro_2020.overturning_ratio(ratio, pfa),
        shaketable_2026_floors.overturning_ratio(*sizes),
    )
    mixes = bool(by_acceleration.any() and not by_acceleration.all())
    apart = (float(np.ptp(np.asarray(risk))) for risk in risks)
    return dict(zip(SPREADS, (height, mixes, *apart), strict=True))


def difference(table: pd.DataFrame, seed: int = 0) -> tuple[float, float, float]:
    """Mean spread where the branches mix less the mean where they do not, with its interval.

    The interval is of a bootstrap over recordings; NaN where nothing mixes, or all do.
    """
    recording = table["recording"].to_numpy()
    spread, mixes = table["simplified_spread"].to_numpy(), table["mixes"].to_numpy()
    groups = (recording[:, None] == np.arange(recording.max() + 1)).astype(np.float64)

    def means(here: NDArray[np.bool_]) -> NDArray[np.float64]:
        total, count = (spread * here) @ groups, here.astype(np.float64) @ groups
        weights = resamples(groups.shape[1], seed=seed)
        with np.errstate(invalid="ignore"):
            return np.asarray((weights @ total) / (weights @ count))

    off = means(mixes) - means(~mixes)
    low, high = interval(off[1:])
    return float(off[0]), float(low), float(high)
