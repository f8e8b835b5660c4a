"""miniSEED, with the instrument's response from a StationXML file beside it. Needs ObsPy.

An accelerometer's counts are divided by its sensitivity; a seismometer's velocities are
deconvolved. Samples without a response are taken as accelerations if their unit is given.
"""

from __future__ import annotations

import io
import logging
import re
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from shaketable.errors import printable, refused
from shaketable.extras import require
from shaketable.language import tell
from shaketable.records.component import Component, azimuth_of
from shaketable.units import acceleration_factor

if TYPE_CHECKING:
    import obspy

log = logging.getLogger(__name__)

_RECORD = re.compile(rb"^\d{6}[DRQM][ \0]")
_BAND = (0.02, 0.05)  # Hz: below this, a seismometer's response is noise
_TOP = (0.8, 0.95)  # of the Nyquist frequency


def recognise(raw: bytes) -> bool:
    """Whether the bytes begin with a miniSEED record's fixed header."""
    return bool(_RECORD.match(raw[:20])) or raw[:3] == b"MS\x03"


def read(path: Path, raw: bytes, units: str | None) -> list[Component]:
    """A component for each channel of the file.

    Raises:
        InputError: ObsPy is missing, the record has gaps, or neither response nor unit is known.
    """
    require("seismology", f"{path}: miniSEED")
    import obspy

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # a record that is cut or damaged
            stream = obspy.read(io.BytesIO(raw), format="MSEED").merge(method=0)
    except Exception as error:  # ObsPy raises what its C library says
        raise refused(path, tell("cannot be read as miniSEED ({error})", error=error)) from None
    texts = [trace.id for trace in stream if trace.data.dtype.kind not in "if"]
    if texts:
        log.warning("%s: left out, no samples: %s", path, ", ".join(map(printable, texts)))
    traces = [trace for trace in stream if trace.id not in texts]
    if not traces:
        raise refused(path, tell("holds no series of samples"))
    inventory = _inventory(path)
    return [_component(path, trace, inventory, units) for trace in traces]


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
    path: Path, trace: Any, inventory: obspy.Inventory | None, units: str | None
) -> Component:
    if np.ma.isMaskedArray(trace.data):
        raise refused(path, tell("{id} has gaps; cut the record before or after them", id=trace.id))
    azimuth = azimuth_of(trace.stats.channel)
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
        format="miniSEED",
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
