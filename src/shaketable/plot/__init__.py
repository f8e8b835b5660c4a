"""Pictures: a run's history and film, the map of modes, a record with its spectrum, a tilt."""

from shaketable.plot.files import require_film, require_picture, save
from shaketable.plot.film import animate_response
from shaketable.plot.history import plot_response
from shaketable.plot.modes import plot_modes
from shaketable.plot.record import plot_record, plot_spectra
from shaketable.plot.tilting import plot_tilt

__all__ = [
    "animate_response",
    "plot_modes",
    "plot_record",
    "plot_response",
    "plot_spectra",
    "plot_tilt",
    "require_film",
    "require_picture",
    "save",
]
