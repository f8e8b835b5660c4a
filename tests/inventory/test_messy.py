"""Twenty lists as people keep them: read at the first reading, or at the second with an answer."""

from __future__ import annotations

import io
import logging
import re
from pathlib import Path

import pytest
from rich.console import Console

from shaketable import InputError
from shaketable.inventory import Item, read_inventory, read_with_columns
from shaketable.report.terminal import print_columns
from tests.inventory.messy import MESSY, Messy


def sizes(item: Item) -> tuple[object, ...]:
    depth = item.body.base if item.depth_known else None
    width = item.sideways.base if item.sideways else None
    return item.name, depth, width, item.height, item.mass


@pytest.mark.parametrize("messy", MESSY, ids=lambda one: one.name)
def test_a_messy_list_is_read(
    messy: Messy, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = messy.write(tmp_path)
    if messy.asked:
        with pytest.raises(InputError) as refused:
            read_inventory(path)
        assert messy.asked in str(refused.value)
        if not (messy.answers or messy.sheet):
            return  # a row to be filled in
        if messy.answers:
            (tmp_path / f"{messy.name}.columns.toml").write_text(messy.answers, encoding="utf-8")
    with caplog.at_level(logging.WARNING):
        items = read_inventory(path, sheet=messy.sheet)
    assert len(items) == messy.objects
    assert sizes(items[0]) == (messy.first[0], *(pytest.approx(each) for each in messy.first[1:]))
    for words in messy.told:
        assert words in caplog.text


def test_there_are_twenty_in_five_languages() -> None:
    assert len({messy.name for messy in MESSY}) >= 20
    at_once = [messy for messy in MESSY if not messy.asked]
    answered = [messy for messy in MESSY if messy.asked and (messy.answers or messy.sheet)]
    assert (len(at_once), len(answered), len(MESSY)) == (
        18,
        2,
        20,
    )  # as docs/how_to/assessing.md tells


def test_a_file_beside_the_list_says_what_columns_mean(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """What it says is used in place of what the headings say, and is told."""
    path = tmp_path / "list.csv"
    path.write_text("name;Ding;Tiefe [cm];H;Rollen?;height\na;b;30;180;gewiss;1.9\n")
    told = tmp_path / "other.toml"
    told.write_text('[columns]\nDing = "name"\nH = "height_cm"\n"Rollen?" = ""\n', encoding="utf-8")
    (before,) = read_inventory_or_none(path)
    assert before is None  # two heights
    (item,) = read_inventory(path, columns=told)
    assert (item.name, item.body.base, item.height) == ("b", 0.3, 1.8)
    assert item.unread == ()  # the column of castors is left out on purpose
    told.rename(tmp_path / "list.csv.columns.toml")
    caplog.clear()
    (again,) = read_inventory(path)
    assert again == item
    assert "columns are read as list.csv.columns.toml says" in caplog.text


def read_inventory_or_none(path: Path) -> list[Item | None]:
    try:
        return [*read_inventory(path)]
    except InputError:
        return [None]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[columns]\nH = "tallness"\n', "H: expected the name of a column, .* found 'tallness'"),
        ("[columns]\nH = 3\n", "H: expected the name of a column, .* found '3'"),
        ('H = "height"\n', r"columns: a table is expected, \[columns\]"),
        ("", "columns: a table is expected"),
        ("sheet = 3\n", "columns: a table is expected"),
        ('sheet = "A"\n', "is a text, which has no sheet 'A'"),
        ("[columns\n", "columns.toml"),
    ],
)
def test_a_mapping_that_cannot_be_read_is_refused(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "list.csv").write_text("name,depth_m,H\na,0.3,1.8\n")
    (tmp_path / "columns.toml").write_text(text)
    with pytest.raises(InputError, match=said):
        read_inventory(tmp_path / "list.csv", columns=tmp_path / "columns.toml")


def test_what_columns_were_taken_for_is_shown_with_cells(tmp_path: Path) -> None:
    """Three of each, shortened, so that a wrong one is seen at once."""
    path = tmp_path / "list.csv"
    rows = "".join(f"shelf {k},0.3{k},1.8,a very long remark\n" for k in range(5))
    path.write_text(f"name,depth_m,height_m,Acme\n{rows}")
    shown = io.StringIO()
    print_columns(path, read_with_columns(path), Console(file=shown, width=80))
    lines = {line.split()[0]: line for line in shown.getvalue().splitlines()}
    told = re.split(r"\s{2,}", lines["depth_m"].strip())
    assert told[-1].endswith("0.30 · 0.31 · 0.32")
    assert "not used" in lines["Acme"]
    assert "a very long …" in lines["Acme"]
