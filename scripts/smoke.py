"""What an installation must do, with no tools but its own: python scripts/smoke.py [EXTRA ...]

It is run by the interpreter of the environment that is tried. Extras that are named must be there.
For every other one whose packages are missing, a command has to say how it is installed, and end
with exit code 2. Exit code 1 names the first thing that fails.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

SHAKETABLE = (sys.executable, "-m", "shaketable")
LIST = "name,depth_m,width_m,height_m\nbookcase,0.32,0.8,1.8\n"
CAMPAIGN = """
[bodies.grid]
base_m = [0.3]
height_m = [1.5]
[motions]
of = ["near-field-pulse"]
"""
ROOM = """
outline_m = [[0, 0], [4, 0], [4, 3], [0, 3]]
[[door]]
at_m = [2, 0]
"""
ASSESS = "assess list.csv --planar --motions near-field-pulse"
#: A short command that needs each extra.
NEEDS = {
    "web": "serve --port 0",
    "campaign": "campaign run campaign.toml --store store",
    "scenario": "scenario list.csv --magnitude 7 --distance-km 20 --out quake",
    "rooms": "room check room.toml",
    "studies": "study boroschek-romo-2004 --out study",
    "docx": f"{ASSESS} --docx --out docx",
}
#: What is done where an extra is there; the server of `web` never ends, and is only imported.
WORKS = {
    "parquet": f"{ASSESS} --out parquet",
    "campaign": NEEDS["campaign"],
    "cluster": "campaign run campaign.toml --workers 1 --store shared",
    "scenario": NEEDS["scenario"] + " --number 8",
    "rooms": NEEDS["rooms"],
    "studies": "study --help",
    "docx": NEEDS["docx"],
    "gltf": "simulate --depth-m 0.3 --width-m 0.4 --height-m 1.5 --animate box.glb",
    "web": "",
}
PYTHON = """
import numpy as np
from shaketable import Body, General, Motion, Solid, simulate
push = Motion(4.0 * np.sin(2 * np.pi * np.arange(0.0, 1.0, 0.01)), 0.01)
for body in (Body.rectangle(0.32, 1.8), Solid.box(0.32, 0.8, 1.8)):
    model = General(static_friction=0.5) if isinstance(body, Solid) else None
    assert simulate(body, push, model=model).outcome.name == "UPHILL", body
"""


def run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """A command in a folder."""
    return subprocess.run([*SHAKETABLE, *words], cwd=folder, capture_output=True, text=True)


def require(condition: bool, what: str, said: subprocess.CompletedProcess[str]) -> None:
    """Stop unless a condition holds."""
    if not condition:
        sys.exit(f"{what}: exit {said.returncode}\n{said.stdout[-2000:]}\n{said.stderr[-2000:]}")


def main() -> None:
    """Try the installation of this interpreter."""
    from importlib.metadata import version

    from shaketable.extras import missing, remedy

    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for name, text in (("list.csv", LIST), ("campaign.toml", CAMPAIGN), ("room.toml", ROOM)):
            (folder / name).write_text(text, encoding="utf-8")
        said = run(folder, "--version")
        require(said.stdout.strip() == f"shaketable {version('shaketable')}", "--version", said)
        code = subprocess.run(
            [sys.executable, "-c", PYTHON], cwd=folder, capture_output=True, text=True
        )
        require(code.returncode == 0, "two simulations in Python", code)
        words = [
            "assess",
            "list.csv",
            "--planar",
            "--motions",
            "near-field-pulse",
            "--out",
            "result",
        ]
        said = run(folder, *words)
        require(said.returncode == 0, " ".join(words), said)
        require((folder / "result" / "report.html").stat().st_size > 10_000, "the report", said)
        for extra in sys.argv[1:]:
            if missing(extra):
                sys.exit(f"the extra {extra} was asked for, and {missing(extra)} is not there")
            if WORKS[extra]:
                said = run(folder, *WORKS[extra].split())
                require(said.returncode == 0, f"with {extra}: {WORKS[extra]}", said)
            else:
                from shaketable.web import app  # noqa: F401  all that the server imports
        absent = [extra for extra in NEEDS if missing(extra)]
        for extra in absent:
            said = run(folder, *NEEDS[extra].split())
            told = " ".join((said.stdout + said.stderr).split())
            require(said.returncode == 2 and remedy(extra) in told, f"without {extra}", said)
    python = ".".join(map(str, sys.version_info[:3]))
    print(f"Python {python}: works; extras that are missing and say so: {', '.join(absent)}")


if __name__ == "__main__":
    main()
