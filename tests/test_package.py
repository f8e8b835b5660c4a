"""The package's public names, and how its command begins."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from importlib import import_module
from types import FunctionType

import pytest

import shaketable

MAIN = (sys.executable, "-m", "shaketable")


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


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_ends_the_imports_without_a_traceback() -> None:
    """Python's own start is not ours: the first moments are left to it."""
    begun = time.monotonic()
    subprocess.run([*MAIN, "--help"], capture_output=True, check=True)
    took = time.monotonic() - begun
    ends = []
    for share in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8):
        with subprocess.Popen(
            [*MAIN, "--help"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as process:
            time.sleep(share * took)
            process.send_signal(signal.SIGINT)
            _, told = process.communicate()
        assert "Traceback" not in told, told
        ends.append(process.returncode)
    assert set(ends) <= {0, 1, -signal.SIGINT}
    assert ends[0] != 0  # it was interrupted
