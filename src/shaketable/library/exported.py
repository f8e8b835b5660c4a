"""The functions of a library as OpenQuake and pelicun read them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from shaketable.fragility.curve import GROUND
from shaketable.fragility.exported import Export, Function, Functions
from shaketable.fragility.limit_states import LimitState, limit_state
from shaketable.library.measures import measure_of


def exports_of(table: pd.DataFrame, title: str) -> dict[str, Export]:
    """The rows of a library's table that have a function, by the name of their measure.

    Each row is a function of its own for a reader, with one limit state: the states of a thing are
    not steps of one damage, as what overturns toward its wall covers no ground before it.

    Args:
        table: as `table_of` gives it, or as it was read from its CSV.
        title: of the library.
    """
    found = {}
    known = table[table["median"].notna()]
    for name, rows in known.groupby("measure", sort=False):
        measure = measure_of(str(name))
        place = "the floor under the thing" if measure.of_floor else GROUND
        first = rows.iloc[0]
        found[str(name)] = Export(
            functions=tuple(_functions(row) for _, row in rows.iterrows()),
            measure=measure.measure,
            place=place,
            through_building=not measure.of_floor,
            title=title,
            description=(
                f"{title}: unanchored rigid things in three dimensions under "
                f"{first['recordings']} recordings of {first['events']} earthquakes, both "
                f"horizontal components; {measure.measure.name} in {{unit}}, geometric mean of "
                f"both components, of {place}. β is of motions, object and model together. "
                "Median, intervals and cautions of each: functions.csv"
            ),
        )
    return found


def _functions(row: pd.Series[Any]) -> Functions:
    state = limit_state(str(row["limit_state"]))
    caution = row["caution"] if isinstance(row["caution"], str) else ""
    function = Function(state, float(row["median"]), float(row["beta"]), caution)
    return Functions(str(row["id"]), str(row["thing"]), about(row, state), (function,))


def about(row: Mapping[str, Any] | pd.Series[Any], state: LimitState) -> str:
    """What a row is of, in sentences."""
    held = {"free": "standing free"}.get(str(row["held"]), str(row["held"]))
    tilted = f", on a tilt of {row['tilt']:g}° toward its back" if row["tilt"] else ""
    return (
        f"{row['depth']:.3g} m deep, {row['width']:.3g} m wide, {row['height']:.3g} m high, "
        f"{held}{tilted}; {row['place']}; friction {row['friction_low']:g} to "
        f"{row['friction_high']:g}. {state.meaning} The demand is "
        f"{row['measure']}, the geometric mean of both horizontal components."
    )
