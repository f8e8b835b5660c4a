"""Options that say which earthquake: a magnitude at a distance, by which models."""

from __future__ import annotations

import logging
import re
from dataclasses import dataclass, fields
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


@dataclass(frozen=True, kw_only=True)
class EarthquakeOptions:
    """Which earthquake, and by which models its ground motion is told."""

    magnitude: Annotated[float | None, typer.Option(help="Moment magnitude of the earthquake.")] = (
        None
    )
    distance_km: Annotated[
        float | None,
        typer.Option(
            help="Joyner-Boore distance: the shortest horizontal distance from the site to the "
            "rupture's projection on the surface [km]."
        ),
    ] = None
    vs30: Annotated[
        float | None,
        typer.Option(
            "--vs30",
            help="Shear-wave velocity of the upper 30 m of the ground [m/s]: 760 rock, 400 stiff, "
            "200 soft soil. [400]",
        ),
    ] = None
    mechanism: Annotated[
        Mechanism | None, typer.Option("--mechanism", help="Kind of faulting. [strike-slip]")
    ] = None
    models: Annotated[
        str | None,
        typer.Option(
            "--models",
            help="Ground-motion models with weights, such as BSSA14=2,CY14=1. [BSSA14, ASK14, "
            "CB14 and CY14, with equal weights]",
        ),
    ] = None
    hypocentral_depth_km: Annotated[
        float | None,
        typer.Option(help="Depth of the hypocentre, used by CB14 only [km]. [CB14's estimate]"),
    ] = None

    @property
    def given(self) -> list[str]:
        """The names of those that were given, as the command line spells them."""
        return [
            f"--{field.name.replace('_', '-')}"
            for field in fields(self)
            if getattr(self, field.name) is not None
        ]

    def scenario(self) -> Scenario:
        """The earthquake that the options describe.

        Raises:
            InputError: no magnitude or distance, weights that cannot be read, or what
                `hazard.scenario` says.
        """
        from shaketable.hazard import scenario

        if self.magnitude is None or self.distance_km is None:
            missing = "--magnitude" if self.magnitude is None else "--distance-km"
            raise InputError(f"{missing}: is needed; an earthquake has a magnitude and a distance")
        vs30 = self.vs30
        if vs30 is None:
            vs30 = USUAL_VS30
            log.warning("--vs30 is not given: using %g m/s (stiff ground)", vs30)
        return scenario(
            self.magnitude,
            self.distance_km,
            vs30,
            mechanism=str(self.mechanism or Mechanism.STRIKE_SLIP),
            models=_weights(self.models),
            hypocentral_depth=self.hypocentral_depth_km,
        )


MapFile = Annotated[
    Path | None,
    typer.Option(
        help="grid.xml of a ShakeMap of the USGS, with its uncertainty.xml beside it, in place of "
        "a magnitude and a distance."
    ),
]
MapSigma = Annotated[
    float | None,
    typer.Option(
        min=0.0,
        help="Of a map without uncertainty.xml: standard deviation of ln of its shaking, some 0.6 "
        "far from all stations.",
    ),
]
Buildings = Annotated[
    list[Path] | None,
    typer.Option(
        "--building",
        help="TOML file of a building whose floors are computed. Repeat it for several buildings: "
        "the name of each must equal the inventory's column building.",
    ),
]
_SCALES = re.compile(rf"({NUMBER})\s*,\s*({NUMBER})", re.ASCII)
_WEIGHT = re.compile(rf"\s*(\w+)\s*=\s*({NUMBER})\s*", re.ASCII)


def scales_of(text: str) -> tuple[float, float]:
    """The smallest and the largest factor on a recording.

    Raises:
        InputError: they are not two numbers.
    """
    limits = _SCALES.fullmatch(text.strip())
    if not limits:
        raise InputError(f"--scales: expected two numbers such as 0.25,4, found {quoted(text)}")
    return float(limits[1]), float(limits[2])


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
