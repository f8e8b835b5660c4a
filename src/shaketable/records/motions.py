"""Motions from recorded components: the choice of a horizontal one and of its vertical one."""

from __future__ import annotations

import logging
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, refused
from shaketable.language import tell
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.records.component import Component, same_code
from shaketable.records.read import read_components
from shaketable.records.siblings import Reader, no_vertical, told_by_name, vertical_beside
from shaketable.records.transverse import right_handed, transverse_of

log = logging.getLogger(__name__)

AUTO = "auto"
_NEAR = 0.5  # degrees: networks print whole degrees


def read_motion(
    path: str | Path,
    *,
    component: str | float | None = None,
    components: int = 1,
    vertical: str | Path | None = None,
    units: str | None = None,
    time_step: float | None = None,
) -> Motion:
    """Read a motion from a record file of any known format.

    Records that their networks publish uncorrected carry their instruments' offsets; their mean is
    subtracted. Where the two time steps differ, the coarser component is interpolated linearly at
    the finer step; where the lengths differ, the shorter is padded with zeros. A vertical
    component that is positive downwards is reversed. The motion's origin records all of this.

    Args:
        path: a file that read_components reads.
        component: which horizontal component, by code ("EW", "H1"), by azimuth in degrees
            ("360", 360) or by channel ("channel 3"), where the file holds several.
        components: 1 for the horizontal one alone; 2 for both horizontal ones; 3 for the vertical
            one, too. The transverse one is at the horizontal's azimuth less 90°, in the same file
            or in one beside it; what was recorded the other way is reversed. Of a file that holds
            both, and without `component`, the two are taken as they were recorded.
        vertical: a file with the vertical component, or "auto": the one in the same file or,
            if it has none, in the file beside it whose name differs only in the component.
        units, time_step: as for read_components, for both files.

    Raises:
        InputError: a file that cannot be read, a component that it does not hold, several
            components and no choice between them, or a second horizontal or a vertical one that
            cannot be found.
    """
    if components not in (1, 2, 3):
        raise InputError(f"components= must be 1, 2 or 3, got {components!r}")
    read = partial(read_components, units=units, time_step=time_step)
    held = read(path)
    pair = None
    if components > 1 and component is None:
        pair = right_handed([one for one in held if not one.is_vertical])
    horizontal = choose(held, component, Path(path)) if pair is None else pair[0]
    transverse: Component | None = None
    if components > 1:
        transverse = transverse_of(horizontal, held, read) if pair is None else pair[1]
    upright: Component | None = None
    if vertical == AUTO or (vertical is None and components == 3):
        upright = vertical_of(horizontal, held, read)
    elif vertical is not None:
        upright = _only_vertical(read(vertical), vertical)
    return motion_of(horizontal, upright, transverse, name=Path(path).stem)


def choose(components: list[Component], wanted: str | float | None, path: Path) -> Component:
    """The horizontal component that `wanted` names, or the only one.

    Raises:
        InputError: none or several match; the message says what the file holds.
    """
    horizontal = [one for one in components if not one.is_vertical]
    if not horizontal:
        raise refused(
            path,
            tell(
                "holds a vertical component ({code}); give it as the vertical component "
                "of a horizontal one",
                code=components[0].code,
            ),
        )
    found = horizontal if wanted is None else [one for one in horizontal if _is(one, wanted)]
    if len(found) == 1:
        return found[0]
    held = "; ".join(_described(one) for one in horizontal)
    if wanted is None:
        raise refused(
            path,
            tell(
                "holds {count} horizontal components ({held}); choose with component=",
                count=len(found),
                held=held,
            ),
        )
    raise refused(
        path,
        tell(
            "{count} components match {wanted!r}; the file holds {held}",
            count=len(found),
            wanted=wanted,
            held=held,
        ),
    )


def vertical_of(horizontal: Component, components: list[Component], read: Reader) -> Component:
    """The vertical component recorded with `horizontal`, in the same file or beside it.

    Raises:
        InputError: none, or several.
    """
    vertical = [one for one in components if one.is_vertical]
    same = [one for one in vertical if one.path == horizontal.path]
    same = same or [one for one in vertical if _recorded_with(horizontal, one)]
    placed = [one for one in same if one.location == horizontal.location]
    same = placed if len(placed) == 1 else same
    if len(same) == 1:
        return same[0]
    if same:
        held = "; ".join(_described(one) for one in same)
        raise no_vertical(
            horizontal.path,
            tell(
                "holds {count} vertical components ({held}); name a file",
                count=len(same),
                held=held,
            ),
        )
    return vertical_beside(horizontal, read)


def _recorded_with(horizontal: Component, vertical: Component) -> bool:
    """Whether another member of an archive is of the same record, by its name or its header."""
    said = (horizontal.station, horizontal.event, horizontal.location)
    return told_by_name(horizontal.path.name, vertical.path.name) or (
        bool(horizontal.station) and said == (vertical.station, vertical.event, vertical.location)
    )


def motion_of(
    horizontal: Component,
    vertical: Component | None,
    transverse: Component | None = None,
    *,
    name: str,
) -> Motion:
    """A motion of one horizontal component and, if given, a vertical and a transverse one.

    Raises:
        InputError: components that do not begin together.
    """
    name = name.encode("utf-8", "replace").decode()  # a file name may not be valid text
    parts = {"horizontal": horizontal, "vertical": vertical, "transverse": transverse}
    given = {word: one for word, one in parts.items() if one is not None}
    for other in given.values():
        if abs(horizontal.start - other.start) > min(horizontal.time_step, other.time_step) / 2:
            raise InputError(
                f"{horizontal.path} begins at {horizontal.start:g} s and {other.path} at "
                f"{other.start:g} s; cut them to the same start"
            )
    step = min(one.time_step for one in given.values())
    even = {word: at_step(*_upward(one), one.time_step, step) for word, one in given.items()}
    count = max(series.size for series, _ in even.values())
    done = {word: padded(series, origin, count) for word, (series, origin) in even.items()}
    series = {word: each for word, (each, _) in done.items()}
    origins = {word: origin for word, (_, origin) in done.items()}
    return Motion(
        series["horizontal"],
        step,
        vertical=series.get("vertical"),
        transverse=series.get("transverse"),
        name=name,
        origin=origins["horizontal"],
        vertical_origin=origins.get("vertical"),
        transverse_origin=origins.get("transverse"),
    )


def _upward(component: Component) -> tuple[NDArray[np.float64], Origin]:
    """The samples without offset, positive upwards if they are vertical, and their origin."""
    series, origin = _centred(component)
    if component.is_vertical and component.upward < 0.0:
        said = f"reversed: the file counts {component.code} as positive"
        return -series, origin.after(said)
    return series, origin


def _is(component: Component, wanted: str | float) -> bool:
    word = str(wanted).strip()
    if same_code(component.code, word):
        return True
    if word.lower().startswith("chan"):
        return word.split()[-1] == str(component.channel)
    try:
        azimuth = float(word)
    except ValueError:
        return False
    if component.azimuth is None:
        return False
    return abs((component.azimuth - azimuth + 180.0) % 360.0 - 180.0) <= _NEAR


def _described(component: Component) -> str:
    said = component.code or "unnamed"
    if component.azimuth is not None and not component.code.isdigit():
        said += f", {component.azimuth:g}°"
    return said if component.channel is None else f"channel {component.channel}: {said}"


def _only_vertical(components: list[Component], path: str | Path) -> Component:
    """The vertical component of a file, or its only component, whatever its code."""
    if len(components) == 1:
        return components[0]
    vertical = [one for one in components if one.is_vertical]
    if len(vertical) != 1:
        codes = ", ".join(one.code for one in components)
        raise refused(
            path,
            tell(
                "holds {count} vertical components among {codes}", count=len(vertical), codes=codes
            ),
        )
    return vertical[0]


def _centred(component: Component) -> tuple[NDArray[np.float64], Origin]:
    """The samples without the offset of an uncorrected record, and their origin."""
    if not component.uncorrected:
        return component.acceleration, component.origin
    mean = float(component.acceleration.mean())
    said = f"mean of {mean:.3g} m/s² subtracted: the record is published uncorrected"
    return component.acceleration - mean, component.origin.after(said)


def at_step(
    series: NDArray[np.float64], origin: Origin, own: float, step: float
) -> tuple[NDArray[np.float64], Origin]:
    """A series interpolated linearly from its own time step to another one [s], and its origin."""
    if own == step:
        return series, origin
    said = f"interpolated linearly from a time step of {own:g} s to {step:g} s"
    log.warning("%s: %s", origin.file, said)
    time = np.arange(series.size) * own
    even = np.arange(0.0, time[-1] + step / 2, step)
    return np.interp(even, time, series), origin.after(said)


def padded(
    series: NDArray[np.float64], origin: Origin, count: int
) -> tuple[NDArray[np.float64], Origin]:
    """A series with zeros up to a number of samples, and its origin."""
    if series.size == count:
        return series, origin
    said = f"{count - series.size} zeros added at the end"
    log.warning("%s: %s", origin.file, said)
    return np.pad(series, (0, count - series.size)), origin.after(said)
