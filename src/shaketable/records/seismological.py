"""miniSEED and SAC, with the instrument's response from a StationXML file beside it. Needs ObsPy.

An accelerometer's counts are divided by its sensitivity; a seismometer's velocities are
deconvolved. Samples without a response are taken as accelerations if their unit is given.
"""

from __future__ import annotations

import io
import logging
import re
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from shaketable.errors import printable, refused
from shaketable.extras import require
from shaketable.language import tell
from shaketable.records.component import Component, azimuth_of
from shaketable.records.numbers import MOST_VALUES
from shaketable.units import acceleration_factor

if TYPE_CHECKING:
    import obspy

log = logging.getLogger(__name__)

_ORDERS: tuple[Literal["little", "big"], ...] = ("little", "big")
_SAC_HEADER = 632  # bytes
_SAC_VERSIONS, _SAC_VERSION_AT, _SAC_COUNT_AT = (6, 7), 304, 316
_RECORD = re.compile(rb"^\d{6}[DRQM][ \0]")
_UNSAID = -12345.0  # in SAC
_BAND = (0.02, 0.05)  # Hz: below this, a seismometer's response is noise
_TOP = (0.8, 0.95)  # of the Nyquist frequency


def recognise(raw: bytes) -> bool:
    """Whether the bytes begin with a miniSEED record's fixed header, or with SAC's."""
    return _kind(raw) != ""


def _kind(raw: bytes) -> str:
    """What ObsPy calls the format; "" if it is neither."""
    if _RECORD.match(raw[:20]) or raw[:3] == b"MS\x03":
        return "MSEED"
    for order in _ORDERS:
        version, count = (
            int.from_bytes(raw[at : at + 4], order) for at in (_SAC_VERSION_AT, _SAC_COUNT_AT)
        )
        if len(raw) > _SAC_HEADER and version in _SAC_VERSIONS and 0 < count <= MOST_VALUES:
            return "SAC"
    return ""


def read(path: Path, raw: bytes, units: str | None) -> list[Component]:
    """A component for each channel of the file.

    Raises:
        InputError: ObsPy is missing, the record has gaps, or neither response nor unit is known.
    """
    kind = _kind(raw)
    named = {"MSEED": "miniSEED"}.get(kind, kind)
    require("seismology", f"{path}: {named}")
    import obspy

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # a record that is cut or damaged
            stream = obspy.read(io.BytesIO(raw), format=kind).merge(method=0)
    except Exception as error:  # ObsPy raises what its C library says
        raise refused(
            path, tell("cannot be read as {kind} ({error})", kind=named, error=error)
        ) from None
    texts = [trace.id for trace in stream if trace.data.dtype.kind not in "if"]
    if texts:
        log.warning("%s: left out, no samples: %s", path, ", ".join(map(printable, texts)))
    traces = [trace for trace in stream if trace.id not in texts]
    if not traces:
        raise refused(path, tell("holds no series of samples"))
    inventory = _inventory(path)
    return [_component(path, trace, inventory, units, named) for trace in traces]


def _inventory(path: Path) -> obspy.Inventory | None:
    """The content of the StationXML file of the same name, or else of all those in the folder."""
    import obspy

    own = path.with_suffix(".xml")
    files = [own] if own.is_file() else sorted(path.parent.glob("*.xml"))
    found = obspy.Inventory()
    for file in files:
        try:
            found += obspy.read_inventory(str(file), format="STATIONXML")
        except Exception:  # noqa: S112  another kind of XML lies in the folder
            continue
    return found if len(found) else None


def _component(
    path: Path, trace: Any, inventory: obspy.Inventory | None, units: str | None, kind: str
) -> Component:
    if np.ma.isMaskedArray(trace.data):
        raise refused(path, tell("{id} has gaps; cut the record before or after them", id=trace.id))
    azimuth = azimuth_of(trace.stats.channel)
    if "sac" in trace.stats:  # which says it, or nothing
        stated = float(trace.stats.sac.get("cmpaz", _UNSAID))
        azimuth = azimuth if stated == _UNSAID else stated % 360.0
    try:
        if inventory is None:
            raise LookupError
        response = inventory.get_response(trace.id, trace.stats.starttime)
        place = inventory.get_orientation(trace.id, trace.stats.starttime)
        azimuth = azimuth if place["azimuth"] is None else float(place["azimuth"])
    except Exception:  # ObsPy raises a bare Exception for an id that the inventory lacks
        if units is None:
            raise refused(
                path,
                tell(
                    "no StationXML file beside it has a response for {id}; put it there "
                    "or, if the samples are accelerations, give their units",
                    id=trace.id,
                ),
            ) from None
        values = np.asarray(trace.data, dtype=np.float64) * acceleration_factor(units)
        done = f"samples taken as {units}"
    else:
        values, done = _acceleration(trace, inventory, response)
    return Component(
        acceleration=values,
        time_step=float(trace.stats.delta),
        code=trace.stats.channel,
        azimuth=None if trace.stats.channel.endswith("Z") else azimuth,
        uncorrected=True,
        station=f"{trace.stats.network}.{trace.stats.station}",
        event=str(trace.stats.starttime),
        location=trace.stats.location,
        processing=(done,),
        format=kind,
    )


def _acceleration(trace: Any, inventory: Any, response: Any) -> tuple[Any, str]:
    """Samples in m/s², and what was done to obtain them."""
    if response.instrument_sensitivity.input_units.upper().replace(" ", "") in {
        "M/S**2",
        "M/S^2",
        "M/S/S",
    }:
        gain = response.instrument_sensitivity.value
        return np.asarray(trace.data, dtype=np.float64) / gain, f"divided by {gain:g} counts/(m/s²)"
    nyquist = 0.5 / trace.stats.delta
    band = (*_BAND, _TOP[0] * nyquist, _TOP[1] * nyquist)
    trace = trace.copy().detrend("linear")
    trace.remove_response(inventory=inventory, output="ACC", pre_filt=band, water_level=60)
    said = f"response removed between {band[1]:g} and {band[2]:g} Hz"
    return np.asarray(trace.data, dtype=np.float64), said
