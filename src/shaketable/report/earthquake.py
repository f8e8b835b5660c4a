"""What falls in one earthquake, as a part of a page and as tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray

from shaketable.assess.earthquake import EarthquakeFalls
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import Scenario, ShakeMap, SpectralTarget
from shaketable.plot import plot_map, plot_target
from shaketable.report.figures import svg
from shaketable.report.html import embedded_svg, pages
from shaketable.report.results_folder import write_folder
from shaketable.report.words import earthquake as words
from shaketable.report.words.numbers import expected_count

MOST_ROWS = 40
MOST_PLACES = 40


@dataclass(frozen=True, kw_only=True, eq=False)
class Quake:
    """An earthquake and what falls in it, as pages show it.

    Attributes:
        found: what falls.
        source: the earthquake or the map.
        target: of the spectra of the simulated motions; None of a map, or where none are simulated.
        ln_spectra: theirs at its periods [ln m/s²], (motion, period).
    """

    found: EarthquakeFalls
    source: Scenario | ShakeMap
    target: SpectralTarget | None = None
    ln_spectra: NDArray[np.float64] | None = None

    def shown(self) -> dict[str, object]:
        """What the template of the part takes."""
        found, unit = self.found, unit_shown(self.found.measure)
        ranked = found.ranked()
        rows = [words.row(one) for one in ranked[:MOST_ROWS]]
        places = found.place_table()
        named = places[(places["building"] != "") | places["latitude"].notna()]
        named = named.sort_values("expected_falls", ascending=False, kind="stable")
        of = words.OF_SCENARIO if isinstance(self.source, Scenario) else words.OF_MAP
        return {
            "lead": words.lead(found, self.source),
            "not_considered": f"{of} {words.ALWAYS}",
            "measure": found.measure.name,
            "unit": unit.name,
            "simulated": any(one.simulated for one in ranked),
            "pictures": list(self._pictures(places)),
            "places": [_place(row, unit.factor) for row in named[:MOST_PLACES].to_dict("records")],
            "more_places": max(0, len(named) - MOST_PLACES),
            "rows": rows,
            "more_rows": max(0, len(ranked) - MOST_ROWS),
        }

    def _pictures(self, places: pd.DataFrame) -> Iterator[dict[str, str]]:
        if self.target is not None and self.ln_spectra is not None:
            figure = Figure(figsize=(6.4, 4.4), layout="constrained")
            plot_target(self.target, self.ln_spectra, figure.subplots())
            caption = (
                "Spectra of the simulated motions of the ground, and what ground-motion models "
                "give for this earthquake."
            )
            yield {"data": embedded_svg(svg(figure)), "caption": caption}
        if isinstance(self.source, ShakeMap):
            figure = Figure(figsize=(7.0, 5.6), layout="constrained")
            plot_map(self.source, self.found.measure.name, places, figure.subplots())
            caption = (
                "How strongly the ground was shaken, and where pieces are expected to fall, by "
                "fragility functions."
            )
            yield {"data": embedded_svg(svg(figure)), "caption": caption}

    def tables(self) -> dict[str, pd.DataFrame]:
        """What is written beside the report, by the names of the files."""
        return {"scenario": self.found.table(), "buildings": self.found.place_table()}


def _place(row: Mapping[object, object], factor: float) -> dict[str, object]:
    lon, lat = row["longitude"], row["latitude"]
    falls = {
        name: expected_count(value) if np.isfinite(value) else "–"
        for name in ("expected_falls", "expected_falls_simulated")
        for value in [float(str(row[name]))]
    }
    return {
        "name": row["building"] or f"{lat:.4f}, {lon:.4f}",
        "shaking": f"{factor * float(str(row['shaking_median'])):.3g}",
        "pieces": row["pieces"],
        "falls": falls["expected_falls"],
        "simulated": falls["expected_falls_simulated"],
    }


def write_quake(
    quake: Quake, run: Mapping[str, object], folder: Path, *, overwrite: bool = False
) -> None:
    """Write the files of an earthquake in which nothing is simulated, or none.

    Args:
        quake: what falls.
        run: what makes the run repeatable.
        folder: new, or one of earlier results with `overwrite`.
    """
    template = pages().get_template("scenario.html.j2")
    write_folder(
        folder,
        run,
        overwrite=overwrite,
        tables=quake.tables(),
        page=lambda _: template.render(quake=quake.shown(), run=run),
        page_name="report.html",
    )
