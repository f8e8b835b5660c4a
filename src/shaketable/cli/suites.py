"""`shaketable suites`: the motions that come with the package."""

from __future__ import annotations

from shaketable.cli.console import say
from shaketable.records import SUITES


def suites() -> None:
    """List the suites of motions that come with the package."""
    for name, info in SUITES.items():
        say(f"{name:30}  {info.description}")
