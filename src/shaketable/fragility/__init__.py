"""What falls as a probability: fragility functions, incremental dynamic analysis, spectra."""

from shaketable.fragility.capacities import ida
from shaketable.fragility.curve import Curve
from shaketable.fragility.efficiency import efficiency
from shaketable.fragility.fragility import Fragility, fragility
from shaketable.fragility.goodness import Goodness, goodness
from shaketable.fragility.intensities import with_intensities
from shaketable.fragility.spectra import Fate, borders, overturning_spectrum, rocking_spectrum
from shaketable.fragility.uncertain import (
    Uncertain,
    UncertainBody,
    UncertainFragility,
    uncertain_fragility,
)

__all__ = [
    "Curve",
    "Fate",
    "Fragility",
    "Goodness",
    "Uncertain",
    "UncertainBody",
    "UncertainFragility",
    "borders",
    "efficiency",
    "fragility",
    "goodness",
    "ida",
    "overturning_spectrum",
    "rocking_spectrum",
    "uncertain_fragility",
    "with_intensities",
]
