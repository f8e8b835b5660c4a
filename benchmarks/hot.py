"""Where the time of compiled code goes, function by function, as Linux's `perf` sees it.

python -m benchmarks.hot                       a bookcase beside a wall and in a strap
python -m benchmarks.hot "wall at 10 mm"       another case of benchmarks.surrounded

Numba's machine code has no symbols that a profiler finds. The object that its cache holds has them,
and one address of it says where all are.
"""

from __future__ import annotations

import argparse
import bisect
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

from numba.core import codegen

FREQUENCY = 999  # samples a second
SECONDS = 6.0


class Symbol(NamedTuple):
    address: int
    size: int
    name: str


def keep_objects() -> list[tuple[Any, bytes]]:
    """The engines and the objects of all drivers that are read from the cache from now on."""
    kept: list[tuple[Any, bytes]] = []
    read = codegen.CPUCodegen.unserialize_library

    def keep(self: Any, serialized: Any) -> Any:
        library = read(self, serialized)
        if serialized[1] == "object":
            kept.append((self._engine, serialized[2][0]))
        return library

    codegen.CPUCodegen.unserialize_library = keep
    return kept


def symbols_of(engine: Any, code: bytes) -> list[Symbol]:
    """The functions of an object, where they lie in this process; none if that is not known."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(code)
        file.flush()
        said = subprocess.run(["nm", "-S", file.name], capture_output=True, text=True, check=True)
    rows = [line.split() for line in said.stdout.splitlines()]
    listed = [row for row in rows if len(row) == 4 and row[2] in "TtWw"]
    for at, _, kind, name in listed:
        here = engine._ee.get_function_address(name) if kind == "T" and "NRT" not in name else 0
        if here:
            first = here - int(at, 16)
            return [Symbol(first + int(a, 16), int(size, 16), n) for a, size, _, n in listed]
    return []


def run(case: str) -> None:
    """Write the symbols to standard output, and then work."""
    objects = keep_objects()
    from benchmarks import surrounded
    from shaketable import simulate_many, suite

    def work() -> None:
        simulate_many(
            [surrounded.BOOKCASE], suite("far-field"), model=surrounded.MODEL,
            surroundings=surrounded.CASES[case], scales=(1.0, 2.0), progress=False, threads=1,
        )  # fmt: skip

    work()
    for engine, code in objects:
        for symbol in symbols_of(engine, code):
            print(*symbol)
    until = time.monotonic() + SECONDS
    while time.monotonic() < until:
        work()


def readable(name: str) -> str:
    """Module and function of a mangled name."""
    parts = []
    while found := re.match(r"\D*?(\d+)", name):
        size, name = int(found[1]), name[found.end() :]
        parts.append(name[:size])
        name = name[size:]
        if name.startswith("B"):
            break
    return ".".join(parts[-2:])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", nargs="?", default="both")
    parser.add_argument("--under-perf", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.under_perf:
        run(given.case)
        return
    with tempfile.TemporaryDirectory() as folder:
        data = str(Path(folder) / "perf.data")
        again = [sys.executable, "-m", "benchmarks.hot", "--under-perf", given.case]
        said = subprocess.run(
            ["perf", "record", "-q", "-o", data, "-F", str(FREQUENCY), *again],
            capture_output=True, text=True, check=True,
        )  # fmt: skip
        samples = subprocess.run(
            ["perf", "script", "-i", data, "-F", "ip"], capture_output=True, text=True, check=True
        )
    rows = sorted(Symbol(int(a), int(b), c) for a, b, c in map(str.split, said.stdout.splitlines()))
    counts: Counter[str] = Counter()
    for text in samples.stdout.split():
        at = int(text, 16)
        k = bisect.bisect(rows, (at, sys.maxsize)) - 1
        if k >= 0 and at < rows[k].address + rows[k].size:
            counts[readable(rows[k].name)] += 1
    for name, count in counts.most_common(25):
        print(f"{100 * count / counts.total():5.1f} %  {name}")


if __name__ == "__main__":
    main()
