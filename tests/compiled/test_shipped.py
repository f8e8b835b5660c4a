"""Machine code that came with the package: used where it fits, and never written to."""

from __future__ import annotations

import math
import os
import platform
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from scripts.take_code import take

from shaketable.compiled.caches import LEVEL, fits_here
from tests.compiled.test_caches import PACKAGE, SLENDERNESS

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64" or not fits_here(),
    reason="machine code is shipped for Linux on x86-64 processors with AVX2",
)

SHIP = """
import sys
from pathlib import Path
from shaketable.compiled.caches import ShippedCache
from shaketable.engine.body_tables import write_blocks
ShippedCache(write_blocks.py_func).take(write_blocks._cache, Path(sys.argv[1]))
"""
HIT = """
from shaketable.engine.body_tables import write_blocks
print(sum(write_blocks.stats.cache_hits.values()))
"""
#: What makes that the code does not fit, by code in front or by a variable.
UNFIT = {
    "another processor": (
        "from shaketable.compiled import caches\ncaches.FEATURES = {'what none has'}\n",
        {},
    ),
    "another Numba": ("import numba\nnumba.__version__ = '0.68.99'\n", {}),
    "a processor that is asked for": ("", {"NUMBA_CPU_NAME": "x86-64-v2"}),
}


@pytest.fixture(scope="module")
def shipping(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the package that came with the machine code of one driver."""
    top = tmp_path_factory.mktemp("shipping")
    shutil.copytree(PACKAGE, top / "shaketable", ignore=shutil.ignore_patterns("__pycache__"))
    for_level = {"NUMBA_CPU_NAME": LEVEL, "NUMBA_CPU_FEATURES": ""}
    run(top, SLENDERNESS + SHIP, top / "cache", for_level, str(top / "shaketable/machine_code"))
    shutil.rmtree(top / "cache")
    return top


def run(
    top: Path, code: str, cache: Path, variables: dict[str, str] | None = None, *words: str
) -> list[float]:
    """The numbers that code prints."""
    said = subprocess.run(
        [sys.executable, "-c", code, *words],
        env={
            **os.environ, "PYTHONPATH": str(top), "NUMBA_CACHE_DIR": str(cache), **(variables or {})
        },
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return [float(word) for word in said.stdout.split()]


def contents(top: Path) -> dict[str, bytes]:
    return {str(f): f.read_bytes() for f in (top / "shaketable/machine_code").rglob("*.*")}


def test_it_is_used_and_nothing_is_compiled(shipping: Path, tmp_path: Path) -> None:
    before = contents(shipping)
    assert len(before) == 4  # an index, its code, and a checksum of each
    slenderness, hits = run(shipping, SLENDERNESS + HIT, tmp_path / "cache")
    assert hits == 1
    assert not list(tmp_path.rglob("*.nbc"))
    # the right corner is 0.2 - 0.1 m from below the centre of gravity, 0.5 m high
    assert slenderness == pytest.approx(math.atan2(0.1, 0.5), rel=1e-15)
    assert contents(shipping) == before


@pytest.mark.parametrize("why", UNFIT)
def test_where_it_does_not_fit_the_driver_is_compiled(
    shipping: Path, tmp_path: Path, why: str
) -> None:
    before, variables = UNFIT[why]
    *_, hits = run(shipping, before + SLENDERNESS + HIT, tmp_path, variables)
    assert hits == 0
    assert list(tmp_path.rglob("*.nbc"))  # among what this user's runs have compiled


@pytest.mark.parametrize("spoilt", ["the sources", "the code", "its checksum"])
def test_what_was_changed_is_not_executed(shipping: Path, tmp_path: Path, spoilt: str) -> None:
    top = tmp_path / "changed"
    shutil.copytree(shipping, top, ignore=shutil.ignore_patterns("__pycache__"))
    (code,) = (top / "shaketable/machine_code").rglob("*.nbc")
    if spoilt == "the sources":
        with (top / "shaketable/physics/plane/rocking.py").open("a") as file:
            file.write("# edited\n")
    elif spoilt == "the code":
        code.write_bytes(code.read_bytes()[:-1])
    else:
        code.with_name(f"{code.name}.sha256").unlink()
    before = contents(top)
    *_, hits = run(top, SLENDERNESS + HIT, tmp_path / "cache")
    assert hits == 0
    assert contents(top) == before


def test_without_a_folder_of_ones_own_it_is_used(shipping: Path, tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    *_, hits = run(shipping, SLENDERNESS + HIT, blocked)
    assert hits == 1


def test_a_checkout_takes_the_code_of_a_wheel(shipping: Path, tmp_path: Path) -> None:
    code = shipping / "shaketable/machine_code"
    wheel = tmp_path / "some.whl"
    with zipfile.ZipFile(wheel, "w") as file:
        file.writestr("shaketable/__init__.py", "")
        for path in code.rglob("*.*"):
            file.write(path, f"shaketable/machine_code/{path.relative_to(code)}")
    said = take(wheel, tmp_path / "taken")
    assert said == (
        "some.whl: machine code for 1 of 3 groups of these sources; the others have changed, and "
        "are compiled when needed"
    )
    taken = {str(f.relative_to(tmp_path / "taken")): f.read_bytes()
             for f in (tmp_path / "taken").rglob("*.*")}  # fmt: skip
    assert taken == {str(f.relative_to(code)): f.read_bytes() for f in code.rglob("*.*")}
    with zipfile.ZipFile(wheel, "w") as file:
        file.writestr("shaketable/__init__.py", "")
    assert "no machine code in it" in take(wheel, tmp_path / "none")
    assert not (tmp_path / "none").exists()
