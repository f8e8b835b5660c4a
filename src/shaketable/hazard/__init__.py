"""How likely what falls is: hazard curves, earthquakes, and the rates at which objects fall."""

from shaketable.hazard.curve import Hazard
from shaketable.hazard.falls import FallProbability, fall_probability
from shaketable.hazard.ground_motion import Scenario, scenario
from shaketable.hazard.rates import AnnualRate, annual_rate, annual_rates
from shaketable.hazard.read import read_hazard
from shaketable.hazard.shakemap import ShakeMap, read_shakemap

__all__ = [
    "AnnualRate",
    "FallProbability",
    "Hazard",
    "Scenario",
    "ShakeMap",
    "annual_rate",
    "annual_rates",
    "fall_probability",
    "read_hazard",
    "read_shakemap",
    "scenario",
]
