"""How likely what falls is: hazard curves, earthquakes, and the rates at which objects fall."""

from shaketable.hazard.artificial import artificial_motions
from shaketable.hazard.curve import Hazard
from shaketable.hazard.falls import FallProbability, fall_probability
from shaketable.hazard.ground_motion import Scenario, scenario
from shaketable.hazard.rates import AnnualRate, annual_rate, annual_rates
from shaketable.hazard.read import read_hazard
from shaketable.hazard.selection import Selection, select_motions
from shaketable.hazard.shakemap import ShakeMap, read_shakemap
from shaketable.hazard.spectral_target import (
    SpectralTarget,
    conditional_target,
    ln_spectra_of,
    target_of,
)

__all__ = [
    "AnnualRate",
    "FallProbability",
    "Hazard",
    "Scenario",
    "Selection",
    "ShakeMap",
    "SpectralTarget",
    "annual_rate",
    "annual_rates",
    "artificial_motions",
    "conditional_target",
    "fall_probability",
    "ln_spectra_of",
    "read_hazard",
    "read_shakemap",
    "scenario",
    "select_motions",
    "target_of",
]
