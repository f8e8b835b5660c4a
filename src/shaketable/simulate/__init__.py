"""One body under one motion, many under many, or members side by side."""

from shaketable.simulate.checks import listed, require_stable
from shaketable.simulate.each import simulate_each
from shaketable.simulate.fall_counts import (
    OutcomeCounts,
    count_by_recording,
    fell,
    fell_downhill,
    simulated,
)
from shaketable.simulate.many import simulate_many
from shaketable.simulate.one import simulate
from shaketable.simulate.shaking_set import ShakingSet

__all__ = [
    "OutcomeCounts",
    "ShakingSet",
    "count_by_recording",
    "fell",
    "fell_downhill",
    "listed",
    "require_stable",
    "simulate",
    "simulate_each",
    "simulate_many",
    "simulated",
]
