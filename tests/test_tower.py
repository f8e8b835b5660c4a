"""Imports go down the tower, never up."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.imports import FILES, MODULES, PACKAGE, modules, names

#: Rooms by storey, lowest first; rooms of one storey may use each other.
TOWER = [
    {"errors", "language"},
    {"footprint", "inputs", "extras", "atomic_files", "toml_file"},
    {"units", "progress", "compiled", "tables"},
    {"oscillators", "physics"},
    {"engine"},
    {"origin", "outcome", "drawing"},
    {
        "body",
        "inertia",
        "solid",
        "rims",
        "support",
        "motion",
        "lazy_motions",
        "motion_file",
        "surroundings",
        "spelled_surroundings",
    },
    {"models", "resampling"},
    {"response", "solid_response", "demand"},
    {"simulate"},
    {"records", "signal", "synthesis"},
    {"compile_ahead", "criteria"},
    {"building", "calibration", "fragility", "hazard", "inventory", "risk", "tilting"},
    {"assess", "library", "modes", "study"},
    {"rooms"},
    {"campaign"},
    {"report", "plot", "web"},
    {"cli", "__main__"},
]
STOREY = {room: level for level, rooms in enumerate(TOWER) for room in rooms}


def imports(path: Path) -> set[str]:
    """Rooms of the package that a file imports."""
    return {name.split(".")[1] for name in names(path)} & STOREY.keys()


def room_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def test_imports_go_down() -> None:
    assert {room_of(path) for path in FILES} - STOREY.keys() == set()  # each has its place
    upward = [
        f"{path.relative_to(PACKAGE)} imports {used}, which stands above it"
        for path in FILES
        for used in sorted(imports(path))
        if STOREY[used] > STOREY[room_of(path)]
    ]
    assert upward == []


def test_there_is_no_circle() -> None:
    """No file is reached again by following what it imports."""
    used = {name: modules(path) for name, path in MODULES.items()}
    done: set[str] = set()

    def walk(name: str, way: list[str]) -> None:
        assert name not in way, " -> ".join([*way[way.index(name) :], name])
        if name not in done:
            for other in sorted(used[name]):
                walk(other, [*way, name])
            done.add(name)

    for name in sorted(used):
        walk(name, [])


def test_studies_stand_on_the_package_and_not_in_it() -> None:
    users = {
        room_of(path) for path in FILES if "shaketable_studies" in path.read_text(encoding="utf-8")
    }
    assert users == {"extras"}  # which tells how to install them


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


def test_the_files_to_which_one_adds_are_there() -> None:
    contributing = PACKAGE.parents[1] / "CONTRIBUTING.md"
    if not contributing.exists():
        pytest.skip(f"the package is not in its source tree: no {contributing}")
    named = set(re.findall(r"`(\w+/[\w/]+\.\w+)`", contributing.read_text(encoding="utf-8")))
    named.remove("criteria/author_year.py")  # stands for any
    assert len(named) > 20
    root = PACKAGE.parents[1]
    assert [n for n in sorted(named) if not ((PACKAGE / n).exists() or (root / n).exists())] == []
