"""Walls, straps and edges as the command line and files spell them, with their units."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from shaketable.body import Body
from shaketable.errors import InputError, quoted
from shaketable.inputs import NUMBER
from shaketable.solid import Solid
from shaketable.surroundings import Edge, Pad, Strap, Surroundings, Wall

AWAY = 0.05  # m: where a strap ends that is given no anchor, and where no wall is
LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
FORCES = {"N": 1.0, "kN": 1e3}
#: What a strap may be given, with the units of each.
UNITS: Mapping[str, Mapping[str, float]] = {
    "slack": LENGTHS,
    "stiffness": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
    "damping": {"Ns/m": 1.0, "kNs/m": 1e3},
    "pretension": FORCES,
    "strength": FORCES,
}
EXAMPLE = "top:slack=5mm,stiffness=100kN/m"
_QUANTITY = re.compile(rf"({NUMBER})\s*([A-Za-z/]+)", re.ASCII)


class BodyStrap(NamedTuple):
    """A strap from the middle of a side of some body, which is toward its back or another azimuth.

    Attributes:
        numbers: of a Strap, by their names, in SI: its stiffness, and what else is given.
        height: where it begins [m]; None at the top.
        anchor: where it ends, as of a Strap [m]; None: straight behind its point.
    """

    numbers: Mapping[str, float]
    height: float | None = None
    anchor: tuple[float, ...] | None = None

    def on(
        self,
        body: Body | Solid,
        orientation: float = 0.0,
        side: float = 0.0,
        behind: float = AWAY,
    ) -> Strap:
        """The strap of a body, a solid turned by an orientation [rad].

        Args:
            body, orientation: what it holds.
            side: of a solid, where it begins, from its +x [rad].
            behind: how far behind its point it ends, where it has no anchor [m].

        Raises:
            InputError: it cannot be.
        """
        planar = isinstance(body, Body)
        top = body.whole_height if isinstance(body, Body) else body.height or 2.0 * body.cg_height
        z = top if self.height is None else self.height
        at = complex(body.right) if isinstance(body, Body) else _middle(body, side)
        turned = (at + behind * cmath.exp(1j * side)) * cmath.exp(1j * orientation)
        anchor = self.anchor or ((turned.real, z) if planar else (turned.real, turned.imag, z))
        point = (at.real, z) if planar else (at.real, at.imag, z)
        if len(anchor) != len(point):
            lengths = "two lengths X/Z in the plane" if planar else "three lengths X/Y/Z"
            raise InputError(f"a strap's anchor has {lengths}, found {len(anchor)}")
        return Strap(point=point, anchor=anchor, **self.numbers)


def surroundings_of(
    body: Body | Solid,
    orientation: float = 0.0,
    *,
    side: float = 0.0,
    straps: Sequence[BodyStrap] = (),
    wall_gap: float | None = None,
    wall_friction: float | None = None,
    wall_restitution: float | None = None,
    wall_vertical: bool = True,
    edge: float | None = None,
    lip: float | None = None,
    pull_off: float | None = None,
) -> Surroundings | None:
    """What stands beside a body and holds it; None if nothing is given.

    Args:
        body: what is surrounded.
        orientation: by which a solid is turned [rad]; the wall and the straps turn with it.
        side: of a solid, toward which the wall stands and straps go, from its +x [rad].
        straps: each by where it begins.
        wall_gap: distance of a wall from that side [m].
        wall_friction, wall_restitution: of the wall, where they are not the usual ones.
        wall_vertical: as of a Wall.
        edge: distance of the edge of the support from its side toward -x [m].
        lip: height of the lip there [m].
        pull_off: force that pulls off a foot that is glued down [N].

    Raises:
        InputError: a wall, a strap or an edge that cannot be, friction without a wall, or a lip
            without an edge.
    """
    walls: tuple[Wall, ...] = ()
    if wall_gap is not None:
        wall = Wall(
            azimuth=orientation + side,
            gap=wall_gap,
            restitution=wall_restitution,
            vertical=wall_vertical,
        )
        walls = (wall if wall_friction is None else replace(wall, friction=wall_friction),)
    elif wall_friction is not None or wall_restitution is not None:
        raise InputError("friction or restitution of a wall without its gap: give the gap")
    if edge is None and lip is not None:
        raise InputError("a lip without an edge: give the distance of the edge")
    ends = None
    if edge is not None:
        ends = Edge(at=_front(body) + edge, azimuth=math.pi + orientation, lip=lip or 0.0)
    behind = wall_gap or AWAY
    around = Surroundings(
        walls=walls,
        straps=tuple(each.on(body, orientation, side, behind) for each in straps),
        edge=ends,
        pad=None if pull_off is None else Pad(pull_off=pull_off),
    )
    return around or None


def read_strap(text: str) -> BodyStrap:
    """A strap as EXAMPLE spells it.

    Raises:
        InputError: it cannot be read.
    """
    place, colon, rest = text.partition(":")
    if not colon:
        raise InputError(f"a strap is written like {EXAMPLE}; found {quoted(text)}")
    height = None if place.strip() == "top" else _quantity(place, LENGTHS, "the height")
    given: dict[str, float] = {}
    anchor: tuple[float, ...] | None = None
    named: set[str] = set()
    for part in rest.split(","):
        name, _, value = (each.strip() for each in part.partition("="))
        if name in named:
            raise InputError(f"the strap {quoted(text)} gives its {name} twice: give it once")
        named.add(name)
        if name == "anchor":
            anchor = tuple(_quantity(each, LENGTHS, "anchor") for each in value.split("/"))
        elif name in UNITS:
            given[name] = _quantity(value, UNITS[name], name)
        else:
            accepted = ", ".join([*UNITS, "anchor"])
            raise InputError(f"a strap has no {quoted(name)}; accepted: {accepted}")
    if "stiffness" not in given:
        raise InputError(f"the strap {quoted(text)} has no stiffness, such as stiffness=100kN/m")
    return BodyStrap(given, height, anchor)


def metres(millimetres: float | None) -> float | None:
    """A length that may not be given."""
    return None if millimetres is None else 1e-3 * millimetres


def _front(body: Body | Solid) -> float:
    """How far a body reaches toward -x from the foot of its centre of gravity [m]."""
    if isinstance(body, Body):
        return body.left
    return body.diameter / 2 if body.diameter is not None else -float(body.corners[:, 0].min())


def _middle(solid: Solid, side: float) -> complex:
    """The middle of the side toward an azimuth [rad], x + iy from the foot of its centre [m]."""
    outward = cmath.exp(1j * side)
    if solid.diameter is not None:
        return solid.diameter / 2 * outward
    corners = (solid.corners[:, 0] + 1j * solid.corners[:, 1]) / outward
    far = float(corners.real.max())
    ends = corners.imag[corners.real > far - 1e-9 * (1.0 + abs(far))]
    return complex(far, 0.5 * float(ends.min() + ends.max())) * outward


def _quantity(text: str, units: Mapping[str, float], name: str) -> float:
    """A number with its unit, in SI."""
    match = _QUANTITY.fullmatch(text.strip())
    if not match or match[2] not in units:
        raise InputError(
            f"of a strap {name} is a number with one of the units {', '.join(units)}, found "
            f"{quoted(text.strip())}"
        )
    return float(match[1]) * units[match[2]]
