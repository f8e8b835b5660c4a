"""shaketable: a virtual shake table for things that are not bolted down."""

from shaketable.assess import Assessment, assess
from shaketable.body import Body
from shaketable.calibration import (
    Calibration,
    Prior,
    ShakeTest,
    Uncertainty,
    calibrate,
    overturning_probability,
)
from shaketable.campaign import open_campaign, run_campaign
from shaketable.errors import InputError, SimulationError
from shaketable.fragility import (
    Fragility,
    fragility,
    ida,
    overturning_spectrum,
    rocking_spectrum,
    with_intensities,
)
from shaketable.hazard import Hazard, annual_rate, read_hazard
from shaketable.inventory import Item, read_inventory
from shaketable.kernels.phases import Phase
from shaketable.models import General, Rocking
from shaketable.motion import Motion
from shaketable.origin import Origin
from shaketable.outcome import Outcome
from shaketable.records import Component, read_components, read_motion, suite
from shaketable.response import Response
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
from shaketable.synthesis import (
    ShearBuilding,
    floor_motions,
    match_spectrum,
    spectrum_compatible,
)

__all__ = [
    "Assessment",
    "Body",
    "Calibration",
    "Component",
    "Fragility",
    "General",
    "Hazard",
    "InputError",
    "Item",
    "Motion",
    "Origin",
    "Outcome",
    "OverturningRisk",
    "Phase",
    "Prior",
    "Response",
    "Rocking",
    "ShakeTest",
    "ShearBuilding",
    "SimulationError",
    "Solid",
    "SolidResponse",
    "Spectrum",
    "Support",
    "Uncertainty",
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


def __getattr__(name: str) -> str:
    """__version__, looked up when it is asked for: that costs a third of the import."""
    if name == "__version__":
        from importlib.metadata import version

        return version("shaketable")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
