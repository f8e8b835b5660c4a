"""One body under one motion, or many under many."""

from shaketable.simulate.many import simulate_many
from shaketable.simulate.one import simulate
from shaketable.simulate.setup import MODELS, require_model, require_stable

__all__ = ["MODELS", "require_model", "require_stable", "simulate", "simulate_many"]
