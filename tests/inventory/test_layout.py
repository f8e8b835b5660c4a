"""Nothing of a list is lost, and no size becomes another one, without a word."""

from __future__ import annotations

from pathlib import Path

import pytest
from openpyxl import Workbook

from shaketable import InputError
from shaketable.inventory import Item, read_inventory


def read(folder: Path, text: str) -> list[Item]:
    path = folder / "list.csv"
    path.write_text(text, encoding="utf-8")
    return read_inventory(path)


def excel(folder: Path, rows: list[list[object]], *merged: str) -> Path:
    book = Workbook()
    for row in rows:
        book.worksheets[0].append(row)
    for each in merged:
        book.worksheets[0].merge_cells(each)
    book.save(folder / "list.xlsx")
    return folder / "list.xlsx"


SIZES = "Name,Depth,Width,Height\nShelf,{}\n"


@pytest.mark.parametrize(
    ("title", "sizes", "height"),
    [
        ("All dimensions in centimetres", "30,80,180", 1.8),
        ("Alle Maße in Zentimeter", "30,80,180", 1.8),
        ("All dimensions in m", "0.3,0.8,1.8", 1.8),
        ("All dimensions in in", "12,32,72", 72 * 0.0254),
        ("Misure antisismiche in corso", "0.3,0.8,1.8", 1.8),
        ("Remeasurements in progress", "0.3,0.8,1.8", 1.8),
        ("寸法はすべてmm", "300,800,1800", None),
        ("寸法単位：mm", "300,800,1800", 1.8),
    ],
)
def test_what_a_title_says_of_units(
    tmp_path: Path, title: str, sizes: str, height: float | None
) -> None:
    text = f"{title}\n{SIZES.format(sizes)}"
    if height is None:
        with pytest.raises(InputError, match="is not to be expected"):
            read(tmp_path, text)
        return
    assert read(tmp_path, text)[0].height == pytest.approx(height)


def test_cells_of_objects_say_no_unit(tmp_path: Path) -> None:
    text = "Name,Depth,Height,Note\nA,0.3,1.8,dimensions in mm: see the drawing\n"
    assert read(tmp_path, text)[0].height == 1.8


def test_uncomputed_rows_are_refused_not_lost(tmp_path: Path) -> None:
    head: list[object] = ["name", "depth_m", "height_m"]
    lost: list[object] = ["=X!A3", "=X!B3", "=X!C3"]
    named: list[object] = ["B", "=B2*1", "=C2*1"]
    for row in (lost, named):
        path = excel(tmp_path, [head, ["A", 0.3, 1.8], row])
        with pytest.raises(InputError, match="formula without a value"):
            read_inventory(path)


def test_a_repeated_header_goes_on_also_with_units_below(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    head = "Bezeichnung;Tiefe;Breite;Höhe\n;cm;cm;cm\n"
    rows = "B;20;60;200\nC;20;60;200\n"
    items = read(tmp_path, f"{head}A;60;60;180\n{head}{rows}")
    assert [(item.name, item.height) for item in items] == [("A", 1.8), ("B", 2.0), ("C", 2.0)]
    assert "as the header again: line 4–5" in caplog.text


def test_a_second_table_is_left_out_with_all_its_rows(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    first = "Name,Depth,Height\nA,40 cm,180 cm\nB,30 cm,190 cm\n"
    second = "Name,Depth_m,Height_m,Mass_kg\nC,0.3,1.9,50\nD,0.3,1.9,50\n"
    assert [item.name for item in read(tmp_path, first + second)] == ["A", "B"]
    assert "another table, to the end: line 4–6" in caplog.text


@pytest.mark.parametrize("cell", ["45³", "35¹", "½", "②"])
def test_signs_of_footnotes_are_no_digits(tmp_path: Path, cell: str) -> None:
    with pytest.raises(InputError, match="expected a positive number"):
        read(tmp_path, f"Name,Depth_cm,Height_cm\nA,{cell},180\n")


def test_a_slip_keeps_its_unit_and_other_words_are_no_slips(tmp_path: Path) -> None:
    (item,) = read(tmp_path, "Name,Depth ft,Overall heigth ft\nA,1.5,4.5\n")
    assert item.height == pytest.approx(4.5 * 0.3048)
    text = "Bezeichnung;Tiefe cm;Höhe cm;Schwerpunkt x cm\nA;60;180;30\n"
    assert read(tmp_path, text)[0].body.cg_height == 0.9  # in the middle, as nothing says else


def test_a_mapping_holds_beside_units_from_elsewhere(tmp_path: Path) -> None:
    text = "All sizes in cm\nName,Depth,D2,Height (total)\nA,90,40,180\n"
    mapping = tmp_path / "list.csv.columns.toml"
    mapping.write_text('[columns]\nDepth = ""\nD2 = "depth"\nHeight = "height"\n')
    (item,) = read(tmp_path, text.replace("Height (total)", "Height"))
    assert (item.body.base, item.height) == (0.4, 1.8)
    mapping.write_text('[columns]\nDepht = ""\n')
    with pytest.raises(InputError, match="no column of the list is called 'depht'"):
        read(tmp_path, text)


def test_words_of_sums_in_other_columns_are_no_totals(tmp_path: Path) -> None:
    text = "Prioridad,Nombre,Fondo_m,Alto_m\nalta,A,0.4,1.8\nmean,B,0.3,1.9\n,Total,1,1\n"
    assert [item.name for item in read(tmp_path, text)] == ["A", "B"]
    assert [item.name for item in read(tmp_path, "Name,Depth_m,Height_m\n1,1,1\n")] == ["1"]


def test_a_name_alone_at_the_end_is_an_object_without_sizes(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    rows = "Name,Depth_m,Height_m\nA,0.3,1.8\n"
    assert [item.name for item in read(tmp_path, f"{rows}Oxygen rack,,\n")] == ["A"]
    assert "1 not assessed" in caplog.text
    assert "'Oxygen rack' (line 3)" in caplog.text
    assert len(read(tmp_path, f"{rows}\nOxygen racks see other list,,\n")) == 1


def test_a_centre_of_gravity_that_cannot_be_read_gives_no_class(tmp_path: Path) -> None:
    text = "Name,Depth_m,Height_m,cg_height_m,eccentricity\nA,0.6,1.8,high,oben\n"
    assert read(tmp_path, text)[0].unread == ("cg_height_m", "eccentricity")


def test_units_that_contradict_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="the unit is m in the column's name, and ft below it"):
        read(tmp_path, "Name,Depth (m),Height (m)\n,ft,ft\nA,1.5,4.5\n")


def test_a_heading_above_ends_where_columns_have_their_own(tmp_path: Path) -> None:
    rows: list[list[object]] = [
        [None, "Base [cm]", None, None, None],
        ["Name", "Depth", "Width", "Height_m", "Wall gap"],
        ["A", 30, 90, 1.8, 0.05],
    ]
    (item,) = read_inventory(excel(tmp_path, rows, "B1:C1"))
    assert item.surroundings is not None
    assert (item.body.base, item.height, item.surroundings.walls[0].gap) == (0.3, 1.8, 0.05)


def test_what_is_merged_over_rows_is_each_ones_but_for_amounts(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    rows: list[list[object]] = [
        ["Name", "Depth_m", "Height_m", "Quantity", "Mass_kg"],
        ["A", 0.3, 1.8, 3, 90], ["B", 0.4, 1.8, None, None],
    ]  # fmt: skip
    first, second = read_inventory(excel(tmp_path, rows, "D2:D3", "E2:E3"))
    assert (first.quantity, second.quantity, first.mass, second.mass) == (1, 1, None, None)
    assert "Quantity: is merged over several rows" in caplog.text
