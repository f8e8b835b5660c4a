"""Compiled code equals the source that is there, and is compiled once."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import shaketable
from shaketable.kernels import compiled

PACKAGE = Path(shaketable.__file__).parent

SLENDERNESS = """
import math
import numpy as np
from shaketable.engine import blocks
table = blocks.tabulate_blocks(np.array([[0.2, 0.5, 0.1, 0.3]]), np.zeros(1), math.nan)
print(float(table[0, 0, 2]))
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A copy of the package that may be edited, with a cache of its own."""
    shutil.copytree(PACKAGE, tmp_path / "shaketable", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


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
    callee = checkout / "shaketable" / "kernels" / "rocking.py"
    source = callee.read_text(encoding="utf-8")
    assert "phase = math.atan2(own, h) + sign * tilt" in source
    callee.write_text(source.replace("math.atan2(own, h) +", "2 * math.atan2(own, h) +"))
    assert float(run(checkout)) == 2 * before
    callee.write_text(source)
    assert float(run(checkout)) == before


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
        "from shaketable.kernels import compiled\n"
        "assert compiled.cache_directory() is None\n" + SLENDERNESS
    )
    assert float(run(checkout, code, NUMBA_CACHE_DIR=str(blocked))) > 0


def test_hash_covers_all_compiled_sources(checkout: Path) -> None:
    package = checkout / "shaketable"
    first = compiled.source_hash(package)
    assert first == compiled.source_hash(PACKAGE)
    # whatever the engines import, and what that imports: read off a process, not off the code
    listing = (
        "import sys, shaketable.engine.cpu, shaketable.engine.pool\n"
        "print(*(m.__file__ for n, m in sys.modules.items() if n.startswith('shaketable.')))"
    )
    loaded = {Path(name) for name in run(checkout, listing).split()}
    compiled_from = {p for p in loaded if p.parent.name in ("kernels", "engine")}
    assert len(compiled_from) >= 6
    for path in [*compiled_from, package / "units.py"]:
        text = path.read_text(encoding="utf-8")
        path.write_text(text + "\n# edited\n")
        assert compiled.source_hash(package) != first
        path.write_text(text)


def test_import_does_nothing() -> None:
    # neither compiled code nor the heavy libraries are touched before they are needed
    code = (
        "import sys, shaketable\n"
        "heavy = {'numba', 'pandas', 'xarray', 'matplotlib', 'scipy', 'h5py', 'rich', 'typer'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.stdout.strip() == "[]", result.stderr
