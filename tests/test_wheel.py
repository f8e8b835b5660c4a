"""The wheel: what it holds, and the main job from it, in an environment without any extra."""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest

from shaketable.compiled.caches import fits_here
from shaketable.extras import EXTRAS

ROOT = Path(__file__).parents[1]
MOST_MEGABYTES = 720  # of the environment, as docs/how_to/installing.md has it
MOST_PACKAGES = 45


def built(folder: Path, *command: str) -> Path:
    subprocess.run([sys.executable, "-m", *command], cwd=ROOT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def test_from_the_sources_it_is_for_every_platform(tmp_path: Path) -> None:
    wheel = built(tmp_path, "hatchling", "build", "-t", "wheel", "-d", str(tmp_path))
    assert wheel.name.endswith("-py3-none-any.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert not [name for name in names if "machine_code" in name]
    for name in (
        "records/fema_p695/series.npz",
        "records/fema_p695/LICENSE",
        "examples/hospital.csv",
    ):
        assert f"shaketable/{name}" in names


@pytest.mark.slow
@pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64" or not fits_here(),
    reason="machine code is shipped for Linux on x86-64 processors with AVX2",
)
def test_the_main_job_needs_no_extra_and_compiles_nothing(tmp_path: Path) -> None:
    wheel = built(tmp_path, "scripts.compile_wheel", str(tmp_path))
    assert f"-cp3{sys.version_info[1]}-manylinux" in wheel.name
    place, home = tmp_path / "environment", tmp_path / "home"
    subprocess.run([sys.executable, "-m", "venv", place], check=True)
    same = f"numba=={version('numba')}"  # the code is for this one
    subprocess.run([place / "bin/pip", "install", "--quiet", wheel, same], check=True)
    listed = subprocess.check_output([place / "bin/pip", "list", "--format", "json"], text=True)
    packages = {each["name"].lower() for each in json.loads(listed)}
    assert not packages & {name.replace("_", "-") for each in EXTRAS.values() for name in each}
    assert len(packages) <= MOST_PACKAGES
    files = [path for path in place.rglob("*") if path.is_file() and not path.is_symlink()]
    assert sum(path.stat().st_size for path in files) <= MOST_MEGABYTES * 2**20
    home.mkdir()
    clean = {"HOME": str(home), "PATH": os.environ["PATH"]}

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = [str(place / "bin/shaketable"), *words]
        return subprocess.run(
            command, cwd=home, env=clean, check=True, capture_output=True, text=True
        )

    said = run("assess", "--out", "result")
    assert said.stderr.count("pip install 'shaketable[parquet]'") == 1
    assert {path.name for path in (home / "result").iterdir()} == {
        "report.html", "results.csv", "run.json"
    }  # fmt: skip
    assert "compiling" not in said.stdout + said.stderr
    rows = "".join(f"{0.01 * k:.2f},{0.3 * (-1) ** (k // 20):.1f}\n" for k in range(200))
    (home / "record.csv").write_text(f"time_s,acceleration_g\n{rows}")
    shelf = ("--base-m", "0.3", "--height-m", "1.5", "--record", "record.csv")
    for model in (
        [],
        ["--model", "general", "--static-friction", "0.4"],
        ["--depth-m", "0.3", "--components", "1"],
    ):
        assert "1.5 m under record" in run("simulate", *shelf, *model).stdout
    assert not list(home.rglob("*.nbc"))
