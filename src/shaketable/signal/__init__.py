"""What follows from a motion (velocity, displacement, spectra, intensity), and its correction."""

from shaketable.signal.baseline import baseline_corrected, permanent_displacement
from shaketable.signal.integrate import displacement, velocity
from shaketable.signal.intensity import Measure, intensity_measures, measure_named, measures
from shaketable.signal.peaks import Peaks, peaks
from shaketable.signal.processing import detrended, filtered
from shaketable.signal.rotated import rotated_spectra, rotd
from shaketable.signal.scaling import (
    IntensityMeasure,
    peak_ground_acceleration,
    spectral_acceleration_at,
    spectral_ratio_to,
)
from shaketable.signal.spectra import (
    PERIODS,
    Spectrum,
    response_spectrum,
    spectral_acceleration,
)

__all__ = [
    "PERIODS",
    "IntensityMeasure",
    "Measure",
    "Peaks",
    "Spectrum",
    "baseline_corrected",
    "detrended",
    "displacement",
    "filtered",
    "intensity_measures",
    "measure_named",
    "measures",
    "peak_ground_acceleration",
    "peaks",
    "permanent_displacement",
    "response_spectrum",
    "rotated_spectra",
    "rotd",
    "spectral_acceleration",
    "spectral_acceleration_at",
    "spectral_ratio_to",
    "velocity",
]
