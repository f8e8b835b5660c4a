"""What is asked about a room, and what is answered."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, Field

from shaketable.web.answers import GroundTrace, InHundred
from shaketable.web.limits import MOST_ROOM
from shaketable.web.questions import Friction, Question, Scale, Shaking, SuiteName

Way = Literal["falls", "held_up", "stands"]


class RoomAsked(Question):
    """A room, as the file that the command line reads."""

    text: str = Field(max_length=MOST_ROOM, description="the room, as TOML")


class ShakeRoom(RoomAsked):
    """A room under one motion."""

    shaking: Shaking
    scale: Scale = 1.0
    reverse: bool = Field(False, description="change the signs of the motion")
    along_deg: float | None = Field(
        None, ge=-360, le=720,
        description="direction of its first component in the plan, from +x toward +y; null: as "
        "north and its azimuth say, and where these are not known along +x",
    )  # fmt: skip
    friction: Friction | None = Field(
        None, description="of what stands on feet or on locked castors; null: feet cannot slide"
    )


class AssessRoom(RoomAsked):
    """A room under a suite: each recording as it is and reversed, each in one direction."""

    suite: SuiteName = "fema-p695-both-directions"
    scale: Scale = 1.0
    changes: bool = Field(False, description="try what could be changed, too; it takes longer")


class RoomFault(BaseModel):
    """What is wrong with a room."""

    text: str
    name: str = Field(description="of the door, place or thing that it is about, if it has one")
    section: str = Field("", description="door, place or thing, where only that is known")
    number: int = Field(0, description="of it in the file, from 0")
    at_m: tuple[float, float] | None = Field(None, description="where to draw it")


class RoomRead(BaseModel):
    """A room as it was read."""

    room: dict[str, Any] = Field(description="its tables, with one name and unit for each column")
    faults: list[RoomFault]
    notes: list[str]


class ThingFrames(BaseModel):
    """Where a thing of a room is in each picture; the last one stays."""

    name: str
    outcome: Way
    time_s: float | None = Field(description="of its fall")
    base_m: tuple[float, float, float, float] = Field(
        description="from its centre of gravity to its front, back, right and left side: -, +, -, +"
    )
    below_m: float = Field(description="height of its centre of gravity over its base")
    height_m: float
    round: bool
    position_m: list[tuple[float, ...]] = Field(
        description="its centre of gravity in the plan, and above the floor"
    )
    quaternion: list[tuple[float, ...]] = Field(
        description="scalar last; its own x goes from its front to its back, y to its left"
    )


class RoomFilm(BaseModel):
    """A room under one motion."""

    ground: GroundTrace
    rate_hz: float = Field(description="pictures a second")
    pictures: int
    ground_m: list[tuple[float, ...]] = Field(description="in the plan, in each picture")
    things: list[ThingFrames]
    left_out: list[str]


AT_FRICTION = Field(description="in words, where it was found with another friction")


class ThingFound(BaseModel):
    """How often an object of a room falls, to which side, and what it covers."""

    name: str
    falls: InHundred
    held_up: InHundred
    sides: tuple[float, float, float, float] = Field(
        description="shares of all shakings in which it falls to its front, back, left and right"
    )
    share: float
    high: float
    at_friction: str = AT_FRICTION
    held_up_at_friction: str = AT_FRICTION
    covers_m2: float


class PlaceFound(BaseModel):
    """How often something falls on a place of a room, and whom it hits."""

    name: str
    hit: InHundred
    high: float
    at_friction: str = AT_FRICTION
    by: str
    people: float
    people_hit: float


class WayFound(BaseModel):
    """How often a way out of a room is closed, and by which objects."""

    place: str
    door: str = Field(description="its name, empty for any")
    to: str = Field(description="in words")
    closed: InHundred
    high: float
    at_friction: str = AT_FRICTION
    by: str
    open_before: bool


class ChangeFound(BaseModel):
    """One change or two, and what they leave."""

    told: str
    left: str
    saves: float = Field(description="people fewer who are hit or shut in, on an average")
    things: list[str]


class WorstOfRoom(BaseModel):
    """The shaking in which most things fall, as `ShakeRoom` takes it."""

    name: str
    reverse: bool
    along_deg: float
    falls: int
    friction: float | None = Field(description="null: what stands on feet cannot slide")


class RoomAssessed(BaseModel):
    """A room after the shakings."""

    notes: list[str]
    summary: list[str]
    not_considered: list[str]
    runs: int
    recordings: int
    low_m: tuple[float, float] = Field(description="corner of the map")
    cell_m: float
    columns: int
    rows: int
    covered: list[tuple[int, float]] = Field(
        description="cells on which something lies, row after row from the lowest, and the share"
    )
    things: list[ThingFound]
    places: list[PlaceFound]
    ways: list[WayFound]
    changes: list[ChangeFound] = Field(description="the one that saves most first")
    pairs: list[ChangeFound]
    worst: WorstOfRoom
