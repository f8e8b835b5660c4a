"""Commands in trouble: Ctrl-C, a second writer, a full disk and a clock that jumps.

Results are whole, or as before, and what is said has no traceback.

python -m tests.fuzz.troubles --count 3 --seed 1    # a table of what was left; exit 1 on a fault
"""

from __future__ import annotations

import argparse
import os
import resource
import signal
import subprocess
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from shaketable.compile_ahead import compile_ahead
from shaketable.engine.pool import available_cores
from tests.fuzz.kills import (
    COMMANDS,
    LONGEST,
    MAIN,
    STORES,
    Command,
    Left,
    contents,
    require_gone,
    tell,
    undisturbed,
    with_files,
    words_of,
)

WORKERS = "--workers 1"
ENDS = ("error: ", "Then: ", "Aborted!")  # how a campaign's own last line begins
FULL = 20_000  # bytes of a file, beyond which the disk is full
#: The time of day jumps by a day, once within the first seconds, for all that a process imports.
JUMPING = """
import random, time
_time, _begun = time.time, time.monotonic()
_after, _by = random.uniform(0.0, 5.0), random.choice([-86400, 86400])
time.time = lambda: _time() + (_by if time.monotonic() - _begun > _after else 0)
"""


def _begun(
    command: Command,
    folder: Path,
    place: str,
    said: Path,
    *,
    limited: bool = False,
    alone: bool = False,
    environment: dict[str, str] | None = None,
) -> subprocess.Popen[bytes]:
    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (FULL, FULL))

    words = words_of(command, folder, place)
    with said.open("wb") as file:
        return subprocess.Popen(
            [*MAIN, *(words.replace(WORKERS, "") if alone else words).split()],
            cwd=folder,
            env=os.environ | (environment or {}),
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            preexec_fn=limit if limited else None,
        )


def _whole_or_before(
    command: Command, folder: Path, place: str, whole: dict[str, str], code: int, said: Path
) -> str:
    """What lies there; AssertionError for anything but the whole results or what was there."""
    text = said.read_text(errors="replace")
    # before or after what Dask and its workers say of themselves
    own = command.name in STORES and any(each.startswith(ENDS) for each in text.splitlines())
    assert own or "Traceback" not in text, f"exit {code}: {text[-1500:]}"
    beside = [each.name for each in folder.iterdir() if each.name.startswith(".")]
    assert not beside or command.name in STORES, f"left beside the results: {beside}"
    if not (folder / place).exists():
        return "nothing"
    found = contents(folder / place)
    if command.name in STORES and found != whole:
        return "a part, as stores may"
    assert found == whole, f"of the results' files {sorted(found)} some are not whole"
    return "whole results"


def interrupted(command: Command, folder: Path, whole: dict[str, str], after: float) -> str:
    """Ctrl-C at a moment: it ends soon, and says so in a line."""
    said = folder / "said.txt"
    process = _begun(command, folder, "place", said)
    try:
        code = process.wait(after)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        code = process.wait(LONGEST)
    require_gone(process.pid)
    return _whole_or_before(command, folder, "place", whole, code, said)


def by_two(command: Command, folder: Path, whole: dict[str, str], _: float) -> str:
    """Two writers at once into one place: one may be refused, and what lies there is whole."""
    said = [folder / "said.txt", folder / "other.txt"]
    processes = [_begun(command, folder, "place", each) for each in said]
    codes = [process.wait(LONGEST) for process in processes]
    assert 0 in codes, f"exits {codes}: {said[0].read_text()[-800:]}"
    for code, each in zip(codes, said, strict=True):
        assert code in (0, 1, 2), code
        left = _whole_or_before(command, folder, "place", whole, code, each)
    return left


def on_a_full_disk(command: Command, folder: Path, whole: dict[str, str], _: float) -> str:
    """No file may be larger than FULL bytes: refused in a line, with nothing half written."""
    said = folder / "said.txt"
    process = _begun(command, folder, "place", said, limited=True)
    code = process.wait(LONGEST)
    assert code in (0, 1), f"exit {code}: {said.read_text(errors='replace')[-800:]}"
    return _whole_or_before(command, folder, "place", whole, code, said)


def by_a_clock_that_jumps(command: Command, folder: Path, whole: dict[str, str], _: float) -> str:
    """The time of day jumps while it runs: the results are the same.

    Without a cluster, as Dask waits for its workers by the time of day.
    """
    beside = folder / "clock"
    beside.mkdir(exist_ok=True)
    (beside / "sitecustomize.py").write_text(JUMPING)
    said = folder / "said.txt"
    environment = {"PYTHONPATH": f"{beside}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"}
    process = _begun(command, folder, "place", said, alone=True, environment=environment)
    code = process.wait(LONGEST)
    assert code == 0, f"exit {code}: {said.read_text(errors='replace')[-800:]}"
    return _whole_or_before(command, folder, "place", whole, code, said)


TROUBLES: dict[str, Callable[[Command, Path, dict[str, str], float], str]] = {
    "Ctrl-C": interrupted,
    "two writers": by_two,
    "a full disk": on_a_full_disk,
    "a clock that jumps": by_a_clock_that_jumps,
}


def troubled(command: Command, count: int, seed: int) -> Left:
    """Every trouble for a command, Ctrl-C at several moments."""
    rng = np.random.default_rng([seed, COMMANDS.index(command)])
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[str] = []
    with with_files() as folder:
        duration, whole = undisturbed(command, folder)
        for name, trouble in TROUBLES.items():
            for _ in range(count if trouble is interrupted else 1):
                after = float(rng.uniform(0.1, duration))
                try:
                    left = trouble(command, folder, whole, after)
                    counts[f"{command.name}, {name}", left] += 1
                except (AssertionError, OSError, subprocess.TimeoutExpired) as error:
                    wrong.append(f"{command.name}, {name} [{seed}], after {after:.2f} s: {error}")
    return Left(counts, wrong)


def trouble_all(count: int, seed: int, names: tuple[str, ...] = ()) -> Left:
    """Every command in every trouble, as many at once as there are cores."""
    chosen = [command for command in COMMANDS if not names or command.name in names]
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[str] = []
    compile_ahead()
    with ThreadPoolExecutor(available_cores()) as pool:
        for left in pool.map(lambda command: troubled(command, count, seed), chosen):
            counts += left.counts
            wrong += left.wrong
    return Left(counts, wrong)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=5, help="Ctrl-C of each command")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("names", nargs="*", help="of commands; all, if none is named")
    given = parser.parse_args()
    tell(trouble_all(given.count, given.seed, tuple(given.names)))


if __name__ == "__main__":
    main()
