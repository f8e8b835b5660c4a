"""Spreadsheets and text tables as people have them: read, or refused with the cell's name."""

from __future__ import annotations

import datetime as dt
import io
import zipfile
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook, load_workbook

from shaketable import InputError
from shaketable.building.typical import STRUCTURES
from shaketable.cli.template import template
from shaketable.inventory import (
    BaseShape,
    Castors,
    Item,
    read_inventory,
    read_with_columns,
    solid_of,
)
from shaketable.inventory.template import LENGTHS, inventory_template
from shaketable.tables.open_document import remarks
from shaketable.tables.packed import LARGEST
from shaketable.tables.template import write_template

TABLE = [
    ["name", "depth_m", "width_m", "height_m", "quantity"],
    ["shelf", 0.32, 0.9, 1.8, 4],
    ["Schränkchen", 0.4, 0.5, 0.62, 1],
]


def excel(path: Path, rows: list[list[object]], title: str = "Sheet") -> Workbook:
    book = Workbook()
    sheet = book.worksheets[0]
    sheet.title = title
    for row in rows:
        sheet.append(row)
    book.save(path)
    return book


def open_document(path: Path, rows: list[list[object]]) -> None:
    """The smallest .ods that a spreadsheet program would read."""

    def cell(value: object) -> str:
        if value is None:
            return "<table:table-cell/>"
        if isinstance(value, str):
            return (
                '<table:table-cell office:value-type="string">'
                f"<text:p>{value}</text:p></table:table-cell>"
            )
        if isinstance(value, dt.date):
            return (
                f'<table:table-cell office:value-type="date" office:date-value="{value}">'
                f"<text:p>{value}</text:p></table:table-cell>"
            )
        return (
            f'<table:table-cell office:value-type="float" office:value="{value}">'
            f"<text:p>{value}</text:p></table:table-cell>"
        )

    lines = "".join(f"<table:table-row>{''.join(map(cell, row))}</table:table-row>" for row in rows)
    urn = "urn:oasis:names:tc:opendocument:xmlns"
    content = (
        f'<?xml version="1.0"?><office:document-content xmlns:office="{urn}:office:1.0" '
        f'xmlns:table="{urn}:table:1.0" xmlns:text="{urn}:text:1.0" office:version="1.2">'
        f'<office:body><office:spreadsheet><table:table table:name="Objects">{lines}</table:table>'
        "</office:spreadsheet></office:body></office:document-content>"
    )
    kind = "application/vnd.oasis.opendocument.spreadsheet"
    manifest = (
        f'<?xml version="1.0"?><manifest:manifest xmlns:manifest="{urn}:manifest:1.0">'
        f'<manifest:file-entry manifest:full-path="/" manifest:media-type="{kind}"/>'
        '<manifest:file-entry manifest:full-path="content.xml" manifest:media-type="text/xml"/>'
        "</manifest:manifest>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", kind)
        archive.writestr("content.xml", content)
        archive.writestr("META-INF/manifest.xml", manifest)


def same(items: list[Item]) -> None:
    """The items are those of TABLE."""
    assert [(item.name, item.body.base, item.height, item.quantity) for item in items] == [
        ("shelf", 0.32, 1.8, 4),
        ("Schränkchen", 0.4, 0.62, 1),
    ]
    assert [item.sideways and item.sideways.base for item in items] == [0.9, 0.5]


def text(separator: str, comma: bool = False) -> str:
    def cell(value: object) -> str:
        return str(value).replace(".", ",") if comma and isinstance(value, float) else str(value)

    return "".join(separator.join(map(cell, row)) + "\n" for row in TABLE)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize(("separator", "comma"), [(",", False), (";", False), (";", True),
                                                  ("\t", False), ("\t", True)])  # fmt: skip
def test_text(tmp_path: Path, encoding: str, separator: str, comma: bool) -> None:
    path = tmp_path / "things.csv"
    path.write_bytes(text(separator, comma).encode(encoding))
    same(read_inventory(path))


def test_spreadsheets(tmp_path: Path) -> None:
    excel(tmp_path / "a.xlsx", TABLE)
    open_document(tmp_path / "a.ods", TABLE)
    for name in ("a.xlsx", "a.ods"):
        same(read_inventory(tmp_path / name))
    # what it is decides, not what it is called
    (tmp_path / "a.ods").rename(tmp_path / "b.csv")
    same(read_inventory(tmp_path / "b.csv"))


def test_titles_blank_rows_and_cells_beside(tmp_path: Path) -> None:
    rows: list[list[object]] = [["Inventory of ward 3"], [], *[[None, *row] for row in TABLE], []]
    path = tmp_path / "a.xlsx"
    excel(path, rows)
    same(read_inventory(path))


@pytest.mark.parametrize(
    ("header", "factor"),
    [
        (["Item", "Depth (cm)", "Width [cm]", "HEIGHT_CM", "Qty"], 0.01),
        (["OBJECT", "depth_mm", "Width (mm)", "height mm", "Count"], 0.001),
        (["Equipment", "Depth in", "width_in", "Height (inches)", "Pieces"], 0.0254),
        (["asset", "depth (ft)", "width_ft", "Height (feet)", "qty"], 0.3048),
    ],
)
def test_headers_and_units(tmp_path: Path, header: list[str], factor: float) -> None:
    rows = [header, ["shelf", 0.32 / factor, 0.9 / factor, 1.8 / factor, 4]]
    excel(tmp_path / "a.xlsx", rows)
    found = read_with_columns(tmp_path / "a.xlsx")
    (item,) = found.items
    assert (item.body.base, item.height) == pytest.approx((0.32, 1.8))
    assert item.sideways is not None
    assert item.sideways.base == pytest.approx(0.9)
    assert item.quantity == 4
    meanings = [column.meaning for _, column in found.columns if column]
    assert meanings == ["name", "depth", "width", "height", "quantity"]


def test_words_and_masses(tmp_path: Path) -> None:
    rows = [
        ["name", "depth_m", "height_m", "castors", "mass_lb", "critical", "blocks_exit",
         "people_nearby", "must_not_fall", "anchored"],
        ["a", 0.5, 1.0, "Free", 100, 3, "Yes", "n", "x", "no"],
        ["b", 0.5, 1.0, "locked", None, "yes", True, None, "no", 1],
        ["c", 0.5, 1.0, "-", 10, "", False, "TRUE", "", ""],
    ]  # fmt: skip
    excel(tmp_path / "a.xlsx", rows)
    a, b, c = read_inventory(tmp_path / "a.xlsx")
    assert [item.castors for item in (a, b, c)] == [Castors.FREE, Castors.LOCKED, Castors.NONE]
    assert a.mass == pytest.approx(45.359237)
    assert b.mass is None
    assert [item.critical for item in (a, b, c)] == [3, 5, 0]
    assert (a.blocks_exit, a.people_nearby, a.must_not_fall, a.anchored) == (
        True,
        False,
        True,
        False,
    )
    assert (b.blocks_exit, b.anchored, c.people_nearby) == (True, True, True)
    assert a.sideways is None
    assert a.depth_known


@pytest.mark.parametrize(
    ("column", "value", "said"),
    [
        ("mass_kg", -1, "expected a positive number, found '-1'"),
        ("quantity", 1e9, "at most 1,000,000"),
        ("height_m", dt.date(2026, 8, 1), "holds a date"),
        ("height_m", "#REF!", "holds the error #REF!"),
        ("height_m", "=A1*2", "cell C2, height_m: a formula without a value"),
        ("height_m", "1.8 furlongs", "write the number, in m, or one of m, "),
    ],
)
def test_bad_cells(tmp_path: Path, column: str, value: object, said: str) -> None:
    header = ["name", "depth_m", column] + ([] if column == "height_m" else ["height_m"])
    excel(tmp_path / "a.xlsx", [header, ["shelf", 0.3, value, 1.8][: len(header)]])
    with pytest.raises(InputError, match=r"a\.xlsx") as raised:
        read_inventory(tmp_path / "a.xlsx")
    assert said in str(raised.value)


def test_a_date_in_an_open_document(tmp_path: Path) -> None:
    open_document(tmp_path / "a.ods", [*TABLE, ["x", 0.3, 0.4, dt.date(2026, 8, 1), 1]])
    with pytest.raises(InputError, match=r"cell D4, height_m: holds a date"):
        read_inventory(tmp_path / "a.ods")


def test_merged_cells(tmp_path: Path) -> None:
    book = excel(tmp_path / "a.xlsx", [*TABLE, ["x", 0.3, 0.4, 1.0, 1]])
    book.worksheets[0].merge_cells("B2:B3")
    book.save(tmp_path / "a.xlsx")
    first, second, *_ = read_inventory(tmp_path / "a.xlsx")
    assert first.body.base == second.body.base
    assert first.name != second.name


def test_merged_cells_of_an_ods(tmp_path: Path) -> None:
    """The value in them is that of each row; rows below a file's two are a third and a fourth."""
    tall = (
        '<table:table-cell table:number-rows-spanned="2" office:value-type="float" '
        'office:value="1.8"/>'
    )
    ods_cells(tmp_path / "a.ods", f"{NAMED}{NUMBER}{NUMBER}{tall}")
    assert read_inventory(tmp_path / "a.ods")[-1].height == 1.8
    noted = remarks(tmp_path / "a.ods", (tmp_path / "a.ods").read_bytes())
    assert [(each.kind, each.rows, each.columns) for each in noted] == [("merged", 2, 1)]


def test_what_nothing_reads_may_hold_anything(tmp_path: Path) -> None:
    """A date of inspection, an error in a sum: they stand in columns that mean nothing here."""
    header = ["name", "depth_m", "height_m", "inspected", "cost", "tax"]
    row = ["shelf", 0.3, 1.8, dt.date(2026, 8, 1), "#REF!", "=A1*2"]
    excel(tmp_path / "a.xlsx", [header, row])
    (shelf,) = read_inventory(tmp_path / "a.xlsx")
    assert shelf.height == 1.8


def test_hidden_cells_are_read_and_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    book = excel(tmp_path / "a.xlsx", TABLE)
    book.worksheets[0].column_dimensions["C"].hidden = True
    book.worksheets[0].row_dimensions[3].hidden = True
    book.save(tmp_path / "a.xlsx")
    same(read_inventory(tmp_path / "a.xlsx"))
    assert "hidden cells are read like others: column C, row 3" in caplog.text


def test_several_sheets(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    book = excel(tmp_path / "a.xlsx", TABLE, "East wing")
    other = book.create_sheet("West wing")
    other.append(["notes"])
    book.create_sheet("empty")
    book.save(tmp_path / "a.xlsx")
    # the only one with the header of an inventory is taken, and the other is named
    same(read_inventory(tmp_path / "a.xlsx"))
    assert "sheets that are not read: 'West wing'" in caplog.text
    for row in TABLE:
        other.append(row)
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(InputError, match="'East wing' has the most rows, 2; name it by --sheet"):
        read_inventory(tmp_path / "a.xlsx")
    same(read_inventory(tmp_path / "a.xlsx", sheet="east wing "))
    said = tmp_path / "a.xlsx.columns.toml"  # beside the list: also where no option names a sheet
    said.write_text('sheet = "East wing"\n')
    same(read_inventory(tmp_path / "a.xlsx"))
    assert read_with_columns(tmp_path / "a.xlsx").said_in == said
    said.unlink()
    with pytest.raises(InputError, match="has no sheet 'North'; it has 'East wing', 'West wing'"):
        read_inventory(tmp_path / "a.xlsx", sheet="North")
    (tmp_path / "a.csv").write_text("name,depth_m,height_m\na,0.3,1\n")
    with pytest.raises(InputError, match="is a text, which has no sheet 'North'"):
        read_inventory(tmp_path / "a.csv", sheet="North")
    book.worksheets[0].title = "Inventory"
    book.save(tmp_path / "a.xlsx")
    with pytest.raises(InputError, match="'West wing' holds 3: which of them is the list"):
        read_inventory(tmp_path / "a.xlsx")
    other.delete_rows(2)
    book.save(tmp_path / "a.xlsx")
    same(read_inventory(tmp_path / "a.xlsx"))


def test_macros_are_left_alone(tmp_path: Path) -> None:
    excel(tmp_path / "a.xlsx", TABLE)
    with zipfile.ZipFile(tmp_path / "a.xlsx", "a") as archive:
        archive.writestr("xl/vbaProject.bin", b"\0" * 100)
    same(read_inventory(tmp_path / "a.xlsx"))


def test_what_is_no_spreadsheet(tmp_path: Path) -> None:
    path = tmp_path / "a.xlsx"
    excel(path, [[]])
    with pytest.raises(InputError, match="no sheet holds anything"):
        read_inventory(path)
    whole = b"PK" + bytes(range(200))
    path.write_bytes(whole)
    with pytest.raises(InputError, match="a damaged spreadsheet"):
        read_inventory(path)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("word/document.xml", "x")
    with pytest.raises(InputError, match=r"neither \.xlsx nor \.ods"):
        read_inventory(path)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b" " * (LARGEST + 1))
    with pytest.raises(InputError, match="at most 20 MB are read"):
        read_inventory(path)
    path.write_bytes(b"\xd0\xcf\x11\xe0" + b"\0" * 500)  # the .xls of before 2007
    with pytest.raises(InputError, match=r"accepted: CSV, \.xlsx, \.ods"):
        read_inventory(path)


@pytest.mark.parametrize(
    ("sizes", "said"),
    [
        ((32, 90, 180), "0.32 m, if it is in cm"),
        ((320, 900, 1800), "0.32 m, if it is in mm"),
        ((0.3, 0.01, 1.8), "0.01 m is not to be expected of furniture"),
        ((0.3, 0.9, 12.0), "0.12 m, if it is in cm"),
    ],
)
def test_sizes_in_the_wrong_unit(
    tmp_path: Path, sizes: tuple[float, float, float], said: str
) -> None:
    path = tmp_path / "a.xlsx"
    excel(path, [TABLE[0], *[[f"thing {n}", *sizes, 1] for n in range(30)]])
    with pytest.raises(InputError) as raised:
        read_inventory(path)
    lines = str(raised.value).splitlines()
    assert said in lines[0] or said in lines[1]
    assert "cell" in lines[0]
    # the remedy stands once, however many rows there are, and of like faults the first three
    assert len(lines) <= 3 * 3 + 2
    assert sum("--accept-sizes" in line for line in lines) == 1
    assert len(read_inventory(path, accept_sizes=True)) == 30


def test_one_row_a_hundred_times_the_others(tmp_path: Path) -> None:
    path = tmp_path / "a.xlsx"
    rows = [[f"thing {n}", 0.03, 0.04, 0.3, 1] for n in range(5)]
    excel(path, [TABLE[0], *rows, ["other", 4.0, 0.04, 0.3, 1]])
    with pytest.raises(InputError, match="cell B7, depth_m: 4 m is 133 times what the other rows"):
        read_inventory(path)
    assert len(read_inventory(path, accept_sizes=True)) == 6


def test_a_centre_of_gravity_above_the_body(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("name,depth_m,height_cm,cg_height_m\na,0.5,100,2\n")
    with pytest.raises(InputError, match="line 2, cg_height_m: 2 m is not inside the body"):
        read_inventory(path)


def test_width_alone_is_taken_for_the_depth(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("name,width_m,height_m\nbookcase,0.9,1.8\n")
    (item,) = read_inventory(path)
    assert (item.body.base, item.depth_known, item.sideways) == (0.9, False, None)


@pytest.mark.parametrize(
    ("name", "note", "castors"),
    [
        ("Crash cart", "", Castors.UNKNOWN),
        ("WorkQueue", "on castors", Castors.UNKNOWN),
        ("IV pole", "", Castors.UNKNOWN),
        ("Ventilator", "", Castors.UNKNOWN),
        ("Carton", "wheelbarrows are elsewhere", Castors.NONE),
    ],
)
def test_castors_in_words_are_asked_for(
    tmp_path: Path, name: str, note: str, castors: Castors, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"name,depth_m,height_m,castors,note\n{name},0.5,1.0,,{note}\n")
    (item,) = read_inventory(path)
    assert item.castors is castors
    assert ("may stand on castors" in caplog.text) == (castors is Castors.UNKNOWN)
    path.write_text(f"name,depth_m,height_m,castors,note\n{name},0.5,1.0,none,{note}\n")
    assert read_inventory(path)[0].castors is Castors.NONE


@pytest.mark.parametrize("name", ["inventory.csv", "inventory.xlsx"])
@pytest.mark.parametrize("language", ["en", "es", "de", "it", "ja"])
def test_the_template_is_an_inventory(tmp_path: Path, name: str, language: str) -> None:
    """In each language and unit the same objects; every heading is understood."""
    path = tmp_path / name
    for lengths in LENGTHS:
        chosen = inventory_template(language, lengths=lengths, every=lengths == "m")
        write_template(path, chosen)
        found = read_with_columns(path)
        assert all(column is not None for _, column in found.columns)
        assert set(chosen.explained) == {header for header, _ in found.columns}
        assert [round(item.body.base, 3) for item in found.items] == [0.32, 0.6, 0.23, 0.5]
        assert [item.shape for item in found.items][2] is BaseShape.CYLINDER
        assert found.items[3].castors is Castors.LOCKED
        assert (found.items[0].blocks_exit, found.items[2].must_not_fall) == (True, True)
        assert found.building is None
    with pytest.raises(InputError, match="exists"):
        template(path)


@pytest.mark.parametrize("language", ["en", "es", "de", "it", "ja"])
def test_its_menus_are_understood(tmp_path: Path, language: str) -> None:
    """Every word of every menu, also of the building's sheet; a period follows from that."""
    path = tmp_path / "inventory.xlsx"
    chosen = inventory_template(language)
    write_template(path, chosen)
    menus = load_workbook(path).worksheets[0].data_validations.dataValidation
    assert sum(each.type == "list" for each in menus) == len(chosen.menus) + len(chosen.suggested)
    assert all(len(each.formula1) <= 255 for each in menus)  # the most that Excel opens
    columns = {name: k for k, name in enumerate(chosen.explained, 1)}
    ((building, questions),) = chosen.asked.items()
    structures = next(each.menu for each in questions if each.menu)
    for structure, known in zip(structures, STRUCTURES, strict=True):
        book = load_workbook(path)
        sheet = book.worksheets[0]
        for name, words in chosen.menus.items():
            for row in range(2, 6):
                sheet.cell(row, columns[name], words[row % len(words)])
        for k, value in enumerate(("Wing", 3, structure, 3.0), 1):
            book[building].cell(k, 2, value)
        book.save(tmp_path / "filled.xlsx")
        found = read_with_columns(tmp_path / "filled.xlsx")
        assert len(found.items) == 4
        assert found.building == {
            "name": "Wing", "storeys": 3, "structure": known, "storey_height_m": 3.0,
        }  # fmt: skip


def test_a_building_that_is_half_said_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.xlsx"
    for cells, said in (
        (("", 3, None), "does not say both storeys and structure"),
        (("", None, None, 4.5), "does not say both storeys and structure"),
        (("", "=2+3", "timber"), "a formula without a value"),
        (("", "three", "timber"), "expected a positive number, found 'three'"),
        (("", 2.5, "timber"), "expected a whole number, found 2.5"),
        (("", 2, "straw"), "expected concrete frame, steel frame.*found 'straw'"),
    ):
        write_template(path, inventory_template())
        book = load_workbook(path)
        for k, value in enumerate(cells, 1):
            book["Building"].cell(k, 2, value)
        book.save(path)
        with pytest.raises(InputError, match=said):
            read_inventory(path)


def test_a_column_that_means_nothing_is_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    excel(tmp_path / "a.xlsx", [[*row, "Acme"] for row in TABLE])
    (item, *_) = read_inventory(tmp_path / "a.xlsx")
    assert "columns that are not used: 'Acme'" in caplog.text
    assert item.unread == ()


def csv(path: Path, text: str) -> list[Item]:
    path.write_text(text)
    return read_inventory(path)


@pytest.mark.parametrize(
    ("mass", "found"),
    [
        ("1.100,5", 1100.5),
        ("1,100.5", 1100.5),
        ("110,5", 110.5),
        ("110 kg", 110.0),
        ("0.11 t", 110),
    ],
)
def test_masses_as_people_write_them(tmp_path: Path, mass: str, found: float) -> None:
    (item,) = csv(tmp_path / "a.csv", f"name;depth_m;height_m;mass_kg\nx;0,9;1,8;{mass}\n")
    assert item.mass == pytest.approx(found)


@pytest.mark.parametrize(
    "text",
    [
        "name;depth_m;height_m;mass_kg\nx;0,9;1,8;1.100\n",  # beside decimal commas
        "name;depth_m;height_m;mass_kg\nx;0.9;1.8;1,100\n",  # beside decimal points
        "name;depth_m;height_m;quantity\nx;2;3;1,000\n",  # nothing tells
    ],
)
def test_a_thousand_or_one(tmp_path: Path, text: str) -> None:
    with pytest.raises(InputError, match=r"which may be 1(\.1)? or 1[01]00"):
        csv(tmp_path / "a.csv", text)
    rows = [line.split(";") for line in text.splitlines()]
    excel(tmp_path / "a.xlsx", rows)  # numbers as text
    with pytest.raises(InputError, match="which may be"):
        read_inventory(tmp_path / "a.xlsx")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,depth_m,height_m,mass_kg\na,0.5,1.8,11000000\n", "kg/m³ are expected"),
        ("name,depth_m,height_m,mass_kg\na,0.5,1.8,0.01\n", "kg/m³ are expected"),
        ("name,depth_m,height_m,cg_height_m\na,0.6,1.8,0.0011\n", "is it in another unit"),
        ("name,depth_m,height_cm,support_length_m\na,0.6,180,100\n", "100 m is not to be"),
        ("name,diameter_m,height_m,contour_friction\na,0.2,1.8,0.5\n", "0.5 m is not to be"),
        ("name,depth_m,height_m,contour_friction_mm\na,0.2,1.8,1\n", "the rim of a cylinder"),
        ("A,0.6,1.8\nname,depth_m,height_m\nB,0.6,1.8\n", "line 1: numbers stand above"),
        ("name,depth,height,,\nA,0.6,1.8,,hello\n", "a column that the header does not name"),
        ('name,depth,height,quantity,note\nA,0.6,1.8,,"bad\nB,0.5,1.7,"\n', "swallows whole"),
        ("name,diameter_m,depth_m,height_m\nA,0.3,0.3,1.5\n", "beside a depth or width"),
        ("name,length_cm,height_m\nA,30,1.5\n", "is depth .* or width .* meant"),
        ("name,depth,height\nTotal,1,2\n", "holds no objects; .*left out, as totals: line 2"),
        ("name,depth,height\n# A,0.6,1.8\n", "line 2, name: begins with #"),
    ],
)
def test_what_would_be_misread_is_refused(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        csv(tmp_path / "a.csv", text)


def test_diameters(tmp_path: Path) -> None:
    (item,) = csv(tmp_path / "a.csv", "name,Diameter (cm),height_m\ntank,23,1.6\n")
    assert item.body.base == pytest.approx(0.23)
    assert item.sideways == item.body


def test_totals_and_comments_are_left_out_and_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    text = "name,depth,height,quantity\n# as of May,,,\nA,0.6,1.8,3\nTotal,0.6,1.8,3\n"
    # a total station is an instrument, and stays
    text += "Total station,0.3,0.4,1\n"
    assert [item.name for item in csv(tmp_path / "a.csv", text)] == ["A", "Total station"]
    assert "left out, as totals: line 4" in caplog.text
    assert "left out, as comments: line 2" in caplog.text


def test_one_name_in_several_rooms(tmp_path: Path) -> None:
    text = "name,depth,height,room\nShelf,0.3,1.8,a\nShelf,0.4,1.8,b\n"
    assert len(csv(tmp_path / "a.csv", text)) == 2
    assert len(csv(tmp_path / "a.csv", text.replace(",b", ",a"))) == 2  # of another depth
    with pytest.raises(InputError, match="is also on line 2; make the names or locations differ"):
        csv(tmp_path / "a.csv", text.replace("0.4", "0.3").replace(",b", ",a"))


@pytest.mark.parametrize(
    ("name", "note", "said"),
    [
        ("shelf", "bolted to the wall", "may hang, or be fixed"),
        ("Regal verschraubt", "", "may hang, or be fixed"),
        ("Estante fijado al muro", "", "may hang, or be fixed"),
        ("Oxygen cylinder", "", "may have to be kept from falling"),
        ("Wheelchair", "", "may stand on castors"),
        ("shelf", "not bolted", ""),
        ("desk", "no castors", ""),
        ("desk", "not on wheels", ""),
    ],
)
def test_hints(
    tmp_path: Path, name: str, note: str, said: str, caplog: pytest.LogCaptureFixture
) -> None:
    csv(tmp_path / "a.csv", f"name,depth,height,note\n{name},0.5,1.5,{note}\n")
    assert bool(caplog.text) == bool(said)
    assert said in caplog.text


def ods_cells(path: Path, cells: str, row: str = "") -> None:
    """An .ods of TABLE with a row of given cells."""
    open_document(path, TABLE)
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name).decode() for name in archive.namelist()}
    files["content.xml"] = files["content.xml"].replace(
        "</table:table>", f"<table:table-row {row}>{cells}</table:table-row></table:table>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)


NAMED = '<table:table-cell office:value-type="string"><text:p>x</text:p></table:table-cell>'
NUMBER = '<table:table-cell office:value-type="float" office:value="0.5"/>'


@pytest.mark.parametrize(
    ("cell", "said"),
    [
        (
            '<table:table-cell table:formula="of:=1/0" office:value-type="string" '
            'office:string-value=""><text:p>#DIV/0!</text:p></table:table-cell>',
            "cell D4, height_m: holds an error",
        ),
        (
            '<table:table-cell table:formula="of:=[.A1]"/>',
            "cell D4, height_m: a formula without a value",
        ),
    ],
)
def test_what_calamine_does_not_tell_of_an_ods(tmp_path: Path, cell: str, said: str) -> None:
    ods_cells(tmp_path / "a.ods", f"{NAMED}{NUMBER}{NUMBER}{cell}")
    with pytest.raises(InputError, match=said):
        read_inventory(tmp_path / "a.ods")


def test_hidden_rows_of_an_ods(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    cells = f"{NAMED}{NUMBER * 3}"
    ods_cells(tmp_path / "a.ods", cells, 'table:visibility="collapse"')
    assert len(read_inventory(tmp_path / "a.ods")) == 3
    assert "hidden cells are read like others: row 4" in caplog.text


def damaged(raw: bytes, rng: np.random.Generator) -> bytes:
    """A spreadsheet with some bytes of one of its files, or of itself, changed, or cut short."""
    if rng.random() < 0.3:
        return changed(raw, rng, whole=True)
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    name = list(files)[int(rng.integers(len(files)))]
    files[name] = changed(files[name], rng, whole=False)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for each, content in files.items():
            archive.writestr(each, content)
    return out.getvalue()


def changed(raw: bytes, rng: np.random.Generator, *, whole: bool) -> bytes:
    data = bytearray(raw)
    if whole and rng.random() < 0.3:
        return bytes(data[: int(rng.integers(len(data)))])
    for _ in range(int(rng.integers(1, 4))):
        symbol = b'<>"0123456789=/'[int(rng.integers(15))]
        data[int(rng.integers(len(data)))] = rng.choice([symbol, int(rng.integers(256))])
    return bytes(data)


@pytest.mark.parametrize("count", [60, pytest.param(4000, marks=pytest.mark.slow)])
def test_damaged_spreadsheets_are_input_errors_or_read(tmp_path: Path, count: int) -> None:
    rng = np.random.default_rng(count)
    excel(tmp_path / "a.xlsx", TABLE)
    open_document(tmp_path / "a.ods", TABLE)
    wholes = [(tmp_path / name).read_bytes() for name in ("a.xlsx", "a.ods")]
    read, messages = 0, ""
    for _ in range(count):
        path = tmp_path / "damaged"
        path.write_bytes(damaged(wholes[int(rng.integers(2))], rng))
        try:
            read += len(read_inventory(path)) > 0
        except InputError as error:
            messages += str(error).replace("\n", "")
    assert messages.isprintable()
    assert 0.05 < read / count < 0.95  # neither all nor none was refused


def test_a_tag_that_never_ends_is_an_error(tmp_path: Path) -> None:
    """Found by damaging documents at random: the library that reads them went on for ever."""
    whole, cut = tmp_path / "whole.ods", tmp_path / "cut.ods"
    open_document(whole, TABLE)
    with zipfile.ZipFile(whole) as old, zipfile.ZipFile(cut, "w") as new:
        for name in old.namelist():
            new.writestr(name, old.read(name).replace(b"</table:table>", b"</table:table&"))
    with pytest.raises(InputError, match=r"cannot be read as \.ods"):
        read_inventory(cut)


def test_losses_reach_the_solid(tmp_path: Path) -> None:
    """In millimetres, in metres, in Spanish and German, of a circle and of a rectangle."""
    path = tmp_path / "list.csv"
    path.write_text(
        "name,diameter_m,height_m,Fricción de rodadura (mm),Konturreibung_mm,drilling_friction_m\n"
        "bottle,0.2,1.4,2,0.3,0.001\nurn,0.2,1.4,,,\n"
    )
    bottle, urn = (solid_of(item, 0.01) for item in read_inventory(path))
    assert bottle is not None
    assert urn is not None
    assert bottle.rolling_friction == pytest.approx(2e-3)
    assert bottle.contour_friction == pytest.approx(3e-4)
    assert bottle.drilling_friction == pytest.approx(1e-3)
    assert (urn.rolling_friction, urn.contour_friction, urn.drilling_friction) == (0.0, 0.0, 0.0)
    path.write_text(
        "name,depth_m,width_m,height_m,castors,rolling_friction_mm\n"
        "box,0.2,0.3,1.4,none,2\ncart,0.2,0.3,1.4,free,2\n"
    )
    for item in read_inventory(path):
        solid = solid_of(item, 0.01)
        assert solid is not None
        assert solid.rolling_friction == pytest.approx(2e-3)
