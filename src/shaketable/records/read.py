"""One way in for every record format: recognise, read, pair with a vertical component."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import require_positive
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.records import at2, columns
from shaketable.records.component import Component, RecordText, read_text
from shaketable.units import acceleration_factor

log = logging.getLogger(__name__)


class Format(NamedTuple):
    name: str
    recognise: Callable[[RecordText], bool]
    read: Callable[[RecordText], list[Component]]


#: In the order in which they are tried: the most particular first.
FORMATS = [
    Format("PEER AT2", at2.recognise, at2.read),
    Format("columns of numbers", columns.recognise, columns.read),
]


def read_components(
    path: str | Path, *, units: str | None = None, time_step: float | None = None
) -> list[Component]:
    """Every component that a record file holds.

    Args:
        path: a file in one of FORMATS.
        units: of acceleration ("g", "m/s2", "cm/s2", "gal"), where the file does not say.
        time_step: [s], where the file does not say.

    Raises:
        InputError: names the file, the line, what was found and what is accepted.
    """
    if units is not None:
        acceleration_factor(units)
    if time_step is not None:
        require_positive("time_step [s]", time_step)
    text = read_text(Path(path), units, time_step)
    for candidate in FORMATS:
        if candidate.recognise(text):
            return candidate.read(text)
    accepted = ", ".join(candidate.name for candidate in FORMATS)
    raise InputError(f"{path}: unknown record format; accepted: {accepted}")


def read_motion(
    path: str | Path,
    *,
    vertical: str | Path | None = None,
    units: str | None = None,
    time_step: float | None = None,
) -> Motion:
    """A motion from a record file, and its vertical component from a second one.

    Where the two time steps differ, the coarser component is interpolated linearly at the finer
    step; where the lengths differ, the shorter is padded with zeros. Both are said in the log.

    Args:
        path: the horizontal component.
        vertical: the vertical component, up positive.
        units, time_step: as for read_components, for both files.

    Raises:
        InputError: a file that cannot be read, or that holds more than one component.
    """
    across = _only(read_components(path, units=units, time_step=time_step))
    name = Path(path).stem
    if across.is_vertical:
        raise InputError(
            f"{path}: holds a vertical component ({across.code}); give it as the vertical of a "
            "horizontal one"
        )
    if vertical is None:
        return Motion(across.acceleration, across.time_step, name=name)
    up = _only(read_components(vertical, units=units, time_step=time_step))
    if abs(across.start - up.start) > min(across.time_step, up.time_step) / 2:
        raise InputError(
            f"{path} begins at {across.start:g} s and {vertical} at {up.start:g} s; "
            "cut them to the same start"
        )
    step = min(across.time_step, up.time_step)
    a_x, a_y = _at_step(across, step), _at_step(up, step)
    count = max(a_x.size, a_y.size)
    return Motion(
        _padded(across.path, a_x, count), step, vertical=_padded(up.path, a_y, count), name=name
    )


def _only(components: list[Component]) -> Component:
    if len(components) > 1:
        codes = ", ".join(component.code for component in components)
        raise InputError(
            f"{components[0].path}: holds {len(components)} components ({codes}); "
            "take one of read_components() and build a Motion of it"
        )
    return components[0]


def _at_step(component: Component, step: float) -> NDArray[np.float64]:
    if component.time_step == step:
        return component.acceleration
    time = np.arange(component.acceleration.size) * component.time_step
    log.warning(
        "%s: interpolated linearly from a time step of %g s to %g s",
        component.path,
        component.time_step,
        step,
    )
    return np.interp(np.arange(0.0, time[-1] + step / 2, step), time, component.acceleration)


def _padded(path: Path, series: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    if series.size < count:
        log.warning("%s: %d zeros added at its end", path, count - series.size)
    return np.pad(series, (0, count - series.size))
