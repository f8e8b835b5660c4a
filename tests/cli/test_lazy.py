"""Commands are imported when they are asked for."""

from __future__ import annotations

import subprocess
import sys

import pytest
import typer

from shaketable.cli import app
from shaketable.cli.lazy import SUMMARIES
from tests.support.command import shaketable

WIDTH = 80  # of a terminal whose width is not known


def test_the_help_of_the_program_imports_no_command_and_no_library() -> None:
    code = (
        "import runpy, sys\nsys.argv[1:] = ['--help']\n"
        "try:\n    runpy.run_module('shaketable', run_name='__main__')\n"
        "finally:\n    print({name.split('.')[0] for name in sys.modules} & {'numpy', 'numba'},"
        " sum(name.startswith('shaketable.cli.') for name in sys.modules))"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert said.stdout.splitlines()[-1] == "set() 3", said.stderr  # examples, lazy, tell


def test_every_command_is_told_in_half_a_line() -> None:
    group = typer.main.get_command(app)
    commands = getattr(group, "commands")  # noqa: B009  typer's own type has none
    assert list(commands) == [*SUMMARIES, "help"]
    assert len(commands) == len(SUMMARIES) + 1
    room = WIDTH - 2 - max(map(len, SUMMARIES)) - 2
    for name, summary in SUMMARIES.items():
        assert commands[name].name == name
        assert len(summary) <= room
    with pytest.raises(KeyError):
        commands["nothing"]
    said = shaketable("--help").stdout
    wide = max(map(len, SUMMARIES)) + 2
    assert all(f"{name:{wide}}{summary}" in said for name, summary in SUMMARIES.items())


def test_an_unknown_command_is_told_with_the_nearest() -> None:
    said = shaketable("asses")
    assert said.returncode == 2
    assert "No such command 'asses'. Did you mean 'assess'?" in said.stderr
