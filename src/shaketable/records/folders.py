"""A folder of records as a suite: every horizontal component, if wanted with its vertical one."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache, partial
from pathlib import Path

from shaketable.errors import Fault, InputError, refusal, refused
from shaketable.language import tell
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records.component import Component
from shaketable.records.motions import motion_of, vertical_of
from shaketable.records.read import files_named, read_components
from shaketable.records.siblings import NoVerticalError, Reader, told_by_name
from shaketable.records.text import NoAccelerationError

log = logging.getLogger(__name__)

NEAR = 8  # files before and after one, in order of names, among which its siblings are
AT_HAND = 64  # files whose components are kept for their siblings


def record_files(folder: Path) -> list[Path]:
    """Every file below a folder except hidden ones, in sorted order."""
    return sorted(
        path
        for path in folder.rglob("*")
        if path.is_file()
        and not any(part.startswith(".") for part in path.relative_to(folder).parts)
    )


def components_of(
    files: list[Path], read: Reader, progress: Progress
) -> Iterator[tuple[Path, list[Component] | NoAccelerationError | InputError]]:
    """Each file with its components, or with the reason why it has none."""
    with meter("reading records", len(files), progress) as done:
        for path in files:
            try:
                yield path, read(path)
            except InputError as error:
                yield path, error
            done(1)


def each_of_folder(
    folder: Path,
    *,
    vertical: bool,
    units: str | None,
    time_step: float | None,
    progress: Progress = False,
) -> Iterator[Motion]:
    """A motion for each horizontal component of the records below a folder, in order of names.

    They are read as they are asked for. Files that hold no acceleration are left out, and a
    warning names them in the end; records that cannot be read are errors.

    Args:
        vertical: whether to pair each with its vertical component, where there is one.

    Raises:
        InputError: after the last file; it names every record that cannot be read, or says that no
            component is horizontal.
    """
    read = lru_cache(AT_HAND)(partial(read_components, units=units, time_step=time_step))
    paths: list[Path] = []
    upward: set[Path] = set()
    left_out: list[str] = []
    faults: list[Fault] = []
    count = flat = 0
    for path, found in components_of(record_files(folder), read, progress):
        if isinstance(found, NoAccelerationError):
            left_out.append(path.name)
            continue
        paths.append(path)
        if isinstance(found, InputError):
            faults += found.listed
            continue
        if len(found) == 1 and found[0].is_vertical and not found[0].station:
            upward.add(path)
        try:
            motions = _motions(found, vertical, read)
        except InputError as error:
            faults += error.listed
            continue
        count += len(motions)
        flat += sum(motion.vertical is None for motion in motions)
        yield from motions
    if faults:
        raise refusal(list(dict.fromkeys(faults)))
    if left_out:
        log.warning("%s: left out, not records: %s", folder, files_named(left_out))
    alone = _lonely(upward, paths)
    if alone:
        log.warning(
            "%s: left out, by their names vertical components, with no horizontal one beside them: "
            "%s",
            folder,
            files_named(alone),
        )
    if not count:
        raise refused(folder, tell("no record with a horizontal component below this folder"))
    if vertical and flat:
        log.warning("%s: %d of %d motions have no vertical component", folder, flat, count)


def _lonely(upward: set[Path], paths: list[Path]) -> list[str]:
    """Names of files that only their names call vertical, where no file beside them fits."""
    lonely = []
    for k, path in enumerate(paths):
        if path in upward:
            beside = paths[max(0, k - NEAR) : k + NEAR + 1]
            if not any(told_by_name(other.stem, path.stem) for other in beside):
                lonely.append(path.name)
    return lonely


def read_file(
    path: Path, *, vertical: bool, units: str | None, time_step: float | None
) -> list[Motion]:
    """A motion for each horizontal component of a file; none if it holds only a vertical one.

    Args:
        vertical: whether to pair each with its vertical component, where there is one.

    Raises:
        InputError: a file that cannot be read.
    """
    read = partial(read_components, units=units, time_step=time_step)
    motions = _motions(read(path), vertical, read)
    if vertical and any(motion.vertical is None for motion in motions):
        log.warning("%s: no vertical component in it or beside it", path)
    return motions


def _motions(components: list[Component], vertical: bool, read: Reader) -> list[Motion]:
    horizontal = [one for one in components if not one.is_vertical]
    motions = []
    for one in horizontal:
        above = None
        if vertical:
            with suppress(NoVerticalError):
                above = vertical_of(one, components, read)
        name = f"{one.path.stem} {one.code}" if len(horizontal) > 1 else one.path.stem
        motions.append(motion_of(one, above, name=name))
    return motions
