"""The package's public names, and how its command begins."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from types import FunctionType

import pytest

import shaketable


def test_names_are_those_of_their_rooms() -> None:
    assert sorted(shaketable._HOMES) == sorted(shaketable.__all__)
    for name, room in shaketable._HOMES.items():
        assert getattr(shaketable, name) is getattr(import_module(f"shaketable.{room}"), name)
    assert set(shaketable.__all__) < set(dir(shaketable))
    assert shaketable.criteria is import_module("shaketable.criteria")
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        _ = shaketable.nothing


@pytest.mark.parametrize("name", ["assess", "fragility", "simulate"])
def test_a_function_keeps_its_place_beside_the_room_of_its_name(name: str) -> None:
    """In whatever order they are imported, in a process of its own."""
    room = f"shaketable.{name}"
    for first in (f"import {room}", f"from {room} import *", "pass", f"shaketable.{name}"):
        code = (
            f"import shaketable\n{first}\nimport {room}.{MODULES[name]}\n"
            f"from shaketable import {name}\n"
            f"assert {name} is shaketable.{name}\nprint(type(shaketable.{name}).__name__)"
        )
        said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        assert said.stdout.strip() == FunctionType.__name__, said.stderr


MODULES = {"assess": "job", "fragility": "lognormal", "simulate": "one"}


def test_the_import_of_the_package_alone_loads_next_to_nothing() -> None:
    code = "import sys, shaketable; print(len([n for n in sys.modules if 'shaketable' in n]))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert said.stdout.strip() == "1"
    code = "import sys, shaketable; print('numpy' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert said.stdout.strip() == "False"


#: `python -m shaketable simulate --help`, interrupted when it imports a module.
INTERRUPTED = """
import runpy, signal, sys

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == sys.argv[3]:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Finder())
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs behind may have it ignored
runpy.run_module("shaketable", run_name="__main__", alter_sys=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("module", ["shaketable.cli", "typer", "shaketable.models", "numpy"])
def test_ctrl_c_ends_the_imports_without_a_traceback(module: str) -> None:
    asked = [sys.executable, "-c", INTERRUPTED, "simulate", "--help", module]
    said = subprocess.run(asked, capture_output=True, text=True)
    assert "Traceback" not in said.stderr, said.stderr
    assert said.returncode in {1, 130}  # before the command begins, and from then on
    asked[-1] = "nothing"
    assert subprocess.run(asked, capture_output=True).returncode == 0
