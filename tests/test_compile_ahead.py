"""Drivers compiled side by side, ahead of what needs them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

COMPILES = """
from shaketable import compile_ahead
from shaketable.compiled import is_kept
from shaketable.engine.rocking_one import rock_one
from shaketable.oscillators.peaks import peak_displacements
told = []
before = [is_kept(rock_one), is_kept(peak_displacements)]
compile_ahead.compile_ahead(["rock_one", "peak_displacements"], progress=told.append)
after = [is_kept(rock_one), is_kept(peak_displacements)]
compile_ahead.compile_ahead(["rock_one", "peak_displacements"], progress=told.append)
print(before, after, told, len(rock_one.overloads))
"""


def said(code: str, cache: Path) -> str:
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True,
        env={**os.environ, "NUMBA_CACHE_DIR": str(cache)},
    )  # fmt: skip
    assert not run.stderr
    return run.stdout.strip()


def test_what_the_cache_lacks_is_compiled_once_in_other_processes(tmp_path: Path) -> None:
    expected = "[False, False] [True, True] [1, 1] 0"
    if len(os.sched_getaffinity(0)) == 1:
        expected = expected[:-1] + "1"  # in this process
    assert said(COMPILES, tmp_path) == expected
    assert said(COMPILES, tmp_path) == "[True, True] [True, True] [] 0"


def test_without_a_cache_nothing_is_compiled_ahead() -> None:
    assert said(COMPILES, Path(os.devnull)).endswith("[False, False] [False, False] [] 0")


def test_a_process_that_compiles_ends_with_the_one_that_asked(tmp_path: Path) -> None:
    code = "from shaketable.compile_ahead import for_another; for_another('move_solid')"
    with subprocess.Popen(
        [sys.executable, "-c", code],
        stdin=subprocess.PIPE,
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
    ) as process:
        assert process.stdin is not None
        process.stdin.close()
        assert process.wait(60) == 1
    assert not list(tmp_path.rglob("*.nbc"))


def test_every_driver_has_a_run_that_compiles_it() -> None:
    code = """
from importlib import import_module
from shaketable.compile_ahead import DRIVERS, compile_driver
for name, driver in DRIVERS.items():
    compile_driver(name)
    assert len(getattr(import_module(driver.module), name).signatures) == 1, name
"""
    subprocess.run([sys.executable, "-c", code], check=True)
