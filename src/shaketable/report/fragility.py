"""Fragility functions as files: a page with its figures, tables, and exports for loss tools."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from shaketable.errors import InputError, named
from shaketable.fragility import Curve, Fragility, pelicun
from shaketable.fragility.exported import demand_of, export_of
from shaketable.fragility.goodness import goodness
from shaketable.fragility.limit_states import OVERTURNS
from shaketable.fragility.lognormal import Points
from shaketable.fragility.shown import SHOWN, MeasureUnit, unit_shown
from shaketable.report.fragility_figures import figures
from shaketable.report.html import pages
from shaketable.report.results_folder import Picture, write_folder
from shaketable.report.words.numbers import counted

log = logging.getLogger(__name__)

NRML, PELICUN = "nrml", "pelicun"
#: Readers, with the units in which each takes measures.
EXPORTS = {NRML: (SHOWN, "OpenQuake"), PELICUN: (pelicun.UNITS, "pelicun")}
MOST_ROWS = 200
MOST_NAMED = 3
NOT_CONSIDERED = (
    "Bodies are planar and rigid, on a rigid support, under one horizontal component, as they "
    "are: what is not known of their sizes, friction or impacts may shift θ, and adds to β. An "
    "object that can fall to the front and to the side has a function for each direction: its "
    "loss counts once. The measure is that of the motion under the body's own support: on an "
    "upper floor that of the floor, not of the ground. Scaled motions keep their shape, which "
    "stronger earthquakes do not."
)
INTERVALS = (
    "Intervals are the basic limits of a bootstrap over earthquakes, and over the recordings of "
    "each."
)


def write_fragility(
    fragility: Fragility,
    measures: pd.DataFrame | None,
    residuals: pd.DataFrame | None,
    run: Mapping[str, object],
    folder: Path,
    *,
    exports: Sequence[str] = (),
    overwrite: bool = False,
) -> None:
    """Write all the files of fragility functions, or none.

    Args:
        fragility: what was found.
        measures, residuals: what `efficiency` and `residuals` give of the first body, or None.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        exports: of EXPORTS.

    Raises:
        InputError: costs in the folder that somebody has filled in would be lost.
    """
    pelicun.require_blank(folder)
    tables = {"functions": fragility.table()}
    if measures is not None:
        tables["measures"] = measures
    if residuals is not None:
        tables["residuals"] = residuals
    written: list[str] = []

    def export(fresh: Path) -> None:
        written.extend(name for name in exports if _exported(fragility, name, fresh))

    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables=tables,
        parquet=["functions"],
        pictures=(Picture(*each) for each in figures(fragility, measures, residuals)),
        page=lambda pictures: render(fragility, measures, run, pictures, written),
        others=export,
    )


def _exported(fragility: Fragility, reader: str, folder: Path) -> bool:
    """Whether there was anything to write for a reader; what is in the way is warned of."""
    try:
        if reader == NRML:
            fragility.to_nrml(folder / "fragility.xml")
        else:
            pelicun.write_into(folder, export_of(fragility))
    except InputError as error:
        log.warning("not exported for %s: %s", reader, error)
        return False
    return True


def render(
    fragility: Fragility,
    measures: pd.DataFrame | None,
    run: Mapping[str, object],
    pictures: Sequence[Mapping[str, str]],
    exports: Sequence[str],
) -> str:
    """The page; arguments as for `write_fragility`."""
    unit = unit_shown(fragility.measure)
    rows = [_row(curve, unit) for curve in fragility.curves]
    compared: list[dict[str, Any]] = []
    beside: list[str] = []
    if measures is not None:
        columns = [str(name) for name in measures.columns]
        beside = [name.removesuffix("_effect") for name in columns if name.endswith("_effect")]
        compared = [_measure_row(row, beside) for _, row in measures.iterrows()]
    return (
        pages()
        .get_template("fragility.html.j2")
        .render(
            title="Fragility functions of unanchored objects",
            lead=lead(fragility),
            messages=run.get("messages", ()),
            not_considered=NOT_CONSIDERED,
            unit=unit.name,
            measure=fragility.measure.name,
            rows=rows[:MOST_ROWS],
            count=len(rows),
            compared=compared,
            beside=beside,
            first=fragility.bodies[0],
            intervals=INTERVALS,
            exports=exports,
            pictures=pictures,
            method=method(fragility),
            run=run,
        )
    )


def lead(fragility: Fragility) -> list[str]:
    """The findings in sentences."""
    unit = unit_shown(fragility.measure)
    curve = fragility.curves[0]
    known = [one for one in fragility.curves if not one.problem]
    found = [
        f"{_of_all(len(known), len(fragility.curves))}, from "
        f"{counted(fragility.motions, 'motion')} of {counted(curve.recordings, 'recording')} of "
        f"{counted(curve.events, 'earthquake')}; {fragility.measure.name} is that "
        f"{demand_of(fragility)}."
    ]
    worst = [one for one in known if one.state.kind == OVERTURNS] or known
    worst.sort(key=lambda one: one.median)
    for one in worst[:MOST_NAMED]:
        found.append(
            f"{one.body.name or 'The body'} reaches “{one.state.name}” in half of the shakings at "
            f"{fragility.measure.name} {unit.factor * one.median:.3g} {unit.name}"
            f"{_interval(one, unit)}, with β {one.beta:.2f}."
        )
    if len(known) > MOST_NAMED:
        found.append(f"The other {len(known) - MOST_NAMED} functions are in the table.")
    without = [one for one in fragility.curves if one.problem]
    if without:
        who = named([f"{one.body.name or 'the body'} ({one.state.name})" for one in without], 3)
        found.append(f"No function can be told of {who}: the table says why.")
    return found


def _of_all(known: int, count: int) -> str:
    if known == count:
        return counted(count, "function")
    return f"{known or 'none'} of {counted(count, 'function')}"


def _directions(fragility: Fragility) -> str:
    both = {1.0, -1.0} == set(fragility.polarities)
    return "Each motion was used in both directions." if both else "Motions were used as given."


def _interval(curve: Curve, unit: MeasureUnit) -> str:
    low, high = (unit.factor * end for end in curve.median_interval)
    if not np.isfinite(low):
        return ", without an interval, as too few draws have a fit"
    return f" (95 % interval {low:.3g} to {high:.3g})"


def method(fragility: Fragility) -> list[str]:
    """How it was found, in paragraphs."""
    unit = unit_shown(fragility.measure)
    lowest = (
        "Each motion was scaled up in steps to the lowest level that overturns the body, to 1 %; "
        "the levels so found are a sample of the lognormal (Vamvatsikos and Cornell 2002). What a "
        "body survives above its lowest fall is left out, so that such functions lie to the left "
        "of those of all simulations"
    )
    how = {
        "cloud": "Every motion was scaled by "
        + ", ".join(f"{scale:.3g}" for scale in fragility.scales)
        + " and all simulations were fitted at once, each at its own intensity, by maximum "
        "likelihood (Baker 2015). Where the truth is not quite lognormal, such a fit depends on "
        "the levels: they are spread evenly in their logarithms, from where hardly anything "
        "happens to where everything does, or to 8.",
        "stripes": "Every motion was scaled to each of these levels of the measure: "
        + ", ".join(f"{unit.factor * level:.3g}" for level in fragility.scales)
        + f" {unit.name}. The shares that reach a state were fitted by maximum likelihood (Baker "
        "2015).",
        "ida": lowest + ".",
        "truncated ida": lowest + ", and of what is not overturned by the highest level that was "
        "looked at only that is known.",
    }
    return [
        how[fragility.method],
        *fragility.model.method,
        INTERVALS,
        f"{_directions(fragility)} θ is the median and β the standard deviation of "
        "the logarithm of the intensity at which the state is reached.",
    ]


def _row(curve: Curve, unit: MeasureUnit) -> dict[str, str]:
    low, high = (unit.factor * end for end in curve.median_interval)
    beta_low, beta_high = curve.beta_interval
    told = not curve.problem
    return {
        "body": curve.body.name or "the body",
        "state": curve.state.name,
        "median": f"{unit.factor * curve.median:.3g}" if told else "–",
        "median_interval": f"{low:.3g} to {high:.3g}" if told and np.isfinite(low) else "–",
        "beta": f"{curve.beta:.2f}" if told else "–",
        "beta_interval": f"{beta_low:.2f} to {beta_high:.2f}"
        if told and np.isfinite(beta_low)
        else "–",
        "curvature": _curvature(curve),
        "falls": f"{curve.falls[0]:,} / {curve.falls[1]:,}" if curve.falls else "–",
        "problem": curve.problem or curve.caution,
    }


def _curvature(curve: Curve) -> str:
    """The p-value of the truth being lognormal, where there are points that tell."""
    if curve.problem or not isinstance(curve.data, Points):
        return "–"
    return _p(goodness(curve).curvature_p)


def _p(value: float) -> str:
    if not np.isfinite(value):
        return "–"
    return "< 0.001" if value < 1e-3 else f"{value:.2g}"


def _measure_row(row: pd.Series[Any], beside: Sequence[str]) -> dict[str, Any]:
    return {
        "measure": str(row["measure"]),
        "dispersion": f"{row['dispersion']:.2f}",
        "interval": f"{row['dispersion_low']:.2f} to {row['dispersion_high']:.2f}",
        "more": f"{row['more_than_best']:.2f} ({row['more_low']:.2f} to {row['more_high']:.2f})",
        "effects": [f"{row[f'{name}_effect']:+.2f} ({_p(row[f'{name}_p'])})" for name in beside],
    }
