"""Build an application for this platform: a folder that needs no Python and compiles nothing.

    python -m scripts.build_app [FOLDER]     # to FOLDER/shaketable, dist by default

A wheel with machine code (scripts/compile_wheel.py) is installed in an environment of its own, of
which PyInstaller makes the folder. It is started once, in an empty folder and without a Python on
its path, for a list and for its page. Where no machine code is shipped (other than Linux on x86-64)
kernels are compiled when the application runs first, for some minutes.
"""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
import venv
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
EXTRAS = "web,docx"
PATIENCE = 300.0  # s; where nothing is compiled yet the page compiles first
WINDOWS = sys.platform == "win32"
LIST = "name,depth_m,width_m,height_m\nshelf,0.32,0.9,1.8\n"


def main() -> None:
    out = Path(sys.argv[1] if len(sys.argv) > 1 else "dist").resolve()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        _wheel_into(work)
        (wheel,) = work.glob("*.whl")
        python = _environment(work, wheel)
        spec = ROOT / "packaging" / "shaketable.spec"
        places = ["--distpath", str(out), "--workpath", str(work / "pyinstaller")]
        _run([python, "-m", "PyInstaller", "--noconfirm", "--log-level=WARN", *places, str(spec)])
    made = out / "shaketable"
    start(made)
    files = (each for each in made.rglob("*") if each.is_file() and not each.is_symlink())
    size = sum(each.stat().st_size for each in files)
    print(f"{made}: {size / 1e6:.0f} MB; begin it by {made / _name()}")


def _wheel_into(work: Path) -> None:
    shipped = sys.platform == "linux" and platform.machine() == "x86_64"
    building = ["scripts.compile_wheel"] if shipped else ["hatchling", "build", "-t", "wheel", "-d"]
    _run([sys.executable, "-m", *building, str(work)])


def _environment(work: Path, wheel: Path) -> str:
    """An environment with the wheel and PyInstaller; its Python."""
    place = work / "environment"
    venv.create(place, with_pip=True)
    python = str(place / ("Scripts/python.exe" if WINDOWS else "bin/python"))
    lock = (ROOT / "requirements.lock").read_text()
    pinned = re.findall(r"^[\w.-]+==[^\\\n]+", lock, re.MULTILINE)  # without hashes
    (work / "constraints.txt").write_text("\n".join(pinned))
    wanted = [f"shaketable[{EXTRAS}] @ {wheel.as_uri()}", "pyinstaller>=6.10"]
    given = ["--quiet", "--constraint", str(work / "constraints.txt")]
    _run([python, "-m", "pip", "install", *given, *wanted])
    return python


def start(made: Path) -> None:
    """Assess a list by the application, and ask its page, where nothing else is.

    Raises:
        SystemExit: it fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        there = Path(folder, "application")
        shutil.copytree(made, there, symlinks=True)
        mine = Path(folder, "mine.csv")
        mine.write_text(LIST)
        # Windows needs some of its own
        kept = {name: os.environ[name] for name in ("SYSTEMROOT", "TEMP") if name in os.environ}
        given: dict[str, Any] = {
            "cwd": folder, "text": True, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
            "env": {**kept, "HOME": folder, "PATH": "", "NUMBA_CACHE_DIR": str(Path(folder, "c"))},
        }  # fmt: skip
        program = str(there / _name())
        began = time.monotonic()
        run = subprocess.run([program, "assess", str(mine), "--out", "found"], **given)
        if run.returncode or not Path(folder, "found", "report.html").exists():
            sys.exit(f"the application does not run:\n{run.stdout}\n{run.stderr}")
        print(f"assesses a list, {time.monotonic() - began:.0f} s after it is started")
        if "compiling" in run.stderr:
            print("it compiled kernels when it ran first")
        began = time.monotonic()
        with subprocess.Popen([program, "serve", "--port", "0"], **given) as page:
            try:
                address = page.stdout.readline().split()[0]
                falls = _asked(f"{address}api/many", {"thing": {"base_m": 0.32, "height_m": 1.8}})
            finally:
                page.terminate()
        told = f"{falls['falls']} of {falls['simulations']} shakings overturn a bookcase"
        print(f"{told}, its page says {time.monotonic() - began:.0f} s after it is started")


def _asked(address: str, question: object) -> Any:
    """The page's answer, once it answers."""
    asked = urllib.request.Request(  # our own
        address, json.dumps(question).encode(), {"Content-Type": "application/json"}
    )
    end = time.monotonic() + PATIENCE
    while True:
        try:
            with urllib.request.urlopen(asked, timeout=PATIENCE) as answer:
                return json.load(answer)
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.2)


def _name() -> str:
    return "shaketable.exe" if WINDOWS else "shaketable"


def _run(words: list[str]) -> None:
    subprocess.run(words, check=True, cwd=ROOT)


if __name__ == "__main__":
    main()
