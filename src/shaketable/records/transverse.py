"""The second horizontal component of a recording, by its azimuth: in the same file or beside it.

The transverse component is the one whose compass azimuth is that of the horizontal one less 90°:
seen from above it points to the left of it, so that horizontal, transverse and up are right-handed.
Which of two files comes first says nothing of that.
"""

from __future__ import annotations

import os
from dataclasses import replace

from shaketable.errors import InputError, named, refused
from shaketable.language import tell, translated
from shaketable.records.component import Component
from shaketable.records.siblings import Reader, beside_by_name

NEAR = 1.0  # degrees from a right angle: networks print whole degrees
MOST_NAMED = 5
MOST_READ = 50  # files beside it whose names would fit


def is_left_of(transverse: float | None, horizontal: float | None) -> bool:
    """Whether an azimuth [degrees] is another one less 90°; not if one is unknown."""
    if transverse is None or horizontal is None:
        return False
    return abs((horizontal - transverse) % 360.0 - 90.0) <= NEAR


def right_handed(components: list[Component]) -> tuple[Component, Component] | None:
    """The right-handed pair of horizontal components, or None unless exactly one exists.

    Args:
        components: the horizontal ones of a file.
    """
    couples = [
        (one, other)
        for one in components
        for other in components
        if is_left_of(other.azimuth, one.azimuth)
    ]
    return couples[0] if len(couples) == 1 else None


def transverse_of(horizontal: Component, components: list[Component], read: Reader) -> Component:
    """The transverse component recorded with `horizontal`, in the same file or beside it.

    What was recorded the other way round, toward the azimuth plus 90°, is reversed.

    Args:
        horizontal: the horizontal component.
        components: of its file.
        read: reads the components of another file.

    Raises:
        InputError: an unknown azimuth, no such component, or several.
    """
    if horizontal.azimuth is None:
        raise refused(
            horizontal.path,
            tell(
                "the azimuth of {component} is not known, and without it nobody can tell "
                "which way the second component points; make the pair yourself: "
                "Motion(horizontal, time_step, transverse=...)",
                component=horizontal.code or translated("its component"),
            ),
        )
    found = [one for one in components if one is not horizontal and _fits(one, horizontal)]
    if not found:
        found = [one for one in _beside(horizontal, read) if _fits(one, horizontal)]
    if len(found) != 1:
        held = named([f"{one.path.name} {one.code}" for one in found], MOST_NAMED)
        said = translated("none is")
        if found:
            said = tell("several are at a right angle to it ({held})", held=held)
        raise refused(
            horizontal.path,
            tell(
                "its transverse component, at azimuth {azimuth:g}°, was looked for in it "
                "and beside it: {said}; choose with component=, or take one component "
                "alone",
                azimuth=(horizontal.azimuth - 90.0) % 360.0,
                said=said,
            ),
        )
    other = found[0]
    return other if is_left_of(other.azimuth, horizontal.azimuth) else _reversed(other)


def _fits(other: Component, horizontal: Component) -> bool:
    """Whether another component is horizontal, of the same recording and at a right angle."""
    if other.is_vertical or other.location != horizontal.location:
        return False
    if (other.station, other.event) != (horizontal.station, horizontal.event):
        return False
    return is_left_of(other.azimuth, horizontal.azimuth) or is_left_of(
        horizontal.azimuth, other.azimuth
    )


def _beside(horizontal: Component, read: Reader) -> list[Component]:
    """The components of the files whose names differ from this one's in the component."""
    path = horizontal.path
    folder = path.parent
    if not folder.is_dir():  # a member of an archive
        return []
    names = sorted(entry.name for entry in os.scandir(folder) if entry.is_file())
    near = [name for name in names if name != path.name and beside_by_name(path.name, name)]
    found: list[Component] = []
    for name in near[:MOST_READ]:
        try:
            found += read(folder / name)
        except InputError:
            continue  # no record; the name alone made it a candidate
    return found


def _reversed(component: Component) -> Component:
    """The same recording, counted positive the other way."""
    azimuth = component.azimuth or 0.0
    said = f"reversed: recorded toward {azimuth:g}°"
    return replace(
        component,
        acceleration=-component.acceleration,
        azimuth=(azimuth + 180.0) % 360.0,
        processing=(*component.processing, said),
    )
