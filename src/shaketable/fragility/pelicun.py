"""Fragility functions as pelicun 3 reads them, in the layout of the Damage and Loss Model Library.

Three files: `fragility.csv`, `fragility.json` that says what the states mean, and
`consequence_repair.csv`, a frame whose costs and times are to be filled in. What bites:

- pelicun counts floors from the ground, 0, and storeys from 1: with its default options, and a
  `Demand-Offset` of 0, an object of location 1 takes "Peak Floor ..." from location 0, the floor on
  which it stands, but "Peak Ground ..." from its own location.
- A demand that has no direction is multiplied by 1.2; here it has one: that of the shaking in the
  plane of the body.
- The side to which a body falls is no limit state: both sides share that of overturning, with
  `DamageStateWeights`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from shaketable.atomic_files import results_folder, write_csv
from shaketable.errors import InputError, refused
from shaketable.fragility.curve import GROUND
from shaketable.fragility.exported import Export, Function, Functions, unit_of
from shaketable.fragility.limit_states import OVERTURNS
from shaketable.fragility.shown import G, MeasureUnit

FILES = ("fragility.csv", "fragility.json", "consequence_repair.csv")
UNITS = {"PGA": G, "SA": G, "PGV": MeasureUnit("mps", 1.0)}
DEMANDS = {
    "ground": {"PGA": "Peak Ground Acceleration", "PGV": "Peak Ground Velocity"},
    "floor": {"PGA": "Peak Floor Acceleration", "PGV": "Peak Floor Velocity"},
}
MOST_STATES = 4
CONSEQUENCES = {"Cost": "USD_2011", "Time": "worker_day"}


def write_pelicun(
    export: Export, folder: str | Path, *, demand: str | None = None, overwrite: bool = False
) -> None:
    """Write a damage and loss library of the bodies for pelicun.

    Args:
        export: its measure must be PGA, PGV or SA(T).
        folder: for the three files.
        demand: "floor": the motion under each object, wherever it stands; or "ground". By default
            what the functions are of: the ground where `fragility(..., ground=)` has taken the
            building into them, else the floor.
        overwrite: whether to replace such files in an existing folder.

    Raises:
        InputError: a measure that pelicun does not know, more than four states, an unknown word,
            a demand that the functions are not of, nothing to write, or an existing folder.
    """
    require_blank(Path(folder))
    with results_folder(Path(folder), overwrite, FILES) as place:
        write_into(place, export, demand)


def require_blank(folder: Path) -> None:
    """InputError if a folder holds costs or times that somebody has filled in.

    Raises:
        InputError: there are some, which would be lost.
    """
    import pandas as pd

    path = folder / FILES[2]
    if not path.exists():
        return
    try:
        table = pd.read_csv(path)
    except (OSError, ValueError):
        table = pd.DataFrame({"Incomplete": [0]})
    blank = (table.get("Incomplete", pd.Series([0])) == 1).all()
    values = table[[name for name in table if "Family" in str(name) or "Theta" in str(name)]]
    if not blank or values.notna().any(axis=None):
        raise refused(
            path, "holds costs or times that were filled in; move it, or give another folder"
        )


def write_into(
    place: Path,
    export: Export,
    demand: str | None = None,
    *,
    costs: Mapping[str, float] | None = None,
    prefix: str = "",
) -> None:
    """Write the files into a folder; arguments as for `write_pelicun`.

    Args:
        place, export, demand: as for it.
        prefix: before the names of the files.
        costs: of the worst state of those whose cost is known, by their identifiers.
    """
    import pandas as pd

    unit = unit_of(export.measure, UNITS, "pelicun")
    demand = _require_demand(export, demand)
    functions = export.functions
    states = max(len(one.curves) for one in functions)
    if states > MOST_STATES:
        raise InputError(f"pelicun takes {MOST_STATES} limit states, got {states}")
    demand_type = _demand(export.measure.name, demand)
    rows = [_row(one, demand_type, unit) for one in functions]
    told: dict[str, Any] = {
        "_GeneralInformation": {
            "ShortName": export.title,
            "Description": export.description.replace("{unit}", unit.name),
            "Version": "1.0",
        },
        **{one.identifier: _meaning(one) for one in functions},
    }
    write_csv(pd.DataFrame(rows), place / f"{prefix}{FILES[0]}")
    text = json.dumps(told, indent=2, ensure_ascii=False)
    (place / f"{prefix}{FILES[1]}").write_text(text + "\n", encoding="utf-8")
    write_csv(pd.DataFrame(_frame(functions, costs or {})), place / f"{prefix}{FILES[2]}")


def _require_demand(export: Export, demand: str | None) -> str:
    """The demand, or the one that the functions are of; InputError for any other."""
    if demand is None:
        return "ground" if export.through_building else "floor"
    if demand not in DEMANDS:
        raise InputError(f"demand= must be one of {', '.join(DEMANDS)}, got {demand!r}")
    if demand == "floor" and export.through_building:
        raise InputError(
            "demand='floor': the functions are of the ground's measure and have the building in "
            "them (ground=), so that a floor's demand would count it twice; leave demand="
        )
    place = export.place
    if demand == "ground" and place != GROUND:
        raise InputError(
            f"demand='ground': the functions are of the measure on {place}; leave demand=, or give "
            "the ground's motions to fragility(..., ground=...)"
        )
    return demand


def _demand(measure: str, demand: str) -> str:
    if measure.startswith("SA("):
        return f"Spectral Acceleration|{measure[3:-1]}"
    return DEMANDS[demand][measure]


def _row(one: Functions, demand: str, unit: MeasureUnit) -> dict[str, Any]:
    row: dict[str, Any] = {
        "ID": one.identifier,
        "Incomplete": 0,
        "Demand-Type": demand,
        "Demand-Unit": unit.name,
        "Demand-Offset": 0,
        "Demand-Directional": 1,
    }
    for k, curve in enumerate(one.curves, 1):
        row |= {
            f"LS{k}-Family": "lognormal",
            f"LS{k}-Theta_0": float(f"{unit.factor * curve.median:.6g}"),
            f"LS{k}-Theta_1": float(f"{curve.beta:.6g}"),
            f"LS{k}-DamageStateWeights": _weights(curve),
        }
    return row


def _weights(curve: Function) -> str:
    return " | ".join(f"{share:.6f}" for share in curve.sides.values())


def _states_of(curve: Function) -> list[str]:
    """What the damage states of a limit state are."""
    if curve.state.kind == OVERTURNS and curve.sides:
        return [f"It falls over, {side}." for side in curve.sides]
    return [curve.state.meaning]


def _meaning(one: Functions) -> dict[str, Any]:
    states, number = {}, 0
    for k, curve in enumerate(one.curves, 1):
        each = {}
        for said in _states_of(curve):
            number += 1
            each[f"DS{number}"] = {"Description": said, "RepairAction": "To be filled in."}
        states[f"LS{k}"] = each
    return {
        "Description": f"{one.name}, unanchored",
        "Comments": one.about
        + "".join(f" Caution: {curve.caution}." for curve in one.curves if curve.caution),
        "SuggestedComponentBlockSize": "1 EA",
        "RoundUpToIntegerQuantity": "True",
        "LimitStates": states,
    }


def _frame(functions: Sequence[Functions], costs: Mapping[str, float]) -> list[dict[str, Any]]:
    rows = []
    for one in functions:
        states = sum(len(_states_of(curve)) for curve in one.curves)
        for kind, unit in CONSEQUENCES.items():
            row: dict[str, Any] = {
                "ID": f"{one.identifier}-{kind}",
                "Incomplete": 1,
                "Quantity-Unit": "1 EA",
                "DV-Unit": unit,
            }
            for k in range(1, states + 1):
                row |= {f"DS{k}-Family": "", f"DS{k}-Theta_0": "", f"DS{k}-Theta_1": ""}
                row |= {f"DS{k}-LongLeadTime": 0 if kind == "Time" else ""}
            if kind == "Cost" and one.identifier in costs:
                first = states - len(_states_of(one.curves[-1]))
                fallen = {f"DS{k + 1}-Theta_0": costs[one.identifier] for k in range(first, states)}
                row |= {"Incomplete": int(first > 0), **fallen}
            rows.append(row)
    return rows
