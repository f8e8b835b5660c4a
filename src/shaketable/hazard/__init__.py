"""How likely what falls is: hazard curves, and the rates at which objects fall."""

from shaketable.hazard.curve import Hazard
from shaketable.hazard.rates import AnnualRate, annual_rate, annual_rates
from shaketable.hazard.read import read_hazard

__all__ = ["AnnualRate", "Hazard", "annual_rate", "annual_rates", "read_hazard"]
