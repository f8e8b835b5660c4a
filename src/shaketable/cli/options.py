"""Options that several commands share, and what is made from them."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Annotated, Any

import typer

from shaketable.errors import InputError, quoted
from shaketable.language import LANGUAGES, Language
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
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Replace the results in an existing folder.")
]
LanguageName = Annotated[
    str, typer.Option(help="Language of the report and of most messages: en, es or de.")
]
Scale = Annotated[float, typer.Option(help="Factor on the motions.")]
TiltDeg = Annotated[
    float, typer.Option(help="Tilt of the support [degrees]; above zero, downhill is toward -x.")
]
DownhillShare = Annotated[
    float, typer.Option(help="Share of the falls that the wanted tilt sends downhill.")
]
BaseM = Annotated[float, typer.Option(help="Base, along the shaking [m].")]
HeightM = Annotated[float, typer.Option(help="Full height [m].")]
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
Eccentricity = Annotated[
    float,
    typer.Option(
        help="Distance of the centre of gravity's foot from the corner toward -x, the front, over "
        "the size along x; 0.5 is symmetric."
    ),
]
ModelOfShape = Annotated[
    ModelWord | None,
    typer.Option(
        "--model",
        help="rocking: neither slides nor jumps; general: slides and jumps, too. "
        "[rocking, or in three dimensions general]",
    ),
]
ModelName = Annotated[
    ModelWord,
    typer.Option(
        "--model", help="rocking: neither slides nor jumps; general: slides and jumps, too."
    ),
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


def warn_of_sizes(sizes: Mapping[str, float]) -> None:
    """Warn of sizes [m], by their options, that no furniture has: they may be in another unit."""
    from shaketable.inventory.plausible import FURNITURE

    for name, size in sizes.items():
        if not FURNITURE[0] <= size <= FURNITURE[1]:
            log.warning("%s: %g m is no size of furniture; is it in another unit?", name, size)


@dataclass(frozen=True)
class ContactOptions:
    """The contact model of a planar body."""

    model: ModelName = ModelWord.ROCKING
    static_friction: StaticFriction = None
    kinetic_friction: KineticFriction = None
    normal_restitution: NormalRestitution = 0.0
    restitution_factor: RestitutionFactor = 1.0

    def contact(self) -> Model:
        """The model; InputError for what it has not, or what is out of range."""
        return model_from(self, self.model)


@dataclass(frozen=True)
class ContactOfShapeOptions:
    """The contact model of a planar body, or of a solid."""

    model: ModelOfShape = None
    static_friction: StaticFriction = None
    kinetic_friction: KineticFriction = None
    normal_restitution: NormalRestitution = 0.0
    restitution_factor: RestitutionFactor = 1.0

    def word(self, solid: bool) -> ModelWord:
        """Which model; that of a solid is the general one by default."""
        return self.model or (ModelWord.GENERAL if solid else ModelWord.ROCKING)

    def contact(self, solid: bool) -> Model:
        """The model; InputError for what it has not, or what is out of range."""
        return model_from(self, self.word(solid))


@dataclass(frozen=True)
class ReadingOptions:
    """What a record file may not say."""

    units: Units = None
    time_step_s: TimeStep = None

    @property
    def as_read(self) -> dict[str, Any]:
        """As the readers of records take them."""
        return {"units": self.units, "time_step": self.time_step_s}


@dataclass(frozen=True)
class ListOptions:
    """How a list of objects is read."""

    sheet: Annotated[
        str | None,
        typer.Option(help="Sheet of the workbook that holds the objects. [the only one that may]"),
    ] = None
    columns: Annotated[
        str | None,
        typer.Option(
            help="TOML file that says what columns mean, and which sheet. [the one beside the "
            "list, such as list.xlsx.columns.toml]"
        ),
    ] = None

    accept_sizes: Annotated[
        bool,
        typer.Option(
            "--accept-sizes", help="Accept sizes smaller or larger than those of furniture."
        ),
    ] = False
    catalogue: Annotated[
        bool,
        typer.Option(
            "--catalogue",
            help="Take missing sizes from the catalogue of common things, by name: the ones "
            "that tip most easily.",
        ),
    ] = False

    @property
    def as_list(self) -> dict[str, Any]:
        """As the reader of lists takes them."""
        return asdict(self)


def model_from(given: ContactOptions | ContactOfShapeOptions, model: ModelWord) -> Model:
    """The model that the options describe.

    Raises:
        InputError: friction or restitution for a model that has none, or out of range.
    """
    if model is ModelWord.GENERAL:
        friction = given.static_friction
        if friction is None and given.kinetic_friction is not None:
            raise InputError(
                "--kinetic-friction: without --static-friction nothing begins to slide; give both"
            )
        return General(
            static_friction=math.inf if friction is None else friction,
            kinetic_friction=given.kinetic_friction,
            normal_restitution=given.normal_restitution,
            restitution_factor=given.restitution_factor,
        )
    named = [
        name
        for name, is_given in {
            "--static-friction": given.static_friction is not None,
            "--kinetic-friction": given.kinetic_friction is not None,
            "--normal-restitution": given.normal_restitution != 0.0,
        }.items()
        if is_given
    ]
    if named:
        raise InputError(f"{', '.join(named)}: only --model general slides and bounces; add it")
    return Rocking(restitution_factor=given.restitution_factor)


def language_of(name: str) -> Language:
    """The language that --language names.

    Raises:
        InputError: it is not spoken here.
    """
    found = next((each for each in LANGUAGES if each == name.strip().lower()), None)
    if found is None:
        raise InputError(f"--language: accepted are {', '.join(LANGUAGES)}, found {quoted(name)}")
    return found
