"""Commands that are imported when they are asked for: the program's own help needs none of them."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup

from shaketable.cli.examples import epilog
from shaketable.errors import InputError

#: Every command, the file of its name in this folder, and what it does, in half a line.
SUMMARIES = {
    "open": "The page in the browser, as without any command.",
    "assess": "What falls in a room, which way, what to do.",
    "room": "A room's plan: what falls where, which ways stay free.",
    "simulate": "One object under one recorded motion, in detail.",
    "tilt": "The tilt that chooses the side of a fall.",
    "criteria": "What simple published criteria say about an object.",
    "initial-modes": "How an object begins to move: rests, slides, rocks.",
    "calibrate": "A body's parameters from its shake-table tests.",
    "fragility": "The probability that objects fall, for loss tools.",
    "library": "Published fragility functions of common things.",
    "hazard": "How often a year objects fall at a site.",
    "scenario": "What falls in a given magnitude, or a ShakeMap.",
    "ida": "The lowest level of each motion that overturns it.",
    "overturning-spectrum": "What pulses of all frequencies do to a body.",
    "records": "List what record files hold, with intensity measures.",
    "select-motions": "Recorded motions whose spectra are an earthquake's.",
    "template": "An empty inventory, or table of tests, explained.",
    "serve": "The page for others, or at an address of its own.",
    "suites": "List the suites of motions that come with the package.",
    "study": "A published study, done again with your motions.",
    "campaign": "Very many simulations, resumable, on many machines.",
}


#: Options that a command does not have, and what is asked for there.
CALLED = {
    "--width-m": "in a plane the one size along the shaking is --base-m",
    "--depth-m": "in a plane the one size along the shaking is --base-m",
    "--upper-width-m": "in a plane the one size along the shaking is --upper-base-m",
}


class LazyGroup(TyperGroup):
    """The group of all commands: those that were added to it, and those of SUMMARIES."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands = _Commands(self.commands)

    def invoke(self, ctx: Any) -> Any:
        """Run a command; an option that has another name there is named."""
        try:
            return super().invoke(ctx)
        except Exception as error:
            name = getattr(error, "option_name", None)  # of Typer's own copy of Click's error
            command = getattr(getattr(error, "ctx", None), "command", None)
            has = [option for each in getattr(command, "params", ()) for option in each.opts]
            if name not in CALLED or "--base-m" not in has:
                raise
            raise InputError(f"{name}: {CALLED[name]}") from None

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the list of commands without importing them."""
        others = set(self.commands) - set(SUMMARIES)
        rows = [*SUMMARIES.items(), *((name, self.commands[name].help) for name in others)]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


class _Commands(MutableMapping[str, Any]):
    """Commands by their names, imported when they are looked up."""

    def __init__(self, own: MutableMapping[str, Any]) -> None:
        self._known = dict(own)

    def __getitem__(self, name: str) -> Any:
        if name not in self._known and name in SUMMARIES:
            self._known[name] = _loaded(name)
        return self._known[name]

    def __setitem__(self, name: str, command: Any) -> None:
        self._known[name] = command

    def __delitem__(self, name: str) -> None:
        del self._known[name]

    def __iter__(self) -> Iterator[str]:
        yield from dict.fromkeys([*SUMMARIES, *self._known])

    def __len__(self) -> int:
        return len({*SUMMARIES, *self._known})


def _loaded(name: str) -> Any:
    """The command, or the group of commands, of a file of this folder."""
    from shaketable.cli.option_groups import with_groups

    file = name.replace("-", "_")
    found = getattr(import_module(f"shaketable.cli.{file}"), file)
    alone = typer.Typer(rich_markup_mode=None)
    if isinstance(found, typer.Typer):
        alone.add_typer(found, name=name)
    else:
        alone.command(name, epilog=epilog(name))(with_groups(found))
    return typer.main.get_group(alone).commands[name]
