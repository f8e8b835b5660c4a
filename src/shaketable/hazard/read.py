"""Hazard curves in the files that hazard tools write."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, refused, require_positive
from shaketable.fragility.shown import unit_shown
from shaketable.hazard import columns, openquake, usgs
from shaketable.hazard.curve import Hazard
from shaketable.hazard.curves import USUAL, Curves, factor_of
from shaketable.inputs import read_file
from shaketable.signal import Measure, measure_named
from shaketable.tables import read_sheet

log = logging.getLogger(__name__)

FARTHEST = 25.0  # km from a site to the curve that is taken for it
EARTH = 6371.0  # km


def read_hazard(
    path: str | Path,
    *,
    measure: str | None = None,
    units: str | None = None,
    site: tuple[float, float] | None = None,
    exposure: float | None = None,
) -> Hazard:
    """Read the hazard curve of a site.

    Read are OpenQuake's hazard curves (CSV: probabilities in an investigation time, as rates), the
    curves of the USGS National Seismic Hazard Model (CSV of annual rates, JSON of its web
    services), and tables of two columns, level and annual rate of exceedance, or probability in
    some years, whose header names the measure and its unit, as "PGV [cm/s]", and says which of both
    the second column is.

    Args:
        path: of the file.
        measure: PGA, PGV, SA(1.0): needed where a file does not say it, or has several.
        units: of the levels: needed where a table does not say it; OpenQuake and the USGS write g,
            cm/s and cm.
        site: longitude and latitude [degrees], where a file has curves of several sites.
        exposure: years in which the probabilities of a table of two columns are, where its header
            does not say it.

    Raises:
        InputError: another format; no such measure; no curve near the site; values that cannot be
            rates of exceedance.
    """
    path = Path(path)
    wanted = None if measure is None else measure_named(measure)
    if exposure is not None:
        require_positive("exposure [years]", exposure)
    curves = _curves(path, wanted and wanted.name, exposure)
    if not curves.measure and wanted is None:
        raise refused(path, "does not say of which measure it is; give measure=, as 'PGA'")
    try:
        found = measure_named(curves.measure) if curves.measure else wanted
    except InputError as error:
        raise refused(path, f"{error}") from None
    assert found is not None
    if wanted is not None and wanted.name != found.name:
        raise refused(path, f"has curves of {found.name}, not of {wanted.name}")
    row = _row(path, curves.sites, site)
    levels, rates = curves.levels * _factor(path, curves, found, units), curves.rates[row]
    certain = np.isinf(rates)
    if certain.any():
        log.warning(
            "%s: %d of %d levels are left out, as a probability of 1 tells no rate",
            path, certain.sum(), certain.size,
        )  # fmt: skip
    return Hazard(
        measure=found,
        levels=levels[~certain],
        rates=rates[~certain],
        site=tuple(curves.sites[row].tolist()) if len(curves.sites) else site,
        source=str(path),
    )


def _curves(path: Path, wanted: str | None, exposure: float | None) -> Curves:
    if read_file(path).lstrip()[:1] == b"{":
        return usgs.read_json(path, read_file(path), wanted)
    sheet = read_sheet(path, "Hazard", lambda texts: True)
    if not any(sheet.filled()):
        raise refused(path, "is empty")
    if openquake.recognise(sheet):
        return openquake.read(sheet)
    return usgs.read(sheet) if usgs.recognise(sheet) else columns.read(sheet, exposure)


def _factor(path: Path, curves: Curves, measure: Measure, units: str | None) -> float:
    """From the file's unit to SI."""
    usual = unit_shown(measure).name
    told = usual if curves.unit == USUAL else curves.unit
    if units is not None and told and units != told:
        raise refused(path, f"its levels are in {told}, not in {units}")
    unit = told or units
    if not unit:
        raise refused(
            path,
            f"does not say the unit of its levels; write a header such as "
            f"'{measure.name} [{usual}]', or give units=",
        )
    return factor_of(path, measure.name, unit, measure)


def _row(path: Path, sites: NDArray[np.float64], site: tuple[float, float] | None) -> int:
    """The curve nearest to a site."""
    if len(sites) == 0 or (len(sites) == 1 and site is None):
        return 0
    if site is None:
        raise refused(
            path, f"has curves of {len(sites):,} sites; give site= as longitude and latitude"
        )
    away = distance(sites, site)
    nearest = int(np.argmin(away))
    if away[nearest] > FARTHEST:
        lon, lat = sites[nearest]
        raise refused(
            path,
            f"the site {site[0]:g}, {site[1]:g} is off the grid: the nearest curve, at "
            f"{lon:g}, {lat:g} (longitude, latitude), is {away[nearest]:.0f} km away",
        )
    return nearest


def distance(places: NDArray[np.float64], site: tuple[float, float]) -> NDArray[np.float64]:
    """From places to a site on the ground [km]; longitudes and latitudes [degrees], (n, 2)."""
    lon, lat = np.radians(places).T
    lon0, lat0 = np.radians(site)
    half = np.sin((lat - lat0) / 2.0) ** 2
    half += np.cos(lat) * np.cos(lat0) * np.sin((lon - lon0) / 2.0) ** 2
    return np.asarray(2.0 * EARTH * np.arcsin(np.sqrt(half)))
