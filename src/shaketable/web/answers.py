"""What is answered, in plain numbers: lengths in metres, angles in degrees, times in seconds."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field

from shaketable.web.questions import Thing, Upright


class Frames(BaseModel):
    """A film of the object, 60 pictures a second."""

    rotation_deg: list[float] = Field(
        description="relative to the support, clockwise, to the right"
    )
    x_m: list[float] = Field(description="centre of gravity along the support")
    y_m: list[float] = Field(description="and normal to it")
    ground_m: list[float] = Field(description="displacement of the ground, without its drift")
    strap: list[float] = Field([], description="force of its strap over its weight, if it has one")


class FramesInSpace(BaseModel):
    """A film in three dimensions, 60 pictures a second; x to the back, y to the left, z up."""

    quaternion: list[tuple[float, float, float, float]] = Field(
        description="turn of the object relative to the support, scalar last"
    )
    position_m: list[tuple[float, float, float]] = Field(
        description="centre of gravity, from where its foot stood on the support"
    )
    ground_m: list[tuple[float, float]] = Field(
        description="displacement of the ground, without its drift"
    )
    strap: list[float] = Field([], description="force of its strap over its weight, if it has one")


class GroundTrace(BaseModel):
    """A motion to draw."""

    name: str
    peak_g: float
    time_step_s: float
    acceleration_g: list[float]


class Surrounded(BaseModel):
    """What became of a thing among what surrounds it."""

    held_up: bool = Field(
        False, description="it did not fall, and would without its wall and strap"
    )
    off_edge: bool = Field(False, description="it fell off its support")
    strap_peak: float | None = Field(
        None, description="largest force of its strap over its weight; null: it has none"
    )


class ShakenThing(Surrounded):
    """One thing after one shaking."""

    outcome: Literal["standing", "left", "right"]
    moving: bool = Field(description="it had neither fallen nor come to rest at the end")
    time_s: float | None = Field(description="of the fall")
    peak_deg: float = Field(description="largest rotation")
    tips_at_deg: float = Field(description="rotation from which it falls, to that side")
    slip_m: float = Field(description="largest distance of its base from where it stood")
    lift_m: float = Field(description="largest height of a jump")
    impacts: int
    ground: GroundTrace
    frames: Frames


class ShakenInSpace(Surrounded):
    """One object in three dimensions after one shaking."""

    outcome: Literal["standing", "left", "right", "front", "back"] = Field(
        description="whether it falls, and to which side of the room, within 45°"
    )
    moving: bool = Field(description="it had neither fallen nor come to rest at the end")
    time_s: float | None = Field(description="of the fall")
    fall_azimuth_deg: float | None = Field(description="of the fall, from the back to the left")
    peak_deg: float = Field(description="largest angle of its axis with the support's normal")
    tips_at_deg: float = Field(description="from which it can fall on a still floor")
    moved_m: float = Field(description="how far its foot ends from where it stood")
    turned_deg: float = Field(description="about its axis")
    lift_m: float = Field(description="largest height of a jump")
    impacts: int
    components: int = Field(description="horizontal ones of the motion: 2 where both are known")
    ground: GroundTrace
    frames: FramesInSpace


class Worst(BaseModel):
    """The motion under which the object overturns at the largest number of scale factors."""

    name: str
    reverse: bool


class Point(BaseModel):
    """A point of a fragility curve, with its 95 % interval."""

    scale: float
    share: float
    low: float
    high: float


class InHundred(BaseModel):
    """A share and its 95 % interval as counts out of a hundred, as they are to be shown."""

    share: str = Field(description='halves rounded up; "<1" and ">99" for what is not 0 or 100')
    low: str = Field(description="whole, and no more than the interval's lower end")
    high: str = Field(description="whole, and no less than its upper end")


class Shares(BaseModel):
    """One thing after many shakings."""

    simulations: int
    recordings: int = Field(description="independent ones, of which the interval is")
    falls: int
    moving: int = Field(description="that had neither fallen nor come to rest at their end")
    held_up: int = Field(
        0,
        description="that did not fall, and would without wall and strap; the share has them, too",
    )
    strap_90: float | None = Field(
        None, description="force of its strap over its weight that 90 of 100 do not exceed"
    )
    left: int = Field(description="falls to the left, which is downhill on a tilt")
    share: float
    low: float
    high: float
    in_100: InHundred
    median_pga_g: float = Field(description="of the motions as they are scaled")
    worst: Worst
    curve: list[Point] = Field(description="empty where it was not asked for")


class SharesInSpace(BaseModel):
    """One object in three dimensions after many shakings."""

    simulations: int
    recordings: int = Field(description="independent ones, of which the interval is")
    falls: int
    sides: dict[Literal["left", "right", "front", "back"], int] = Field(
        description="falls to each side of the room, within 45°"
    )
    moving: int = Field(description="that had neither fallen nor come to rest at their end")
    held_up: int = Field(
        0,
        description="that did not fall, and would without wall and strap; the share has them, too",
    )
    strap_90: float | None = Field(
        None, description="force of its strap over its weight that 90 of 100 do not exceed"
    )
    share: float
    low: float
    high: float
    in_100: InHundred
    median_pga_g: float = Field(description="of the motions as they are scaled")
    worst: Worst
    curve: list[Point] = Field(description="empty where it was not asked for")


class MotionSpectrum(BaseModel):
    """A motion and its elastic response spectrum at 5 % of critical damping."""

    ground: GroundTrace
    period_s: list[float]
    acceleration_g: list[float]


class Listed(BaseModel):
    """A motion to choose from."""

    name: str
    suite: str
    earthquake: str
    magnitude: float | None
    distance_km: float | None = Field(description="of the station from what broke")
    peak_g: float
    duration_s: float


class UploadedRecord(BaseModel):
    """An uploaded record, as `Uploaded` takes it."""

    name: str
    time_step_s: float
    acceleration: list[float] = Field(description="[m/s²]")


class ColumnRead(BaseModel):
    """A column of a list, and what it was read as."""

    header: str
    meaning: str = Field(description='"" where it is not used')
    unit: str = Field(
        description="where it is not used, what its name says in brackets, if anything"
    )
    renamed: bool = Field(description="a number tells it from another of its name")
    unused: bool = Field(description="somebody said that it is not used")
    asked: bool = Field(
        description="it may say castors, anchors or shapes and is not understood: until somebody "
        "says what it is, nothing gets a class"
    )


class ColumnMeaning(BaseModel):
    """What a column may mean."""

    meaning: str
    label: str = Field(description="in words")
    units: list[str] = Field(description="in which it may be, none where it has none")


class Understood(BaseModel):
    """A list as it was read; of a workbook of which a sheet must be chosen, that alone."""

    sheets: list[str] = Field(description="of a workbook; none of a text")
    sheet: str = Field("", description="that was read")
    columns: list[ColumnRead] = []
    meanings: list[ColumnMeaning] = Field([], description="that a column may have")
    rows: list[list[str]] = []
    numbers: list[int] = Field([], description="of the rows, as messages count them")
    building: dict[str, str | float] | None = Field(
        None, description="what a sheet of the workbook says of it"
    )
    floors: bool = Field(False, description="whether rows name floors")
    objects: int = Field(0, description="kinds of object that were read")
    notes: list[str] = Field([], description="what was read and is not used here")
    faults: list[str] = Field(description="what must be corrected first, by row and column")


class LevelOfSite(BaseModel):
    """A level of the ground's shaking at a site."""

    years: float = Field(description="in which it is exceeded once, on average")
    measure: str
    value: float = Field(description="[SI]")
    in_words: str = Field(description="with its unit, and the measure")


class SiteLevels(BaseModel):
    """What a hazard curve says, at a few rates; those that it does not reach are left out."""

    levels: list[LevelOfSite]


class Started(BaseModel):
    """An assessment that was begun."""

    id: str


#: What the share of an object is of: beside falls, leaving its support, or rolling far.
Counts = Literal[
    "falls", "falls_or_leaves", "falls_or_held_up", "falls_or_goes_far", "on_furniture"
]


class Ranked(BaseModel):
    """An object of a list, after the shakings."""

    name: str
    building: str
    floor: str
    where: str
    quantity: int
    risk: str
    risk_in_words: str
    share: float = Field(description="of the shakings, in which what `counts` says happens")
    counts: Counts
    low: float
    high: float
    in_100: InHundred
    measure: str
    happens: list[str]
    advice: list[str]
    thing: Thing | Upright | None = Field(
        description="as it is shaken by itself: in three dimensions if it was so here, else in the "
        "direction in which it fares worse; null for what rolls"
    )


class Assessed(BaseModel):
    """A list after the shakings, the most pressing first."""

    notes: list[str] = Field(description="warnings of the run")
    headline: list[str]
    how_sure: list[str]
    objects: list[Ranked]
