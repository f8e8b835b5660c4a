"""Compiled code equals the source that is there, and is compiled once."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import shaketable
from shaketable.compiled.places import make_private, writable_by_others
from shaketable.compiled.sources import COMPILED_TOGETHER, SHARED_SOURCES, source_hash
from tests.support.imports import MODULES, modules

PACKAGE = Path(shaketable.__file__).parent
MESSAGES = {"shaketable.errors"}  # what units raises; no compiled code holds it

SLENDERNESS = """
import math
import numpy as np
from shaketable.engine.body_tables import BLOCK, tabulate_blocks
table = tabulate_blocks(np.array([[0.2, 0.5, 0.1, 0.3, 1.0]]), np.zeros(1), math.nan)
print(float(table[0, BLOCK.right.phase]))
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A copy of the package that may be edited, with a cache of its own."""
    shutil.copytree(PACKAGE, tmp_path / "shaketable", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


#: What drivers inline, called as tests call it.
PRODUCT = """
from shaketable.physics.space.vectors import Vec, dot
print(dot(Vec(1.0, 2.0, 3.0), Vec(4.0, 5.0, 6.0)), sum(dot.stats.cache_hits.values()))
"""


def run(checkout: Path, code: str = SLENDERNESS, **environment: str) -> str:
    result = subprocess.run(
        [sys.executable, "-c", code],
        env={
            **os.environ,
            "PYTHONPATH": str(checkout),
            "NUMBA_CACHE_DIR": str(checkout / "cache"),
            **environment,
        },
        capture_output=True,
        text=True,
        check=True,
    )
    return result.stdout


def machine_code(checkout: Path) -> dict[Path, int]:
    return {path: path.stat().st_mtime_ns for path in (checkout / "cache").rglob("*.nbc")}


def test_an_edit_in_a_callee_changes_the_result(checkout: Path) -> None:
    before = float(run(checkout))
    cached = machine_code(checkout)
    assert cached
    assert float(run(checkout)) == before
    assert machine_code(checkout) == cached  # the second process compiled nothing
    callee = checkout / "shaketable" / "physics" / "plane" / "rocking.py"
    source = callee.read_text(encoding="utf-8")
    assert "phase = math.atan2(own, h) + sign * tilt" in source
    callee.write_text(source.replace("math.atan2(own, h) +", "2 * math.atan2(own, h) +"))
    assert float(run(checkout)) == 2 * before
    callee.write_text(source)
    assert float(run(checkout)) == before


def test_what_is_no_driver_is_kept_where_python_calls_it(checkout: Path) -> None:
    assert run(checkout, PRODUCT).split() == ["32.0", "0"]
    assert run(checkout, PRODUCT).split() == ["32.0", "1"]


@pytest.mark.slow
def test_an_edit_of_gravity_changes_the_result(checkout: Path) -> None:
    drop = (
        "import numpy as np\nfrom shaketable import Body, Motion, simulate\n"
        "quiet = Motion(np.zeros(2), 0.01)\n"
        "run = simulate(Body.rectangle(0.3, 1.0), quiet, initial_rotation=0.1)\n"
        "print(run.impact_times[0])"
    )
    before = float(run(checkout, drop))
    units = checkout / "shaketable" / "units.py"
    source = units.read_text(encoding="utf-8")
    units.write_text(source.replace("9.80665", "1.62"))
    # the time of a fall goes with 1/√g
    assert float(run(checkout, drop)) == pytest.approx(before * (9.80665 / 1.62) ** 0.5, rel=1e-9)


def test_a_cache_that_cannot_be_written_is_done_without(checkout: Path) -> None:
    blocked = checkout / "file"
    blocked.write_text("not a folder")
    code = (
        "from shaketable.compiled.places import cache_directory\n"
        "assert cache_directory('engine') is None\n" + SLENDERNESS
    )
    assert float(run(checkout, code, NUMBA_CACHE_DIR=str(blocked))) > 0


@pytest.mark.parametrize(
    "spoil",
    ["cut", *(pytest.param(how, marks=pytest.mark.slow) for how in ("a byte", "zeros", "empty"))],
)
@pytest.mark.parametrize("kind", ["nbc", pytest.param("nbi", marks=pytest.mark.slow)])
def test_damaged_machine_code_is_compiled_anew(checkout: Path, kind: str, spoil: str) -> None:
    before = run(checkout)
    (path,) = (checkout / "cache").rglob(f"*.{kind}")
    whole = path.read_bytes()
    middle = len(whole) // 2
    path.write_bytes(
        {
            "cut": whole[:middle],
            "zeros": bytes(len(whole)),
            "empty": b"",
            "a byte": whole[:middle] + bytes([whole[middle] ^ 0x5D]) + whole[middle + 1 :],
        }[spoil]
    )
    assert run(checkout) == before
    again = machine_code(checkout)
    assert run(checkout) == before
    assert machine_code(checkout) == again  # what was thrown away has been replaced


@pytest.mark.skipif(sys.platform == "win32", reason="limits the size of files")
def test_a_full_disk_is_no_harm_to_compiled_code(checkout: Path) -> None:
    # files of at most 1 kB stand for a disk that fills while machine code is written
    limit = (
        "import resource, signal\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
    )
    full = run(checkout, limit + SLENDERNESS, PYTHONDONTWRITEBYTECODE="1")  # Python 3.11 keeps half
    assert full == run(checkout)


def test_hash_covers_all_that_compiled_code_is_made_of(checkout: Path) -> None:
    # where functions are compiled is read off a process, what they take from elsewhere off the
    # text of their imports: neither asks the hash where it looks
    package = checkout / "shaketable"
    listing = (
        "import importlib, pkgutil, sys, shaketable\n"
        "from numba.core.dispatcher import Dispatcher\n"
        "for found in pkgutil.walk_packages(shaketable.__path__, 'shaketable.'):\n"
        "    if not found.name.endswith('.gpu_cache'):  # takes the packages of the extra gpu\n"
        "        importlib.import_module(found.name)\n"
        "for name, module in sys.modules.items():\n"
        "    if name.startswith('shaketable.') and any(isinstance(each, Dispatcher) and\n"
        "            each.py_func.__module__ == name for each in vars(module).values()):\n"
        "        print(name)"
    )
    compiled_in = set(run(checkout, listing).split())
    assert len(compiled_in) > 20
    for room, folders in COMPILED_TOGETHER.items():
        own = {name for name in compiled_in if "/".join(name.split(".")[1:-1]) in folders}
        compiled_in -= own
        made_of = set(own)
        for name in own:
            made_of |= modules(MODULES[name])
        first = source_hash(room, package)
        assert first == source_hash(room, PACKAGE)
        for name in made_of - MESSAGES:
            path = package / MODULES[name].relative_to(PACKAGE)
            text = path.read_text(encoding="utf-8")
            path.write_text(text + "\n# edited\n")
            assert source_hash(room, package) != first, name
            path.write_text(text)
    shared = {
        name
        for name in compiled_in
        if MODULES[name].relative_to(PACKAGE).as_posix() in SHARED_SOURCES
    }
    assert compiled_in == shared  # every other file with compiled functions belongs to a room


def test_an_edit_of_the_oscillators_leaves_the_contact_kernels_compiled(checkout: Path) -> None:
    package = checkout / "shaketable"
    first = source_hash("engine", package)
    own = source_hash("oscillators", package)
    with (package / "oscillators" / "peaks.py").open("a") as file:
        file.write("# edited\n")
    assert source_hash("engine", package) == first
    assert source_hash("oscillators", package) != own


def test_import_does_nothing() -> None:
    # neither compiled code nor the heavy libraries are touched before they are needed
    code = (
        "import sys\n"
        "from shaketable import *\n"
        "heavy = {'numba', 'pandas', 'xarray', 'matplotlib', 'scipy', 'rich', 'typer'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout.strip() == "[]", result.stderr


def test_a_cache_that_others_may_write_is_not_executed(tmp_path: Path) -> None:
    """A pickle that another user put there ran as whoever simulated next."""
    own = tmp_path / "own"
    make_private(own / "cache")
    assert (own / "cache").stat().st_mode & 0o777 == 0o700
    assert writable_by_others(own / "cache") is None
    for mode, place in (
        (0o777, own),
        (0o770, own),
        (0o777, own / "cache"),
        (0o1777, own / "cache"),
    ):
        place.chmod(mode)
        assert writable_by_others(own / "cache") == place
        place.chmod(0o700)
    own.chmod(0o1777)  # as the temporary folder
    assert writable_by_others(own / "cache") is None
    own.chmod(0o700)
    (tmp_path / "link").symlink_to(own / "cache")
    own.chmod(0o777)
    assert writable_by_others(tmp_path / "link") == own
    own.chmod(0o700)
    if os.getuid() == 0:
        os.chown(own / "cache", 12345, -1)
        assert writable_by_others(own / "cache") == own / "cache"


def test_a_cache_of_others_is_told_and_done_without(checkout: Path) -> None:
    cache = checkout / "cache"
    cache.mkdir()
    cache.chmod(0o777)
    result = subprocess.run(
        [sys.executable, "-c", SLENDERNESS],
        env={**os.environ, "PYTHONPATH": str(checkout), "NUMBA_CACHE_DIR": str(cache)},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert float(result.stdout) == float(run(checkout, NUMBA_CACHE_DIR=str(checkout / "private")))
    assert "others may write there" in result.stderr
    assert not list(cache.rglob("*.nb*"))
