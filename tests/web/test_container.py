"""The steps of the Containerfile, in a fresh folder and environment: no engine is needed."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
OF_THE_SYSTEM = ("useradd", "chown")  # there is one user here
WAITS = 120.0  # s until the page answers


def steps() -> list[tuple[str, str]]:
    """Instructions of the Containerfile, and what each says."""
    lines = (ROOT / "Containerfile").read_text().splitlines()
    told = [line.partition(" ") for line in lines if line and not line.startswith("#")]
    return [(word, rest) for word, _, rest in told]


def test_everything_is_pinned_and_nothing_runs_as_root() -> None:
    found = steps()
    words = [word for word, _ in found]
    assert found[0][0] == "FROM"
    assert found[0][1].count(".") >= 3  # a whole version
    assert any("--require-hashes -r requirements.lock" in rest for _, rest in found)
    assert words.index("USER") < words.index("CMD")
    assert "HEALTHCHECK" in words


@pytest.mark.slow
def test_its_steps_make_a_page_that_answers(tmp_path: Path) -> None:
    app = tmp_path / "app"
    app.mkdir()
    environment = {"HOME": str(tmp_path), "PATH": os.environ["PATH"]}
    python = Path(sys.executable).resolve().parent
    environment["PATH"] = f"{python}:{environment['PATH']}"
    health = command = ""
    for word, rest in steps():
        rest = rest.replace("/app", str(app)).replace("'/tmp'", f"'{tmp_path}'")
        if word == "COPY":
            *sources, target = rest.split()
            for source in sources:
                place = app / target if target != "./" else app / source
                copy = shutil.copytree if (ROOT / source).is_dir() else shutil.copy
                copy(ROOT / source, place)
        elif word == "ENV":
            for each in shlex.split(rest):
                name, _, value = each.partition("=")
                environment[name] = value.replace("$PATH", environment["PATH"])
        elif word == "RUN":
            kept = [each for each in rest.split(" && ") if not each.startswith(OF_THE_SYSTEM)]
            if kept:
                subprocess.run(" && ".join(kept), shell=True, cwd=app, env=environment, check=True)
        elif word == "HEALTHCHECK":
            health = rest.partition("CMD ")[2]
        elif word == "CMD":
            command = rest
    shown = [each.replace("8000", "8765") for each in json.loads(command)]
    program = shutil.which(shown[0], path=environment["PATH"])
    assert program is not None
    assert Path(program).is_relative_to(app)
    server = subprocess.Popen([program, *shown[1:]], cwd=app, env=environment)
    try:
        begun = time.monotonic()
        while True:
            asked = subprocess.run(
                health.replace("8000", "8765"), shell=True, cwd=app, env=environment,
                capture_output=True, check=False,
            )  # fmt: skip
            if asked.returncode == 0:
                break
            assert time.monotonic() - begun < WAITS
            time.sleep(1.0)
        assert list((app / "cache").rglob("*.nbc"))  # compiled before it starts
    finally:
        server.terminate()
        server.wait(timeout=30)
