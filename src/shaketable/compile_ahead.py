"""Compiles what is about to be needed, side by side, each driver in a process of its own.

Numba compiles one function at a time in a process. Machine code is kept on disk, where another
process finds it.
"""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable
from functools import partial
from importlib import import_module
from typing import NamedTuple

import numpy as np

from shaketable.body import Body
from shaketable.engine.pool import available_cores, run_all
from shaketable.models import General, Rocking
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.signal.intensity import intensity_measures
from shaketable.simulate.many import simulate_many
from shaketable.simulate.one import simulate
from shaketable.solid import Solid

TITLE = "compiling for this machine, once"


class Driver(NamedTuple):
    """A large driver, and a short run that has it compiled, with all that it calls."""

    module: str
    run: Callable[[Motion, Body, General], object]


#: Those that take longest to compile first.
DRIVERS = {
    "move_solid": Driver(
        "shaketable.physics.space.drive",
        lambda quiet, tall, rough: simulate(Solid.box(0.4, 0.4, 1.0), quiet, model=rough),
    ),
    "move_many": Driver(
        "shaketable.engine.general_many",
        lambda quiet, tall, rough: simulate_many([tall], [quiet], model=rough, progress=False),
    ),
    "rock_many": Driver(
        "shaketable.engine.rocking_many",
        lambda quiet, tall, rough: simulate_many([tall], [quiet], model=Rocking(), progress=False),
    ),
    "move_one": Driver(
        "shaketable.engine.general_one",
        lambda quiet, tall, rough: simulate(tall, quiet, model=rough),
    ),
    "rock_one": Driver(
        "shaketable.engine.rocking_one", lambda quiet, tall, rough: simulate(tall, quiet)
    ),
    "peak_displacements": Driver(
        "shaketable.oscillators.peaks", lambda quiet, tall, rough: intensity_measures(quiet)
    ),
}


def compile_ahead(names: Iterable[str] = DRIVERS, *, progress: Progress = True) -> None:
    """Compile those drivers that the cache lacks; nothing where there is no cache.

    Args:
        names: keys of DRIVERS.
        progress: as for `simulate_many`.
    """
    wanted = set(names)
    missing = [name for name in DRIVERS if name in wanted and not _is_there(name)]
    if not missing:
        return
    with meter(TITLE, len(missing), progress) as done:
        one_process = getattr(sys, "frozen", False)  # an application that is no interpreter
        if len(missing) == 1 or available_cores() == 1 or one_process:
            for name in missing:
                compile_driver(name)
                done(1)
        else:
            run_all((partial(_in_a_process, name) for name in missing), None, done)


def compile_driver(name: str) -> None:
    """Have one driver compiled in this process, or read from the cache."""
    quiet = Motion(np.full(3, 0.1), 0.01)
    DRIVERS[name].run(quiet, Body.rectangle(0.3, 1.0), General(static_friction=0.5))


def _is_there(name: str) -> bool:
    from shaketable.compiled import is_kept, may_be_kept

    driver = getattr(import_module(DRIVERS[name].module), name)
    return is_kept(driver) or not may_be_kept(driver)


def _in_a_process(name: str) -> int:
    """Compile one driver there. If that fails, the command that needs it will say why."""
    code = f"from shaketable.compile_ahead import for_another; for_another({name!r})"
    with subprocess.Popen(  # noqa: S603  # words of our own
        [sys.executable, "-c", code],
        stdin=subprocess.PIPE,  # ends when this process does
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        process.wait()
    return 1


def for_another(name: str) -> None:
    """Compile one driver for the process at the other end of standard input, while it lives."""
    threading.Thread(target=_end_with_input, daemon=True).start()
    gc.disable()  # a fourteenth of the time: nearly all that a compiler makes stays until it ends
    compile_driver(name)


def _end_with_input() -> None:
    sys.stdin.buffer.read()
    os._exit(1)
