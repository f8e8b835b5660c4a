"""What it costs to compile each driver: processor seconds in a process of its own, no cache.

python -m benchmarks.compiling            # all of them, one after another
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from shaketable.compile_ahead import DRIVERS

PROCESS = """
import sys
import time
from numba.core import event
from shaketable.compile_ahead import compile_driver
begun, clock = time.process_time(), time.perf_counter()
with event.install_recorder("numba:compile") as recorder:
    compile_driver(sys.argv[1])
ends = [each for _, each in recorder.buffer if each.is_end]
names = [each.data["dispatcher"].py_func.__qualname__ for each in ends]
print(time.process_time() - begun, time.perf_counter() - clock, len(names), len(set(names)))
"""


def main() -> None:
    print(
        "| driver | processor s | s | functions | of these different |\n|---|---:|---:|---:|---:|"
    )
    total = 0.0
    for name in DRIVERS:
        with tempfile.TemporaryDirectory() as empty:
            environment = {**os.environ, "NUMBA_CACHE_DIR": empty}
            said = subprocess.run(
                [sys.executable, "-c", PROCESS, name],
                env=environment,
                stdout=subprocess.PIPE,
                check=True,
            ).stdout.split()
        spent, took, functions, different = map(float, said)
        total += spent
        print(f"| {name} | {spent:.1f} | {took:.1f} | {functions:.0f} | {different:.0f} |")
    print(f"\n{total:.0f} processor s in all")


if __name__ == "__main__":
    main()
