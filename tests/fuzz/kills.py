"""Commands that are killed at random times: results are whole or as before, and the next run heals.

python -m tests.fuzz.kills --count 50 --seed 1     # a table of what was left; exit 1 if one failed
"""

from __future__ import annotations

import argparse
import hashlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import NamedTuple

import httpx
import numpy as np

from shaketable.compile_ahead import compile_ahead
from shaketable.engine.pool import available_cores

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
MAIN = (sys.executable, "-m", "shaketable")
MOTIONS = "--motions fema-p695-near-field-pulse"
LIST = "name,width_m,depth_m,height_m\nbookcase,0.8,0.32,1.8\nbox,0.5,0.5,0.4\n"
CAMPAIGN = """
[bodies.grid]
base_m = [0.2, 0.3, 0.4]
height_m = [1.0, 1.5]
[motions]
of = ["fema-p695-near-field-pulse"]
[plan]
block = 4
"""
LIBRARY = """
[library]
title = "Few things"
edition = "0.1"
measures = ["PGV"]
limit_states = ["overturns"]
seed = 1
[motions]
of = "fema-p695-near-field-pulse"
[[places]]
name = "ground"
[[held]]
name = "free"
draws = 1
[[things]]
kinds = ["bookcase"]
sizes = ["slender"]
"""
ROOM = """
name = "Room {name}"
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[door]]
at_m = [1, 0]
[[place]]
kind = "bed"
at_m = [1, 2]
size_m = [0.9, 1.8]
[[thing]]
name = "bookcase"
at_m = [3, 2.8]
facing_deg = 180
depth_m = 0.3
width_m = 0.9
height_m = 1.8
"""
QUESTION = {
    "thing": {"base_m": 0.32, "height_m": 1.8, "friction": 0.5},
    "shaking": {"kind": "pulse", "period_s": 1.5, "peak_g": 0.6},
}
GONE_WITHIN = 15.0  # s after which no process of a killed command lives
LONGEST = 300.0  # s for a run that nobody disturbs: all is compiled, and it takes 5 s
STACKS = 20_000  # characters of the stacks of a run that hangs


class Command(NamedTuple):
    """A command that leaves something.

    Attributes:
        name: of the command.
        words: its words, of which `{}` is where results go.
        again: words that are added where earlier results lie.
    """

    name: str
    words: str
    again: str = "--overwrite"


COMMANDS = (
    Command("assess", f"assess list.csv {MOTIONS} --planar --out {{}}"),
    Command("study", f"study boroschek-romo-2004 {MOTIONS} --out {{}}"),
    Command(
        "scenario",
        f"scenario list.csv --magnitude 7 --distance-km 10 --number 8 {MOTIONS} --out {{}}",
    ),
    Command("calibrate", "calibrate tests.csv --motions fema-p695 --members 64 --out {}"),
    Command("campaign", "campaign run campaign.toml --workers 1 --store {}", again=""),
    Command("library", "campaign run library.toml --workers 1 --store {}", again=""),
    Command("room", f"room assess room.toml {MOTIONS} --out {{}}"),
    Command("survey", f"room survey room.toml other.toml {MOTIONS} --out {{}}"),
)
STORES = ("campaign", "library")  # which may be left in part


class Left(NamedTuple):
    """What killed runs of a command left: how often each, and what was wrong."""

    counts: Counter[tuple[str, str]]
    wrong: list[str]


def undisturbed(command: Command, folder: Path) -> tuple[float, dict[str, str]]:
    """How long a command takes by itself, in seconds, and what it leaves."""
    begun = time.monotonic()
    run_whole(command, folder, "whole")
    return time.monotonic() - begun, contents(folder / "whole")


def killed(command: Command, count: int, seed: int) -> Left:
    """Kill a command over and over, in one place: what lies there is always whole.

    It begins in an empty place. After every five kills, and at last, it runs to its end over what
    was left, which has to give the undisturbed run's results and nothing beside them. The second
    five begin with these results, the third ones in an empty place again, and so on.
    """
    rng = np.random.default_rng([seed, COMMANDS.index(command)])
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[str] = []
    with with_files() as folder:
        duration, whole = undisturbed(command, folder)
        for number in range(count):
            if number % 10 == 0:
                shutil.rmtree(folder / "place", ignore_errors=True)
            after = float(rng.uniform(0.0, duration))
            ended = _kill(command, folder, after)
            said = f"{command.name} [{seed}], kill {number + 1} after {after:.2f} s: "
            try:
                counts[
                    command.name, "ended before" if ended else _left(command, folder, whole)
                ] += 1
                if number % 5 == 4 or number == count - 1:
                    run_whole(command, folder, "place")
                    differing = _differing(folder)
                    assert not differing, f"the next run differs in {', '.join(differing)}"
                    beside = [each.name for each in folder.iterdir() if each.name.startswith(".")]
                    assert not beside, f"left beside the results: {beside}"
                    counts[command.name, "healed"] += 1
            except (AssertionError, OSError) as error:
                wrong.append(f"{said}{error}")
    return Left(counts, wrong)


@contextmanager
def with_files() -> Iterator[Path]:
    """With what the commands read."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "list.csv").write_text(LIST)
        (folder / "campaign.toml").write_text(CAMPAIGN)
        (folder / "library.toml").write_text(LIBRARY)
        for name, place in (("1", "room.toml"), ("2", "other.toml")):
            (folder / place).write_text(ROOM.format(name=name))
        (folder / "tests.csv").write_bytes((EXAMPLES / "tests.csv").read_bytes())
        yield folder


def begin(words: str, folder: Path) -> subprocess.Popen[bytes]:
    """In a session of its own, by which all its processes are found."""
    with (folder / "said").open("wb") as said:
        return subprocess.Popen(
            [*MAIN, *words.split()],
            cwd=folder,
            env=os.environ | {"PYTHONFAULTHANDLER": "1"},
            stdout=said,
            stderr=said,
            start_new_session=True,
        )


def words_of(command: Command, folder: Path, place: str) -> str:
    again = command.again if (folder / place).exists() else ""
    return f"{command.words.format(place)} {again}"


def run_whole(command: Command, folder: Path, place: str) -> None:
    """To its end."""
    process = begin(words_of(command, folder, place), folder)
    try:
        code = process.wait(LONGEST)
    except subprocess.TimeoutExpired:
        for number in _processes(process.pid):  # faulthandler prints the stack of each thread
            with suppress(ProcessLookupError):  # it has just ended
                os.kill(number, signal.SIGABRT)
        process.wait()
        raise AssertionError(f"not done after {LONGEST:.0f} s: {said_in(folder, STACKS)}") from None
    assert code == 0, f"exit {code}: {said_in(folder)}"


def _kill(command: Command, folder: Path, after: float) -> bool:
    """Whether it had ended by then."""
    process = begin(words_of(command, folder, "place"), folder)
    try:
        code = process.wait(after)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        require_gone(process.pid)
        return False
    assert code == 0, f"exit {code}: {said_in(folder)}"
    return True


def said_in(folder: Path, most: int = 800) -> str:
    return (folder / "said").read_text(errors="replace")[-most:]


def require_gone(session: int) -> None:
    """No process of a killed command works on for nobody."""
    until = time.monotonic() + GONE_WITHIN
    while left := _processes(session):
        assert time.monotonic() < until, f"{len(left)} of its processes live on"
        time.sleep(0.05)


def _processes(session: int) -> list[int]:
    """Those of a session that live; none where the system does not tell."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rsplit(")", 1)[1].split()
        except OSError:  # it has just ended
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.append(int(status.parent.name))
    return found


def _left(command: Command, folder: Path, whole: dict[str, str]) -> str:
    """What lies where the results go: nothing, or all of them. A store may be in between."""
    place = folder / "place"
    if not place.exists():
        return "nothing"
    found = contents(place)
    if command.name in STORES and found != whole:
        return "a part, as stores may"
    assert found == whole, f"of the results' files {sorted(found)} some are not whole"
    return "whole results"


def contents(place: Path) -> dict[str, str]:
    """The files of some results, but for when they were made and how long that took."""
    found = {}
    for path in sorted(place.rglob("*")):
        name = path.relative_to(place).as_posix()
        if path.is_file() and "campaign/" not in name:
            timed = path.suffix in (".html", ".json") and "zarr" not in path.name
            found[name] = "" if timed else hashlib.sha256(path.read_bytes()).hexdigest()
    return found


def _differing(folder: Path) -> list[str]:
    a, b = (contents(folder / place) for place in ("whole", "place"))
    return sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))


def killed_server(count: int, seed: int) -> Left:
    """Kill `serve` while it starts and answers: its workers end, and its port is free again."""
    rng = np.random.default_rng([seed, len(COMMANDS)])
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[str] = []
    with with_files() as folder:
        duration = _answered(folder, None)
        for number in range(count):
            after = float(rng.uniform(0.0, 1.2 * duration))
            try:
                _answered(folder, after)
                counts["serve", "nothing"] += 1
                if number % 5 == 4 or number == count - 1:
                    _answered(folder, None)
                    counts["serve", "healed"] += 1
            except (AssertionError, OSError) as error:
                wrong.append(f"serve [{seed}], kill {number + 1} after {after:.2f} s: {error}")
    return Left(counts, wrong)


def _answered(folder: Path, after: float | None) -> float:
    """Ask a server over and over until it answers, or until it is killed [s since it began]."""
    # below 32,768, from where systems draw the ports of calls: one that calls itself takes it
    port = 10_000 + os.getpid() % 20_000
    begun = time.monotonic()
    process = begin(f"serve --port {port} --workers 1", folder)
    until = begun + (LONGEST if after is None else after)
    try:
        while time.monotonic() < until:
            assert process.poll() is None, f"it ended by itself: {said_in(folder)}"
            try:
                address = f"http://127.0.0.1:{port}/api/simulate"
                answer = httpx.post(address, json=QUESTION, timeout=until - time.monotonic())
            except httpx.TransportError:  # not yet there
                time.sleep(0.05)
                continue
            assert answer.status_code == 200, answer.text
            if after is None:
                break
        return time.monotonic() - begun
    finally:
        process.send_signal(signal.SIGTERM if after is None else signal.SIGKILL)
        process.wait(30.0)
        require_gone(process.pid)


def _caught(work: Callable[[], Left], name: str) -> Left:
    try:
        return work()
    except Exception:
        return Left(Counter(), [f"{name}: {traceback.format_exc(limit=-3)}"])


def kill_all(count: int, seed: int, names: tuple[str, ...] = ()) -> Left:
    """Every command, as many at once as there are cores.

    Args:
        count: kills of each.
        seed: of the moments.
        names: of the commands; all of them, if empty.
    """
    works: dict[str, Callable[[], Left]] = {
        command.name: partial(killed, command, count, seed) for command in COMMANDS
    }
    works["serve"] = partial(killed_server, count, seed)
    chosen = names or tuple(works)
    counts: Counter[tuple[str, str]] = Counter()
    wrong: list[str] = []
    compile_ahead()  # when a run is killed is drawn from how long one takes
    with ThreadPoolExecutor(available_cores()) as pool:
        for left in pool.map(_caught, [works[name] for name in chosen], chosen):
            counts += left.counts
            wrong += left.wrong
    return Left(counts, wrong)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0)
    known = [*(command.name for command in COMMANDS), "serve"]
    parser.add_argument("names", nargs="*", help=f"of {', '.join(known)}; all, if none is named")
    given = parser.parse_args()
    found = kill_all(given.count, given.seed, tuple(given.names))
    tell(found)


def tell(found: Left) -> None:
    """Print a table of what was left and what was wrong, and end with 1 if anything was."""
    kinds = sorted({kind for _, kind in found.counts})
    print(f"| command | {' | '.join(kinds)} |\n|---|{'---:|' * len(kinds)}")
    for name in dict.fromkeys(name for name, _ in found.counts):
        print(f"| {name} | {' | '.join(str(found.counts[name, kind]) for kind in kinds)} |")
    for said in found.wrong:
        print(f"\n{said}")
    sys.exit(bool(found.wrong))


if __name__ == "__main__":
    main()
