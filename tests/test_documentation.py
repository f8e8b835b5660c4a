"""The documentation: links lead somewhere; every public name and command has a page."""

from __future__ import annotations

import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import typer

import shaketable
from shaketable.cli import app
from shaketable.cli.lazy import SUMMARIES

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?\)")
#: Pages of the site that docs/generated.py and the gallery make: they are not in the repository.
MADE = tuple(
    DOCS / place
    for place in (
        "reference/commands",
        "reference/api",
        "gallery_of_examples",
        "library_page",
        "_build",
    )
)
PAGES = sorted(
    page
    for pages in (
        ROOT.glob("*.md"),
        DOCS.rglob("*.md"),
        (ROOT / place / "README.md" for place in ("benchmarks", "studies")),
    )
    for page in pages
    if not any(page.is_relative_to(folder) for folder in MADE)
)
FENCED = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)

pytestmark = pytest.mark.skipif(not DOCS.exists(), reason=f"the source tree is not here: {DOCS}")


def prose(page: Path) -> str:
    return FENCED.sub("", page.read_text(encoding="utf-8"))


def anchors(page: Path) -> set[str]:
    """Those of GitHub and of the site alike."""
    titles = re.findall(r"^#+ (.+)$", prose(page), re.MULTILINE)
    words = [re.sub(r"[^\w\- ]", "", title.lower()).strip() for title in titles]
    return {each.replace(" ", "-") for each in words}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for link in LINK.findall(prose(page)):
        if re.match(r"(https?|mailto):", link):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        if any(target.is_relative_to(folder) for folder in MADE):
            continue  # Sphinx looks after these
        assert target.exists(), f"{page.relative_to(ROOT)}: {link}"
        if anchor:
            assert anchor in anchors(target), f"{page.relative_to(ROOT)}: {link}"


def test_anchors_are_read() -> None:
    assert "8-errata-of-the-print" in anchors(DOCS / "explanation" / "theory.md")
    assert "nothing" not in anchors(DOCS / "explanation" / "theory.md")


def test_every_picture_is_shown() -> None:
    shown = {
        Path(link).name
        for page in PAGES
        for link in re.findall(r"[\w/.-]+\.(?:png|gif|svg)", page.read_text("utf-8"))
    }
    assert {path.name for path in (DOCS / "pictures").iterdir()} <= shown


def generated(part: str, folder: Path) -> Path:
    """Pages that docs/generated.py makes, beside the page that it reads."""
    sys.path.insert(0, str(DOCS))
    try:
        import generated as made
    finally:
        sys.path.remove(str(DOCS))
    (folder / "python.md").write_bytes((DOCS / "reference" / "python.md").read_bytes())
    getattr(made, f"write_{part}")(folder)
    return folder / part


def test_every_public_name_has_a_page(tmp_path: Path) -> None:
    pages = {path.stem for path in generated("api", tmp_path).glob("*.rst")}
    assert {f"shaketable.{name}" for name in shaketable.__all__} <= pages
    assert {"shaketable.rooms.Room", "shaketable.tilting.design_tilt"} <= pages
    page = (tmp_path / "api" / "shaketable.simulate.rst").read_text("utf-8")
    assert ".. autofunction:: simulate" in page
    assert "seealso" in page


@pytest.mark.parametrize("name", shaketable.__all__)
def test_public_names_say_what_they_take(name: str) -> None:
    thing = getattr(shaketable, name)
    told = inspect.getdoc(thing) or ""
    assert told.split("\n")[0].endswith("."), f"{name}: no first sentence"
    if not inspect.isfunction(thing):
        return
    for parameter in inspect.signature(thing).parameters:
        assert re.search(rf"\b{parameter}\b", told), f"{name}: nothing about {parameter}"


def test_every_command_has_a_page_with_its_options(tmp_path: Path) -> None:
    folder = generated("commands", tmp_path)
    program = typer.main.get_command(app)
    for name in SUMMARIES:
        page = (folder / f"{name}.md").read_text("utf-8")
        command = program.commands[name]  # type: ignore[attr-defined]
        below = getattr(command, "commands", {"": command}).values()
        for option in (word for each in below for one in each.params for word in one.opts):
            if option.startswith("--") and option != "--help":
                assert f"`{option}`" in page, f"{name}: {option}"


SCRIPTS = sorted((DOCS / "gallery").glob("*/plot_*.py"))


def test_the_gallery_has_short_scripts_with_a_title() -> None:
    assert len(SCRIPTS) >= 24
    for script in SCRIPTS:
        text = script.read_text("utf-8")
        title, line = text.splitlines()[1:3]
        assert set(line) == {"="}, script
        assert len(line) == len(title), script
        assert len(text.splitlines()) <= 60, script


@pytest.mark.slow
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_scripts_of_the_gallery_run(script: Path, tmp_path: Path) -> None:
    environment = os.environ | {"MPLBACKEND": "agg"}
    command = [sys.executable, str(script)]
    subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True)
