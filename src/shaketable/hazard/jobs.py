"""Whole jobs for loss tools: what stands where, its functions, what its loss costs, the hazard.

`openquake_job` writes those of OpenQuake. pelicun (3) takes the library with its quantities and
costs, a row for each object; the demand at which it is asked comes from whoever asks.
`left_out.csv` names the objects that are in neither, and why.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from shaketable.atomic_files import write_csv
from shaketable.fragility.exported import unit_of
from shaketable.fragility.pelicun import UNITS, write_into
from shaketable.hazard.exported import ExportedObjects, exported_objects, place_of
from shaketable.hazard.exposure import Exposure
from shaketable.hazard.objects import ObjectRates
from shaketable.hazard.openquake_job import READER, write_openquake
from shaketable.signal import Measure

OPENQUAKE, PELICUN = "openquake", "pelicun"
#: The tools, with the units in which each takes measures, and their names.
READERS = {OPENQUAKE: READER, PELICUN: (UNITS, "pelicun")}
JOBS = tuple(READERS)
QUANTITIES = "CMP_QNT.csv"


def require_measure(measure: Measure, jobs: Sequence[str]) -> None:
    """InputError unless the tools of all jobs know a measure."""
    for job in jobs:
        unit_of(measure, *READERS[job])


def write_jobs(rates: ObjectRates, folder: Path, jobs: Sequence[str]) -> None:
    """Write jobs into a folder.

    Args:
        rates: what `object_rates` gives.
        folder: that is there.
        jobs: of JOBS.

    Raises:
        InputError: a measure that the tool does not know, or nothing to write.
    """
    exported = exported_objects(rates)
    write_csv(_left_out(exported.exposure), folder / "left_out.csv")
    if OPENQUAKE in jobs:
        write_openquake(exported, rates.hazard, folder)
    if PELICUN in jobs:
        _write_pelicun(exported, folder)


def _left_out(exposure: Exposure) -> pd.DataFrame:
    """The objects that are in no job, and why."""
    rows = [(one.item.called(one.number), one.curve.problem) for one in exposure.without_function]
    rows += [(one.item.called(one.number), "it has no replacement cost, and others have")
             for one in exposure.without_cost]  # fmt: skip
    return pd.DataFrame(rows, columns=["object", "why"])


def _write_pelicun(exported: ExportedObjects, folder: Path) -> None:
    costs = {
        function: one.item.cost
        for one, function in zip(exported.exposure.objects, exported.functions, strict=True)
        if one.item.cost is not None
    }
    write_into(folder, exported.export, "ground", costs=costs)
    # one block: alike pieces fall together, as one motion shakes them all
    rows = [
        {"ID": function, "Units": "ea", "Location": 1, "Direction": 1,
         "Theta_0": one.item.quantity, "Blocks": 1, "Family": "", "Theta_1": "",
         "Comment": place_of(one)}
        for one, function in zip(exported.exposure.objects, exported.functions, strict=True)
    ]  # fmt: skip
    write_csv(pd.DataFrame(rows), folder / QUANTITIES)
