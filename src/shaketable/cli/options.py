"""Options that several commands share, and what is made from them."""

from __future__ import annotations

import logging
import math
from enum import StrEnum
from typing import Annotated

import typer

from shaketable.errors import InputError
from shaketable.models import General, Model, Rocking

log = logging.getLogger(__name__)


class Unit(StrEnum):
    """Units of acceleration, as the command line spells them."""

    G = "g"
    M_S2 = "m/s2"
    CM_S2 = "cm/s2"
    GAL = "gal"


class ShapeWord(StrEnum):
    """Shapes of solids, as the command line spells them."""

    BOX = "box"
    CYLINDER = "cylinder"


class ModelWord(StrEnum):
    """What a body may do."""

    ROCKING = "rocking"
    GENERAL = "general"


Units = Annotated[
    Unit | None, typer.Option(help="Unit of acceleration, where a record file does not state it.")
]
TimeStep = Annotated[
    float | None, typer.Option(help="Time step [s], where a record file does not state it.")
]
Scale = Annotated[float, typer.Option(help="Factor on the motions.")]
TiltDeg = Annotated[
    float, typer.Option(help="Tilt of the support [degrees]; above zero, downhill is toward -x.")
]
Control = Annotated[
    float, typer.Option(help="Share of the falls that the wanted tilt sends downhill.")
]
WidthM = Annotated[float, typer.Option(help="Base width [m].")]
HeightM = Annotated[float, typer.Option(help="Full height [m].")]
DepthM = Annotated[
    float | None,
    typer.Option(help="Base depth across the width [m]: a box in three dimensions. [one plane]"),
]
ShapeName = Annotated[
    ShapeWord | None,
    typer.Option(
        "--shape", help="In three dimensions: a box of --depth-m, or a cylinder of --width-m."
    ),
]
AzimuthDeg = Annotated[
    float | None,
    typer.Option(
        help="Downhill on the tilted support, from +x toward +y [degrees], in three dimensions. "
        "[180: toward -x]"
    ),
]
OrientationDeg = Annotated[
    float | None,
    typer.Option(
        help="Turn of the object on its support, from x toward y [degrees], in three dimensions. "
        "[0]"
    ),
]
RollingFrictionM = Annotated[
    float | None,
    typer.Option(
        help="Length that, times the pressure, bounds the moment against rolling [m], in three "
        "dimensions. [0]"
    ),
]
ContourFrictionM = Annotated[
    float | None,
    typer.Option(
        help="Length that, times the pressure and the rate of the contact around the rim, is the "
        "power lost [m]: of a cylinder. [0]"
    ),
]
DrillingFrictionM = Annotated[
    float | None,
    typer.Option(
        help="Length that, times the pressure, bounds the moment against turning on the spot [m], "
        "in three dimensions. [0]"
    ),
]
Eccentricity = Annotated[
    float,
    typer.Option(
        help="Distance of the centre of gravity's foot from the left corner, toward -x, "
        "over the width; 0.5 is symmetric."
    ),
]
ModelOfShape = Annotated[
    ModelWord | None,
    typer.Option(
        "--model",
        help="rocking: no sliding, no jump; general: both of them. "
        "[rocking, or in three dimensions general]",
    ),
]
ModelName = Annotated[
    ModelWord, typer.Option("--model", help="rocking: no sliding, no jump; general: both of them.")
]
StaticFriction = Annotated[
    float | None,
    typer.Option(help="Static friction of the support, with --model general. [no slip]"),
]
KineticFriction = Annotated[
    float | None,
    typer.Option(
        help="Kinetic friction, at most the static one, with --model general. [the static one]"
    ),
]
NormalRestitution = Annotated[
    float, typer.Option(help="Normal restitution of impacts in [0, 1), with --model general.")
]
RestitutionFactor = Annotated[
    float,
    typer.Option(
        help="Factor in (0, 1] on the angular velocity that a rocking impact leaves: tests find "
        "0.60 to 0.98 on granite."
    ),
]


def warn_of_sizes(width: float, height: float, width_option: str = "--width-m") -> None:
    """Warn of sizes [m] that no furniture has: they may be in another unit."""
    from shaketable.inventory.rows import FURNITURE

    for name, size in ((width_option, width), ("--height-m", height)):
        if not FURNITURE[0] <= size <= FURNITURE[1]:
            log.warning("%s: %g m is no size of furniture; is it in another unit?", name, size)


def model_from(
    model: ModelWord,
    static_friction: float | None,
    kinetic_friction: float | None,
    normal_restitution: float,
    restitution_factor: float = 1.0,
) -> Model:
    """The model that the options describe.

    Raises:
        InputError: friction or restitution for a model that has none, or out of range.
    """
    if model is ModelWord.GENERAL:
        return General(
            static_friction=math.inf if static_friction is None else static_friction,
            kinetic_friction=kinetic_friction,
            normal_restitution=normal_restitution,
            restitution_factor=restitution_factor,
        )
    given = {
        "--static-friction": static_friction is not None,
        "--kinetic-friction": kinetic_friction is not None,
        "--normal-restitution": normal_restitution != 0.0,
    }
    if any(given.values()):
        named = ", ".join(name for name, is_given in given.items() if is_given)
        raise InputError(f"{named}: only --model general slides and bounces; add it")
    return Rocking(restitution_factor=restitution_factor)
