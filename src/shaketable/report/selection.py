"""Selected motions as files: the selection, how near it came, and a picture."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from shaketable.hazard import Selection
from shaketable.motion import Motion
from shaketable.plot import plot_target
from shaketable.records.selected import HEADER, fingerprint
from shaketable.records.suites import info_of
from shaketable.report.results_folder import Picture, write_folder


def write_selection(
    selection: Selection,
    candidates: Sequence[tuple[str, Motion]],
    run: Mapping[str, object],
    folder: Path,
    *,
    units: str | None = None,
    time_step: float | None = None,
    overwrite: bool = False,
) -> None:
    """Write all the files of a selection, or none.

    Args:
        selection: what `select_motions` gives.
        candidates: the sources and motions that it chose from.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        units, time_step: that were said to read the sources.
    """
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    plot_target(selection.target, selection.ln_spectra, figure.subplots())
    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables={
            "selection": _rows(selection, candidates, folder, units, time_step),
            "match": match_table(selection),
        },
        pictures=[Picture("spectra", "", figure)],
    )


def _rows(
    selection: Selection,
    candidates: Sequence[tuple[str, Motion]],
    folder: Path,
    units: str | None,
    time_step: float | None,
) -> pd.DataFrame:
    """The selection as `suite` reads it, with where each motion comes from beside it."""
    rows = []
    for k, factor in zip(selection.chosen, selection.factors, strict=True):
        source, motion = candidates[k]
        origin = motion.origin
        where = source if info_of(source) else os.path.relpath(source, folder)
        sha256 = fingerprint(motion)
        told = (where, motion.name, f"{factor:.6g}", sha256, units or "", time_step or "")
        rows.append({
            **dict(zip(HEADER, told, strict=True)),
            "event": origin.event if origin else "",
            "station": origin.station if origin else "",
            "component": origin.component if origin else "",
        })  # fmt: skip
    return pd.DataFrame(rows)


def match_table(selection: Selection) -> pd.DataFrame:
    """The medians [m/s²] and standard deviations of ln wanted and found, a row for a period."""
    target = selection.target
    return pd.DataFrame({
        "period_s": target.periods,
        "median_wanted": np.exp(target.mean),
        "median_found": np.exp(selection.mean),
        "sigma_wanted": target.sigma,
        "sigma_found": selection.sigma,
    })  # fmt: skip
