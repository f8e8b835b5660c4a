"""What falls as a probability: fragility functions, incremental dynamic analysis, spectra."""

from shaketable.fragility.capacities import ida
from shaketable.fragility.curve import Curve
from shaketable.fragility.efficiency import efficiency
from shaketable.fragility.fragility import Fragility, fragility
from shaketable.fragility.goodness import Goodness, goodness
from shaketable.fragility.intensities import with_intensities
from shaketable.fragility.residuals import residuals
from shaketable.fragility.spectra import Fate, borders, overturning_spectrum, rocking_spectrum
from shaketable.fragility.two_measures import VectorFragility, vector_fragility
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
    "VectorFragility",
    "borders",
    "efficiency",
    "fragility",
    "goodness",
    "ida",
    "overturning_spectrum",
    "residuals",
    "rocking_spectrum",
    "uncertain_fragility",
    "vector_fragility",
    "with_intensities",
]
