"""Extras: what each brings, and what is said where one is missing."""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Callable
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest

from shaketable import InputError, extras
from shaketable.cli import main, study
from shaketable.cli.serve import serve
from shaketable.drawing.files import require_scene
from shaketable.extras import EXTRAS, remedy, require
from shaketable.records.seismological import read

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
FOR_DEVELOPERS = {"test", "lint", "bench", "docs"}


#: What is imported by another name than it is installed by.
IMPORTED = {"dask": "distributed", "scikit-learn": "sklearn", "python-docx": "docx"}


def test_extras_are_those_of_the_project() -> None:
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    told = project["optional-dependencies"]
    always = {re.match(r"[\w-]+", one)[0] for one in project["dependencies"]}  # type: ignore[index]
    assert set(EXTRAS) == set(told) - FOR_DEVELOPERS

    def names(extra: str) -> set[str]:
        found: set[str] = set()
        for one in told[extra]:
            name, options = re.match(r"([\w-]+)(?:\[([\w,]+)\])?", one).groups()  # type: ignore[union-attr]
            if name == "shaketable":
                found |= {each for other in options.split(",") for each in names(other)}
            else:
                found.add(IMPORTED.get(name, name))
        return {name.replace("-", "_") for name in found}

    for extra, packages in EXTRAS.items():
        assert set(packages) == names(extra) - always, extra  # gpu narrows NumPy
    assert packages_distributions()["sklearn"] == ["scikit-learn"]


@pytest.mark.parametrize(
    ("extra", "ask"),
    [
        ("web", serve),
        ("gltf", lambda: require_scene(Path("fall.glb"))),
        ("seismology", lambda: read(Path("a.mseed"), b"", None)),
    ],
)
def test_what_misses_an_extra_says_so(
    extra: str, ask: Callable[[], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    for package in EXTRAS[extra]:
        monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(InputError) as told:
        ask()
    assert f"needs the package {EXTRAS[extra][0]}: {remedy(extra)}" in str(told.value)


@pytest.mark.parametrize("extra", EXTRAS)
def test_each_package_of_an_extra_is_asked_for(extra: str, monkeypatch: pytest.MonkeyPatch) -> None:
    there = set(EXTRAS[extra])
    monkeypatch.setattr(extras, "find_spec", lambda name: name if name in there else None)
    require(extra, "this")
    for package in EXTRAS[extra]:
        there.remove(package)
        with pytest.raises(InputError, match=f"this needs the package {package}: pip install"):
            require(extra, "this")
        there.add(package)


def test_where_no_study_is_installed_it_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(study, "installed_studies", dict)
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    asked = ["study", "boroschek-romo-2004", "--motions", "far-field", "--out", str(tmp_path / "o")]
    monkeypatch.setattr(sys, "argv", ["shaketable", *asked])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert "pip install 'shaketable[studies]'" in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "o").exists()
