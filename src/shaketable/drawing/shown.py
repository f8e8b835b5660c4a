"""What a drawing asks of the object that it shows, and how it writes names.

The objects themselves are defined in packages above this one.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import printable
from shaketable.outcome import Outcome, downhill_sign
from shaketable.physics.plane.phases import Phase

Series = NDArray[np.float64]

LOOSE, TAUT, LOADED = "0.45", "tab:orange", "tab:red"  # straps


class ShownBody(Protocol):
    """What is asked of a `Body`."""

    @property
    def name(self) -> str: ...
    @property
    def cg_height(self) -> float: ...
    @property
    def whole_height(self) -> float: ...
    @property
    def left(self) -> float: ...
    @property
    def right(self) -> float: ...
    @property
    def slenderness_left(self) -> float: ...
    @property
    def slenderness_right(self) -> float: ...


class ShownMotion(Protocol):
    """What is asked of a `Motion`."""

    @property
    def name(self) -> str: ...
    @property
    def time(self) -> Series: ...
    @property
    def duration(self) -> float: ...
    @property
    def horizontal(self) -> Series: ...
    @property
    def vertical(self) -> Series | None: ...
    @property
    def transverse(self) -> Series | None: ...


class ShownSupport(Protocol):
    """What is asked of a `Support`."""

    @property
    def tilt(self) -> float: ...


class ShownModel(Protocol):
    """What is asked of a contact model."""

    @property
    def slides(self) -> bool: ...


class ShownWall(Protocol):
    """What is asked of a `Wall`."""

    @property
    def azimuth(self) -> float: ...
    @property
    def gap(self) -> float: ...
    @property
    def vertical(self) -> bool: ...


class ShownStrap(Protocol):
    """What is asked of a `Strap`."""

    @property
    def point(self) -> tuple[float, ...]: ...
    @property
    def anchor(self) -> tuple[float, ...]: ...


class ShownEdge(Protocol):
    """What is asked of an `Edge`."""

    @property
    def at(self) -> float: ...
    @property
    def azimuth(self) -> float: ...
    @property
    def lip(self) -> float: ...
    @property
    def drop(self) -> float: ...


class ShownSurroundings(Protocol):
    """What is asked of the `Surroundings` of a body."""

    @property
    def walls(self) -> tuple[ShownWall, ...]: ...
    @property
    def straps(self) -> tuple[ShownStrap, ...]: ...
    @property
    def edge(self) -> ShownEdge | None: ...


class ShownResponse(Protocol):
    """What is asked of a `PlanarResponse`."""

    @property
    def body(self) -> ShownBody: ...
    @property
    def motion(self) -> ShownMotion: ...
    @property
    def support(self) -> ShownSupport: ...
    @property
    def surroundings(self) -> ShownSurroundings | None: ...
    @property
    def model(self) -> ShownModel: ...
    @property
    def outcome(self) -> Outcome: ...
    @property
    def overturning_time(self) -> float: ...
    @property
    def peak_rotation(self) -> float: ...
    @property
    def impacts(self) -> int: ...
    @property
    def time(self) -> Series: ...
    @property
    def rotation(self) -> Series: ...
    @property
    def position(self) -> Series: ...
    @property
    def velocity(self) -> Series: ...
    @property
    def slip(self) -> Series: ...
    @property
    def peak_slip(self) -> float: ...
    @property
    def phase_times(self) -> Series: ...
    @property
    def phases(self) -> tuple[Phase, ...]: ...
    @property
    def strap_forces(self) -> Series: ...
    @property
    def strap_broke_at(self) -> tuple[float, ...]: ...
    @property
    def off_edge(self) -> bool: ...
    @property
    def landing_rotation(self) -> float: ...


def lying_rotation(response: ShownResponse) -> float:
    """θ [rad] at which a fall ends: π/2 toward +x, -π/2 toward -x; over an edge as it lands."""
    if response.off_edge:
        return response.landing_rotation
    return response.outcome * downhill_sign(response.support.tilt) * math.pi / 2


def strap_colour(force: float, most: float) -> str:
    """Of a strap in a picture: grey where it is loose, redder the more of its most it bears."""
    if force <= 0.0:
        return LOOSE
    return TAUT if force < 0.5 * most else LOADED


def drawn(name: str) -> str:
    """A name as matplotlib shows it: no formula between dollar signs, no control character."""
    return printable(name).replace("$", r"\$")
