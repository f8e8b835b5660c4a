"""Pictures: one run's history, a film of it, the map of modes."""

from shaketable.plot.files import require_film, require_picture, save
from shaketable.plot.film import animate_response
from shaketable.plot.history import plot_response
from shaketable.plot.modes import plot_modes

__all__ = [
    "animate_response",
    "plot_modes",
    "plot_response",
    "require_film",
    "require_picture",
    "save",
]
