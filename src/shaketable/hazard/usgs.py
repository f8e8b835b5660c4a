"""Curves of the USGS National Seismic Hazard Model: annual rates of exceedance.

Its calculations write a CSV of many sites for each measure, in a folder of the measure's name, and
its web services a JSON with all measures of one site:

    name,lon,lat,0.00233,0.0035,...              {"response": {"hazardCurves": [
    Los Angeles,-118.25,34.05,0.42,0.35,...        {"imt": {"value": "SA1P0"}, "data": [
                                                     {"component": "Total",
                                                      "values": {"xs": [...], "ys": [...]}}]}]}}
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from shaketable.errors import named, quoted, refused
from shaketable.hazard.curves import USUAL, Curves, numbers
from shaketable.inputs import number_of
from shaketable.tables import Sheet

_PERIOD = re.compile(r"SA(\d+)P(\d+)")
_LONGITUDES, _LATITUDES = ("lon", "longitude"), ("lat", "latitude")
FEWEST = 3  # levels in a header


def measure_of(word: str) -> str:
    """OpenQuake's name of a measure that the USGS writes as SA0P2 or PGA."""
    match = _PERIOD.fullmatch(word)
    return f"SA({match[1]}.{match[2]})" if match else word


def recognise(sheet: Sheet) -> bool:
    """Whether the header has places and levels."""
    names = [cell.text.lower() for cell in next(sheet.filled(), [])]
    return (
        any(name in _LONGITUDES for name in names)
        and any(name in _LATITUDES for name in names)
        and sum(map(_is_level, names)) >= FEWEST
    )


def _is_level(text: str) -> bool:
    return number_of(text) > 0.0


def read(sheet: Sheet) -> Curves:
    """The curves of all sites of a CSV; its folder's name is the measure, if it is one."""
    header, *body = list(sheet.filled())
    names = [cell.text.lower() for cell in header]
    at = [k for k, name in enumerate(names) if _is_level(name)]
    place = [
        next(k for k, name in enumerate(names) if name in known)
        for known in (_LONGITUDES, _LATITUDES)
    ]
    if not body:
        raise refused(sheet.path, "has no site")
    values = np.array([numbers(sheet, row, names, (*place, *at)) for row in body])
    folder = sheet.path.absolute().parent.name
    known = folder if _PERIOD.fullmatch(folder) or folder in ("PGA", "PGV") else ""
    levels = np.array([number_of(names[k]) for k in at])
    return Curves(measure_of(known), USUAL, levels, values[:, 2:], values[:, :2])


def read_json(path: Path, raw: bytes, wanted: str | None) -> Curves:
    """The curve of one measure in an answer of the web services.

    Raises:
        InputError: no such answer, or no curve of the measure that is wanted.
    """
    try:
        told: Any = json.loads(raw)
        response = told.get("response", told)
        curves = {measure_of(one["imt"]["value"]): one["data"] for one in response["hazardCurves"]}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise refused(
            path,
            "JSON, but not hazard curves as the web services of the USGS write them "
            "(response.hazardCurves)",
        ) from None
    if wanted is None and len(curves) > 1:
        raise refused(path, f"has curves of {', '.join(curves)}; give measure= as one of them")
    name = wanted or next(iter(curves), "")
    if name not in curves:
        raise refused(path, f"has no curve of {name}; it has {named(list(curves), 20)}")
    try:
        total = next(one for one in curves[name] if one.get("component", "Total") == "Total")
        levels, rates = (np.array(total["values"][key], np.float64) for key in ("xs", "ys"))
    except (StopIteration, KeyError, TypeError, ValueError):
        raise refused(path, f"the curve of {quoted(name)} has no values of 'Total'") from None
    if levels.ndim != 1 or levels.shape != rates.shape or not levels.size:
        raise refused(
            path,
            f"the curve of {quoted(name)} has {levels.size} levels (xs) and {rates.size} "
            "rates (ys); it has to be as many of each, and one or more",
        )
    return Curves(name, USUAL, levels, rates[None], np.zeros((0, 2)))
