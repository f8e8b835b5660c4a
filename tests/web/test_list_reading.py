"""A list on the page: what is read once is the same when the page sends it back."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from openpyxl import Workbook

from shaketable.inventory import Item, read_inventory
from shaketable.web.answers import ColumnRead, Understood
from shaketable.web.list_reading import understand


def said_of(columns: list[ColumnRead]) -> str:
    """What the page sends as the meanings of columns, as list_columns.js writes it."""
    lines = []
    for each in columns:
        if each.header and (each.meaning or each.unused):
            unit = f"_{each.unit}" if each.meaning and each.unit else ""
            lines.append(f"{json.dumps(each.header)} = {json.dumps(each.meaning + unit)}")
    return "[columns]\n" + "\n".join(lines)


def sent(found: Understood) -> bytes:
    """The list as the page sends it back, as list.js writes it."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter=found.separator, quoting=csv.QUOTE_ALL)
    writer.writerows([[each.header for each in found.columns], *found.rows])
    return text.getvalue().encode()


def back(found: Understood, folder: Path) -> list[Item]:
    """The objects that the page assesses."""
    (folder / "back.csv").write_bytes(sent(found))
    (folder / "back.csv.columns.toml").write_text(said_of(found.columns), "utf-8")
    return read_inventory(folder / "back.csv")


def book(folder: Path, rows: list[list[object]], *merged: str) -> bytes:
    one = Workbook()
    for row in rows:
        one.worksheets[0].append(row)
    for each in merged:
        one.worksheets[0].merge_cells(each)
    one.save(folder / "mine.xlsx")
    return (folder / "mine.xlsx").read_bytes()


def test_units_headings_and_commas_survive(tmp_path: Path) -> None:
    text = (
        "Labor;;;;\nGegenstand;Tiefe;Breite;Höhe;Typ;Typ;Masse\n;mm;cm;ft;;;lbs\n"
        '"Regal ""A""; links";320,5;90;6;x;y;100\n'
    )
    (tmp_path / "mine.csv").write_text(text, "utf-8")
    (whole,) = read_inventory(tmp_path / "mine.csv")
    found = understand("mine.csv", text.encode())
    assert found.faults == []
    assert [each.header for each in found.columns][4:6] == ["Typ", "Typ 2"]
    (again,) = back(found, tmp_path)
    assert again.body == whole.body
    assert (again.height, again.mass) == (whole.height, whole.mass)
    assert whole.height == pytest.approx(6 * 0.3048)
    assert found.columns[-1].unit == "lb"


def test_a_cell_that_cannot_be_used_stays_one(tmp_path: Path) -> None:
    """A formula without a value is no empty cell once the page has shown it."""
    rows: list[list[object]] = [
        ["name", "depth_m", "width_m", "height_m", "castors"],
        ["cart", 0.5, "=B2", 1.1, '=IF(1,"free","none")'],
    ]
    first = understand("mine.xlsx", book(tmp_path, rows))
    assert len(first.faults) == 2
    again = understand("mine.csv", sent(first), columns=said_of(first.columns))
    assert any("width_m" in fault for fault in again.faults)
    mended = sent(first).replace(b'"=?"', b'"0.5"', 1)
    noted = understand("mine.csv", mended, columns=said_of(first.columns))
    assert "until it is mended the object gets no class" in " ".join(noted.notes)


def test_what_is_merged_is_left_out_on_the_page_too(tmp_path: Path) -> None:
    rows: list[list[object]] = [
        ["name", "depth_m", "width_m", "height_m", "mass_kg", "quantity"],
        ["a", 0.5, 0.5, 1.1, 90, 6], ["b", 0.4, 0.5, 1.2, None, None],
    ]  # fmt: skip
    found = understand("mine.xlsx", book(tmp_path, rows, "E2:E3", "F2:F3"))
    assert [(each.mass, each.quantity) for each in back(found, tmp_path)] == [(None, 1)] * 2


def test_headings_that_are_alike_are_told_apart(tmp_path: Path) -> None:
    text = "name,depth_m,height_m,remarks,remarks,remarks 2\nshelf,0.3,1.8,a,b,c\n"
    found = understand("mine.csv", text.encode())
    names = [each.header for each in found.columns]
    assert names[3:] == ["remarks", "remarks 3", "remarks 2"]
    assert len(back(found, tmp_path)) == 1


def test_a_unit_that_is_not_known_is_asked(tmp_path: Path) -> None:
    """Feet that are called otherwise are no metres, once somebody says which column it is."""
    text = "name,T (Fuß),H (Fuß)\nshelf,1,4\n"
    said = '[columns]\n"T (Fuß)" = "depth"\n"H (Fuß)" = "height"\n'
    found = understand("mine.csv", text.encode(), columns=said)
    assert "'fuß' is no unit that is known for 'depth'" in found.faults[0]
    fine = said.replace('"depth"', '"depth_ft"').replace('"height"', '"height_ft"')
    assert understand("mine.csv", text.encode(), columns=fine).faults == []
    raw = understand("mine.csv", text.encode())
    assert [each.unit for each in raw.columns] == ["", "fuß", "fuß"]
