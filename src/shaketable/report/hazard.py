"""How often a year objects fall, as files: a page with figures, and tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from shaketable.fragility.shown import unit_shown
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.totals import LossTotals
from shaketable.plot import plot_hazard, plot_levels, plot_losses
from shaketable.report.html import pages
from shaketable.report.results_folder import Picture, write_folder
from shaketable.report.words.hazard import (
    NOT_CONSIDERED,
    amount,
    chance,
    note,
    of_inventory,
    of_totals,
    once_in,
    where,
)

MOST_ROWS = 200
MOST_DRAWN = 6


def write_hazard(
    rates: ObjectRates,
    totals: LossTotals | None,
    years: float,
    run: Mapping[str, object],
    folder: Path,
    *,
    exports: Callable[[Path], object] | None = None,
    overwrite: bool = False,
) -> None:
    """Write all the files of the rates of an inventory, or none.

    Args:
        rates: what `object_rates` gives.
        totals: what `loss_totals` gives of them; None where no object has a function.
        years: for which probabilities are told.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
        exports: writes jobs of loss tools into the folder that it is given.
    """
    tables = {"rates": rates.table(years), "levels": levels_table(rates)}
    if totals is not None:
        tables |= {"totals": totals.table(), "loss_curve": totals.curve_table()}
    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables=tables,
        pictures=(Picture(*each) for each in _figures(rates, totals)),
        page=lambda pictures: render(rates, totals, years, run, pictures),
        others=exports,
    )


def levels_table(rates: ObjectRates) -> pd.DataFrame:
    """The part of each rate that comes from each interval of the ground's measure [SI]."""
    rows = []
    for one in rates.rates:
        for low, high, part in zip(
            one.found.levels[:-1], one.found.levels[1:], one.found.by_level, strict=True
        ):
            rows.append({
                "number": one.number, "row": one.item.row, "name": one.item.name,
                "direction": one.direction,
                "from": low, "to": high, "annual_rate": part,
            })  # fmt: skip
    return pd.DataFrame(rows)


def _figures(rates: ObjectRates, totals: LossTotals | None) -> Iterator[tuple[str, str, Figure]]:
    if totals is not None:
        figure = Figure(figsize=(6.4, 4.4), layout="constrained")
        plot_losses(totals, figure.subplots())
        yield (
            "losses",
            "How often a year more than each loss happens at once. Bars are 95 % intervals, over "
            "the earthquakes of the fragility functions; crosses come from shaking beyond the "
            "hazard curve.",
            figure,
        )
    figure = Figure(figsize=(6.4, 4.4), layout="constrained")
    plot_hazard(rates.hazard, figure.subplots())
    yield "hazard", "How often a year the ground is shaken by more than each level.", figure
    first = [
        (one.item.called(one.number), one.found)
        for one in rates.ranked()[:MOST_DRAWN]
        if one.found.rate > 0.0
    ]
    if first:
        figure = Figure(figsize=(6.4, 4.4), layout="constrained")
        plot_levels(first, rates.hazard, figure.subplots())
        yield (
            "levels",
            "From which shaking the falls come: half of them from below the level where a line "
            f"crosses a half. The {len(first)} objects with the most falls.",
            figure,
        )


def render(
    rates: ObjectRates,
    totals: LossTotals | None,
    years: float,
    run: Mapping[str, object],
    pictures: Sequence[Mapping[str, str]],
) -> str:
    """The page; arguments as for `write_hazard`."""
    unit = unit_shown(rates.hazard.measure)
    total, so_far, rows = rates.expected(1.0), 0.0, []
    for one in rates.ranked()[:MOST_ROWS]:
        falls = one.item.quantity * one.found.rate
        so_far += falls
        rows.append({
            "name": one.item.called(one.number),
            "where": where(one.item.building, one.floor),
            "quantity": one.item.quantity, "direction": one.direction,
            "median": f"{unit.factor * one.curve.median:.3g}", "beta": f"{one.curve.beta:.2f}",
            "once": once_in(one.found), "chance": chance(one.found, years),
            "falls": f"{falls * years:.2g}",
            "saved": f"{100 * falls / total:.0f}" if total else "–",
            "so_far": f"{100 * so_far / total:.0f}" if total else "–",
            "note": note(one, rates.hazard),
        })  # fmt: skip
    without = [one for one in rates.of_objects().values() if not np.isfinite(one.found.rate)]
    return (
        pages()
        .get_template("hazard.html.j2")
        .render(
            title="How often objects fall at this site",
            lead=of_inventory(rates, years),
            messages=run.get("messages", ()),
            not_considered=NOT_CONSIDERED,
            measure=rates.hazard.measure.name,
            unit=unit.name,
            years=f"{years:g}",
            rows=rows,
            totals=of_totals(totals) if totals else [],
            periods=_periods(totals) if totals else [],
            places=any(row["where"] for row in rows),
            without=[
                {"who": one.item.called(one.number), "why": one.curve.problem} for one in without
            ],
            pictures=pictures,
            hazard=rates.hazard,
            motions=rates.motions,
            run=run,
        )
    )


def _periods(totals: LossTotals) -> list[dict[str, Any]]:
    """Rows of losses at return periods."""
    return [
        {
            "years": f"{each.years:g}",
            "loss": amount(each.loss),
            "interval": f"{amount(each.low)} to {amount(each.high)}",
            "varied": [amount(losses[k]) for losses in totals.varied.values()],
            "note": "beyond the hazard curve" if each.beyond_curve else "",
        }
        for k, each in enumerate(totals.periods)
    ]
