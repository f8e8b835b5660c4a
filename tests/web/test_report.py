"""The report as people see it, in headless Chromium: on a phone, on paper, by a screen reader."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from shaketable import Body
from shaketable.assess import Assessment, assess
from shaketable.inventory import BaseShape, Castors, Item
from shaketable.language import LANGUAGES, Language
from shaketable.records import suite
from shaketable.report.figures import COLORS
from shaketable.report.page import render
from tests.support.builders import RUN
from tests.web.test_page import AXE

pytestmark = pytest.mark.web

PHONE = {"width": 400, "height": 800}
KINDS = 60
#: As long as what stands under the title of a report by default.
MOTIONS = "48 motions with both horizontal components (fema-p695-both-directions)"


def item(k: int) -> Item:
    depth, width = 0.2 + 0.005 * k, 0.6 + 0.005 * k
    name = f"Thing number {k}"
    front, side = (Body.rectangle(base, 1.2 + 0.01 * k, name=name) for base in (depth, width))
    if k % 12 == 0:
        side = front
    return Item(
        body=front, sideways=side, height=1.2 + 0.01 * k, mass=50.0 + k, quantity=1 + k % 4,
        location=f"room {k % 9}", people_nearby=k % 4 == 0,
        shape=BaseShape.CYLINDER if k % 12 == 0 else BaseShape.BOX,
        castors=Castors.LOCKED if k % 15 == 7 else Castors.NONE,
    )  # fmt: skip


@pytest.fixture(scope="module")
def result() -> Assessment:
    """Sixty kinds under so few recordings as decide something."""
    pairs = [m for m in suite("fema-p695", pairs=True)[:11] if m.transverse is not None]
    return assess([item(k) for k in range(KINDS)], pairs, progress=False)


@pytest.fixture
def shown(browser: Any, result: Assessment, tmp_path: Path) -> Any:
    """A function that opens the report at a size."""
    contexts = []

    def show(size: dict[str, int], language: Language = "en") -> Any:
        path = tmp_path / f"report.{language}.html"
        run = RUN | {"motions": {"description": MOTIONS, "sources": []}}
        path.write_text(render(result, run, language=language), encoding="utf-8")
        context = browser.new_context(viewport=size)
        contexts.append(context)
        page = context.new_page()
        page.goto(path.as_uri())
        return page

    yield show
    for context in contexts:
        context.close()


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_first_screen_of_a_phone_has_the_first_three_measures(
    shown: Any, language: Language
) -> None:
    page = shown(PHONE, language)
    rows = page.locator(".first li .do b")
    for k in range(3):
        box = rows.nth(k).bounding_box()
        assert box["y"] + box["height"] <= PHONE["height"], (language, k, box)
    # and nothing is wider than the phone
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def test_no_serious_fault_for_a_screen_reader(shown: Any) -> None:
    for size in (PHONE, {"width": 1100, "height": 900}):
        page = shown(size)
        page.evaluate("document.querySelectorAll('details').forEach(each => each.open = true)")
        page.evaluate(AXE.read_text("utf-8"))
        found = page.evaluate("async () => await axe.run()")
        serious = [
            (each["id"], each["nodes"][0]["html"][:120])
            for each in found["violations"]
            if each["impact"] in ("serious", "critical")
        ]
        assert serious == []


def test_sixty_kinds_are_two_pages_and_eight(shown: Any) -> None:
    page = shown({"width": 1100, "height": 900})
    content = page.pdf(prefer_css_page_size=True, print_background=True)
    pages = len(re.findall(rb"/Type\s*/Page[^s]", content))
    assert 3 <= pages <= 10
    page.evaluate("document.querySelector('.annex').remove()")
    content = page.pdf(prefer_css_page_size=True, print_background=True)
    assert len(re.findall(rb"/Type\s*/Page[^s]", content)) <= 2


def test_every_kind_stands_once_in_the_annex(shown: Any) -> None:
    page = shown({"width": 1100, "height": 900})
    names = page.locator(".card h4").all_text_contents()
    assert sorted(names) == sorted(f"Thing number {k}" for k in range(KINDS))
    # folded until somebody asks for it
    assert not page.locator(".card").first.is_visible()


def luminance(color: str) -> float:
    """Relative luminance by WCAG 2.1."""
    parts = [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_classes_are_told_apart_in_grey() -> None:
    """The worse the darker; and every row names its class in words."""
    shades = [luminance(COLORS[name]) for name in list(COLORS)[:5]]
    for lighter, darker in pairwise(shades):
        assert (lighter + 0.05) / (darker + 0.05) > 1.1
