"""How many overturn: in a plane under the stronger component, and in space under both."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.models import General
from shaketable.motion import Motion
from shaketable.resampling import interval, ratio
from shaketable.simulate import fell, simulate_many
from shaketable.solid import Solid
from shaketable_studies.shaketable_2026_solids.setting import (
    MODEL,
    SIZES,
    Pairs,
    components,
    cylinder,
    square,
)

ORIENTATIONS = np.radians([0.0, 22.5, 45.0, 67.5])
SCALES = (0.5, 1.0)
PLANAR = ("one component", "the stronger component", "either component")
SOLID = ("square", "round")
RATIOS = (
    ("square", PLANAR[0]), ("square", PLANAR[1]), ("square", PLANAR[2]), ("round", "square"),
)  # fmt: skip


class FallsByCase(NamedTuple):
    """How often each size falls under each recording at each scale, out of `simulations`.

    Attributes:
        name: of the case.
        falls: (size, recording, scale).
        simulations: of one size under one recording at one scale.
    """

    name: str
    falls: NDArray[np.int64]
    simulations: int

    @classmethod
    def of(cls, name: str, fallen: NDArray[np.bool_]) -> FallsByCase:
        """Counted over the last axis."""
        return cls(name, fallen.sum(axis=-1), fallen.shape[-1])


def simulations(pairs: int) -> int:
    """How many simulations `all_falls` runs."""
    each = len(SIZES) * pairs * len(SCALES)
    return int(each * (2 * 2 + 2 * ORIENTATIONS.size + 1))


def all_falls(pairs: Pairs, done: Callable[[int], None]) -> list[FallsByCase]:
    """Every case."""
    return [*of_planes(pairs, done, MODEL), *_solid(pairs, done)]


def of_planes(pairs: Pairs, done: Callable[[int], None], model: General) -> Iterator[FallsByCase]:
    """Rectangles under one component or the other."""
    both = components(pairs)
    bodies = [size.body for size in SIZES]
    one, other = (fallen(bodies, motions, pairs, done, model) for motions in both)
    peak = np.array([[np.abs(motion.horizontal).max() for motion in motions] for motions in both])
    first = (peak[0] >= peak[1])[motion_of_each(pairs)][:, None, None]
    yield FallsByCase.of(PLANAR[0], np.concatenate([one, other], axis=-1))
    yield FallsByCase.of(PLANAR[1], np.where(first, one, other))
    yield FallsByCase.of(PLANAR[2], one | other)


def motion_of_each(pairs: Pairs) -> NDArray[np.intp]:
    """The motion of each recording."""
    return np.unique(pairs.recording, return_index=True)[1]


def _solid(pairs: Pairs, done: Callable[[int], None]) -> Iterator[FallsByCase]:
    boxes, drums = ([make(size) for size in SIZES] for make in (square, cylinder))
    yield FallsByCase.of(SOLID[0], fallen(boxes, pairs.motions, pairs, done, MODEL, ORIENTATIONS))
    yield of_circles(drums, pairs, done, MODEL)


def of_circles(
    drums: Sequence[Solid], pairs: Pairs, done: Callable[[int], None], model: General
) -> FallsByCase:
    """Cylinders. Turned or reversed, a motion does the same to them on a level support."""
    once = np.zeros(1)
    return FallsByCase.of(
        SOLID[1], fallen(drums, pairs.motions, pairs, done, model, once, polarities=(1,))
    )


def fallen(
    bodies: Sequence[Body] | Sequence[Solid],
    motions: Sequence[Motion],
    pairs: Pairs,
    done: Callable[[int], None],
    model: General,
    orientations: ArrayLike = 0.0,
    polarities: Sequence[int] = (1, -1),
) -> NDArray[np.bool_]:
    """What overturns, (size, recording, scale, polarity and orientation)."""
    runs = simulate_many(
        bodies,
        motions,
        scales=SCALES,
        orientations=orientations,
        polarities=polarities,
        model=model,
        progress=done,
    )
    found = fell(runs).isel(tilt=0)
    repeats = [name for name in ("polarity", "orientation") if name in found.dims]
    ordered = found.transpose("body", "motion", "scale", *repeats).values
    ordered = ordered.reshape(*ordered.shape[:3], -1)
    return np.asarray(ordered[:, motion_of_each(pairs)])


def share_table(cases: list[FallsByCase], weights: NDArray[np.float64]) -> pd.DataFrame:
    """The share that overturns by case and scale, over all sizes and by size, with intervals."""
    rows = []
    for case in cases:
        for k, scale in enumerate(SCALES):
            parts = [("all", case.falls[:, :, k].mean(axis=0))]
            parts += [
                (size.body.name, each[:, k]) for size, each in zip(SIZES, case.falls, strict=True)
            ]
            for name, falls in parts:
                share = ratio(falls, np.full(falls.shape, case.simulations), weights)
                low, high = interval(share[1:])
                rows.append(
                    {
                        "case": case.name,
                        "scale": scale,
                        "size": name,
                        "fall_share": share[0],
                        "low": float(low),
                        "high": float(high),
                    }
                )
    return pd.DataFrame(rows)


def ratios(cases: list[FallsByCase], weights: NDArray[np.float64]) -> pd.DataFrame:
    """The share of each case over that of another, at each scale, with its interval."""
    return pd.DataFrame(ratio_rows(cases, weights, RATIOS))


def ratio_rows(
    cases: Sequence[FallsByCase], weights: NDArray[np.float64], compared: Sequence[tuple[str, str]]
) -> list[dict[str, object]]:
    """The rows of `ratios`, for pairs of names of cases."""
    by_name = {case.name: case for case in cases}
    rows: list[dict[str, object]] = []
    for one, other in compared:
        for k, scale in enumerate(SCALES):
            shares = [
                ratio(
                    case.falls[:, :, k].mean(axis=0),
                    np.full(case.falls.shape[1], case.simulations),
                    weights,
                )
                for case in (by_name[one], by_name[other])
            ]
            with np.errstate(invalid="ignore", divide="ignore"):
                quotient = shares[0] / shares[1]
            low, high = interval(quotient[1:])
            rows.append(
                {
                    "case": one,
                    "over": other,
                    "scale": scale,
                    "ratio": quotient[0],
                    "low": float(low),
                    "high": float(high),
                }
            )
    return rows
