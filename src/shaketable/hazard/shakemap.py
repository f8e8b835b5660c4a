"""The shaking of a real earthquake: ShakeMap's grid of the USGS, with its uncertainty.

grid.xml holds medians of PGA and spectral accelerations in percent of g and of PGV in cm/s at the
points of a grid, and uncertainty.xml, beside it, the standard deviations of their logarithms
(Worden and Wald 2016, ShakeMap manual). Values of a site are those of the grid, linear between its
points in the logarithm.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.errors import InputError, named, refused, require_not_negative
from shaketable.hazard.curves import factor_of
from shaketable.inputs import read_file
from shaketable.signal import measure_named

log = logging.getLogger(__name__)

UNCERTAINTY = "uncertainty.xml"  # the sibling of a grid.xml
_PERIOD = re.compile(r"(STD)?PSA(\d)(\d)")
MOST_POINTS = 4_000_000


class _Table(NamedTuple):
    """What an XML file of ShakeMap holds."""

    event: Mapping[str, str]
    fields: Mapping[str, tuple[int, str]]  # column and unit of each
    values: NDArray[np.float64]  # (point, column)


@dataclass(frozen=True, kw_only=True, eq=False)
class ShakeMap:
    """The shaking of an earthquake over a region.

    Attributes:
        name: of the event.
        magnitude: of the event, NaN if the file does not say.
        longitudes, latitudes: of the grid, rising [degrees], (nx,), (ny,).
        ln_median: of each measure by its name, ln of SI values, (ny, nx).
        sigma: standard deviations of these, (ny, nx); of the measures that are known.
        source: the file.
    """

    name: str
    magnitude: float
    longitudes: NDArray[np.float64]
    latitudes: NDArray[np.float64]
    ln_median: Mapping[str, NDArray[np.float64]]
    sigma: Mapping[str, NDArray[np.float64]]
    source: str = ""

    def of(
        self, measure: str, longitudes: ArrayLike, latitudes: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The mean and the standard deviation of ln of a measure at sites [SI].

        Args:
            measure: PGA, PGV, SA(0.3), SA(1.0) or SA(3.0), as the map has them.
            longitudes, latitudes: [degrees], broadcast.

        Raises:
            InputError: a measure that the map does not have, or whose uncertainty is not known; a
                site off the grid.
        """
        name = measure_named(measure).name
        if name not in self.ln_median:
            raise InputError(f"{self.source}: has no {name}; it has {', '.join(self.ln_median)}")
        if name not in self.sigma:
            raise InputError(
                f"{self.source}: the uncertainty of {name} is not known, without which "
                f"probabilities are too near to 0 or 1: put {UNCERTAINTY} beside it, "
                "or assume one (assumed_sigma=0.6, --map-sigma 0.6)"
            )
        x, y = np.broadcast_arrays(
            np.asarray(longitudes, np.float64), np.asarray(latitudes, np.float64)
        )
        tolerance = 1e-9
        # the grid may go on beyond 180°, where a site's longitude may be told from the other side
        given = x
        x = x + 360.0 * np.ceil((self.longitudes[0] - tolerance - x) / 360.0)
        off = ~(
            (x >= self.longitudes[0] - tolerance) & (x <= self.longitudes[-1] + tolerance)
            & (y >= self.latitudes[0] - tolerance) & (y <= self.latitudes[-1] + tolerance)
        )  # fmt: skip
        if off.any():
            first = np.flatnonzero(off)[0]
            raise InputError(
                f"{self.source}: {int(off.sum())} of {off.size} sites are off the grid, which is "
                f"from {self.longitudes[0]:g} to {self.longitudes[-1]:g} in longitude and from "
                f"{self.latitudes[0]:g} to {self.latitudes[-1]:g} in latitude; the first is "
                f"{given.flat[first]:g}, {y.flat[first]:g}"
            )
        i, p = _between(self.longitudes, x)
        j, q = _between(self.latitudes, y)
        found = []
        for grid in (self.ln_median[name], self.sigma[name]):
            low = (1.0 - p) * grid[j, i] + p * grid[j, i + 1]
            high = (1.0 - p) * grid[j + 1, i] + p * grid[j + 1, i + 1]
            found.append((1.0 - q) * low + q * high)
        return found[0], found[1]


def read_shakemap(
    path: str | Path, uncertainty: str | Path | None = None, *, assumed_sigma: float | None = None
) -> ShakeMap:
    """Read a ShakeMap from its grid.xml.

    Args:
        path: of the grid.
        uncertainty: of its uncertainty.xml; by default the one beside the grid, if there is one.
        assumed_sigma: standard deviation of ln of the measures whose uncertainty is not known;
            without it they give no probabilities.

    Raises:
        InputError: a file that is not such a grid, is cut short, or two that do not belong
            together.
    """
    path = Path(path)
    table = _read(path)
    x, y, order = _axes(path, table)
    medians = {}
    for field, (column, unit) in table.fields.items():
        name = _measure(field)
        if name is None or field.startswith("STD"):
            continue
        factor = factor_of(path, field, unit, measure_named(name))
        values = table.values[order, column] * factor
        if not (np.isfinite(values) & (values >= 0.0)).all():
            raise refused(path, f"{field} must be above 0 everywhere")
        if not values.all():
            log.warning(
                "%s: %s is left out: it is 0 at %d of its points, rounded from less",
                path, name, int((values == 0.0).sum()),
            )  # fmt: skip
            continue
        medians[name] = np.log(values).reshape(y.size, x.size)
    if not medians:
        raise refused(path, "has neither PGA, PGV nor PSA that is above 0 everywhere")
    beside = Path(uncertainty) if uncertainty else path.with_name(UNCERTAINTY)
    sigmas = _sigmas(beside, x, y) if uncertainty or beside.exists() else _sigmas_in(path, table)
    if assumed_sigma is not None:
        require_not_negative("assumed_sigma", assumed_sigma)
        unknown = [name for name in medians if name not in sigmas]
        sigmas |= {name: np.full((y.size, x.size), float(assumed_sigma)) for name in unknown}
        if unknown:
            log.warning(
                "%s: the uncertainty of %s is assumed: a standard deviation of ln of %g",
                path, ", ".join(unknown), assumed_sigma,
            )  # fmt: skip
    event = table.event
    return ShakeMap(
        name=event.get("event_description") or event.get("event_id") or path.stem,
        magnitude=_number(event.get("magnitude")),
        longitudes=x, latitudes=y, ln_median=medians, sigma=sigmas, source=str(path),
    )  # fmt: skip


def _number(text: str | None) -> float:
    try:
        return float(text or "nan")
    except ValueError:
        return np.nan


def _sigmas(
    path: Path, x: NDArray[np.float64], y: NDArray[np.float64]
) -> dict[str, NDArray[np.float64]]:
    table = _read(path)
    theirs_x, theirs_y, _ = _axes(path, table)
    if not (np.array_equal(x, theirs_x) and np.array_equal(y, theirs_y)):
        raise refused(path, "is on another grid than the shaking beside it")
    return _sigmas_in(path, table)


def _sigmas_in(path: Path, table: _Table) -> dict[str, NDArray[np.float64]]:
    """Standard deviations that a file has, by the measure's name."""
    x, y, order = _axes(path, table)
    found = {}
    for field, (column, unit) in table.fields.items():
        name = _measure(field)
        if name is None or not field.startswith("STD"):
            continue
        values = table.values[order, column]
        if not unit.startswith("ln"):
            log.warning(
                "%s: %s is left out: it is no standard deviation of a logarithm, its unit is %r",
                path, field, unit,
            )  # fmt: skip
            continue
        if not (np.isfinite(values) & (values >= 0.0)).all():
            raise refused(path, f"{field} must be standard deviations, 0 or more")
        found[name] = values.reshape(y.size, x.size)
    return found


def _measure(field: str) -> str | None:
    """The measure of a field: PGA, STDPGV, PSA03; None of another."""
    bare = field.removeprefix("STD")
    if bare in ("PGA", "PGV"):
        return bare
    match = _PERIOD.fullmatch(field)
    return f"SA({match[2]}.{match[3]})" if match else None


def _axes(
    path: Path, table: _Table
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.intp]]:
    """Longitudes and latitudes, rising, and the order of the points by latitude and longitude."""
    if not {"LON", "LAT"} <= set(table.fields):
        raise refused(path, "its grid has no LON and LAT")
    lon, lat = (table.values[:, table.fields[name][0]] for name in ("LON", "LAT"))
    if not (np.abs(lon).max() <= 360.0 and np.abs(lat).max() <= 90.0):
        raise refused(path, "LON and LAT of its grid are no degrees")
    lon, lat = _unwrapped(np.round(lon, 6)), np.round(lat, 6)
    nx = int((np.abs(lat - lat[0]) < 1e-9).sum())
    if nx < 2 or lon.size % nx or lon.size // nx < 2:
        raise refused(path, f"{lon.size} points are no grid of whole rows; is the file cut short?")
    order = np.lexsort((lon, lat))
    x, y = lon[order][:nx], lat[order][::nx]
    if np.abs(lon[order].reshape(-1, nx) - x).max() > 1e-3 or not (np.diff(x) > 0.0).all():
        raise refused(path, "the points of its grid do not lie in rows and columns")
    return x, y, order


def _unwrapped(lon: NDArray[np.float64]) -> NDArray[np.float64]:
    """Longitudes of a grid that may lie across 180°: cut where the widest gap between them is."""
    axis = np.unique(lon)
    around = np.diff(np.append(axis, axis[0] + 360.0))
    widest = int(around.argmax())
    if widest == axis.size - 1 or around[widest] < 2.0 * float(np.median(around)):
        return lon  # it ends there, or goes all around
    turned = np.where(lon <= axis[widest], lon + 360.0, lon)
    return np.asarray(np.round(turned, 6), np.float64)


def _between(
    axis: NDArray[np.float64], at: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    k = np.clip(np.searchsorted(axis, at, side="right") - 1, 0, axis.size - 2)
    return k, (at - axis[k]) / (axis[k + 1] - axis[k])


def _read(path: Path) -> _Table:
    from xml.etree.ElementTree import ParseError

    from defusedxml.common import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    try:
        root: Any = fromstring(read_file(path))
    except (ParseError, DefusedXmlException, LookupError, ValueError) as error:  # or its encoding
        raise refused(path, f"not an XML file that can be read ({error})") from None
    space = root.tag[: root.tag.index("}") + 1] if root.tag.startswith("{") else ""
    data = root.find(f"{space}grid_data")
    if root.tag.removeprefix(space) != "shakemap_grid" or data is None:
        raise refused(path, "is no grid of ShakeMap (shakemap_grid with grid_data)")
    told = root.findall(f"{space}grid_field")
    order = [field.get("index", "") for field in told]
    if sorted(order) != sorted(str(k) for k in range(1, len(told) + 1)):
        raise refused(path, f"the indices of its grid_field are not 1 to {len(told)}")
    fields = {
        field.get("name", "").upper(): (int(index) - 1, field.get("units", ""))
        for index, field in zip(order, told, strict=True)
    }
    try:
        values = np.array((data.text or "").split(), np.float64)
    except ValueError as error:
        raise refused(path, f"its grid holds what is no number ({error})") from None
    columns = len(fields)
    if not columns or values.size == 0 or values.size % columns or values.size > 40 * MOST_POINTS:
        raise refused(
            path,
            f"{values.size} numbers in {columns} fields "
            f"({named(list(fields), 20)}); is the file cut short?",
        )
    event = root.find(f"{space}event")
    return _Table(event.attrib if event is not None else {}, fields, values.reshape(-1, columns))
