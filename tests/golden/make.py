"""Golden results: `python -m tests.golden.make FOLDER` writes all of them there.

python -m tests.golden.make --against COMMIT    # made by that commit and by this tree, to the bit
python -m tests.golden.make                     # stored anew, where a change is meant
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from matplotlib.figure import Figure

from tests.golden.commands import CALLS, called
from tests.golden.datasets import CASES, written
from tests.support.command import undrawn
from tests.support.small_files import write_small_files

STORED = Path(__file__).parent / "stored"
ROOT = Path(__file__).resolve().parents[2]


def file_of(name: str) -> str:
    return f"{name.replace(', ', ' ').replace(' ', '-')}.txt"


def results() -> Iterator[tuple[str, str]]:
    """Each golden result's file and content."""
    for name in CASES:
        yield file_of(name), written(name)
    for name in CALLS:
        with tempfile.TemporaryDirectory() as folder:
            write_small_files(Path(folder))
            yield file_of(f"{name} said"), called(name, Path(folder))


def make(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    Figure.savefig = undrawn  # type: ignore[method-assign,assignment]  # text alone is compared
    for name, content in results():
        (folder / name).write_text(content + "\n", encoding="utf-8")


def differing(commit: str) -> list[str]:
    """The golden results that another commit, with its own cases, gives otherwise."""
    with tempfile.TemporaryDirectory() as place:
        tree, one, other = Path(place, "tree"), Path(place, "one"), Path(place, "other")
        subprocess.run(["git", "worktree", "add", "--detach", tree, commit], cwd=ROOT, check=True)
        try:
            for root, found in ((tree, one), (ROOT, other)):
                command = [sys.executable, "-m", "tests.golden.make", str(found)]
                paths = {"PYTHONPATH": f"{root / 'src'}:{root}"}
                subprocess.run(command, cwd=root, env={**os.environ, **paths}, check=True)
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", tree], cwd=ROOT, check=True)
        names = {path.name for folder in (one, other) for path in folder.iterdir()}
        return sorted(name for name in names if _read(one / name) != _read(other / name))


def _read(path: Path) -> str | None:
    return path.read_text("utf-8") if path.exists() else None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=STORED)
    parser.add_argument("--against", metavar="COMMIT")
    given = parser.parse_args()
    if given.against:
        found = differing(given.against)
        print("\n".join(found) or "all are equal")
        sys.exit(bool(found))
    make(given.folder)


if __name__ == "__main__":
    main()
