"""Build a wheel that holds the machine code of all drivers, for Linux on x86-64 processors.

    python -m scripts.compile_wheel [FOLDER]     # the wheel goes to FOLDER, dist by default

What the CPU runs is compiled by short runs of it, for the types of arguments that all runs share.
The code is for processors of level x86-64-v3; where another one, another Python, another Numba or
other sources are found, drivers are compiled as without it (shaketable.compiled.caches).
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from shaketable import Body, suite
from shaketable.compile_ahead import DRIVERS, compile_ahead, compile_driver
from shaketable.compiled.caches import LEVEL, KeptCache, ShippedCache
from shaketable.compiled.sources import COMPILED_TOGETHER, PACKAGE, folder_of
from shaketable.modes import simulated_mode
from shaketable.synthesis import ShearBuilding, asce_7, floor_motions, match_spectrum

ROOT = Path(__file__).resolve().parents[1]
#: Drivers that the CPU runs for a GPU, or in its place in tests.
FOR_A_GPU = {"move_each", "rock_each", "write_demands"}


def main() -> None:
    """Compile in a process of its own, as Numba reads its settings when it is imported."""
    if sys.argv[1:2] == ["--into"]:
        write_machine_code(Path(sys.argv[2]))
        return
    if sys.platform != "linux" or platform.machine() != "x86_64":
        sys.exit(
            "machine code is shipped for Linux on x86-64; elsewhere: python -m hatchling build"
        )
    out = Path(sys.argv[1] if len(sys.argv) > 1 else "dist").resolve()
    with tempfile.TemporaryDirectory() as work:
        code, cache = Path(work, "code"), Path(work, "cache")
        settings = {
            "NUMBA_CPU_NAME": LEVEL,
            "NUMBA_CPU_FEATURES": "",
            "NUMBA_CACHE_DIR": str(cache),
        }
        compiling = [sys.executable, "-m", "scripts.compile_wheel", "--into", str(code)]
        subprocess.run(compiling, check=True, cwd=ROOT, env={**os.environ, **settings})
        building = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(out)]
        told = {"SHAKETABLE_MACHINE_CODE": str(code)}
        subprocess.run(building, check=True, cwd=ROOT, env={**os.environ, **told})


def write_machine_code(out: Path) -> None:
    """The machine code of all drivers, for the processor that Numba was told of."""
    compile_ahead()
    for name in DRIVERS:
        compile_driver(name)
    motion = suite("fema-p695-far-field")[0]
    simulated_mode(Body.rectangle(0.3, 1.0), 1, 0.5, 0.4, 0.3)
    floor_motions(ShearBuilding(storeys=2, first_period=0.3), motion)
    match_spectrum(motion, asce_7(10.0, 6.0))
    size = 0
    for driver in drivers():
        name = driver.py_func.__name__
        if not driver.overloads:
            sys.exit(f"{name} was not compiled: a run in this file has to need it")
        files = ShippedCache(driver.py_func).take(driver._cache, out)
        size += sum(file.stat().st_size for file in files)
        print(f"{name:20} {len(driver.overloads)} {folder_of(driver.py_func)}")
    print(f"{size / 1e6:.1f} MB of machine code for {LEVEL}")


def drivers() -> Iterator[Any]:
    """All drivers of the package but those for a GPU."""
    for room in (room for rooms in COMPILED_TOGETHER.values() for room in rooms):
        for path in sorted(PACKAGE.glob(f"{room}/*.py")):
            module = import_module(f"shaketable.{room.replace('/', '.')}.{path.stem}")
            for name, value in vars(module).items():
                own = getattr(value, "__module__", "") == module.__name__
                cache = getattr(value, "_cache", None)
                if own and isinstance(cache, KeptCache) and name not in FOR_A_GPU:
                    yield value


if __name__ == "__main__":
    main()
