"""The entry point for every record format: it recognises a file's format and reads it."""

from __future__ import annotations

import hashlib
import logging
import zipfile
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable.errors import (
    Fault,
    InputError,
    named,
    printable,
    quoted,
    refusal,
    refused,
    require_positive,
)
from shaketable.inputs import require_file
from shaketable.language import tell
from shaketable.records import (
    at2,
    bhrc,
    columns,
    cosmos,
    csmip,
    csmnc,
    cwb,
    esm,
    geonet,
    headed_column,
    knet,
    nsmn,
    seismological,
    smc,
    unam,
    volume1,
)
from shaketable.records.archives import is_office, unpacked
from shaketable.records.component import Component, code_in_name
from shaketable.records.plausible import require_plausible, warn_of_spikes
from shaketable.records.text import (
    STEPS,
    NoAccelerationError,
    RecordText,
    no_acceleration,
    read_bytes,
    read_text,
)
from shaketable.units import acceleration_factor

log = logging.getLogger(__name__)

MOST_NAMED = 10  # members left out: a warning names no more than this


class Format(NamedTuple):
    """A text format: its name, how to recognise a text in it, and its reader."""

    name: str
    recognise: Callable[[RecordText], bool]
    read: Callable[[RecordText], list[Component]]


#: In the order in which they are tried, the most specific first.
FORMATS = [
    Format("CSMIP/CESMD V1, V2, USC V2", csmip.recognise, csmip.read),
    Format("COSMOS V1, V2", cosmos.recognise, cosmos.read),
    Format("RENADIC, USC V1", volume1.recognise, volume1.read),
    Format("BHRC V1", bhrc.recognise, bhrc.read),
    Format("K-NET, KiK-net", knet.recognise, knet.read),
    Format("ESM, ITACA", esm.recognise, esm.read),
    Format("GeoNet V1A, V2A", geonet.recognise, geonet.read),
    Format("USGS SMC", smc.recognise, smc.read),
    Format("UNAM ASA", unam.recognise, unam.read),
    Format("CSMNC", csmnc.recognise, csmnc.read),
    Format("NSMN", nsmn.recognise, nsmn.read),
    Format("CWB", cwb.recognise, cwb.read),
    Format("PEER AT2", at2.recognise, at2.read),
    Format("column under a divisor and a time step", headed_column.recognise, headed_column.read),
    Format("columns of numbers", columns.recognise, columns.read),
]


def read_components(
    path: str | Path, *, units: str | None = None, time_step: float | None = None
) -> list[Component]:
    """Read every acceleration component of a record file, unchanged.

    Args:
        path: a file in one of FORMATS, miniSEED or SAC (with ObsPy), or a zip archive of such
            files, of which those that hold no acceleration are left out with a warning.
        units: of acceleration ("g", "m/s2", "cm/s2", "gal"), where the file does not say.
        time_step: [s], where the file does not say; for uneven pairs, the step wanted.

    Raises:
        InputError: names the file, the line, what was found and what is accepted.
    """
    if units is not None:
        acceleration_factor(units)
    if time_step is not None:
        require_positive("time_step [s]", time_step)
        if not STEPS[0] <= time_step <= STEPS[1]:
            raise InputError(
                f"time_step [s] must lie between {STEPS[0]:g} and {STEPS[1]:g}, got {time_step!r}"
            )
    path = Path(path)
    require_file(path)
    if zipfile.is_zipfile(path):
        return _read_archive(path, units, time_step)
    return _read_file(path, read_bytes(path), units, time_step)


def _read_file(
    path: Path, raw: bytes, units: str | None, time_step: float | None
) -> list[Component]:
    if seismological.recognise(raw):
        components = seismological.read(path, raw, units)
    else:
        components = _read_text(read_text(path, raw, units, time_step))
    _require_distinct(path, components)
    digest = hashlib.sha256(raw).hexdigest()
    if len(components) == 1 and not components[0].code:
        code = code_in_name(path)
        components = [replace(components[0], code=code)]
    for component in components:
        require_plausible(path, component)
        warn_of_spikes(path, component)
    # the lines are not kept: they are for messages, and as long as the samples
    return [replace(one, path=path, sha256=digest, lines=None) for one in components]


def _require_distinct(path: Path, components: list[Component]) -> None:
    """Raise an error if a component of several has no name, or the name of another."""
    if len(components) < 2:
        return
    nameless = sum(not one.code for one in components)
    if nameless:
        raise refused(
            path,
            tell(
                "holds {count} components, of which {nameless} have no name; is a line "
                "of a header that names one damaged?",
                count=len(components),
                nameless=nameless,
            ),
        )
    names = Counter((one.station, one.channel, one.code) for one in components)
    (station, _, code), times = names.most_common(1)[0]
    if times > 1:
        raise refused(
            path,
            tell(
                "holds component {code} {of}{times} times; are several files joined in one?",
                code=quoted(code),
                of=tell("of {station} ", station=quoted(station)) if station else "",
                times=times,
            ),
        )


def _read_text(text: RecordText) -> list[Component]:
    try:
        for candidate in FORMATS:
            if candidate.recognise(text):
                with np.errstate(all="ignore"):  # what overflows is found afterwards
                    found = candidate.read(text)
                return [replace(one, format=candidate.name) for one in found]
    except InputError:
        raise
    except (ArithmeticError, LookupError, ValueError) as error:
        raise text.damaged(error) from None
    announced = csmip.announced(text)
    if announced is not None:
        raise text.fault(
            tell(
                "a volume of CSMIP, CESMD, USC or RENADIC in a layout that is not known: no line "
                "announces its values as '… POINTS OF ACCEL DATA EQUALLY SPACED AT … SEC (UNITS: "
                "…)' or '… Accelerogram points at … pts/sec in units of …' does, found {found}",
                found=quoted(text.lines[announced].strip()),
            ),
            announced + 1,
        )
    accepted = ", ".join([*(candidate.name for candidate in FORMATS), "miniSEED", "SAC", "zip"])
    raise text.no_acceleration(
        tell("unknown record format; accepted: {accepted}", accepted=accepted)
    )


def _read_archive(path: Path, units: str | None, time_step: float | None) -> list[Component]:
    if is_office(path):
        raise no_acceleration(
            path,
            tell(
                "a spreadsheet or document, no record; save its table as CSV, with a "
                "column time_s and one column for each component, such as ew_g"
            ),
        )
    components: list[Component] = []
    left_out: list[str] = []
    faults: list[Fault] = []
    for name, member in unpacked(path):
        try:
            if not member.strip():
                raise no_acceleration(path / name, tell("the file is empty"))
            components += _read_file(path / name, member, units, time_step)
        except NoAccelerationError as error:
            left_out.append(name)
            faults += error.listed
    if not components:
        empty = Fault(path, "", "", "no acceleration", tell("the archive is empty"))
        raise refusal(faults or [empty], NoAccelerationError)
    if left_out:
        log.warning("%s: left out, no records of acceleration: %s", path, files_named(left_out))
    return components


def files_named(files: list[str]) -> str:
    """Some names of files, and how many more there are."""
    return named([printable(name) for name in files], MOST_NAMED)
