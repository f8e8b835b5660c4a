"""Risk over shape and acceleration (figure 6), and the polynomial of eq. 9 fitted to it (figures 7
and 8)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.outcome import Outcome
from shaketable.risk import TOLERANCE, compatible_motions
from shaketable.signal import peaks
from shaketable.simulate import simulate_many
from shaketable.units import CM, STANDARD_GRAVITY
from shaketable_studies.cimellaro_2020.floors import Channel

HEIGHTS = (0.5, 1.0, 1.8, 3.0)  # m; the paper does not say which it took
RATIOS = np.round(np.arange(0.10, 0.451, 0.025), 3)  # B/H
PFA_G = np.round(np.arange(0.1, 1.01, 0.1), 3)


def risk_surface(
    channels: Sequence[Channel], n: int, seed: int, done: Callable[[int], None]
) -> pd.DataFrame:
    """Direct integration and both formulas over height, B/H and PFA, one row each.

    Args:
        channels: the worst one of each building; its motions are scaled to each PFA.
        n: compatible motions for each.
        seed: of their phases.
    """
    bodies = [Body.rectangle(h * ratio, h) for h in HEIGHTS for ratio in RATIOS]
    height, ratio = (axis.ravel() for axis in np.meshgrid(HEIGHTS, RATIOS, indexing="ij"))
    parts = []
    for k, channel in enumerate(channels):
        motions = compatible_motions(channel.motion, n, seed + k, TOLERANCE, done)
        # the motions' own peaks, not the floor's: a spectrum from 0.05 s on does not fix them
        found = [peaks(motion) for motion in motions]
        peak_pfa = float(np.mean([peak.acceleration for peak in found]))
        peak_pfv = float(np.mean([peak.velocity for peak in found]))
        scales = PFA_G * STANDARD_GRAVITY / peak_pfa
        runs = simulate_many(bodies, motions, scales=scales, polarities=(1,), progress=done)
        falls = (runs.outcome != Outcome.STANDING).sum(["motion", "polarity", "tilt"]).values
        for j, scale in enumerate(scales):
            pfa, pfv = scale * peak_pfa, scale * peak_pfv
            parts.append(
                pd.DataFrame(
                    {
                        "building": channel.building,
                        "channel": channel.name,
                        "height_m": height,
                        "b_over_h": ratio,
                        "pfa_g": PFA_G[j],
                        "pfv_m_s": pfv,
                        "direct": falls[:, j] / n,
                        "simplified": kaneko_hayashi_2004.overturning_ratio(
                            height * ratio, height, pfa, pfv
                        ),
                        "formula": cimellaro_2020.overturning_ratio(ratio, pfa),
                    }
                )
            )
    return pd.concat(parts, ignore_index=True)


def simulations(channels: int, n: int) -> int:
    """How many motions are made and simulations run for so many channels."""
    return channels * n * (1 + len(HEIGHTS) * RATIOS.size * PFA_G.size)


def terms(ratio: NDArray[np.float64], pfa_g: NDArray[np.float64]) -> NDArray[np.float64]:
    """What the coefficients of eq. 9 are multiplied by, (..., 6)."""
    x, y = 1.0 / ratio, pfa_g * STANDARD_GRAVITY / CM
    return np.stack([np.ones_like(x), x, y, x**2, y**2, x * y], axis=-1)


def fit_surface(risks: pd.DataFrame) -> tuple[cimellaro_2020.Surface, pd.DataFrame, float]:
    """Fit eq. 9 to direct integration by ordinary least squares.

    Returns:
        the surface, its coefficients beside the printed ones with the standard errors of least
        squares, which treat every cell as independent and so are too small, and R².
    """
    direct = risks["direct"].to_numpy()
    given = terms(risks["b_over_h"].to_numpy(), risks["pfa_g"].to_numpy())
    inverse = np.linalg.pinv(given)
    found = inverse @ direct
    left = float(((direct - given @ found) ** 2).sum())
    variance = left / (direct.size - found.size)
    r_squared = 1.0 - left / float(((direct - direct.mean()) ** 2).sum())
    table = pd.DataFrame(
        {
            "coefficient": cimellaro_2020.Surface._fields,
            "printed": cimellaro_2020.PRINTED,
            "refit": found,
            "ols_standard_error": np.sqrt(variance * (inverse**2).sum(axis=1)),
        }
    )
    return cimellaro_2020.Surface(*map(float, found)), table, r_squared


def errors_by_order(risks: pd.DataFrame) -> pd.DataFrame:
    """How far polynomials of three orders are off buildings that they were not fitted to."""
    from sklearn.preprocessing import PolynomialFeatures

    inputs = np.stack([1.0 / risks["b_over_h"], risks["pfa_g"]], axis=1)
    direct, building = risks["direct"].to_numpy(), risks["building"].to_numpy()
    rows = []
    for order in (1, 2, 3):
        table = PolynomialFeatures(order).fit_transform(inputs)
        for name in dict.fromkeys(building):
            here = building == name
            found = np.linalg.lstsq(table[~here], direct[~here])[0] if (~here).any() else None
            if found is not None:
                off = np.clip(table[here] @ found, 0.0, 1.0) - direct[here]
                rows.append(
                    {"order": order, "building": name, "rms_off": float(np.sqrt((off**2).mean()))}
                )
    return pd.DataFrame(rows, columns=["order", "building", "rms_off"])


def errors_by_building(risks: pd.DataFrame) -> pd.DataFrame:
    """Of every building: how far the formulas are off, and how much eq. 9's error knows of size."""
    rows = []
    for name, here in risks.groupby("building", sort=False):
        off = here["formula"] - here["direct"]
        by_height = off.groupby(here["height_m"]).mean()
        rows.append(
            {
                "building": name,
                "formula_rms_off": float(np.sqrt((off**2).mean())),
                "simplified_rms_off": float(
                    np.sqrt(((here["simplified"] - here["direct"]) ** 2).mean())
                ),
                "spread_over_heights": float(by_height.max() - by_height.min()),
            }
        )
    return pd.DataFrame(rows)


def errors_by_height(risks: pd.DataFrame, refit: cimellaro_2020.Surface) -> pd.DataFrame:
    """How far each way is from direct integration, by height, which the formula does not know."""
    pfa = risks["pfa_g"].to_numpy() * STANDARD_GRAVITY
    fitted = cimellaro_2020.overturning_ratio(risks["b_over_h"].to_numpy(), pfa, refit)
    rows = []
    for height, here in [(0.0, np.ones(len(risks), bool)), *_by_height(risks)]:
        direct = risks["direct"].to_numpy()[here]
        row: dict[str, float] = {"height_m": height, "cases": int(here.sum())}
        for name, values in (
            ("simplified", risks["simplified"].to_numpy()),
            ("formula", risks["formula"].to_numpy()),
            ("refit", fitted),
        ):
            off = values[here] - direct
            row[f"{name}_mean_off"] = float(off.mean())
            row[f"{name}_rms_off"] = float(np.sqrt((off**2).mean()))
        rows.append(row)
    return pd.DataFrame(rows)


def _by_height(risks: pd.DataFrame) -> list[tuple[float, NDArray[np.bool_]]]:
    return [(h, (risks["height_m"] == h).to_numpy()) for h in HEIGHTS]
