"""shaketable: a virtual shake table for things that are not bolted down."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from shaketable.assess import Assessment, assess
    from shaketable.body import Body
    from shaketable.calibration import (  # type: ignore[no-redef]  # a function and its module
        Calibration,
        Prior,
        ShakeTest,
        Uncertainty,
        calibrate,
        overturning_probability,
    )
    from shaketable.campaign import open_campaign, run_campaign
    from shaketable.errors import InputError, SimulationError
    from shaketable.fragility import (  # type: ignore[no-redef]  # a function and its module
        Fragility,
        fragility,
        ida,
        overturning_spectrum,
        rocking_spectrum,
        with_intensities,
    )
    from shaketable.hazard import Hazard, annual_rate, read_hazard
    from shaketable.inventory import Item, read_inventory
    from shaketable.models import General, Rocking
    from shaketable.motion import Motion
    from shaketable.origin import Origin
    from shaketable.outcome import Outcome
    from shaketable.physics.plane.phases import Phase
    from shaketable.records import Component, read_components, read_motion, suite
    from shaketable.response import PlanarResponse, Response
    from shaketable.rims import uneven_rims
    from shaketable.risk import OverturningRisk, overturning_risk
    from shaketable.signal import (
        Spectrum,
        baseline_corrected,
        intensity_measures,
        response_spectrum,
    )
    from shaketable.simulate import simulate, simulate_each, simulate_many
    from shaketable.solid import Solid
    from shaketable.solid_response import SolidResponse
    from shaketable.support import Support
    from shaketable.surroundings import Edge, Pad, Strap, Surroundings, Wall
    from shaketable.synthesis import (
        ShearBuilding,
        floor_motions,
        match_spectrum,
        spectrum_compatible,
    )

#: The public names of each module, which is imported when one of them is first used.
_GIVEN = {
    "assess": ("Assessment", "assess"),
    "body": ("Body",),
    "calibration": (
        "Calibration",
        "Prior",
        "ShakeTest",
        "Uncertainty",
        "calibrate",
        "overturning_probability",
    ),
    "campaign": ("open_campaign", "run_campaign"),
    "errors": ("InputError", "SimulationError"),
    "fragility": (
        "Fragility",
        "fragility",
        "ida",
        "overturning_spectrum",
        "rocking_spectrum",
        "with_intensities",
    ),
    "hazard": ("Hazard", "annual_rate", "read_hazard"),
    "inventory": ("Item", "read_inventory"),
    "physics.plane.phases": ("Phase",),
    "models": ("General", "Rocking"),
    "motion": ("Motion",),
    "origin": ("Origin",),
    "outcome": ("Outcome",),
    "records": ("Component", "read_components", "read_motion", "suite"),
    "response": ("PlanarResponse", "Response"),
    "rims": ("uneven_rims",),
    "risk": ("OverturningRisk", "overturning_risk"),
    "signal": ("Spectrum", "baseline_corrected", "intensity_measures", "response_spectrum"),
    "simulate": ("simulate", "simulate_each", "simulate_many"),
    "solid": ("Solid",),
    "solid_response": ("SolidResponse",),
    "support": ("Support",),
    "surroundings": ("Edge", "Pad", "Strap", "Surroundings", "Wall"),
    "synthesis": ("ShearBuilding", "floor_motions", "match_spectrum", "spectrum_compatible"),
}
_HOMES = {name: module for module, names in _GIVEN.items() for name in names}

__all__ = [
    "Assessment",
    "Body",
    "Calibration",
    "Component",
    "Edge",
    "Fragility",
    "General",
    "Hazard",
    "InputError",
    "Item",
    "Motion",
    "Origin",
    "Outcome",
    "OverturningRisk",
    "Pad",
    "Phase",
    "PlanarResponse",
    "Prior",
    "Response",
    "Rocking",
    "ShakeTest",
    "ShearBuilding",
    "SimulationError",
    "Solid",
    "SolidResponse",
    "Spectrum",
    "Strap",
    "Support",
    "Surroundings",
    "Uncertainty",
    "Wall",
    "annual_rate",
    "assess",
    "baseline_corrected",
    "calibrate",
    "floor_motions",
    "fragility",
    "ida",
    "intensity_measures",
    "match_spectrum",
    "open_campaign",
    "overturning_probability",
    "overturning_risk",
    "overturning_spectrum",
    "read_components",
    "read_hazard",
    "read_inventory",
    "read_motion",
    "response_spectrum",
    "rocking_spectrum",
    "run_campaign",
    "simulate",
    "simulate_each",
    "simulate_many",
    "spectrum_compatible",
    "suite",
    "uneven_rims",
    "with_intensities",
]


def __getattr__(name: str) -> Any:
    """Import a public name or a module, or look up the version, when it is first used."""
    found: Any
    if name == "__version__":
        found = import_module("importlib.metadata").version(__name__)
    elif name in _HOMES:
        found = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    elif not name.startswith("_") and find_spec(f"{__name__}.{name}"):
        found = import_module(f"{__name__}.{name}")
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


class _Package(ModuleType):
    """Keep `assess` the function, also after the module of that name has been imported."""

    def __setattr__(self, name: str, value: object) -> None:
        if not (name in _HOMES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
