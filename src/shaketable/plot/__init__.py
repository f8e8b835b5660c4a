"""Pictures of every kind: a run's history and film, the map of modes, a record, a tilt, spectra."""

from shaketable.drawing.files import require_film, require_film_or_scene, require_picture, save
from shaketable.drawing.film import animate_response
from shaketable.drawing.history import plot_response
from shaketable.drawing.solid_film import animate_solid
from shaketable.drawing.solid_gltf import write_gltf
from shaketable.drawing.solid_history import plot_solid
from shaketable.fragility.drawn import plot_functions
from shaketable.plot.earthquake import plot_map, plot_target
from shaketable.plot.fragility import (
    plot_capacities,
    plot_measures,
    plot_residuals,
    plot_two_measures,
)
from shaketable.plot.hazard import plot_hazard, plot_levels, plot_losses
from shaketable.plot.modes import plot_modes
from shaketable.plot.record import plot_record, plot_spectra
from shaketable.plot.spectra import plot_overturning_spectrum, plot_rocking_spectrum
from shaketable.plot.tilting import plot_tilt

__all__ = [
    "animate_response",
    "animate_solid",
    "plot_capacities",
    "plot_functions",
    "plot_hazard",
    "plot_levels",
    "plot_losses",
    "plot_map",
    "plot_measures",
    "plot_modes",
    "plot_overturning_spectrum",
    "plot_record",
    "plot_residuals",
    "plot_response",
    "plot_rocking_spectrum",
    "plot_solid",
    "plot_spectra",
    "plot_target",
    "plot_tilt",
    "plot_two_measures",
    "require_film",
    "require_film_or_scene",
    "require_picture",
    "save",
    "write_gltf",
]
