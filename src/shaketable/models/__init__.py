"""Contact models: what a body may do on its support, as frozen objects with their parameters."""

from shaketable.models.general import General
from shaketable.models.model import Model, Table
from shaketable.models.named import NAMES, model_of, with_friction
from shaketable.models.rocking import Rocking

__all__ = ["NAMES", "General", "Model", "Rocking", "Table", "model_of", "with_friction"]
