"""Pictures: one run's history, a film of it, the map of modes, a record with its spectrum."""

from shaketable.plot.files import require_film, require_picture, save
from shaketable.plot.film import animate_response
from shaketable.plot.history import plot_response
from shaketable.plot.modes import plot_modes
from shaketable.plot.record import plot_record, plot_spectra

__all__ = [
    "animate_response",
    "plot_modes",
    "plot_record",
    "plot_response",
    "plot_spectra",
    "require_film",
    "require_picture",
    "save",
]
