"""The cases as they stand in cases.json."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from shaketable import Solid
from shaketable.units import STANDARD_GRAVITY

FILE = Path(__file__).with_name("cases.json")


class Answers(NamedTuple):
    """What is known of a case; None where it is not told.

    Attributes:
        slip: distance between where the middle of the base begins and ends on the support [m].
        peak: largest angle between the box's axis and the support's normal [rad].
        falls: whether it overturns.
    """

    slip: float | None = None
    peak: float | None = None
    falls: bool | None = None


class Case(NamedTuple):
    """A homogeneous box at rest on a plane support that begins to move.

    Attributes:
        size: of the box along x, along y and upward [m].
        friction: Coulomb's coefficient, static and kinetic; nothing bounces.
        tilt: of the support [rad], down toward `azimuth` from x.
        acceleration: of the support along level x, level y and upward [m/s²], (sample, 3), linear
            between samples.
        step: between samples [s].
        source: how the answers were found.
        within: by how much they may be off: metres, or parts of the peak.
    """

    name: str
    about: str
    size: tuple[float, float, float]
    friction: float
    tilt: float
    azimuth: float
    step: float
    acceleration: NDArray[np.float64]
    answers: Answers
    source: str
    within: float

    @property
    def seconds(self) -> float:
        return float((len(self.acceleration) - 1) * self.step)

    @property
    def solid(self) -> Solid:
        return Solid.box(*self.size)

    @property
    def force(self) -> NDArray[np.float64]:
        """Apparent gravity in the support's frame [m/s²], (sample, 3)."""
        axis = np.array([-np.sin(self.azimuth), np.cos(self.azimuth), 0.0])
        lean = Rotation.from_rotvec(self.tilt * axis).inv()
        return np.asarray(lean.apply(-self.acceleration - [0.0, 0.0, STANDARD_GRAVITY]))


def read_cases(path: Path = FILE) -> list[Case]:
    return [
        Case(
            name=each["name"],
            about=each["about"],
            size=tuple(each["size_m"]),
            friction=each["friction"],
            tilt=each["tilt_rad"],
            azimuth=each["azimuth_rad"],
            step=each["time_step_s"],
            acceleration=np.array(each["acceleration_m_s2"]),
            answers=Answers(each["slip_m"], each["peak_rad"], each["falls"]),
            source=each["source"],
            within=each["within"],
        )
        for each in json.loads(path.read_text(encoding="utf-8"))["cases"]
    ]


def written(case: Case) -> dict[str, object]:
    """A case as it stands in the file."""
    return {
        "name": case.name,
        "about": case.about,
        "size_m": list(case.size),
        "friction": case.friction,
        "tilt_rad": case.tilt,
        "azimuth_rad": case.azimuth,
        "time_step_s": case.step,
        "slip_m": case.answers.slip,
        "peak_rad": case.answers.peak,
        "falls": case.answers.falls,
        "source": case.source,
        "within": case.within,
        "acceleration_m_s2": np.round(case.acceleration, 9).tolist(),
    }
