"""What is published says the same everywhere: version, dependencies, licences."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from scripts import install
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


def pins(lock: str) -> dict[str, set[str]]:
    """Of each package its versions, of which one or another is for some Pythons."""
    text = (ROOT / lock).read_text(encoding="utf-8")
    found: dict[str, set[str]] = {}
    for name, version in re.findall(r"^([\w.-]+)==([^ ]+)", text, re.MULTILINE):
        found.setdefault(name, set()).add(version)
    return found


def test_the_locks_agree() -> None:
    """One environment: what the main job needs, and beside it tools of tests and of the site."""
    main = pins("requirements.lock")
    assert set(main) >= {"numba", "pyarrow", "fastapi", "uv", "hatchling"}
    assert not {"pytest", "mypy", "hypothesis", "obspy"} & set(main)
    for other in ("requirements-test.lock", "requirements-bench.lock", "requirements-docs.lock"):
        both = set(main) & set(pins(other))
        assert len(both) > 15, other
        assert {name: main[name] for name in both} == {name: pins(other)[name] for name in both}


@pytest.mark.parametrize(("there", "fails", "by"), [
    (True, False, ["uv"]), (True, True, ["uv", "pip", "compileall"]),
    (False, False, ["pip", "pip", "compileall"]),
])  # fmt: skip
def test_packages_come_by_uv_or_else_by_pip(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], there: bool, fails: bool,
    by: list[str],
) -> None:  # fmt: skip
    """The first pip of the last fetches the pinned uv, which here it cannot."""
    called: list[str] = []

    def run(words: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        of_python = words[:2] == [sys.executable, "-m"]
        called.append(words[2] if of_python else Path(words[0]).name)
        assert "--require-hashes" in words or called[-1] == "compileall"
        return subprocess.CompletedProcess(words, int(fails and called[-1] == "uv"))

    monkeypatch.setattr(subprocess, "run", run)
    monkeypatch.setattr(shutil, "which", lambda name, path=None: "/bin/uv" if there else None)
    monkeypatch.setattr(sys, "argv", ["install.py", str(ROOT / "requirements.lock")])
    install.main()
    assert called == by
    said = capsys.readouterr().out
    assert f"{len(pins('requirements.lock'))} packages" in said
    assert f"installed by {'pip' if 'pip' in by else 'uv'} in 0 s" in said
