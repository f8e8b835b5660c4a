"""What a user can mend, told apart from what went wrong inside."""

from __future__ import annotations


class InputError(ValueError):
    """The user's input cannot be used; the message says where, what was found and what is accepted.

    The command line ends with exit code 2 on it.
    """


def joined(faults: list[str]) -> str:
    """Several faults as one message, a line each."""
    return "\n".join(faults)


class SimulationError(RuntimeError):
    """A run that could not be brought to its end."""
