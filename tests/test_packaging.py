"""What is published says the same everywhere: version, dependencies, licences."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from scripts.build_paper import WORDS, words

from shaketable.cli.lazy import SUMMARIES

ROOT = Path(__file__).resolve().parents[1]
OTHER_NAMES = {"matplotlib": "matplotlib-base"}  # of conda's packages


def project(place: str = ".") -> dict[str, object]:
    return tomllib.loads((ROOT / place / "pyproject.toml").read_text("utf-8"))["project"]


def test_one_version_everywhere() -> None:
    version = project()["version"]
    assert project("studies")["version"] == version
    for name, pattern in (
        ("CITATION.cff", r"^version: (\S+)$"),
        ("packaging/conda/meta.yaml", r'set version = "([^"]+)"'),
        ("CHANGELOG.md", r"^## (\d\S*)"),
        ("docs/project/citing.md", r"version (\d+\.\d+\.\d+)"),
    ):
        found = re.search(pattern, (ROOT / name).read_text("utf-8"), re.MULTILINE)
        assert found is not None, name
        assert found[1] == version, name


def test_the_conda_recipe_has_the_dependencies_of_the_project() -> None:
    recipe = (ROOT / "packaging" / "conda" / "meta.yaml").read_text("utf-8")
    listed = recipe.split("  run:\n")[1].split("\n\n")[0]
    told = {line.strip("- ").replace(" ", "") for line in listed.splitlines()}
    wanted = {f"python{project()['requires-python']}"}
    for one in project()["dependencies"]:  # type: ignore[attr-defined]
        name, rest = re.match(r"([\w-]+)(.*)", one).groups()  # type: ignore[union-attr]
        wanted.add(OTHER_NAMES.get(name, name) + rest)
    assert told == wanted
    licence = str(project()["license"])
    assert f"  license: {licence}\n" in recipe
    cited = (ROOT / "CITATION.cff").read_text("utf-8")
    assert f"license: [{licence.replace(' AND ', ', ')}]\n" in cited


def test_the_paper_is_as_long_as_its_journal_takes() -> None:
    assert WORDS[0] <= words() <= WORDS[1]
    cited = set(re.findall(r"@(\w+:\d+)", (ROOT / "paper" / "paper.md").read_text("utf-8")))
    known = set(
        re.findall(
            r"^@\w+\{([^,]+),", (ROOT / "paper" / "paper.bib").read_text("utf-8"), re.MULTILINE
        )
    )
    assert cited == known


def test_the_readme_fits_on_a_page() -> None:
    assert len((ROOT / "README.md").read_text("utf-8").splitlines()) <= 80


@pytest.mark.parametrize("name", SUMMARIES)
def test_every_command_has_a_task(name: str) -> None:
    """A reader of docs/reference/commands.md meets each command; `open` needs no name."""
    page = (ROOT / "docs" / "reference" / "commands.md").read_text("utf-8")
    words = "" if name == "open" else f" {name}\\b"
    assert re.search(rf"^    shaketable{words or '$'}", page, re.MULTILINE)
