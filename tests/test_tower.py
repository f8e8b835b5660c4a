"""Imports go down the tower, never up."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import shaketable

PACKAGE = Path(shaketable.__file__).parent

#: Rooms by storey, lowest first; rooms of one storey may use each other.
TOWER = [
    {"errors"},
    {"units", "progress"},
    {"kernels"},
    {"engine"},
    {"origin"},
    {"body", "support", "motion"},
    {"response", "recordings"},
    {"simulate"},
    {"records", "signal", "synthesis"},
    {"criteria"},
    {"building", "inventory", "risk", "tilting"},
    {"assess", "modes", "studies"},
    {"report", "plot"},
    {"cli"},
]
STOREY = {room: level for level, rooms in enumerate(TOWER) for room in rooms}

#: The one step up: Response.plot and Response.animate, when they are called.
STEPS_UP = {("response", "plot")}


def imports(path: Path) -> set[str]:
    """Rooms of the package that a file imports, inside functions too."""
    rooms = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            parts = name.split(".")
            if parts[0] == "shaketable" and len(parts) > 1 and parts[1] in STOREY:
                rooms.add(parts[1])
    return rooms


def room_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


FILES = sorted(path for path in PACKAGE.rglob("*.py") if path != PACKAGE / "__init__.py")


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_imports_go_down(path: Path) -> None:
    room = room_of(path)
    assert room in STOREY, f"{room} has no place in the tower"
    for used in imports(path) - {room}:
        if (room, used) not in STEPS_UP:
            assert STOREY[used] <= STOREY[room], f"{room} imports {used}, which stands above it"


def test_a_wrong_import_would_be_seen(tmp_path: Path) -> None:
    file = tmp_path / "wrong.py"
    file.write_text("def f():\n    from shaketable.cli import main\n")
    assert imports(file) == {"cli"}


def test_the_tower_in_words_is_this_one() -> None:
    contributing = PACKAGE.parents[1] / "CONTRIBUTING.md"
    if not contributing.exists():
        pytest.skip(f"the package is not in its source tree: no {contributing}")
    text = contributing.read_text(encoding="utf-8").partition("## The tower")[2]
    lines = [line[4:].split("  ")[0] for line in text.splitlines() if line.startswith("    ")]
    assert [set(line.split(", ")) for line in lines] == TOWER
