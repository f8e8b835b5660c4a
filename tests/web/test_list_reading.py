"""A list on the page: what is read once is the same when the page sends it back."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook

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
    writer = csv.writer(text, quoting=csv.QUOTE_ALL)
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
    """Ells are no metres, once somebody says which column it is."""
    text = "name,T (Elle),H (Elle)\nshelf,1,4\n"
    said = '[columns]\n"T (Elle)" = "depth"\n"H (Elle)" = "height"\n'
    found = understand("mine.csv", text.encode(), columns=said)
    assert "'elle' is no unit that is known for 'depth'" in found.faults[0]
    fine = said.replace('"depth"', '"depth_ft"').replace('"height"', '"height_ft"')
    assert understand("mine.csv", text.encode(), columns=fine).faults == []
    raw = understand("mine.csv", text.encode())
    assert [each.unit for each in raw.columns] == ["", "elle", "elle"]


FORTY = Path(__file__).parents[1] / "inventory" / "forty"


@pytest.mark.parametrize("name", sorted(json.loads((FORTY / "right.json").read_text("utf-8"))))
def test_lists_of_all_kinds_survive_the_page(name: str, tmp_path: Path) -> None:
    """What is read of the file is read of what the page makes of it."""
    data = (FORTY / name).read_bytes()
    found = understand(name, data)
    if found.faults:
        pytest.skip("it asks for a unit first")
    items = read_inventory(FORTY / name)
    again = back(found, tmp_path)
    assert [(one.name, one.location) for one in again] == [(o.name, o.location) for o in items]
    for one, other in zip(again, items, strict=True):
        assert (one.height, one.mass, one.quantity) == (other.height, other.mass, other.quantity)
        assert (one.body.base, one.shape) == (other.body.base, other.shape)
    rows = ",".join(map(str, found.numbers))
    told = understand(name, sent(found), columns=said_of(found.columns), rows=rows)
    assert (told.objects, told.numbers) == (found.objects, found.numbers)
    assert told.faults == []


def test_messages_name_the_rows_of_the_users_own_file(tmp_path: Path) -> None:
    rows: list[list[object]] = [
        ["Ward 3"], [], ["name", "depth (cm)", "height (cm)"],
        ["a", 30, 180], [], ["b", 40, "1.8."],
    ]  # fmt: skip
    first = understand("ward.xlsx", book(tmp_path, rows))
    assert "ward.xlsx, cell C6" in first.faults[0]
    columns = said_of(first.columns)
    again = understand("ward.xlsx", sent(first), columns=columns, rows="4,6")
    assert "ward.xlsx, row 6, height (cm): expected a positive number" in again.faults[0]


def test_the_unit_of_a_number_format_is_sent(tmp_path: Path) -> None:
    raw = book(tmp_path, [["name", "depth", "height"], ["a", 1.5, 4.5]])
    path = tmp_path / "shown.xlsx"
    path.write_bytes(raw)
    made = load_workbook(path)
    for cell in made.worksheets[0][2][1:]:
        cell.number_format = '0.0" ft"'
    made.save(path)
    found = understand("shown.xlsx", path.read_bytes())
    assert found.rows == [["a", "1.5 ft", "4.5 ft"]]
    assert back(found, tmp_path)[0].height == pytest.approx(4.5 * 0.3048)


def test_the_long_side_goes_along_the_wall_after_the_page_too(tmp_path: Path) -> None:
    """Whichever of length and width is written first, the shorter one is the base's depth."""
    data = b"Item,Length (cm),Width (cm),Height (cm)\nShelf,90,30,180\nDesk,60,120,75\n"
    again = back(understand("list.csv", data), tmp_path)
    assert [item.body.base for item in again] == pytest.approx([0.3, 0.6])
