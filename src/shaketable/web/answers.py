"""What is answered, in plain numbers: lengths in metres, angles in degrees, times in seconds."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field


class Frames(BaseModel):
    """A film of the object, 60 pictures a second."""

    rotation_deg: list[float] = Field(
        description="relative to the support, clockwise, to the right"
    )
    x_m: list[float] = Field(description="centre of gravity along the support")
    y_m: list[float] = Field(description="and normal to it")
    ground_m: list[float] = Field(description="displacement of the ground, without its drift")


class Ground(BaseModel):
    """A motion to draw."""

    name: str
    peak_g: float
    time_step_s: float
    acceleration_g: list[float]


class Shaken(BaseModel):
    """One thing after one shaking."""

    outcome: Literal["standing", "left", "right"]
    time_s: float | None = Field(description="of the fall")
    peak_deg: float = Field(description="largest rotation")
    tips_at_deg: float = Field(description="rotation from which it falls by itself, to the left")
    slip_m: float = Field(description="largest distance of its base from where it stood")
    lift_m: float = Field(description="largest height of a jump")
    impacts: int
    ground: Ground
    frames: Frames


class Point(BaseModel):
    """A point of a fragility curve, with its 95 % interval."""

    scale: float
    share: float
    low: float
    high: float


class Shares(BaseModel):
    """One thing after many shakings."""

    simulations: int
    recordings: int = Field(description="independent ones, of which the interval is")
    falls: int
    left: int = Field(description="falls to the left, which is downhill on a tilt")
    share: float
    low: float
    high: float
    median_pga_g: float = Field(description="of the motions as they are scaled")
    curve: list[Point]


class Spectrum(BaseModel):
    """A motion and its elastic response spectrum at 5 % of critical damping."""

    ground: Ground
    period_s: list[float]
    acceleration_g: list[float]


class Listed(BaseModel):
    """A motion to choose from."""

    name: str
    suite: str
    peak_g: float
    duration_s: float


class Read(BaseModel):
    """An uploaded record, as `Uploaded` takes it."""

    name: str
    time_step_s: float
    acceleration: list[float] = Field(description="[m/s²]")
