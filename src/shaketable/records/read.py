"""The entry point for every record format: it recognises a file's format and reads it."""

from __future__ import annotations

import hashlib
import io
import logging
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable.errors import InputError, require_positive
from shaketable.records import (
    at2,
    bhrc,
    columns,
    cosmos,
    csmip,
    cwb,
    esm,
    geonet,
    headed_column,
    knet,
    miniseed,
    nsmn,
    smc,
    volume1,
)
from shaketable.records.component import Component, code_in_name
from shaketable.records.text import NoAccelerationError, RecordText, read_bytes, read_text
from shaketable.units import STANDARD_GRAVITY, acceleration_factor

log = logging.getLogger(__name__)

LARGEST_ARCHIVE = 2e9  # bytes, unpacked
LOUDEST = 100 * STANDARD_GRAVITY  # m/s²: no ground and no floor accelerates this much


class Format(NamedTuple):
    """A text format: its name, how to recognise a text in it, and its reader."""

    name: str
    recognise: Callable[[RecordText], bool]
    read: Callable[[RecordText], list[Component]]


#: In the order in which they are tried, the most specific first.
FORMATS = [
    Format("CSMIP/CESMD V1, V2", csmip.recognise, csmip.read),
    Format("COSMOS V1, V2", cosmos.recognise, cosmos.read),
    Format("RENADIC, USC V1", volume1.recognise, volume1.read),
    Format("BHRC V1", bhrc.recognise, bhrc.read),
    Format("K-NET, KiK-net", knet.recognise, knet.read),
    Format("ESM, ITACA", esm.recognise, esm.read),
    Format("GeoNet V1A, V2A", geonet.recognise, geonet.read),
    Format("USGS SMC", smc.recognise, smc.read),
    Format("NSMN", nsmn.recognise, nsmn.read),
    Format("CWB", cwb.recognise, cwb.read),
    Format("PEER AT2", at2.recognise, at2.read),
    Format("column under a divisor and a time step", headed_column.recognise, headed_column.read),
    Format("columns of numbers", columns.recognise, columns.read),
]


def read_components(
    path: str | Path, *, units: str | None = None, time_step: float | None = None
) -> list[Component]:
    """Every acceleration component that a record file holds, as given by the file.

    Args:
        path: a file in one of FORMATS, miniSEED (with ObsPy), or a zip archive of such files,
            of which those that hold no acceleration are left out.
        units: of acceleration ("g", "m/s2", "cm/s2", "gal"), where the file does not say.
        time_step: [s], where the file does not say; for uneven pairs, the step wanted.

    Raises:
        InputError: names the file, the line, what was found and what is accepted.
    """
    if units is not None:
        acceleration_factor(units)
    if time_step is not None:
        require_positive("time_step [s]", time_step)
    path = Path(path)
    raw = read_bytes(path)
    if zipfile.is_zipfile(io.BytesIO(raw)):
        return _read_archive(path, raw, units, time_step)
    return _read_file(path, raw, units, time_step)


def _read_file(
    path: Path, raw: bytes, units: str | None, time_step: float | None
) -> list[Component]:
    if miniseed.recognise(raw):
        components = miniseed.read(path, raw, units)
    else:
        components = _read_text(read_text(path, raw, units, time_step))
    for component in components:
        loudest = float(np.abs(component.acceleration).max())
        if loudest > LOUDEST:
            at = int(np.argmax(np.abs(component.acceleration)))
            raise InputError(
                f"{path}: sample {at + 1} of component {component.code or 1} is "
                f"{loudest / STANDARD_GRAVITY:.3g} g; is the unit wrong, or a number damaged?"
            )
    digest = hashlib.sha256(raw).hexdigest()
    if len(components) == 1 and not components[0].code:
        code = code_in_name(path)
        components = [replace(components[0], code=code)]
    return [replace(component, path=path, sha256=digest) for component in components]


def _read_text(text: RecordText) -> list[Component]:
    for candidate in FORMATS:
        if candidate.recognise(text):
            return [replace(one, format=candidate.name) for one in candidate.read(text)]
    accepted = ", ".join([*(candidate.name for candidate in FORMATS), "miniSEED", "zip"])
    raise text.no_acceleration(f"unknown record format; accepted: {accepted}")


def _read_archive(
    path: Path, raw: bytes, units: str | None, time_step: float | None
) -> list[Component]:
    components: list[Component] = []
    refused: list[str] = []
    for name, member in _members(path, raw):
        try:
            if not member.strip():
                raise NoAccelerationError(f"{path / name}: the file is empty")
            components += _read_file(path / name, member, units, time_step)
        except NoAccelerationError as error:
            refused.append(str(error))
            log.info("left out: %s", error)
    if not components:
        raise NoAccelerationError("\n".join(refused) or f"{path}: the archive is empty")
    return components


def _members(path: Path, raw: bytes) -> list[tuple[str, bytes]]:
    """Names and contents of an archive's files, in order."""
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            names = sorted(name for name in archive.namelist() if not name.endswith("/"))
            if sum(archive.getinfo(name).file_size for name in names) > LARGEST_ARCHIVE:
                raise InputError(f"{path}: holds more than {LARGEST_ARCHIVE / 1e9:g} GB")
            return [(name, archive.read(name)) for name in names]
    except InputError:
        raise
    except Exception as error:  # zlib, lzma and struct raise their own errors on damaged data
        raise InputError(f"{path}: cannot be unpacked ({error})") from None
