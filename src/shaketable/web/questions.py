"""What a visitor asks, checked as it arrives."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, FailFast, Field, field_validator, model_validator

from shaketable.building.typical import STOREY_HEIGHT, STRUCTURES
from shaketable.records import SUITES
from shaketable.records.plausible import LOUDEST
from shaketable.records.text import STEPS
from shaketable.signal.intensity import measure_named
from shaketable.signal.scaling import by_measure
from shaketable.units import OFFERED_UNITS, STANDARD_GRAVITY
from shaketable.web.limits import LEAST_FRICTION, LEAST_SIZE, MOST_NAME, MOST_SAMPLES

Size = Annotated[float, Field(ge=LEAST_SIZE, le=20)]  # m
Inside = Annotated[float, Field(ge=0.01, le=0.99)]  # a share of what is not at its ends
Friction = Annotated[float, Field(ge=LEAST_FRICTION, le=5)]
Name = Annotated[str, Field(max_length=MOST_NAME)]
ROWS = r"^[0-9,\-]*$"
MOST_ROWS_SAID = 20_000
ROWS_SAID = 'numbers of the rows in the file that this list was made of, as "3-9,11"'
SuiteName = Literal[
    "fema-p695",
    "fema-p695-both-directions",
    "fema-p695-far-field",
    "fema-p695-near-field-pulse",
    "fema-p695-near-field-no-pulse",
]
Shape = Literal["box", "cylinder"]
Units = Literal["g", "m/s2", "cm/s2", "gal"]
assert set(Units.__args__) == set(OFFERED_UNITS)  # type: ignore[attr-defined]
assert set(SuiteName.__args__) == set(SUITES)  # type: ignore[attr-defined]


class Question(BaseModel):
    """Anything asked: without fields that nobody knows, and of finite numbers."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Beside(Question):
    """What stands beside a thing of 100 kg, and what holds it: all of it moves with the floor."""

    wall_gap_mm: float | None = Field(
        None, ge=0, le=2000, description="from its back to a wall; null: none [mm]"
    )
    strap_slack_mm: float | None = Field(
        None, ge=0, le=500,
        description="of a strap from the middle of the top of its back straight to the wall, "
        "or to a point 50 mm behind it; null: none [mm]",
    )  # fmt: skip
    strap_stiffness_kn_m: float = Field(
        50.0, ge=1, le=500, description="of the strap; for another mass in proportion to it [kN/m]"
    )
    edge_mm: float | None = Field(
        None, ge=0, le=2000,
        description="from its front to the edge of its support; null: none [mm]",
    )  # fmt: skip
    lip_mm: float = Field(0.0, ge=0, le=500, description="of that edge [mm]")


class Thing(Question):
    """A rectangular object that stands free, seen from the side: its front is at the left."""

    base_m: Size = Field(description="along the shaking [m]")
    height_m: Size = Field(description="[m]")
    cg_share: float = Field(
        0.5,
        ge=0.01,
        le=0.99,
        description="height of its centre of gravity, as a share of its height",
    )
    eccentricity: Inside = Field(
        0.5,
        description="where over its base that lies: 0.5 is the middle, less is to the front",
    )  # fmt: skip
    tilt_deg: float = Field(
        0.0,
        ge=0,
        le=30,
        description="of its support, downhill to the front, however it is turned [°]",
    )
    friction: Friction | None = Field(
        None, description="between object and support; null: it cannot slide"
    )
    beside: Beside | None = Field(None, description="null: it stands alone")


class Upright(Question):
    """A box or a cylinder that stands free, in three dimensions."""

    shape: Shape = "box"
    depth_m: Size | None = Field(None, description="from front to back, of a box [m]")
    width_m: Size | None = Field(None, description="from side to side, of a box [m]")
    base_m: Size | None = Field(None, description="the diameter, of a cylinder [m]")
    height_m: Size = Field(description="[m]")
    cg_share: float = Field(
        0.5,
        ge=0.01,
        le=0.99,
        description="height of its centre of gravity, as a share of its height",
    )
    facing_deg: float = Field(
        0.0, ge=-360, le=360, description="turn on its support, counterclockwise from above [°]"
    )
    tilt_deg: float = Field(
        0.0,
        ge=0,
        le=30,
        description="of its support, downhill to the front, however it is turned [°]",
    )
    friction: Friction | None = Field(
        None, description="between object and support; null: it cannot slide"
    )
    rolling_friction_mm: float = Field(
        0.0, ge=0, le=50,
        description="length that, times the pressure, is the moment against rolling [mm]",
    )  # fmt: skip
    contour_friction_mm: float = Field(
        0.0, ge=0, le=50,
        description="of a cylinder: length that, times the pressure and the rate of the contact "
        "around the rim, is the power lost [mm]",
    )  # fmt: skip
    beside: Beside | None = Field(
        None, description="it turns with the object; null: the object stands alone"
    )

    @model_validator(mode="after")
    def _sizes_of_shape(self) -> Self:
        """A box has a depth and a width, a cylinder a base."""
        box = self.shape == "box"
        if (self.base_m is None) is not box or any(
            (size is None) is box for size in (self.depth_m, self.width_m)
        ):
            needed = "depth_m and width_m" if box else "base_m, its diameter,"
            raise ValueError(f"a {self.shape} has {needed} and no other size of its base")
        return self

    @property
    def bases(self) -> tuple[float, float]:
        """Its sizes from front to back and from side to side [m]; of a cylinder its diameter."""
        return self.depth_m or self.base_m or 0.0, self.width_m or self.base_m or 0.0


class Recording(Question):
    """A recorded earthquake of FEMA P-695."""

    kind: Literal["recording"] = "recording"
    name: Name


class Pulse(Question):
    """One sine of acceleration."""

    kind: Literal["pulse"] = "pulse"
    period_s: float = Field(ge=0.05, le=10, description="[s]")
    peak_g: float = Field(gt=0, le=5, description="[g]")


Acceleration = Annotated[float, Field(ge=-LOUDEST, le=LOUDEST)]


class Uploaded(Question):
    """A motion that `PUT /api/record` has read."""

    kind: Literal["uploaded"] = "uploaded"
    name: Name = "record"
    time_step_s: float = Field(ge=STEPS[0], le=STEPS[1], description="[s]")
    acceleration: Annotated[list[Acceleration], FailFast()] = Field(
        min_length=2, max_length=MOST_SAMPLES, description="horizontal [m/s²]"
    )


Shaking = Annotated[Recording | Pulse | Uploaded, Field(discriminator="kind")]
Scale = Annotated[float, Field(ge=0, le=20, description="factor on the motion")]


class UnderMotion(Question):
    """Something under a motion."""

    shaking: Shaking
    scale: Scale = 1.0

    @model_validator(mode="after")
    def _not_too_strong(self) -> Self:
        """Neither is what is uploaded, once it is scaled."""
        if isinstance(self.shaking, Uploaded):
            peak = self.scale * max(map(abs, self.shaking.acceleration))
            if peak > LOUDEST:
                raise ValueError(
                    f"scale: the motion would reach {peak / STANDARD_GRAVITY:.3g} g; at most "
                    f"{LOUDEST / STANDARD_GRAVITY:g} g is taken"
                )
        return self


class Shake(UnderMotion):
    """One thing under one motion."""

    thing: Thing
    reverse: bool = Field(False, description="change the signs of the motion")


class Many(Question):
    """One thing under all motions of a suite, each component as recorded and reversed."""

    thing: Thing
    suite: SuiteName = "fema-p695-both-directions"
    scale: Scale = 1.0
    curve: bool = Field(True, description="also at other strengths")


class ShakeInSpace(UnderMotion):
    """A box or a cylinder under one motion, along x, with the component across it along y."""

    thing: Upright
    reverse: bool = Field(False, description="change the signs of the motion")


class ManyInSpace(Question):
    """A box or a cylinder under all pairs of components of a suite, as recorded and reversed."""

    thing: Upright
    suite: SuiteName = "fema-p695-both-directions"
    scale: Scale = 1.0
    curve: bool = Field(True, description="also at other strengths, which takes some seconds")


MOST_COLUMNS_SAID = 20_000  # characters
COLUMNS_SAID = (
    "what columns mean where their headings do not say it, as TOML: a table [columns] with lines "
    'such as "H" = "height_cm", and "" for a column that is not used'
)
OF_CATALOGUE = "take sizes that are left out from the catalogue of common things"
StructureWord = Literal[
    "concrete frame", "steel frame", "braced steel frame", "concrete walls", "masonry", "timber"
]
assert set(StructureWord.__args__) == set(STRUCTURES)  # type: ignore[attr-defined]


class OfBuilding(Question):
    """The building of a list, of which only its structure and its storeys are known."""

    storeys: int = Field(ge=1, le=60, description="above the ground")
    structure: StructureWord
    storey_height_m: float = Field(STOREY_HEIGHT, ge=2, le=10, description="[m]")


class OfLevel(Question):
    """The level that every recording is scaled to."""

    measure: str = Field(max_length=20, description="of the ground, such as PGA, PGV or SA(1.0)")
    value: float = Field(gt=0, le=1000, description="[SI]")
    said: str = Field("", max_length=300, description="the level in words, for the report")

    @field_validator("measure")
    @classmethod
    def _known(cls, name: str) -> str:
        measure = measure_named(name)
        by_measure(measure)
        return measure.name

    def told(self) -> str:
        """What the report says of it."""
        return (
            f"{self.said or f'{self.measure} {self.value:.3g} (SI)'}. Each recording is scaled to "
            "that level; durations and mixes of frequencies stay as they were recorded, and a real "
            "earthquake of that level may last longer or shake more slowly."
        )


class Assess(Question):
    """A list of objects under a suite."""

    name: Name = "list.csv"
    text: str = Field(max_length=2_000_000, description="the list, as CSV")
    suite: SuiteName = "fema-p695-both-directions"
    scale: Scale = 1.0
    columns: str = Field("", max_length=MOST_COLUMNS_SAID, description=COLUMNS_SAID)
    rows: str = Field("", max_length=MOST_ROWS_SAID, pattern=ROWS, description=ROWS_SAID)
    accept_sizes: bool = Field(False, description="take sizes that furniture does not have")
    catalogue: bool = Field(False, description=OF_CATALOGUE)
    building: OfBuilding | None = Field(
        None, description="on whose floors the list's objects stand; without, on the ground"
    )
    level: OfLevel | None = Field(None, description="of the ground, in place of as recorded")
    planar: bool = Field(False, description="leave three dimensions out, which is quicker")
    wall: Literal["", "yes", "no", "each"] = Field(
        "", description="whether most things stand against a wall; each: as the list says"
    )


class LookAtMotion(UnderMotion):
    """A motion, to look at."""
