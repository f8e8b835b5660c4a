"""Damaged files, command lines and questions, at random: read or refused, and nothing else.

python -m tests.fuzz.run --count 100000 --seed 1      # a table of outcomes; exit 1 if one failed
"""

from __future__ import annotations

import argparse
import io
import logging
import sys
import tempfile
import time
import traceback
import warnings
import zipfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager, suppress
from itertools import repeat
from pathlib import Path
from typing import NamedTuple

import numpy as np

from shaketable import InputError
from shaketable.compile_ahead import compile_ahead
from shaketable.engine.pool import available_cores
from shaketable.web.limits import MANY_SECONDS
from tests.fuzz.readers import Reader, readers
from tests.support.mutations import MUTATIONS

LONGEST = 10.0  # s of the processor for a file
MOST_MEMORY = 1_000_000_000  # bytes more than before
PIECE = 500  # files of a process at a time


class Failure(NamedTuple):
    """What must not be: a file that is neither read nor refused, or not in time."""

    kind: str
    seed: tuple[int, int]  # of the generator
    said: str


class Outcome(NamedTuple):
    """Of some files: how many of each kind were read or refused, and what failed."""

    counts: Counter[tuple[str, str]]
    failures: list[Failure]


def damaged(reader: Reader, rng: np.random.Generator) -> bytes:
    """A file with one to three faults; of a spreadsheet, also in what it packs."""
    if reader.damaged is not None:
        return reader.damaged(rng)
    raw = reader.raw
    for _ in range(int(rng.choice([1, 1, 2, 3]))):
        mutation = MUTATIONS[int(rng.integers(len(MUTATIONS)))]
        if raw.startswith(b"PK") and rng.random() < 0.8:
            raw = _inside(raw, mutation, rng)
        else:
            raw = mutation(raw, rng).raw if raw else raw
    return raw


def _inside(raw: bytes, mutation: object, rng: np.random.Generator) -> bytes:
    """An archive one of whose members is damaged."""
    fresh = io.BytesIO()
    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as old, zipfile.ZipFile(fresh, "w") as new:
            names = old.namelist()
            chosen = names[int(rng.integers(len(names)))]
            for name in names:
                content = old.read(name)
                if name == chosen and content:
                    content = mutation(content, rng).raw  # type: ignore[operator]
                new.writestr(name, content)
    except Exception:  # it has been damaged as a whole before
        return raw
    return fresh.getvalue()


def fuzz(seed: int, first: int, count: int) -> Outcome:
    """Read damaged files; each is made by its own numbers alone."""
    counts: Counter[tuple[str, str]] = Counter()
    failures: list[Failure] = []
    with tempfile.TemporaryDirectory() as place, quiet():
        folder = Path(place)
        known = readers(folder)
        for number in range(first, first + count):
            rng = np.random.default_rng([seed, number])
            reader = known[int(rng.integers(len(known)))]
            path = folder / f"{number % 7}-{reader.name}"
            if reader.kind == "ShakeMap":
                path = folder / reader.name  # its uncertainty is beside it
            path.write_bytes(damaged(reader, rng))
            how, said = outcome(reader, path)
            counts[reader.kind, how] += 1
            if how == "failed":
                failures.append(Failure(reader.kind, (seed, number), said))
            path.unlink()
    return Outcome(counts, failures)


@contextmanager
def quiet() -> Iterator[None]:
    """What readers warn of is not looked at; what NumPy warns of is an error."""
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)  # an overflow is no word to a user
            yield
    finally:
        logging.disable(logging.NOTSET)


def outcome(reader: Reader, path: Path) -> tuple[str, str]:
    """How reading a file ends, and what is said where it failed."""
    begun, before = time.process_time(), _memory(anew=True)
    how, said = "read", ""
    try:
        reader.read(path)
    except InputError:
        how = "refused"
    except BaseException:
        return "failed", traceback.format_exc(limit=-3)
    spent, grown = time.process_time() - begun, _memory() - before
    longest = MANY_SECONDS if reader.kind == "question" else LONGEST  # where its answer is stopped
    if spent > longest or grown > MOST_MEMORY:
        return "failed", f"{spent:.1f} s and {grown / 1e6:.0f} MB"
    return how, said


def _memory(anew: bool = False) -> int:
    """The most memory that this process has had, or since it was last asked for anew [bytes]."""
    try:
        import resource
    except ImportError:  # Windows
        return 0
    status, peaks = Path("/proc/self/status"), Path("/proc/self/clear_refs")
    if not status.exists():
        scale = 1 if sys.platform == "darwin" else 1024
        return scale * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    if anew:
        with suppress(OSError):  # where that is forbidden it is the most of all
            peaks.write_text("5")
    peak = next(line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    return 1024 * int(peak.split()[1])


def pieces(count: int) -> Iterator[tuple[int, int]]:
    for first in range(0, count, PIECE):
        yield first, min(PIECE, count - first)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    compile_ahead()  # which is no question's cost
    total, failures, begun = Counter[tuple[str, str]](), list[Failure](), time.monotonic()
    firsts, counts = zip(*pieces(given.count), strict=True)
    with ProcessPoolExecutor(available_cores()) as pool:
        for found in pool.map(fuzz, repeat(given.seed), firsts, counts):
            total += found.counts
            failures += found.failures
    print("| kind | read | refused | failed |\n|---|---:|---:|---:|")
    for kind in dict.fromkeys(sorted(kind for kind, _ in total)):
        row = " | ".join(f"{total[kind, how]:,}" for how in ("read", "refused", "failed"))
        print(f"| {kind} | {row} |")
    seconds = time.monotonic() - begun
    print(f"\n{total.total():,} files in {seconds:.0f} s ({total.total() / seconds:.0f} a second)")
    for failure in failures[:20]:
        print(f"\n{failure.kind} {failure.seed}: {failure.said}")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
