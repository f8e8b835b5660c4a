"""Links of the documentation lead somewhere, and its pages are all to be found."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?\)")
#: Pages of the site that docs/generated.py and the gallery make: they are not in the repository.
MADE = tuple(
    DOCS / place
    for place in ("reference/commands", "reference/api", "gallery_of_examples", "_build")
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
