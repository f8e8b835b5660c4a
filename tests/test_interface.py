"""docs/reference/python.md: the public interface on one page, with an example of each name."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest

import shaketable

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "python.md"


def test_every_public_name_has_its_room_and_an_example() -> None:
    text = PAGE.read_text(encoding="utf-8")
    told = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 3 and "`" in cells[0]:
            names, rooms = (re.findall(r"`([\w.]+)`", cell) for cell in cells[:2])
            told |= dict.fromkeys(names, rooms)
    homes = shaketable._HOMES
    assert told.keys() == set(shaketable.__all__) == homes.keys()
    assert all(homes[name] in rooms for name, rooms in told.items())
    examples = [example.source for example in doctest.DocTestParser().get_examples(text)]
    missing = [
        name
        for name in told
        if not any(re.search(rf"\bst\.{name}\b", source) for source in examples)
    ]
    assert missing == []


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # a bootstrap of few draws
def test_the_examples_give_what_the_page_says() -> None:
    pytest.importorskip("zarr", reason="the extra campaign is not installed")
    pytest.importorskip("shapely", reason="the extra rooms is not installed")
    failed, tried = doctest.testfile(str(PAGE), module_relative=False)
    assert failed == 0
    assert tried > 50
