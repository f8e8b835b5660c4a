"""The rows of a library in the columns of NIST's NED and of pyincore, where those differ.

NED, the Nonstructural Element Database (github.com/usnistgov/NED), takes JSON of fragility models
and of their curves, over peak floor velocities in m/s and peak floor accelerations in g. pyincore
takes JSON of sets of curves, each with the expression of its probability. R2D reads pelicun's.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from shaketable.fragility.limit_states import limit_state
from shaketable.fragility.shown import G
from shaketable.library.exported import about
from shaketable.library.measures import FLOOR, measure_of

if TYPE_CHECKING:
    import pandas as pd

REFERENCE = "SHAKETABLE-LIBRARY"
#: What NED calls measures of the floor, its unit, and that unit in SI.
NED = {
    "PGV": ("Peak Floor Velocity", "Meters Per Second", 1.0),
    "PGA": ("Peak Floor Acceleration, horizontal", "g", 1.0 / G.factor),
}


class NedTables(NamedTuple):
    """The entries of NED's `fragility_model.json` and `fragility_curve.json`."""

    models: list[dict[str, Any]]
    curves: list[dict[str, Any]]


def ned_tables(table: pd.DataFrame, title: str) -> NedTables:
    """The rows whose measure is that of the floor under the thing, the ground included.

    Args:
        table: of a library.
        title: of the library.
    """
    models: dict[str, dict[str, Any]] = {}
    curves = []
    for _, row in table[table["median"].notna()].iterrows():
        name = str(row["measure"])
        of_floor = name.startswith(FLOOR) or row["floor"] == 0  # the ground is a floor, too
        kind = name.removeprefix(FLOOR)
        if kind not in NED or not of_floor:
            continue
        metric, unit, factor = NED[kind]
        state = limit_state(str(row["limit_state"]))
        key = f"{row['id']}.{kind}"
        models[key] = {
            "comp_description": f"{row['thing']}, unanchored: {about(row, state)}",
            "comp_detail": str(row["held"]),
            "edp_metric": metric,
            "edp_unit": unit,
            "material": "",
            "model_id": key,
            "p58_fragility": "",
            "reference": REFERENCE,
            "reviewer": "",
            "size_class": str(row["size"]),
            "source": title,
        }
        curves.append({
            "fragility_model": f"{REFERENCE}|{key}",
            "reviewer": "",
            "source": title,
            "basis": "Analytical Study",
            "num_observations": int(row["recordings"]),
            "reference": REFERENCE,
            "edp_metric": metric,
            "edp_unit": unit,
            "ds_rank": 1,
            "ds_description": state.meaning,
            "median": round(float(row["median"]) / factor, 4),
            "beta": round(float(row["beta"]), 3),
            "probability": None,
        })  # fmt: skip
    return NedTables(list(models.values()), curves)


def pyincore_sets(table: pd.DataFrame, measure: str, title: str) -> list[dict[str, Any]]:
    """The rows of a measure of the ground as pyincore's sets of one curve each.

    Args:
        table: of a library.
        measure: PGA, PGV or SA(T); nothing else has sets.
        title: of the library.
    """
    known = measure_of(measure)
    kind = known.measure.name.split("(")[0]
    if known.of_floor or kind not in ("PGA", "PGV", "SA"):
        return []
    demand = f"{known.measure.name[3:-1]} SA" if kind == "SA" else kind
    unit, factor = ("cm/s", 100.0) if kind == "PGV" else ("g", G.factor)
    found = []
    for _, row in table[(table["measure"] == measure) & table["median"].notna()].iterrows():
        state = limit_state(str(row["limit_state"]))
        theta, beta = factor * float(row["median"]), float(row["beta"])
        expression = (
            f"scipy.stats.norm.cdf((math.log({kind}) - math.log({theta:.6g}))/({beta:.6g}))"
        )
        found.append({
            "id": str(row["id"]),
            "description": f"{row['thing']}, unanchored: {about(row, state)}",
            "authors": [title],
            "demandTypes": [demand],
            "demandUnits": [unit],
            "resultType": "Limit State",
            "hazardType": "earthquake",
            "inventoryType": "building",
            "curveParameters": [{"name": kind, "fullName": demand, "unit": unit}],
            "fragilityCurves": [{
                "description": str(row["limit_state"]),
                "className": "FragilityCurve",
                "returnType": {"type": "Limit State", "unit": "", "description": state.meaning},
                "rules": [{"expression": expression}],
            }],
        })  # fmt: skip
    return found
