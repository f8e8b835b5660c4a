"""Options that say which earthquake: a magnitude at a distance, by which models."""

from __future__ import annotations

import logging
import re
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.errors import InputError, quoted
from shaketable.inputs import NUMBER

if TYPE_CHECKING:
    from shaketable.hazard import Scenario


log = logging.getLogger(__name__)

USUAL_VS30 = 400.0  # m/s


class Mechanism(StrEnum):
    """Kinds of faulting."""

    STRIKE_SLIP = "strike-slip"
    REVERSE = "reverse"
    NORMAL = "normal"


Magnitude = Annotated[float | None, typer.Option(help="Moment magnitude of the earthquake.")]
DistanceKm = Annotated[
    float | None,
    typer.Option(help="Joyner-Boore distance: from the site to what lies above the rupture [km]."),
]
Vs30 = Annotated[
    float | None,
    typer.Option(
        "--vs30",
        help="Shear-wave velocity of the upper 30 m of the ground [m/s]: 760 rock, 400 stiff, "
        "200 soft soil. [400]",
    ),
]
Faulting = Annotated[
    Mechanism | None, typer.Option("--mechanism", help="Kind of faulting. [strike-slip]")
]
Weights = Annotated[
    str | None,
    typer.Option(
        "--models",
        help="Ground-motion models with weights, such as BSSA14=2,CY14=1. [BSSA14, ASK14, CB14 "
        "and CY14 alike]",
    ),
]
HypocentralDepthKm = Annotated[
    float | None,
    typer.Option(help="Depth of the hypocentre, of which CB14 makes use [km]. [CB14's estimate]"),
]
Buildings = Annotated[
    list[Path] | None,
    typer.Option(
        "--building",
        help="TOML file of a building whose floors are computed; several times for several "
        "buildings, each called as in the inventory's column building.",
    ),
]
_WEIGHT = re.compile(rf"\s*(\w+)\s*=\s*({NUMBER})\s*", re.ASCII)


def scenario_of(
    magnitude: float | None,
    distance_km: float | None,
    vs30: float | None,
    mechanism: Mechanism | None,
    models: str | None,
    hypocentral_depth_km: float | None = None,
) -> Scenario:
    """The earthquake that the options describe.

    Raises:
        InputError: no magnitude or distance, weights that cannot be read, or what `scenario` says.
    """
    from shaketable.hazard import scenario

    if magnitude is None or distance_km is None:
        missing = "--magnitude" if magnitude is None else "--distance-km"
        raise InputError(f"{missing}: is needed; an earthquake has a magnitude and a distance")
    if vs30 is None:
        vs30 = USUAL_VS30
        log.warning("--vs30 is not given: %g m/s, stiff ground, is taken", vs30)
    return scenario(
        magnitude,
        distance_km,
        vs30,
        mechanism=str(mechanism or Mechanism.STRIKE_SLIP),
        models=_weights(models),
        hypocentral_depth=hypocentral_depth_km,
    )


def _weights(text: str | None) -> dict[str, float] | None:
    if text is None:
        return None
    found = {}
    for part in text.split(","):
        match = _WEIGHT.fullmatch(part if "=" in part else f"{part}=1")
        if not match:
            raise InputError(
                f"--models: expected names and weights, such as BSSA14=2,CY14=1, found "
                f"{quoted(part)}"
            )
        found[match[1].upper()] = float(match[2])
    return found
