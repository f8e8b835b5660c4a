"""shaketable: a virtual shake table for things that are not bolted down."""

from importlib.metadata import version

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.records import Component, read_components, read_motion, suite
from shaketable.response import Outcome, Response
from shaketable.simulate import simulate, simulate_many
from shaketable.support import Support

__version__ = version("shaketable")

__all__ = [
    "Body",
    "Component",
    "InputError",
    "Motion",
    "Outcome",
    "Response",
    "Support",
    "__version__",
    "read_components",
    "read_motion",
    "simulate",
    "simulate_many",
    "suite",
]
