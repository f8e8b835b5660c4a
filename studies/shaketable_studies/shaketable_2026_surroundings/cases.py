"""The cases, each a row of a table: walls, straps that hold, straps that break, and tilts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from shaketable.surroundings import Surroundings
from shaketable.units import radians
from shaketable_studies.shaketable_2026_solids.setting import Pairs
from shaketable_studies.shaketable_2026_surroundings.setting import (
    SCALES,
    Runs,
    shaken,
    share_of,
    simulations,
    strap_of,
    wall_at,
)

Done = Callable[[int], None]
GAPS = (0.0, 0.01, 0.05, 0.10)  # m
RESTITUTIONS = (0.0, 0.3, 0.7)
USUAL = 0.3  # restitution, where only one is asked
STIFFNESSES = (500.0, 2000.0)  # 1/s²: 50 and 200 kN/m for 100 kg
SLACKS = (0.0, 0.005, 0.020)  # m
STRENGTHS = (0.25, 0.5)  # of the weight
HELD_AT = (0.01, 0.05)  # m: gaps of the walls behind straps
QUANTILES = (0.5, 0.9, 0.99)
TILTS = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0)  # degrees, toward the wall
CATCHING = (0.01, 0.05, 0.20, 0.50)  # m: gaps of the walls toward which it is tilted


def counted(runs: Runs, free: Runs, k: int, pairs: Pairs) -> dict[str, Any]:
    """Numbers and shares of a case at one scale, and its change of the share against another."""
    fell, alone = runs.fell[:, k], free.fell[:, k]
    share, low, high = share_of(fell, pairs)
    _, change_low, change_high = share_of(fell.astype(np.int64) - alone, pairs)
    return {
        "runs": fell.size,
        "falls": int(fell.sum()),
        "fall_share": share,
        "low": low,
        "high": high,
        "away": int(runs.away[:, k].sum()),
        "to_the_wall": int(runs.toward[:, k].sum()),
        "held_up": int(runs.held_up[:, k].sum()),
        "saved": int((alone & ~fell).sum()),
        "harmed": int((fell & ~alone).sum()),
        "change_low": change_low,
        "change_high": change_high,
    }


def walls(pairs: Pairs, free: Runs, done: Done) -> pd.DataFrame:
    """Falls beside a wall, by gap, restitution and scale."""
    rows = [
        {"gap_mm": np.nan, "restitution": np.nan, "scale": scale, **counted(free, free, k, pairs)}
        for k, scale in enumerate(SCALES)
    ]
    for gap in GAPS:
        for restitution in RESTITUTIONS:
            runs = shaken(pairs, Surroundings(walls=(wall_at(gap, restitution),)), done)
            rows += [
                {"gap_mm": 1e3 * gap, "restitution": restitution, "scale": scale,
                 **counted(runs, free, k, pairs)}
                for k, scale in enumerate(SCALES)
            ]  # fmt: skip
    return pd.DataFrame(rows)


def straps(pairs: Pairs, free: Runs, done: Done) -> pd.DataFrame:
    """Forces that straps bear which do not break, behind walls and without one."""
    rows = []
    for gap in (None, *HELD_AT):
        for stiffness in STIFFNESSES:
            for slack in SLACKS:
                runs = _held(pairs, done, gap, stiffness, slack, np.inf)
                assert runs.force is not None
                for k, scale in enumerate(SCALES):
                    forces = np.quantile(runs.force[:, k], QUANTILES, method="higher")
                    rows.append(
                        {
                            "gap_mm": np.nan if gap is None else 1e3 * gap,
                            "stiffness_per_mass": stiffness,
                            "slack_mm": 1e3 * slack,
                            "scale": scale,
                            **{
                                f"force_{100 * q:g}": force
                                for q, force in zip(QUANTILES, forces, strict=True)
                            },
                            **counted(runs, free, k, pairs),
                        }
                    )
    return pd.DataFrame(rows)


def weak_straps(pairs: Pairs, done: Done) -> pd.DataFrame:
    """Falls with straps that may break, beside the same walls without one."""
    rows = []
    for gap in HELD_AT:
        bare = shaken(pairs, Surroundings(walls=(wall_at(gap, USUAL),)), done)
        for strength in STRENGTHS:
            for slack in SLACKS[::2]:
                runs = _held(pairs, done, gap, STIFFNESSES[0], slack, strength)
                assert runs.broke is not None
                rows += [
                    {"gap_mm": 1e3 * gap, "strength_of_weight": strength, "slack_mm": 1e3 * slack,
                     "scale": scale, "broke": int(runs.broke[:, k].sum()),
                     "falls_without": int(bare.fell[:, k].sum()), **counted(runs, bare, k, pairs)}
                    for k, scale in enumerate(SCALES)
                ]  # fmt: skip
    return pd.DataFrame(rows)


def _held(
    pairs: Pairs, done: Done, gap: float | None, stiffness: float, slack: float, strength: float
) -> Runs:
    beside = () if gap is None else (wall_at(gap, USUAL),)
    strap = strap_of(stiffness, slack, 0.05 if gap is None else gap, strength)
    return shaken(pairs, Surroundings(walls=beside, straps=(strap,)), done)


def tilts(pairs: Pairs, done: Done) -> pd.DataFrame:
    """What becomes of a bookcase that is tilted toward a wall, vertical or normal to its shelf."""
    rows = []
    for tilt in TILTS:
        free = shaken(pairs, None, done, tilt=radians(tilt))
        cases: list[tuple[str, float, Runs]] = [("none", np.nan, free)]
        for gap in CATCHING:
            for name, vertical in (("vertical", True), ("normal to the support", False)):
                around = Surroundings(walls=(wall_at(gap, USUAL, vertical),))
                cases.append((name, gap, shaken(pairs, around, done, tilt=radians(tilt))))
        rows += [
            {"tilt_deg": tilt, "wall": name, "gap_mm": 1e3 * gap, "scale": scale,
             **counted(runs, free, k, pairs)}
            for name, gap, runs in cases
            for k, scale in enumerate(SCALES)
        ]  # fmt: skip
    return pd.DataFrame(rows)


def count_all(pairs: int) -> int:
    """How many simulations all tables take."""
    held = (1 + len(HELD_AT)) * len(STIFFNESSES) * len(SLACKS)
    weak = len(HELD_AT) * (1 + len(STRENGTHS) * len(SLACKS[::2]))
    tilted = len(TILTS) * (1 + 2 * len(CATCHING))
    cases = 1 + len(GAPS) * len(RESTITUTIONS) + held + weak + tilted
    return simulations(pairs) * cases


def of_scale(table: pd.DataFrame, scale: float) -> pd.DataFrame:
    return table[table["scale"] == scale]
