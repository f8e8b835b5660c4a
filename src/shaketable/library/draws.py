"""What is not known of a thing and of the model, drawn by a Latin hypercube for each case.

Every draw is a solid, what holds it, its friction and how it is turned, and meets one motion at all
scales. What was drawn stands beside each simulation in standard deviations, so that a regression
tells how much of a function's dispersion is the object's and how much the model's.
"""

from __future__ import annotations

import math
import zlib
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.library.case import Case
from shaketable.models import General
from shaketable.solid import Solid
from shaketable.surroundings import Edge, Strap, Surroundings, Wall
from shaketable.units import STANDARD_GRAVITY

#: Shares by which lengths of one size may differ, either way.
BASE_DIFFERS, HEIGHT_DIFFERS = 0.03, 0.02
#: The foot of the centre of gravity, as a share of the base from one side.
FOOT = (0.45, 0.55)
#: What is left of the angular velocity that a plastic impact leaves.
KEPT = (0.8, 1.0)
#: Contour friction of the rim of a cylinder [m] (Leine 2009): hard rims on hard floors.
CONTOUR = (0.0, 0.001)
#: Equally likely values that stand for a range of what a batch of simulations shares.
STEPS = 3
WALL_FRICTION, WALL_RESTITUTION = 0.3, 0.3
#: A strap of webbing or a chain, per kg of the thing: 4.5 Hz with 18 % of critical damping.
STIFFNESS, DAMPING = 800.0, 10.0  # N/m, N s/m
#: What is drawn of a thing, and of the model.
OF_OBJECT = ("depth", "width", "height", "cg_height", "foot_x", "foot_y", "friction")
OF_MODEL = ("restitution", "contour")


class Draw(NamedTuple):
    """A thing as it may be.

    Attributes:
        solid: of 1 kg.
        around: what surrounds it, as it is turned; None where nothing does.
        model: with its friction and its losses at impacts.
        orientation: by which it is turned, from +x toward +y [rad]; its back is toward its own +x.
    """

    solid: Solid
    around: Surroundings | None
    model: General
    orientation: float


@dataclass(frozen=True, eq=False)
class Draws:
    """All draws of a case.

    Attributes:
        each: the draws, (draw,).
        standard: what was drawn, in standard deviations, (parameter, draw).
        spread: the standard deviation of each: of ln of a length, a friction or what impacts keep,
            of the foot as a share of the base, of contour friction in mm, (parameter,).
        parameters: their names, of OF_OBJECT and OF_MODEL.
    """

    each: tuple[Draw, ...]
    standard: NDArray[np.float64]
    spread: NDArray[np.float64]
    parameters: tuple[str, ...]


def draws_of(case: Case, count: int, seed: int) -> Draws:
    """The draws of a case; those of another case with the same seed are independent of them."""
    from scipy.stats import qmc

    names = _drawn(case)
    random = np.random.default_rng([seed, zlib.crc32(case.name.encode())])
    share = qmc.LatinHypercube(len(names) + 1, rng=random).random(count)
    for name in ("friction", "restitution"):  # a batch of simulations shares a model
        at = names.index(name)
        share[:, at] = (np.floor(STEPS * share[:, at]) + 0.5) / STEPS
    each = tuple(
        _draw(case, dict(zip(names, row, strict=False)), 2.0 * math.pi * float(row[-1]))
        for row in share.tolist()
    )
    values = share[:, :-1].T
    deviation = values.std(axis=1, keepdims=True)
    standard = (values - values.mean(axis=1, keepdims=True)) / np.where(deviation, deviation, 1.0)
    spread = deviation[:, 0] * np.array([_width(case, name) for name in names])
    return Draws(each, standard, spread, names)


def _width(case: Case, name: str) -> float:
    """How wide the range is from which something is drawn, in the unit of `Draws.spread`."""
    cg = case.thing.common.cg
    low, high = {
        "depth": (1.0 - BASE_DIFFERS, 1.0 + BASE_DIFFERS),
        "width": (1.0 - BASE_DIFFERS, 1.0 + BASE_DIFFERS),
        "height": (1.0 - HEIGHT_DIFFERS, 1.0 + HEIGHT_DIFFERS),
        "cg_height": (cg.least, cg.most),
        "friction": case.friction,
        "restitution": KEPT,
    }.get(name, (1.0, 1.0))
    if name in ("foot_x", "foot_y"):
        return FOOT[1] - FOOT[0]
    return 1e3 * (CONTOUR[1] - CONTOUR[0]) if name == "contour" else math.log(high / low)


def _drawn(case: Case) -> tuple[str, ...]:
    """What is drawn of the thing of a case."""
    without = {"width", "foot_x", "foot_y"} if case.thing.round else {"contour"}
    return tuple(name for name in (*OF_OBJECT, *OF_MODEL) if name not in without)


def _between(ends: tuple[float, float], share: float) -> float:
    return ends[0] + (ends[1] - ends[0]) * share


def _draw(case: Case, share: dict[str, float], orientation: float) -> Draw:
    thing = case.thing
    depth = thing.depth * (1.0 + BASE_DIFFERS * (2.0 * share["depth"] - 1.0))
    height = thing.height * (1.0 + HEIGHT_DIFFERS * (2.0 * share["height"] - 1.0))
    cg = height * _between((thing.common.cg.least, thing.common.cg.most), share["cg_height"])
    model = General(
        static_friction=_between(case.friction, share["friction"]),
        restitution_factor=_between(KEPT, share["restitution"]),
    )
    if thing.round:
        solid = Solid.cylinder(
            depth, height, cg_height=cg, contour_friction=_between(CONTOUR, share["contour"]),
            name=thing.name, mass=1.0,
        )  # fmt: skip
        front = back = depth / 2
    else:
        width = thing.width * (1.0 + BASE_DIFFERS * (2.0 * share["width"] - 1.0))
        foot = _between(FOOT, share["foot_x"]), _between(FOOT, share["foot_y"])
        front, back, right = foot[0] * depth, (1.0 - foot[0]) * depth, foot[1] * width
        if thing.on_feet:
            corners = [(-front, -right), (back, -right), (back, width - right),
                       (-front, width - right)]  # fmt: skip
            solid = Solid.on_feet(
                corners, height, cg_height=cg, castors=(thing.rolls,) * 4, name=thing.name,
                mass=1.0,
            )  # fmt: skip
        else:
            solid = Solid.box(
                depth, width, height, cg_height=cg, eccentricity=foot, name=thing.name, mass=1.0
            )
    return Draw(solid, _around(case, front, back, height, orientation), model, orientation)


def _around(
    case: Case, front: float, back: float, height: float, orientation: float
) -> Surroundings | None:
    """The wall behind a thing, its strap, and the edge of its table.

    Args:
        case: which.
        front, back: from the foot of the centre of gravity to the front and to the back [m].
        height: of the thing [m].
        orientation: by which it is turned [rad].
    """
    held = case.held
    edge = None
    if held.edge is not None:
        edge = Edge(at=front + held.edge, azimuth=math.pi + orientation)
    if held.wall_gap is None:
        return Surroundings(edge=edge) if edge else None
    wall = Wall(
        azimuth=orientation, gap=held.wall_gap, friction=WALL_FRICTION, restitution=WALL_RESTITUTION
    )
    if held.strength is None:
        return Surroundings(walls=(wall,), edge=edge)
    far = back + (held.wall_gap or 0.05)
    strap = Strap(
        point=(back, 0.0, height),
        anchor=(far * math.cos(orientation), far * math.sin(orientation), height),
        stiffness=STIFFNESS,
        damping=DAMPING,
        slack=held.slack,
        strength=held.strength * STANDARD_GRAVITY,
    )
    return Surroundings(walls=(wall,), straps=(strap,), edge=edge)
