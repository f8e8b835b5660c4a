"""shaketable: a virtual shake table for things that are not bolted down."""

from shaketable.body import Body
from shaketable.errors import InputError, SimulationError
from shaketable.kernels.phases import Phase
from shaketable.motion import Motion
from shaketable.records import Component, read_components, read_motion, suite
from shaketable.response import Outcome, Response
from shaketable.simulate import simulate, simulate_many
from shaketable.support import Support

__all__ = [
    "Body",
    "Component",
    "InputError",
    "Motion",
    "Outcome",
    "Phase",
    "Response",
    "SimulationError",
    "Support",
    "read_components",
    "read_motion",
    "simulate",
    "simulate_many",
    "suite",
]


def __getattr__(name: str) -> str:
    """__version__, looked up when it is asked for: that costs a third of the import."""
    if name == "__version__":
        from importlib.metadata import version

        return version("shaketable")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
