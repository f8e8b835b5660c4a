"""What falls as a probability: fragility functions, incremental dynamic analysis, spectra."""

from shaketable.fragility.capacities import ida
from shaketable.fragility.curve import Curve
from shaketable.fragility.fragility import Fragility, fragility
from shaketable.fragility.intensities import with_intensities

__all__ = [
    "Curve",
    "Fragility",
    "fragility",
    "ida",
    "with_intensities",
]
