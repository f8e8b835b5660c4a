"""What the code cites stands in docs/explanation/theory.md."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
THEORY = ROOT / "docs" / "explanation" / "theory.md"
FOLDERS = ("src", "tests", "benchmarks", "docs")
SOURCES = sorted(
    path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py") if path != Path(__file__)
)
CITED = re.compile(r"theory,\s+(?:#\s+)?sections?\s+(\d+)(?:\s+(?:to|and)\s+(\d+))?")
EQUATION = re.compile(r"\beqs?\.\s+\d")
AUTHOR_AND_YEAR = re.compile(r"[A-Z]\w+[^\n]{0,60}\b(?:19|20)\d\d\b|\b(?:19|20)\d\d\b")

pytestmark = pytest.mark.skipif(
    not THEORY.exists(), reason=f"the source tree is not here: {THEORY}"
)


def sections() -> set[int]:
    found = re.findall(r"^## (\d+)\. ", THEORY.read_text(encoding="utf-8"), re.MULTILINE)
    return {int(number) for number in found}


def cited(text: str) -> set[int]:
    numbers: set[int] = set()
    for first, last in CITED.findall(text):
        numbers |= {int(first), int(last or first)}
    return numbers


def test_every_section_that_is_cited_exists() -> None:
    everywhere: set[int] = set()
    for path in SOURCES:
        numbers = cited(path.read_text(encoding="utf-8"))
        assert numbers <= sections(), f"{path}: cites {numbers - sections()}"
        everywhere |= numbers
    assert len(everywhere) >= 6  # the pattern still finds what is cited
    assert cited("(theory, section 99)") == {99}


def test_who_cites_an_equation_names_the_paper() -> None:
    source = [path for path in SOURCES if path.is_relative_to(ROOT / "src")]
    citing = [path for path in source if EQUATION.search(path.read_text(encoding="utf-8"))]
    assert len(citing) > 10
    for path in citing:  # in a file or folder author_year its name says whose equation it is
        assert re.search(r"[a-z]_(19|20)\d\d", str(path)) or AUTHOR_AND_YEAR.search(
            path.read_text(encoding="utf-8")
        ), path


def test_nothing_cites_a_document_that_users_do_not_have() -> None:
    for path in [*SOURCES, *ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]:
        text = path.read_text(encoding="utf-8")
        for named in re.findall(r"[\w./-]+\.md\b", text):
            name = Path(named).name
            known = (ROOT / name, ROOT / "paper" / name, path.parent / named, ROOT / named)
            in_docs = any((ROOT / "docs").rglob(name))
            assert in_docs or any(each.exists() for each in known), f"{path}: names {named}"
        assert not re.search(r"\b[Pp]aper [ABC]\b|\b[ABC] eqs?\.", text), path


def test_every_picture_of_the_page_is_there() -> None:
    pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", THEORY.read_text(encoding="utf-8"))
    assert pictures
    assert all((THEORY.parent / picture).exists() for picture in pictures)
